#!/usr/bin/env python3
"""What a better tree costs: time of the whole build against surface area cost, a point a builder and order.

    plots/pareto_orders.py FILE... --out DIR

A panel a scene. Reads any file whose cells have several orders or builders; the line joins what is not beaten
by another in both (the Pareto front), and those points are filled.
"""
from __future__ import annotations

import math
import sys

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import figure
import results
import style

COLUMNS = 3
ALONG_A_CURVE = ("oibvh", "perfect", "apetrei", "karras", "lbvh", "radix")
MARKERS = "osD^vP*X<>hd"  # an order each, by first appearance: here a colour is a builder
PANEL_HEIGHT = 1.9  # inches
Point = tuple[float, float, results.Cell]  # milliseconds, cost


def points_of(cells: list[results.Cell]) -> list[Point]:
    return [(1e3 * results.quantiles(cell.whole_times_s()).median, cell.counters["sah_cost"], cell) for cell in cells
            if cell.samples and "sah_cost" in cell.counters]


def front(points: list[Point]) -> list[Point]:
    """Those that no other is as fast as and as good as, one of them more so; by time."""
    kept: list[Point] = []
    for point in sorted(points, key=lambda p: p[:2]):
        if not kept or point[1] < kept[-1][1]:
            kept.append(point)
    return kept


def order_of(cell: results.Cell) -> str:
    """Builders that sort along no curve ignore the option."""
    if not cell.builder.startswith(ALONG_A_CURVE):
        return "own order"
    return dict(cell.options).get("order", "morton30")


def draw_scene(axes: plt.Axes, scene: str, points: list[Point], markers: dict[str, str]) -> None:
    best = front(points)
    axes.plot([time for time, _, _ in best], [cost for _, cost, _ in best], color="#888888", linewidth=0.8, zorder=1)
    for time, cost, cell in points:
        colour = style.look(cell.builder).colour
        is_best = any(cell is other for _, _, other in best)
        axes.plot(time, cost, marker=markers[order_of(cell)], linestyle="none", markeredgecolor=colour,
                  markerfacecolor=colour if is_best else "white")
    axes.set_title(f"{scene}\n{points[0][2].triangles:,} triangles", loc="left", fontsize=7)
    axes.set_xscale("log")  # a host builder takes a thousand times as long as one on a GPU
    axes.margins(x=0.12)
    figure.log_ticks(axes.xaxis, min(time for time, _, _ in points), max(time for time, _, _ in points))
    axes.set_ylim(0, 1.12 * max(cost for _, cost, _ in points))
    axes.grid(axis="x")


def draw(run: results.Run) -> plt.Figure:
    by_scene = {scene: points_of([cell for cell in run.builds if cell.scene == scene])
                for scene in dict.fromkeys(cell.scene for cell in run.builds)}
    by_scene = {scene: points for scene, points in by_scene.items() if len(points) > 1}
    if not by_scene:
        raise results.Refused(f"{run.path}: no scene has times and surface area costs of two builders or orders")
    columns = min(COLUMNS, len(by_scene))
    rows = math.ceil(len(by_scene) / columns)
    drawing, grid = plt.subplots(rows, columns, figsize=(style.PAGE_WIDTH, 1.4 + PANEL_HEIGHT * rows),
                                 squeeze=False, layout="constrained")
    panels = [axes for line in grid for axes in line]
    orders = dict.fromkeys(order_of(cell) for points in by_scene.values() for _, _, cell in points)
    markers = {order: MARKERS[place % len(MARKERS)] for place, order in enumerate(orders)}
    for axes, (scene, points) in zip(panels, by_scene.items()):
        draw_scene(axes, scene, points, markers)
    for axes in panels[len(by_scene):]:
        axes.remove()
    for line in grid:
        line[0].set_ylabel("surface area cost")
    for axes in panels[max(0, len(by_scene) - columns):len(by_scene)]:
        axes.set_xlabel("whole build, ms")
    cells = [cell for points in by_scene.values() for _, _, cell in points]
    names = [name for name in style.LOOKS if any(cell.builder == name for cell in cells)]
    handles = [Patch(facecolor=style.look(name).colour, label=name) for name in names]
    handles += [Line2D([], [], color="#222222", marker=marker, linestyle="none", label=order)
                for order, marker in markers.items()]
    height = figure.legend_above(drawing, handles, columns=6)
    remark = "Down and left is better. Filled, joined: beaten by none in both time and cost. Times: medians."
    figure.footer(drawing, run, cells[0].experiment, (remark,), height)
    return drawing


if __name__ == "__main__":
    sys.exit(figure.command_line("pareto_orders", __doc__, draw))
