#!/usr/bin/env python3
"""Run time against error, a figure an axis of accuracy.

    plots/accuracy.py FILE... --out DIR

narrow: a panel a class of pairs of triangles, a point a narrow phase. sums: a panel a scene, a point a way to add areas
up. codes: a panel a scene and measure, a point an order, and which is the fastest of build and k queries. input: how
many pairs of boxes, and what a frame takes, by how far from the origin the scene is. boxes: a panel a scene, a point a format, larger the more bytes a box takes. swept: as plots/swept.py. In the
others left and down is better; the grey line joins what no other method is as good as in both time and error (the Pareto
front), and those points are filled.
"""
import functools
import math
import sys
from collections.abc import Callable
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator

import figure
import pareto
import results
import style
import swept
from style import Look

NARROW_COLUMNS = 6
SCENE_COLUMNS = 4
MOST_QUERIES = 1000

# Methods of each axis, in the order of legends; colours as in style.py. To add a method, add its line here.
METHODS = {
    "narrow": {"filter-f64+exact": Look("#0072B2", "o"), "guigue-f64": Look("#E69F00", "^"),
               "guigue-f32": Look("#D55E00", "v"), "moller-f32": Look("#CC79A7", "s")},
    "sums": {"f32": Look("#D55E00", "v"), "f32-pairwise": Look("#E69F00", "s"), "f32-compensated": Look("#CC79A7", "D"),
             "f64": Look("#0072B2", "^"), "f64-pairwise": Look("#56B4E9", "s"), "f64-compensated": Look("#009E73", "o")},
    "codes": {f"{curve}{bits}{axis}{grid}": Look(colour, marker)
              for curve, axis, colour in (("morton", "", "#0072B2"), ("morton", "-axis", "#56B4E9"),
                                          ("hilbert", "", "#009E73"), ("hilbert", "-axis", "#E69F00"))
              for grid, markers in (("", "oDs"), ("-scene", "v<^"))
              for bits, marker in zip((30, 48, 63), markers)}
             | {"kd": Look("#CC79A7", "*"), "radix": Look("#000000", "P")},
    "input": {"f32": Look("#D55E00", "v"), "f32-recentred": Look("#0072B2", "o")},
    "boxes": {"f32": Look("#0072B2", "o"), "f64": Look("#56B4E9", "o"), "f16": Look("#CC79A7", "o"),
              "u16": Look("#009E73", "o"), "u8": Look("#D55E00", "o"), "u8-node-local": Look("#E69F00", "s")},
}


class Point(NamedTuple):
    time: float
    error: float
    method: str


def look(axis: str, method: str) -> Look:
    if method not in METHODS[axis]:
        raise results.Refused(f"plots/accuracy.py has no look for the method '{method}' of {axis}: add a line to METHODS")
    return METHODS[axis][method]


def by_input(cells: list[results.Cell]) -> dict[str, list[results.Cell]]:
    return results.grouped(cells, lambda cell: cell.scene)


def median_s(cell: results.Cell, stage: str = "") -> float:
    return results.median(cell.times_s(stage))


def build_s(cell: results.Cell) -> float:
    """Returns the median time of all stages before the query, in seconds."""
    return results.median(cell.times_s() - cell.times_s("broad"))


def wrong(cell: results.Cell) -> float:
    """Returns the share of pairs that were missed or false."""
    return (cell.counters["missed_count"] + cell.counters["false_count"]) / cell.counters["pairs_count"]


def draw_points(axes: plt.Axes, axis: str, points: list[Point]) -> None:
    best = pareto.front(points)
    figure.scatter(axes, points, best, lambda point: look(axis, point.method),
                   lambda is_best: {"clip_on": False, "zorder": 4 if is_best else 3})


def log_times(axes: plt.Axes, points: list[Point]) -> None:
    low, high = min(point.time for point in points) / 1.3, max(point.time for point in points) * 1.3
    axes.set(xscale="log", xlim=(low, high))
    figure.log_ticks(axes.xaxis, low, high)


