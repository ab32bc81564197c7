"""bvhbench show: prints a result file as tables."""
from ..console import (accuracy_table, best_table, builder_table, cell, cells, effects_table, frame_table, rank_table, run as run_page,
                       skip_table, stress_table, swept_table, trees)
from ..program import command
from ..read import input_files, rank_files, ranking_text, results


def parser() -> command.Parser:
    words = command.Parser("show", "Print a result file as tables", "Prints what the command that wrote the file did.",
                           [("bvhbench show peers.json", "its tables"), ("bvhbench show out", "of every file below a folder"),
                            ("bvhbench show peers.json --wide", "with all columns")], "docs/result-files.md")
    words.add_argument("files", nargs="+", metavar="FILE", help="result files, or folders of them")
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    files = input_files.files_of(arguments.files)
    for number, file in enumerate(files):
        heading = f"{chr(10) * (number > 0)}== {file.path}\n" if len(files) > 1 else ""
        print(heading, text(str(file.path), arguments.wide), sep="", end="")
    return 0


def text(file: str, all_: bool) -> str:
    run = results.everything(file)
    try:
        race = best_table.race(run, all_)
        answer = race or ranking_text.of_cells(run.all_cells) + ranking_text.warning_lines(run.all_cells)
        return answer + run_page.text(run) + run_page.merged(run) + ("" if race else pages(run))
    except KeyError as missing:
        raise results.Refused(f"{file}: a cell has no {missing}") from missing


def pages(run: results.Run) -> str:
    """Returns the tables for the file's contents: axes of accuracy, several ranks, stress, frames of `collide`, one cell, or an experiment."""
    if axes := accuracy_table.text(run):
        return axes
    if rank_files.is_of_ranks(run.document):
        return rank_table.text(run)
    if run.stress:
        return stress_table.text(run)
    if run.all_cells and all(one.experiment == "collide" for one in run.all_cells):
        whole = cell.text(run.all_cells[0], run) if len(run.all_cells) == 1 else frame_table.each(run)
        return whole + swept_table.text(run) + skip_table.text(run)
    if len(run.all_cells) == 1:
        return cell.text(run.all_cells[0], run)
    if all(one.experiment == skip_table.EXPERIMENT for one in run.all_cells):
        return cells.text(run) + skip_table.of_scenes(run)
    pages_of = (cells.text, builder_table.text, frame_table.text, swept_table.text, trees.refits, trees.quality, trees.roofline, trees.yardstick, rank_table.text, skip_table.of_scenes,
                best_table.families_of, effects_table.text)
    return "".join(page(run) for page in pages_of)
