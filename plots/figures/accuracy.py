"""Run time against error, a figure an axis of accuracy.

narrow: a row a narrow phase, with its worst and its typical class of pairs of triangles; classes: all of them in
numbers. sums: a panel a scene, a point a way to add areas up. codes: a panel a scene and measure, a point an order, and
which is the fastest of build and k queries. input: how many pairs of boxes, and what a frame takes, by how far from the
origin the scene is. boxes: a panel a scene, a point a format, larger the more bytes a box takes. swept: as
swept_bars.py. frames: a panel a scene, a point a setting, false contacts above and missed ones below. impacts: a panel
a scene and query, a point a tolerance. distance: a panel a scene and distance, a point a narrow phase. queries: a
column a kind of queries, false ones above and what a step loses below. In sums, codes, boxes, impacts, distance and
queries left and down is better; the grey line joins what no other method is as good as in both time and error (the
Pareto front), and those points are filled.
"""
import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import matplotlib.pyplot as plt

from ..draw import figure, style
from ..read import results
from . import accuracy_frames, accuracy_narrow, swept_bars
from .accuracy_points import METHODS, Point, by_input, draw_points, from_zero, legend, log_times, look, median_s

SCENE_COLUMNS = 4
MOST_QUERIES = 1000
Value = Callable[[results.Cell], float]
Text = Callable[[float], str]


def sheet(axis: str, inputs: dict[str, list[results.Cell]], columns: int, inches: float, error: Value, scale: tuple[float, float, Text],
          time: Value, labels: tuple[str, str], limit: Callable[[plt.Axes, list[Point]], Any] = log_times,
          **title: float) -> tuple[plt.Figure, list[plt.Axes]]:
    """Draws a panel for each input and a point for each method. `scale` is that of from_zero, and `limit` sets the axis of times."""
    drawing, grid, columns = figure.panels(len(inputs), columns, (1.1, inches), sharey=True)
    from_zero(grid[0].yaxis, [error(cell) for cells in inputs.values() for cell in cells], *scale, 6)
    for number, (axes, (name, cells)) in enumerate(zip(grid, inputs.items(), strict=True)):
        points = [Point(time(cell), error(cell), cell.accuracy["method"]) for cell in cells]
        limit(axes, points)
        draw_points(axes, axis, points)
        axes.set_title(name, loc="left", **title)
        axes.set_xlabel(labels[0])
        if number % columns == 0:
            axes.set_ylabel(labels[1])
    return drawing, grid


