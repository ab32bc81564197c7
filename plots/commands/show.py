"""bvhbench show: prints a result file as tables."""
import answer
import clusters
import command
import given
import results
from console import accuracy, best, builders, cell, cells, cluster, frames, skips, stress, swept, trees
from console import run as run_page


def parser() -> command.Parser:
    words = command.Parser("show", "Print a result file as tables", "Prints what the command that wrote the file did.",
                           [("bvhbench show peers.json", "its tables"), ("bvhbench show out", "of every file below a folder"),
                            ("bvhbench show peers.json --wide", "with all columns")], "docs/result-files.md")
    words.add_argument("files", nargs="+", metavar="FILE", help="result files, or folders of them")
    return words


def main(words: list[str]) -> int:
    files = given.files_of(parser().parse_args(words).files)
    for number, file in enumerate(files):
        heading = f"{chr(10) * (number > 0)}== {file.path}\n" if len(files) > 1 else ""
        print(heading, text(str(file.path)), sep="", end="")
    return 0


def text(file: str) -> str:
    if clusters.kind_of(file):
        return cluster.text(clusters.read(file))
    run = results.everything(file)
    try:
        return answer.of_cells(run.all_cells) + answer.warning_lines(run.all_cells) + run_page.text(run) + run_page.merged(run) + pages(run)
    except KeyError as missing:
        raise results.Refused(f"{file}: a cell has no {missing}") from missing


def pages(run: results.Run) -> str:
    """Returns the tables for the file's contents: axes of accuracy, stress, frames of `collide`, one cell, or an experiment."""
    if axes := accuracy.text(run):
        return axes
    if run.stress:
        return stress.text(run)
    if run.all_cells and all(one.experiment == "collide" for one in run.all_cells):
        whole = cell.text(run.all_cells[0], run) if len(run.all_cells) == 1 else frames.each(run)
        return whole + swept.text(run) + skips.text(run)
    if len(run.all_cells) == 1:
        return cell.text(run.all_cells[0], run)
    if all(one.experiment == skips.EXPERIMENT for one in run.all_cells):
        return cells.text(run) + skips.of_scenes(run)
    pages_of = (cells.text, builders.text, frames.text, swept.text, trees.refits, trees.quality, trees.roofline, trees.yardstick, skips.of_scenes,
                best.families_of)
    return "".join(page(run) for page in pages_of)
