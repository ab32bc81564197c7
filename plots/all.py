#!/usr/bin/env python3
"""Every figure that result files can make.

    plots/all.py FILE_OR_FOLDER... --out DIR

A folder stands for all result files below it; their pictures go into folders of the same names below DIR.
Other JSON files are passed over, and so are files of a folder that no figure is made of. A file without cells of an experiment
with a figure of its own gets bars of medians (overview.py). Exits 0; 2 for wrong usage; 3 if a
file cannot be read or drawn.
"""
import argparse
import collections
import pathlib
import sys

import accuracy
import clusters
import family_bars
import fig10
import fig13
import fig8
import fig9
import figure
import frames
import given
import output
import overview
import pareto_orders
import ranks
import results
import roofline
import scaling
import skips
import stress
import style
import sweeps
import swept
import table1
import table2
import table3
import table4

# The figure of each experiment. To add a figure, add its line here.
FIGURES: dict[str, figure.Draw] = {
    "table1": table1.draw,
    "table4": table4.draw,
    "fig8": fig8.draw,
    "fig13": fig13.draw,
    "quality": pareto_orders.draw,
    "orders": pareto_orders.draw,
    "scaling": scaling.draw,
    "roofline": roofline.draw,
}

# The figures of experiments over whole frames.
FRAME_FIGURES: dict[str, dict[str, figure.Draw]] = {
    "table2": {"table2": table2.draw, "fig9": fig9.draw, "fig10": fig10.draw},
    "table3": {"table3": table3.draw},
    "swept": {"swept": swept.draw},
    skips.EXPERIMENT: {skips.EXPERIMENT: skips.draw},
    **{name: {name: draw} for name, draw in (frames.FIGURES | family_bars.FIGURES).items()},
}


def pictures_of(run: results.Run) -> figure.Figures:
    """Returns every figure that the file has cells for, by the name of its picture."""
    draws = {name: draw for name, draw in FIGURES.items() if run.of(name)} | accuracy.draws_of(run)
    if run.stress:
        draws["stress"] = stress.draw
    for experiment, of_frames in FRAME_FIGURES.items():
        draws |= of_frames if run.all_frames(experiment) else {}
    draws |= sweeps.figures_of(run)
    return figure.named(run, draws or overview.draws_of(run))


def held(run: results.Run) -> str:
    """Returns the experiments in a file, with their numbers of cells, as text for a message."""
    counts = collections.Counter(cell.experiment for cell in run.cells)
    counts.update(cell.experiment for cell in run.without_numbers)
    named = [f"{name} ({count} cell{'' if count == 1 else 's'})" for name, count in counts.items()]
    return ", ".join(named) or "no cells"


def drawn(path: pathlib.Path, folder: pathlib.Path, is_of_folder: bool, inputs: list[pathlib.Path], force: bool) -> None:
    """Draws and prints the figures of one file. Raises results.Refused or output.WrongUsage."""
    if clusters.kind_of(path):
        for picture in style.save(ranks.draw(clusters.read(path)), folder, path.name.split(".")[0], [path, *inputs], force):
            print(picture)
        return
    run = results.load(path)
    pictures = pictures_of(run)
    if not pictures and not is_of_folder:
        raise results.Refused(f"{path}: there is no figure of what it holds: {held(run)}; `bvhbench report` makes a page of "
                              "any file")
    for picture in figure.save_all(run, pictures, folder, [path, *inputs], force):
        print(picture)


def draw_all(files: list[pathlib.Path], out: pathlib.Path, force: bool) -> list[str]:
    """Draws everything that can be drawn and returns one message for each file that cannot. Raises output.WrongUsage."""
    style.set_up()
    refusals = []
    for one in given.files_of(files):
        try:
            drawn(pathlib.Path(one.path), out / one.below, one.is_of_folder, files, force)
        except results.Refused as refusal:
            refusals.append(str(refusal))
    return refusals


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("given", nargs="+", type=pathlib.Path, metavar="FILE_OR_FOLDER")
    figure.add_output(parser, required=True)
    arguments = parser.parse_args()

    def draw() -> int:
        refusals = draw_all(arguments.given, arguments.out, arguments.force)
        for refusal in refusals:
            output.say(refusal)
        return 3 if refusals else 0

    return output.to_an_end(draw)


if __name__ == "__main__":
    sys.exit(main())