def draw_sums(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    drawing, _ = sheet("sums", by_input(cells), SCENE_COLUMNS, 2.0, lambda cell: cell.counters["relative_error"],
                       (1e-17, 1e-16, lambda value: f"1e{round(math.log10(value))}"),
                       lambda cell: 1e9 * median_s(cell) / cell.counters["nodes_count"], ("ns a node", "relative error"))
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
    # Numbers of queries at which a method with faster queries becomes cheaper than the current best.
    while crossings := [((cost.build - best.build) / (best.query - cost.query), cost.query, cost)
                        for cost in costs if cost.query < best.query]:
        queries, _, best = min(crossings)
        found.append((queries, best))
    return [(queries, cost) for queries, cost in found if queries <= most]


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
        axes.plot(counts, [cost.of(queries) / low for queries, low in zip(counts, least, strict=True)], color=seen.colour,
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
    drawing, grid = figure.grid(len(measures) + 1, len(inputs), 7.0)
    for column, (name, group) in enumerate(inputs.items()):
        costs = [Cost(results.median(cell.times_s() - cell.times_s("broad")), median_s(cell, "broad"), cell.accuracy["method"])
                 for cell in group]
        draw_break_even(grid[-1][column], costs, MOST_QUERIES)
        grid[-1][column].set_xlabel("queries of one build")
        if column == 0:
            grid[-1][column].set_ylabel("build and queries")
        for row, measure in enumerate(measures):
            scale = 1e-6 if measure == "box_tests_count" else 1
            points = [Point(1e3 * cost.build, scale * cell.counters[measure], cost.method) for cost, cell in zip(costs, group, strict=True)]
            axes = grid[row][column]
            log_times(axes, points, 3 if len(inputs) > 3 else 5)
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


def draw_by_distance(run: results.Run, cells: list[results.Cell], axis: str, nearest: float, values: dict[str, Value],
                     note: str) -> plt.Figure:
    """Draws a row for each value, a column for each scene and a line for each method, from 0 and `nearest` sizes away on."""
    scenes = results.grouped(cells, lambda cell: cell.scene.rsplit(" at ", 1)[0])
    drawing, grid = figure.grid(2, len(scenes), 4.0, sharex=True)
    for column, (scene, there) in enumerate(scenes.items()):
        for method, seen in METHODS[axis].items():
            group = sorted((cell for cell in there if cell.accuracy["method"] == method), key=distance)
            for axes, value in zip(grid[:, column], values.values(), strict=True):
                axes.plot([distance(cell) for cell in group], [value(cell) for cell in group], color=seen.colour,
                          marker=seen.marker, label=method)
                axes.set_xscale("symlog", linthresh=nearest, linscale=0.5)
                axes.set_yscale("log")
        for axes, name in zip(grid[:, column], values, strict=True):
            figure.log_ticks(axes.yaxis, *axes.get_ylim())
            if column == 0:
                axes.set_ylabel(name)
        grid[0][column].set_title(scene, loc="left")
        grid[1][column].set_xlabel("sizes of the scene away")
    figure.footer(drawing, run, "accuracy", (note,), legend(drawing, axis, cells, 2))
    return drawing


def draw_input(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    return draw_by_distance(run, cells, "input", 100, {
        "pairs, for each right one": lambda cell: cell.counters["pairs_count"] / cell.counters["right_pairs_count"],
        "frame, ms": lambda cell: 1e3 * median_s(cell)},
        "Vertices are doubles, by their distance from the origin, rounded to floats as they are or after the middle of their box was "
        "taken off. Pairs of boxes against those of doubles: rounding misses none. Times: medians.")


def draw_place(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    return draw_by_distance(run, cells, "place", 1, {
        "left open, %": lambda cell: 100 * cell.counters["narrow_exact_count"] / max(1, cell.counters["pairs_count"]),
        "narrow phase, ns/pair": lambda cell: 1e9 * median_s(cell, "narrow") / max(1, cell.counters["pairs_count"])},
        "Vertices are doubles, by their distance from the origin, rounded to floats there: exact contacts, and the filters alone, which take "
        "what they leave open for contacts. No point: nothing was left open. Times: medians.")


def inflation(cell: results.Cell) -> float:
    """Returns the number of false pairs for each right pair."""
    return cell.counters["false_count"] / max(1, cell.counters["right_pairs_count"])


def draw_boxes(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    def limit(axes: plt.Axes, points: list[Point]) -> None:
        low, high = min(point.time for point in points), max(point.time for point in points)
        axes.set_xlim(low - 0.15 * (high - low) - 0.05 * high, high + 0.3 * (high - low) + 0.05 * high)

    inputs = by_input(cells)
    drawing, grid = sheet("boxes", inputs, 2 if len(inputs) == 4 else 3, 2.6, inflation, (1e-3, 1e-3, lambda value: f"{value:g}"),
                          lambda cell: 1e3 * median_s(cell, "broad"), ("query, ms", "false pairs, for each right one"), limit)
    for axes, group in zip(grid, inputs.values(), strict=True):
        for line, cell in zip(axes.lines[1:], group, strict=True):  # the line of the front comes first, then one line for each point
            line.set_markersize(2.2 * math.sqrt(cell.counters["node_bytes"]))
    figure.footer(drawing, run, "accuracy", (
        "Areas of points: bytes a box, 6 of u8 to 48 of f64. Rounded outward, boxes miss no pair.",
        "Left and down is better. Filled, joined: no other is as good in both. Times: medians."),
        legend(drawing, "boxes", cells, 6))
    return drawing


def draw_narrow_of(run: results.Run, axis: str, inputs: dict[str, list[results.Cell]], what: str, columns: int) -> plt.Figure:
    """Draws a panel for each input: false pairs by what the narrow phase takes. `what` says what pairs are found."""
    drawing, _ = sheet(axis, inputs, SCENE_COLUMNS, 2.0, lambda cell: cell.counters.get("false_count", 0),
                       (1, 1, lambda value: f"{value:,.0f}"), lambda cell: 1e3 * median_s(cell, "narrow"),
                       ("narrow phase, ms", "false pairs"), functools.partial(log_times, most=4), fontsize=6.5)
    cells = [cell for own in inputs.values() for cell in own]
    missed = sum(cell.counters.get("missed_count", 0) for cell in cells)
    figure.footer(drawing, run, "accuracy", (
        f"Pairs found that {what}, against CGAL; {missed:,.0f} right ones are missed. Left and down is "
        "better. Filled, joined: no other is as good in both. Times: medians.",), legend(drawing, axis, cells, columns))
    return drawing


def draw_impacts(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    inputs = results.grouped(cells, lambda cell: f"{cell.scene},\n{cell.swept['pairs']}")
    return draw_narrow_of(run, "impacts", inputs, "do not touch between two frames", 3)


def draw_distance(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    inputs = results.grouped(cells, lambda cell: f"{cell.scene},\nwithin {cell.raw['collider']['options']['within']}")
    return draw_narrow_of(run, "distance", inputs, "are not within the distance", 4)


def kind_of(cell: results.Cell) -> str:
    """Returns the data set of queries, if it is one, and their kind: "ccd_wang2021, edge-edge"."""
    return ", ".join([*cell.scene.split("/")[:-2], cell.scene.split("/")[-1].split()[0]])


def means_of(cells: list[results.Cell]) -> dict[str, Any]:
    """Returns what a method takes, gives away and gets wrong over all queries of some cells."""
    queries, touching, false = (sum(cell.counters[f"{key}_count"] for cell in cells) for key in ("queries", "touching", "false"))
    unsafe = (f"{count:,} {word}" for word in ("missed", "late") if (count := sum(cell.counters[f"{word}_count"] for cell in cells)))
    return {"false": false / max(1, queries - touching), "unsafe": ", ".join(unsafe),
            "of": f"{queries:,} queries, {touching:,} touch", "time": sum(1e6 * median_s(cell) / cell.counters["copies_count"] for cell in cells) / queries,
            "loss": sum(cell.counters["shortened_mean"] * cell.counters["queries_count"] for cell in cells) / queries}


def draw_queries(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    """Draws a column a kind of queries; a method that misses a touch, or says it later than it is, is on no front."""
    kinds = {kind: {method: means_of(own) for method, own in results.grouped(group, lambda cell: cell.accuracy["method"]).items()}
             for kind, group in results.grouped(cells, kind_of).items()}
    drawing, rows = figure.grid(2, len(kinds), 5.2, sharey="row", sharex="col")
    for row, (error, name) in zip(rows, {"false": "false, of those apart", "loss": "loss of a step, mean"}.items(), strict=True):
        from_zero(row[0].yaxis, [means[error] for methods in kinds.values() for means in methods.values()], 1e-4, 1e-3, lambda share: f"{share:.0e}", 6)
        row[0].set_ylabel(name)
        for axes, methods in zip(row, kinds.values(), strict=True):
            points = [Point(means["time"], means[error], method) for method, means in methods.items()]
            log_times(axes, points, 5)
            draw_points(axes, "queries", points, [point for point in points if not methods[point.method]["unsafe"]])
            for point in points if error == "false" else ():
                axes.annotate(methods[point.method]["unsafe"], point[:2], (5, 2), textcoords="offset points", fontsize=style.SMALL)
    for top, bottom, (kind, methods) in zip(*rows, kinds.items(), strict=True):
        top.set_title(f"{kind}\n{next(iter(methods.values()))['of']}", loc="left", fontsize=6.5)
        bottom.set_xlabel("µs a query")
    figure.footer(drawing, run, "accuracy", (
        "Queries of continuous collision detection in doubles, against CGAL's exact times. Left and down is better. Filled, joined: no other method "
        "is as good in both, of those that miss no touch and are never late. Loss: from the time found to the right one, or to the end of the "
        "step if nothing touches. Times: medians.",), legend(drawing, "queries", cells, 5))
    return drawing


# The figure of each axis.
FIGURES = {"narrow": accuracy_narrow.draw, "sums": draw_sums, "codes": draw_codes, "input": draw_input, "place": draw_place,
           "boxes": draw_boxes, "swept": functools.partial(swept_bars.draw_cells, experiment="accuracy"), "frames": accuracy_frames.draw,
           "impacts": draw_impacts, "distance": draw_distance, "queries": draw_queries}


def draws_of(run: results.Run) -> dict[str, figure.Draw]:
    """Returns the figure of each axis that the file has measured cells of."""
    by_axis = results.grouped((cell for cell in run.cells if cell.samples), lambda cell: cell.accuracy.get("axis"))
    return {axis: functools.partial(draw, cells=by_axis[axis]) for axis, draw in FIGURES.items() if axis in by_axis}
