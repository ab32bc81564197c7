"""Every figure that result files can make."""
import collections
import functools
import pathlib

from ..draw import figure, style
from ..read import input_files, results
from . import (accuracy, effects, family_bars, fig10, fig13, fig8, frame_bars, overview, pareto_orders, rank_curves, roofline, scaling,
               skip_bars, stress_map, sweeps, swept_bars, table1, table2, table4)

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
    "table2": {"table2": table2.draw, "fig9": functools.partial(frame_bars.draw, experiment="table2"),
               "fig10": fig10.draw},
    "table3": {"table3": functools.partial(table2.draw, table="table3")},
    "swept": {"swept": swept_bars.draw},
    "effects": {"effects": effects.draw},
    skip_bars.EXPERIMENT: {skip_bars.EXPERIMENT: skip_bars.draw},
    **{name: {name: draw} for name, draw in (frame_bars.FIGURES | family_bars.FIGURES).items()},
}


# Figures that can be asked for by name, whatever else a file has cells for.
NAMED: dict[str, figure.Draw] = FIGURES | {"stress": stress_map.draw} | {
    name: draw for draws in FRAME_FIGURES.values() for name, draw in draws.items()}


def pictures_of(run: results.Run) -> figure.Figures:
    """Returns every figure that the file has cells for, by the name of its picture."""
    draws = {name: draw for name, draw in FIGURES.items() if run.of(name)} | accuracy.draws_of(run) | rank_curves.draws_of(run)
    if run.stress:
        draws["stress"] = stress_map.draw
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


def drawn(one: input_files.Given, out: pathlib.Path, inputs: list[pathlib.Path], force: bool, only: str | None) -> None:
    """Draws the figures of one file, or the one named `only`, and prints their paths. Raises results.Refused or output.WrongUsage."""
    path, folder = pathlib.Path(one.path), out / one.below
    run = results.load(path)
    pictures = figure.named(run, {only: NAMED[only]}) if only else pictures_of(run)
    if not pictures and not one.is_of_folder:
        why = rank_curves.why_none(run) or f"there is no figure of what it holds: {held(run)}; `bvhbench report` makes a page of any file"
        raise results.Refused(f"{path}: {why}")
    for picture in figure.save_all(run, pictures, folder, [path, *inputs], force):
        print(picture)


def draw_all(files: list[pathlib.Path], out: pathlib.Path, force: bool, only: str | None = None) -> list[str]:
    """Draws everything that can be drawn and returns one message for each file that cannot. Raises output.WrongUsage."""
    style.set_up()
    refusals = []
    for one in input_files.files_of(files):
        try:
            drawn(one, out, files, force, only)
        except results.Refused as refusal:
            refusals.append(str(refusal))
    return refusals