def from_zero(axes: plt.Axes, errors: list[float], least: float, most: float, text: Callable[[float], str], ticks: int) -> None:
    """Sets a logarithmic axis with one extra step below it for 0. It starts at the decade of the smallest nonzero error (`least`
    if all errors are 0) and ends at `most` or above."""
    least = min((error for error in errors if error > 0), default=least)
    first, last = math.floor(math.log10(least)), math.ceil(math.log10(max(*errors, most)))
    axes.set_yscale("symlog", linthresh=10.0**first, linscale=0.5)
    step = max(1, math.ceil((last - first) / ticks))
    places = [0.0, *(10.0**power for power in range(last, first - 1, -step))]
    axes.yaxis.set_major_locator(FixedLocator(places))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: "0" if value == 0 else text(value)))
    axes.set_ylim(0, 10.0**last * 1.3)


def legend(drawing: plt.Figure, axis: str, cells: list[results.Cell], columns: int) -> float:
    there = {cell.accuracy["method"] for cell in cells}
    handles = [Line2D([], [], color=seen.colour, marker=seen.marker, linestyle="none", label=name)
               for name, seen in METHODS[axis].items() if name in there]
    return figure.legend_above(drawing, handles, columns)


def draw_narrow(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    inputs = by_input(cells)
    drawing, grid, columns = figure.panels(len(inputs), NARROW_COLUMNS, (1.1, 1.12), sharex=True, sharey=True)
    points = {name: [Point(1e9 * median_s(cell) / cell.counters["pairs_count"], 100 * wrong(cell), cell.accuracy["method"])
                     for cell in group] for name, group in inputs.items()}
    everything = [point for group in points.values() for point in group]
    log_times(grid[0], everything)
    from_zero(grid[0], [point.error for point in everything], 1e-3, 100, lambda value: f"{value:g} %", 4)
    for number, (axes, name) in enumerate(zip(grid, inputs)):
        draw_points(axes, "narrow", points[name])
        axes.set_title(name.replace("_", " "), fontsize=6.5, pad=3, loc="left")
        axes.tick_params(labelsize=6)
        is_last = number // columns == (len(grid) - 1) // columns
        axes.tick_params(labelbottom=is_last)
        if is_last:
            axes.set_xlabel("ns a pair", fontsize=6.5)
        if number % columns == 0:
            axes.set_ylabel("wrong", fontsize=6.5)
    height = legend(drawing, "narrow", cells, 4)
    seeds = sorted({cell.accuracy["seed"] for cell in cells})
    pairs = sum(int(group[0].counters["pairs_count"]) for group in inputs.values())
    figure.footer(drawing, run, "accuracy", (
        f"{pairs:,} pairs of triangles, seed {', '.join(map(str, seeds))}. Wrong: missed or false, of the class's pairs, "
        "against CGAL's exact predicates on the coordinates as stored.", "Down and left is better. Filled, joined: no other "
        "is as good in both. Times: medians."), height)
    return drawing


def draw_sums(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    inputs = by_input(cells)
    drawing, grid, columns = figure.panels(len(inputs), SCENE_COLUMNS, (1.1, 2.0), sharey=True)
    from_zero(grid[0], [cell.counters["relative_error"] for cell in cells], 1e-17, 1e-16,
              lambda value: f"1e{round(math.log10(value))}", 6)
    for number, (axes, (name, group)) in enumerate(zip(grid, inputs.items())):
        points = [Point(1e9 * median_s(cell) / cell.counters["nodes_count"], cell.counters["relative_error"],
                        cell.accuracy["method"]) for cell in group]
        log_times(axes, points)
        draw_points(axes, "sums", points)
        axes.set_title(name, loc="left")
        axes.set_xlabel("ns a node")
        if number % columns == 0:
            axes.set_ylabel("relative error")
    figure.footer(drawing, run, "accuracy", (
        "Surface area cost of the tree of oibvh-multi, on one core of the host, against long double. Down and left is "
        "better. Filled, joined: no other is as good in both. Times: medians.",), legend(drawing, "sums", cells, 6))
    return drawing


class Cost(NamedTuple):
    build: float
    query: float
    method: str

    def of(self, queries: float) -> float:
        return self.build + queries * self.query


def cheapest(costs: list[Cost], most: float) -> list[tuple[float, Cost]]:
    """Returns (queries, cost) for each method that is cheapest from that number of queries on, starting at 1 and up to `most`."""
    best = min(costs, key=lambda cost: (cost.of(1), cost.query))
    found = [(1.0, best)]
    while True:
        # Numbers of queries at which a method with faster queries becomes cheaper than the current best.
        crossings = [((cost.build - best.build) / (best.query - cost.query), cost.query, cost)
                     for cost in costs if cost.query < best.query]
        if not crossings or min(crossings)[0] > most:
            return found
        queries, _, best = min(crossings)
        found.append((queries, best))


def draw_break_even(axes: plt.Axes, costs: list[Cost], most: float) -> None:
    """Draws the time of a build plus k queries, relative to the fastest implicit tree, and marks each k at which another tree
    becomes the fastest."""
    implicit = [cost for cost in costs if cost.method != "radix"] or costs
    best = cheapest(implicit, most)
    counts = sorted({most ** (step / 60) for step in range(61)} | {queries for queries, _ in best})
    least = [min(cost.of(queries) for cost in implicit) for queries in counts]
    for cost in costs:
        seen = look("codes", cost.method)
        is_best = cost.method == "radix" or any(cost is other for _, other in best)
        axes.plot(counts, [cost.of(queries) / low for queries, low in zip(counts, least)], color=seen.colour,
                  linewidth=1.4 if is_best else 0.5, zorder=3 if is_best else 2)
    for number, (queries, cost) in enumerate(best):
        seen = look("codes", cost.method)
        axes.plot(queries, 1, marker=seen.marker, color=seen.colour, linestyle="none", clip_on=False, zorder=4)
        if number > 0:
            axes.axvline(queries, ymax=0.5, color=seen.colour, linewidth=0.5, linestyle=":", zorder=1)
            axes.text(queries, 0.04 + 0.13 * (number % 2), f" {queries:.3g}", fontsize=6)
    axes.set(xscale="log", xlim=(1, most), ylim=(0, 2))
    figure.log_ticks(axes.xaxis, 1, most)


def draw_codes(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    cells = [cell for cell in cells if "sah_cost" in cell.counters]
    inputs = by_input(cells)
    if not inputs:
        raise results.Refused(f"{run.path}: no tree of the axis codes has a surface area cost")
    measures = {"sah_cost": "surface area cost", "box_tests_count": "box tests of a query, M"}
    drawing, grid = plt.subplots(len(measures) + 1, len(inputs), figsize=(style.PAGE_WIDTH, 7.0), squeeze=False,
                                 layout="constrained")
    for column, (name, group) in enumerate(inputs.items()):
        costs = [Cost(build_s(cell), median_s(cell, "broad"), cell.accuracy["method"]) for cell in group]
        draw_break_even(grid[-1][column], costs, MOST_QUERIES)
        grid[-1][column].set_xlabel("queries of one build")
        if column == 0:
            grid[-1][column].set_ylabel("build and queries")
        for row, measure in enumerate(measures):
            scale = 1e-6 if measure == "box_tests_count" else 1
            points = [Point(1e3 * build_s(cell), scale * cell.counters[measure], cell.accuracy["method"])
                      for cell in group]
            axes = grid[row][column]
            log_times(axes, points)
            axes.xaxis.set_major_locator(LogLocator(subs=(1.0,) if len(inputs) > 3 else (1.0, 2.0, 5.0)))
            draw_points(axes, "codes", points)
            axes.set_ylim(0, 1.1 * max(point.error for point in points))
            if row == 0:
                axes.set_title(name if len(name) < 20 else name.replace(":", ":\n", 1), loc="left", fontsize=6.5)
            else:
                axes.set_xlabel("build, ms")
            if column == 0:
                axes.set_ylabel(measures[measure])
    figure.footer(drawing, run, "accuracy", (
        "Trees of oibvh-multi, and the radix tree of apetrei-fused, queried by leaf; every query's pairs are those of the "
        "sweep. -axis: cells stretched to the box, -scene: one grid over all objects. Filled, joined: no other is as good in "
        "both.", "Below: times as long as the fastest but for radix; marked is from how many queries on that is another. Times: medians.",
        run.costs_remark()), legend(drawing, "codes", cells, 5))
    return drawing


def distance(cell: results.Cell) -> float:
    """Returns the 1e3 of "SCENE at 1e3": the distance of the scene from the origin, in sizes of the scene."""
    return float(cell.scene.rsplit(" at ", 1)[1])


def draw_input(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    scenes = results.grouped(cells, lambda cell: cell.scene.rsplit(" at ", 1)[0])
    drawing, grid = plt.subplots(2, len(scenes), figsize=(style.PAGE_WIDTH, 4.0), squeeze=False, layout="constrained",
                                 sharex=True)
    for column, (scene, there) in enumerate(scenes.items()):
        for method, seen in METHODS["input"].items():
            group = sorted((cell for cell in there if cell.accuracy["method"] == method), key=distance)
            for row, value in enumerate((lambda cell: cell.counters["pairs_count"] / cell.counters["right_pairs_count"],
                                         lambda cell: 1e3 * median_s(cell))):
                axes = grid[row][column]
                axes.plot([distance(cell) for cell in group], [value(cell) for cell in group], color=seen.colour,
                          marker=seen.marker, label=method)
                axes.set_xscale("symlog", linthresh=100, linscale=0.5)
                axes.set_yscale("log")
        for axes, name in zip(grid[:, column], ("pairs, for each right one", "frame, ms")):
            figure.log_ticks(axes.yaxis, *axes.get_ylim())
            if column == 0:
                axes.set_ylabel(name)
        grid[0][column].set_title(scene, loc="left")
        grid[1][column].set_xlabel("distance from the origin, in sizes of the scene")
    figure.footer(drawing, run, "accuracy", (
        "Vertices are doubles, rounded to floats as they are or after the middle of their box was taken off. Pairs of boxes "
        "against those of doubles: rounding misses none. Times: medians.",), legend(drawing, "input", cells, 2))
    return drawing


def inflation(cell: results.Cell) -> float:
    """Returns the number of false pairs for each right pair."""
    return cell.counters["false_count"] / max(1, cell.counters["right_pairs_count"])


def draw_boxes(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    inputs = by_input(cells)
    drawing, grid, columns = figure.panels(len(inputs), 3, (1.1, 2.6), sharey=True)
    from_zero(grid[0], [inflation(cell) for cell in cells], 1e-3, 1e-3, lambda value: f"{value:g}", 6)
    for number, (axes, (name, group)) in enumerate(zip(grid, inputs.items())):
        points = [Point(1e3 * median_s(cell, "broad"), inflation(cell), cell.accuracy["method"]) for cell in group]
        low, high = min(point.time for point in points), max(point.time for point in points)
        axes.set_xlim(low - 0.15 * (high - low) - 0.05 * high, high + 0.3 * (high - low) + 0.05 * high)
        draw_points(axes, "boxes", points)
        for line, cell in zip(axes.lines[1:], group):  # the line of the front comes first, then one line for each point
            line.set_markersize(2.2 * math.sqrt(cell.counters["node_bytes"]))
        axes.set_title(name, loc="left")
        axes.set_xlabel("query, ms")
        if number % columns == 0:
            axes.set_ylabel("false pairs, for each right one")
    figure.footer(drawing, run, "accuracy", (
        "Areas of points: bytes a box, 6 of u8 to 48 of f64. Rounded outward, boxes miss no pair.", "Left and down is better. Filled, joined: no other is as good in both. Times: medians."),
        legend(drawing, "boxes", cells, 6))
    return drawing


FIGURES = {"narrow": draw_narrow, "sums": draw_sums, "codes": draw_codes, "input": draw_input, "boxes": draw_boxes,
           "swept": functools.partial(swept.draw_cells, experiment="accuracy")}


def draws_of(run: results.Run) -> dict[str, figure.Draw]:
    """Returns the figure of each axis that the file has measured cells of."""
    by_axis = results.grouped((cell for cell in run.cells if cell.samples), lambda cell: cell.accuracy.get("axis"))
    return {axis: functools.partial(draw, cells=by_axis[axis]) for axis, draw in FIGURES.items() if axis in by_axis}


def some_figures_of(run: results.Run) -> figure.Figures:
    return figure.named(run, draws_of(run), "no measured cell of an axis of accuracy")


if __name__ == "__main__":
    sys.exit(figure.draw_from(__doc__, some_figures_of))
