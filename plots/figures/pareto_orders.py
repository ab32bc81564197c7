"""What a better tree costs: time of the whole build against how good the tree is, a point a builder and order.

A panel a scene, beside it one for builders on the host, whose times are of another kind. Reads any file whose
cells have several orders or builders, and shows all of them, the worse ones too. Numbers are orders (names.py); the line joins
what is not beaten by another in both time and cost (the Pareto front), and those points are filled. Where cells
count the box tests of a collision query (box_tests_count), a second row shows time against those.
"""
import math

import matplotlib.pyplot as plt
from matplotlib.axis import Axis
from matplotlib.lines import Line2D

from ..draw import figure, labels, style
from ..program import child
from ..read import families, pareto, results
from ..words import names

COLUMNS = 2
MEASURES = {"sah_cost": "surface area cost", "box_tests_count": "box tests of a query"}
PANEL_HEIGHT = 2.2  # inches
HOST_WIDTH = 0.42  # width of a host panel, relative to the panel beside it
Point = tuple[float, float, results.Cell]  # milliseconds, measure


def points_of(cells: list[results.Cell], measure: str = "sah_cost") -> list[Point]:
    return [(1e3 * results.median(cell.times_s()), cell.counters[measure], cell) for cell in cells
            if cell.samples and measure in cell.counters]


def order_of(cell: results.Cell) -> str | None:
    """Returns the order of a cell, or None for builders that ignore the option."""
    return dict(cell.options).get("order", "morton30") if cell.builder in child.builders_of_any_order() else None


def is_wide(cell: results.Cell) -> bool:
    return families.of_builder(cell.builder) == "wide trees"


def scale(axis: Axis, values: list[float], most: int) -> None:
    """Sets a logarithmic axis with room for markers and numbers."""
    low, high = min(values), max(values)
    low, high = low / 1.15 / (high / low) ** 0.1, high * 1.15 * (high / low) ** 0.1
    figure.log_axis(axis, low, high, most)


def draw_points(axes: plt.Axes, points: list[Point], best: list[Point]) -> None:
    figure.scatter(axes, points, best, lambda point: style.look(point[2].builder))


class Panels:
    """A grid of scenes: for each scene one row of panels for each measure, and in each row one panel for each clock."""

    def __init__(self, by_scene: dict[str, list[results.Cell]], measures: list[str]):
        self.has_host = any(cell.on_host for cells in by_scene.values() for cell in cells)
        self.clocks = 2 if self.has_host else 1
        self.columns = min(COLUMNS, len(by_scene))
        lines = math.ceil(len(by_scene) / self.columns)
        rows = lines * len(measures)
        self.figure, grid = figure.grid(rows, self.columns * self.clocks, 1.2 + PANEL_HEIGHT * rows,
                                        width_ratios=(1, HOST_WIDTH)[:self.clocks] * self.columns)
        self.labels: list[tuple[plt.Axes, list[labels.Label], list[labels.Place]]] = []
        unused = set(grid.flat)
        for place, cells in enumerate(by_scene.values()):
            for number, measure in enumerate(measures):
                row = place // self.columns * len(measures) + number
                left = place % self.columns * self.clocks
                unused -= set(self.draw(grid[row][left:left + self.clocks], cells, measure, number == 0))
        for axes in unused:
            axes.remove()

    def draw(self, pair: list[plt.Axes], cells: list[results.Cell], measure: str, is_first: bool) -> list[plt.Axes]:
        """Draws one scene and measure; returns the axes that show something."""
        points = points_of(cells, measure)
        best = pareto.front([one for one in points if measure != "sah_cost" or not is_wide(one[2])])
        used = []
        for axes, on_host in zip(pair, (False, True)):
            here = [point for point in points if point[2].on_host == on_host]
            if not here:
                continue
            draw_points(axes, here, best)
            scale(axes.xaxis, [time for time, _, _ in here], 3 if on_host else 6)
            scale(axes.yaxis, [value for _, value, _ in points], 6)
            used.append(axes)
            axes.set_xlabel("on the host, ms" if on_host else "whole build, ms")
            self.labels.append((axes, [labels.Label(time, value, order_of(cell), style.look(cell.builder).colour)
                                       for time, value, cell in here if order_of(cell)],
                                [point[:2] for point in best if point in here]))
        for axes in used[:1]:
            axes.set_ylabel(MEASURES[measure])
            if is_first:
                axes.set_title(f"{cells[0].scene}, {cells[0].triangles:,} triangles", loc="left", fontsize=7)
        for axes in used[1:]:
            axes.tick_params(labelleft=False)
        return used

    def number(self, orders: dict[str, int]) -> None:
        self.figure.draw_without_rendering()  # settles the layout
        self.figure.set_layout_engine("none")
        for axes, wanted, path in self.labels:
            numbers = [labels.Label(label.x, label.y, str(orders[label.text]), label.colour) for label in wanted]
            labels.draw(axes, numbers, path)


def legend(drawing: plt.Figure, cells: list[results.Cell], orders: dict[str, int]) -> float:
    builders = [name for name in style.LOOKS if any(cell.builder == name for cell in cells)]
    handles = [Line2D([], [], color=style.look(name).colour, marker=style.look(name).marker, linestyle="none",
                      label=name) for name in builders]
    handles += [Line2D([], [], color="#222222", marker=f"${number}$", markersize=4.2 if number < 10 else 5.8,
                       markeredgewidth=0.2, linestyle="none", label=order) for order, number in orders.items()]
    return figure.legend_above(drawing, handles, columns=6)


def draw(run: results.Run) -> plt.Figure:
    by_scene = results.grouped(run.builds, lambda cell: cell.scene)
    by_scene = {scene: cells for scene, cells in by_scene.items() if len(points_of(cells)) > 1}
    if not by_scene:
        raise results.Refused(f"{run.path}: no scene has times and surface area costs of two builders or orders")
    cells = [cell for cells in by_scene.values() for cell in cells]
    measures = [measure for measure in MEASURES if any(measure in cell.counters for cell in cells)]
    orders = names.numbers(order for cell in cells if (order := order_of(cell)))
    panels = Panels(by_scene, measures)
    height = legend(panels.figure, cells, orders)
    remark = ("Numbers are orders, the same in all figures. Down and left is better. Filled, joined: no other is as good in "
              "both. Times: medians.")
    if any(map(is_wide, cells)):
        remark += " A visit of a wide node tests several boxes and counts once: such costs are not comparable, and on no front."
    figure.footer(panels.figure, run, cells[0].experiment, (remark, run.costs_remark()), height)
    panels.number(orders)
    return panels.figure
