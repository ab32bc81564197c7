"""How near each stage is to its floor: time over what copying its bytes and launching its kernels would take.

A panel a stage, a line a builder, or of the query's stages a collider, against triangles. The floor is the least that a
stage must read and write at the run's own copy rate, and its launches at the run's own cost of one that has nothing to
do. Both axes are logarithmic; a line at 1 is a stage that nothing but the memory and the driver holds up, and below
1 the caches have helped. Builds have one scale, each of the query's stages its own.
"""
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy

from ..draw import figure, pipelines, style
from ..read import results
from ..words import names

COLUMNS = 4


class Line(NamedTuple):
    label: str
    look: style.Look
    points: figure.Curve


def floor_s(run: results.Run, cell: results.Cell, stage: str) -> float | None:
    """Returns the floor in seconds, or None for a stage on the host or without declared bytes."""
    numbers = cell.samples[0].get(stage, {})
    if run.copy_rate is None or not numbers.get("launches") or not numbers.get("moved_bytes"):
        return None
    return numbers["moved_bytes"] / run.copy_rate_of(cell) + numbers["launches"] * run.launch_cost_s


def points(run: results.Run, cells: list[results.Cell], stage: str) -> figure.Curve:
    """Returns the ratios of the stage's times to its floor."""
    def ratios(cell: results.Cell) -> numpy.ndarray:
        floor = floor_s(run, cell, stage) if cell.samples else None
        return cell.times_s(stage) / floor if floor else numpy.empty(0)

    return figure.by_size(cells, ratios)


def build_lines(run: results.Run, stage: str) -> list[Line]:
    cells = run.of("roofline")
    among = style.in_order(cells)
    lines = [Line(style.label(series, among), style.look_in(series, among),
                  points(run, [cell for cell in cells if style.series_of(cell) == series], stage)) for series in among]
    return [line for line in lines if line.points]


def query_lines(run: results.Run, stage: str) -> list[Line]:
    """Returns one line for each collider and tree. Colliders over one tree share its builder's colour, so these have variants' looks, from the
    last on: builds have the first."""
    groups = pipelines.grouped_by_pipeline(run.all_frames("roofline"))
    trees = {style.series_of(cells[0]) for cells in groups if cells[0].builder != "none"}
    lines = []
    for place, cells in enumerate(groups, 1):
        first = cells[0]
        alone = len(trees) == 1 or first.builder == "none"
        label = names.variant(first.collider, dict(first.collider_options)) if alone else first.called
        lines.append(Line(label, style.VARIANT_LOOKS[-place % len(style.VARIANT_LOOKS)], points(run, cells, stage)))
    return [line for line in lines if line.points]


def draw_panel(axes: plt.Axes, stage: str, lines: list[Line], sizes: list[int]) -> None:
    axes.axhline(1, color="black", linewidth=0.8)
    for line in lines:
        figure.band(axes, line.points, lambda ratios: ratios, line.look, 0.2, markersize=3,
                    label=line.label)
    axes.set_title(stage, loc="left")
    figure.powers_of_two(axes, figure.step_between(sizes), 9)
    axes.set(yscale="log", xlabel="triangles", xlim=(min(sizes) / 1.4, max(sizes) * 1.4))


def scale(panels: list[plt.Axes]) -> None:
    """Gives all panels one scale. It starts a little below the floor, or below the smallest value if that is lower."""
    drawn = numpy.concatenate([line.get_ydata() for axes in panels for line in axes.lines])
    low, high = 0.8 * min(1.0, drawn.min()), 1.25 * drawn.max()
    for axes in panels:
        axes.set_ylim(low, high)
        figure.log_ticks(axes.yaxis, low, high)


def draw(run: results.Run) -> plt.Figure:
    builds = {stage: lines for stage in names.OF_BUILDS if (lines := build_lines(run, stage))}
    queries = {stage: lines for stage in names.OF_QUERIES if (lines := query_lines(run, stage))}
    if not builds and not queries:
        raise results.Refused(f"{run.path}: no measured cell of roofline has a stage with a floor")
    stages = builds | queries
    drawing, panels, columns = figure.panels(len(stages), COLUMNS, (0.7, 1.9))
    sizes = [size for lines in stages.values() for line in lines for size, _ in line.points]
    for axes, (stage, lines) in zip(panels, stages.items(), strict=True):
        draw_panel(axes, stage, lines, sizes)
    if builds:
        scale(panels[:len(builds)])
    for axes in panels[len(builds):]:
        scale([axes])
    for axes in panels[::columns]:
        axes.set_ylabel("time over its floor")
    handles: dict[str, plt.Line2D] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    height = figure.legend_above(drawing, list(handles.values()), 3)
    rate = (f"Floor: bytes at {run.copy_rate * 1e-9:,.1f} GB/s, read plus written, and launches at "
            f"{run.launch_cost_s * 1e6:.2g} µs. Medians; bands: 10th to 90th percentile.")
    figure.footer(drawing, run, "roofline", (rate,), height)
    return drawing
