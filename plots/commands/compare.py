"""bvhbench compare: compares a result file with an earlier one."""
import pathlib

from ..comparing import axes, comparison, comparison_text, ranks, sides
from ..comparing.refusals import Rules, require_comparable
from ..files import documents, output
from ..program import command
from ..read import rank_files
from ..read.cells import Cell


def parser() -> command.Parser:
    words = command.Parser(
        "compare", "Compare result files with earlier ones, cell by cell; 1 if anything got worse",
        "Times by the spread between processes that ran by turns: SAME, FASTER, SLOWER or UNSURE. Verdicts, counters and errors "
        "exactly. 1 if anything is slower, larger or wrong, so that CI can gate on it.",
        [("bvhbench compare before.json after.json", "what got worse, but for times?"),
         ("bvhbench compare before?.json after?.json", "times too: several processes of each"),
         ("bvhbench compare before?.json after?.json --threshold 10% --all", "coarser, and every cell"),
         ("bvhbench compare peers.json --builders karras,oibvh-single", "two builders in one file")], "docs/comparing.md")
    words.add_argument("files", metavar="FILE", nargs="+", type=pathlib.Path,
                       help="earlier result files, one for each process, and as many later ones; with --builders one may be both")
    words.add_argument("--builders", type=axes.pair_of, help="as karras,oibvh-single: compare cells of the second builder, in B, "
                       "with those of the first, in A; slower is then no regression, and another answer is")
    words.add_argument("--threshold", type=command.share(10), default="5%",
                       help="the smallest change of time that counts, as 5% or 0.05")
    words.add_argument("--all", action="store_true", help="show cells that are unchanged, too")
    words.add_argument("--allow-missing", action="store_true", help="cells and counters that only A has are no regression")
    words.add_argument("--allow-dirty", action="store_true", help="files of programs with changes that no commit has")
    words.add_argument("--other-devices", action="store_true",
                       help="files of two devices: compare verdicts, and times as ratios within a scene")
    words.add_argument("--test-hooks", action="store_true", help=command.argparse.SUPPRESS)  # for the tests of this command
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    files = arguments.files * 2 if len(arguments.files) == 1 and arguments.builders else arguments.files
    if len(files) % 2:
        raise output.WrongUsage(f"as many later files are required as earlier ones, and {len(files)} were given; --builders compares two "
                                "builders in one file")
    if arguments.builders and len(files) > 2:
        raise output.WrongUsage("--builders compares cells of one file or two; `bvhbench merge --processes` makes one file of several")
    half = len(files) // 2
    rules = Rules(threshold=arguments.threshold, allow_missing=arguments.allow_missing, allow_dirty=arguments.allow_dirty,
                  other_devices=arguments.other_devices, allow_test_hooks=arguments.test_hooks, builders=arguments.builders)
    parts = [documents.read(str(name)) for name in files]
    of_ranks = [rank_files.is_of_ranks(document) for document in parts]
    if any(of_ranks):
        if not all(of_ranks):
            raise output.WrongUsage(f"{files[of_ranks.index(False)]} is no file of `bvhbench cluster` or `scale`, and the other is")
        if half > 1:
            raise output.WrongUsage("files of `bvhbench cluster` and `scale` are compared one with one")
        text, regressions = ranks.compare(*zip(files, parts, strict=True), rules, arguments.all)
        print(text, end="")
        return 1 if regressions else 0
    for one, other in zip(range(half), range(half, len(files)), strict=True):
        require_comparable((files[one], parts[one]), (files[other], parts[other]), rules)
    names = files[0], files[half]
    first, second = sides.side_of(files[:half], parts[:half]), sides.side_of(files[half:], parts[half:])
    if rules.builders:
        first, second = axes.between_builders(names, first, second, rules.builders)
    elif not rules.allow_missing:
        axes.require_shared(names, *([Cell(raw) for raw in document["cells"]] for document in (first, second)))
    compared = comparison.compare(first, second, rules)
    print(comparison_text.text(compared, arguments.all), end="")
    return 1 if compared.regressions else 0
