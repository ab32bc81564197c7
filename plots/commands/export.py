"""bvhbench export: writes result files in formats of other programs."""
import argparse

from ..exporting import csv_table, google_benchmark
from ..files import output
from ..files.json_files import Refused
from ..files.reserved import reserved
from ..program import command
from ..read import input_files, rank_files, results

FORMATS = {"google-benchmark": google_benchmark.text, "csv": csv_table.text}
NAMES = "google-benchmark or csv"


def parser() -> command.Parser:
    words = command.Parser(
        "export", "Write result files in a format that other programs read",
        "google-benchmark: the JSON of --benchmark_out, a repetition a sample. csv: a row for each stage of each sample. "
        "Times are nanoseconds.",
        [("bvhbench export peers.json --format csv --out peers.csv", "for a spreadsheet, R or pandas"),
         ("bvhbench export results --format google-benchmark", "all result files of a folder, to standard output")],
        "docs/result-files.md")
    words.add_argument("files", nargs="+", metavar="FILE", help="result files, or folders of them")
    words.add_argument("--format", type=format_named, required=True, help=NAMES)
    words.add_argument("--out", help="the file to write; default: standard output")
    return words


def format_named(name: str) -> str:
    if name not in FORMATS:
        raise argparse.ArgumentTypeError(f"must be {NAMES}, not '{name}'")
    return name


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    out = arguments.out or "/dev/stdout"
    with reserved(out, "--out", arguments.force, arguments.files):
        runs = [run for run in map(loaded, input_files.files_of(arguments.files)) if run]
        if not runs:
            raise Refused("there are no cells to export in these files")
        if output.write(out, FORMATS[arguments.format](runs).encode("utf-8", "replace")):
            print(f"written: {out}")
    return 0


def loaded(file: input_files.Given) -> results.Run | None:
    """Reads a file. Returns None, with a note, for a file of a folder without cells. Raises Refused."""
    run = results.everything(file.path)
    for hook, value in run.facts.get("test_hooks", {}).items():
        raise Refused(f"{file.path}: made under the test hook {hook}={value}: it is no result")
    if run.all_cells and not rank_files.is_of_ranks(run.document):
        return run
    what = "stress" if run.stress else "several ranks" if run.all_cells else ""
    why = f"{file.path}: there are no cells to export in it{f', its results are of {what}' if what else ''}"
    if not file.is_of_folder:
        raise Refused(why)
    output.say(f"bvhbench: {why}")
    return None
