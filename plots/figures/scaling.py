"""How each stage of a whole build grows with the mesh: time and time per triangle against triangles.

A column a stage and one for all of them, a line a builder. Above the median time, below the same divided by the
triangles: a line that falls pays for its launches, one that is level is proportional to the mesh. Stages that
builders share lie over each other.
"""
from collections.abc import Callable

import matplotlib.pyplot as plt
import numpy

from ..draw import figure, style
from ..read import results
from ..words import names

WHOLE = "whole build"
COLUMNS = 4  # of the legend, at most
Times = Callable[[results.Cell], numpy.ndarray]  # seconds, one per sample


def stages_of(cells: list[results.Cell]) -> list[str]:
    """Returns every stage that took time in some cell, in the order of docs/measuring.md."""
    there = {stage for cell in cells for sample in cell.samples for stage in sample}
    return [stage for stage in names.OF_BUILDS if stage in there]


def dress(upper: list[plt.Axes], lower: list[plt.Axes], sizes: list[int]) -> None:
    for axes in (*upper, *lower):
        axes.set_yscale("log")
        figure.powers_of_two(axes, figure.step_between(sizes), 9)
        axes.tick_params(labelleft=axes in (upper[0], lower[0]))
    for line, what in ((upper, "time, ms"), (lower, "per triangle, ns")):
        line[0].set_ylabel(what)
        figure.log_ticks(line[0].yaxis, *line[0].get_ylim())
    for axes in lower:
        axes.set_xlabel("triangles")


def draw(run: results.Run, experiment: str = "scaling", cells: list[results.Cell] | None = None) -> plt.Figure:
    """Draws `cells`, or all of the experiment's cells if none are given."""
    cells = [cell for cell in (run.of(experiment) if cells is None else cells) if cell.samples]
    stages = stages_of(cells)
    if not stages:
        raise results.Refused(f"{run.path}: no measured cell of {experiment} has a stage")
    among = style.in_order(cells)
    columns: dict[str, Times] = {stage: lambda cell, stage=stage: cell.times_s(stage) for stage in stages}
    columns[WHOLE] = lambda cell: cell.times_s()
    drawing, (upper, lower) = figure.grid(2, len(columns), 4.2, sharex=True, sharey="row")
    for place, (name, times) in enumerate(columns.items()):
        upper[place].set_title(name, loc="left")
        for series in among:
            curve = figure.by_size([cell for cell in cells if style.series_of(cell) == series], times)
            points = [(size, seconds) for size, seconds in curve if seconds.p10 > 0]
            sizes = numpy.array([size for size, _ in points])
            for axes, scale in ((upper[place], 1e3), (lower[place], 1e9 / sizes)) if points else ():
                figure.band(axes, points, lambda seconds, scale=scale: scale * seconds, style.look_in(series, among),
                            markersize=3, label=style.label(series, among))
    dress(list(upper), list(lower), [cell.triangles for cell in cells])
    handles = upper[-1].get_legend_handles_labels()[0]
    height = figure.legend_above(drawing, handles, COLUMNS)
    figure.footer(drawing, run, experiment, ("Medians; bands: 10th to 90th percentile.",), height)
    return drawing
