"""bvhbench merge: merges several result files into one."""
from ..files import documents, output
from ..files.reserved import reserved
from ..program import command
from ..read.merging import merge
from ..words.tables import counted


def parser() -> command.Parser:
    words = command.Parser(
        "merge", "Make one result file of several, with each cell once and as it was",
        "Of shards of a sweep, or of runs of parts. Refuses a cell that two files tell differently.",
        [("bvhbench merge out/part-1/sweep.json out/part-2/sweep.json -o sweep.json", "two shards"),
         ("bvhbench merge --processes 1.json 2.json 3.json -o peers.json", "one experiment, run by three processes")],
        "docs/sweeps.md")
    words.add_argument("files", metavar="FILE", nargs="+", help="result files of one format")
    words.add_argument("-o", "--out", required=True, help="the file to write")
    words.add_argument("--processes", action="store_true",
                       help="of the same cells in each file: a cell gets the samples of all, and each says of which process it is")
    words.add_argument("--other-devices", action="store_true", help="even if they were measured on different devices")
    words.add_argument("--other-commits", action="store_true", help="even if different commits of this program measured them")
    return words


def main(words: list[str]) -> int:
    """Returns the exit code: 1 if an answer in the merged file is wrong."""
    arguments = parser().parse_args(words)
    with reserved(arguments.out, "--out", arguments.force, arguments.files):
        parts = [(path, documents.read(path)) for path in arguments.files]
        merged = merge(parts, arguments.other_devices, arguments.other_commits, arguments.processes)
        output.write(arguments.out, merged.text.encode())
    repeated = f"; in more than one file, the same in each: {merged.repeated}" if merged.repeated else ""
    print(f"{counted(merged.cells, 'cell')} of {counted(merged.runs, 'run')}{repeated}\nwritten: {arguments.out}")
    return 1 if merged.differs else 0
