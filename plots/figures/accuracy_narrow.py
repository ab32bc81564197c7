"""Draws how often each narrow phase is wrong and what a pair takes: in its worst and typical class of pairs."""
from collections.abc import Callable

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from ..draw import figure, style
from ..read import results
from ..words import tables
from .accuracy_points import METHODS, by_input, from_zero, look, median_s

ROW = 0.52  # inches for a method
INK = "#444444"
Value = Callable[[results.Cell], float]


def wrong(cell: results.Cell) -> float:
    """Returns the share of pairs that were missed or false."""
    return (cell.counters["missed_count"] + cell.counters["false_count"]) / cell.counters["pairs_count"]


def ns_a_pair(cell: results.Cell) -> float:
    return 1e9 * median_s(cell) / cell.counters["pairs_count"]


def percent(share: float) -> str:
    return "0" if share == 0 else f"{100 * share:.{0 if share >= 0.1 else 2}{'f' if share >= 0.1 else 'g'}} %"


def ns(value: float) -> str:
    return f"{tables.three_digits(value)} ns"


def by_method(cells: list[results.Cell]) -> dict[str, list[results.Cell]]:
    """Returns the cells of each method, in the order of METHODS. Raises Refused for a method without a look."""
    found = results.grouped(cells, lambda cell: cell.accuracy["method"])
    for method in found:
        look("narrow", method)
    return {method: found[method] for method in METHODS["narrow"] if method in found}


def class_name(cell: results.Cell) -> str:
    return cell.scene.replace("_", " ")


def draw_spread(axes: plt.Axes, methods: dict[str, list[results.Cell]], value: Value, text: Callable[[float], str]) -> None:
    """Draws a row for each method: a dot for each class, and marks of the worst class and of the median over all classes."""
    for row, (method, cells) in enumerate(methods.items()):
        seen, values = look("narrow", method), [value(cell) for cell in cells]
        worst, typical = max(cells, key=value), results.median(values)
        axes.plot(values, [row] * len(values), ".", color=seen.colour, alpha=0.35, markersize=5, markeredgewidth=0,
                  clip_on=False)
        axes.plot(value(worst), row, "|", color=seen.colour, markersize=13, markeredgewidth=2, clip_on=False, zorder=3)
        axes.plot(typical, row, seen.marker, color=seen.colour, markeredgecolor="black", markeredgewidth=0.6, markersize=6,
                  clip_on=False, zorder=4)
        low = axes.get_xlim()[0]
        middle = axes.transData.transform((value(worst), 0))[0] > axes.transAxes.transform((0.5, 0))[0]
        told = f"{class_name(worst)}: {text(value(worst))}" if value(worst) > 0 else "none wrong"
        axes.annotate(told, (value(worst), row), (0, 8), textcoords="offset points", ha="right" if middle else "left",
                      va="bottom", fontsize=style.SMALL)
        axes.annotate(text(typical), (typical, row), (0, -7), textcoords="offset points",
                      ha="center" if typical > low else "left", va="top", fontsize=style.SMALL, color=INK)
    axes.set_ylim(len(methods) - 0.45, -0.65)
    axes.grid(visible=False, axis="y")
    axes.grid(axis="x")


def remark(cells: list[results.Cell]) -> str:
    inputs = by_input(cells)
    pairs = sum(int(group[0].counters["pairs_count"]) for group in inputs.values())
    seeds = ", ".join(map(str, sorted({cell.accuracy["seed"] for cell in cells})))
    classes = f"{len(inputs)} class{'' if len(inputs) == 1 else 'es'}"
    return (f"{pairs:,} pairs of triangles in {classes}, seed {seeds}. Wrong: missed or false, of the class's pairs, against "
            "CGAL's exact predicates on the coordinates as stored.")


def draw(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    methods = by_method(cells)
    drawing, [[errors, times]] = figure.grid(1, 2, 1.5 + ROW * len(methods), sharey=True, width_ratios=(3, 2))
    from_zero(errors.xaxis, [wrong(cell) for cell in cells], 1e-3, 1, percent, 4)
    figure.log_axis(times.xaxis, min(map(ns_a_pair, cells)) / 2, max(map(ns_a_pair, cells)) * 1.5, 5)
    draw_spread(errors, methods, wrong, percent)
    draw_spread(times, methods, ns_a_pair, ns)
    errors.set_yticks(range(len(methods)), list(methods))
    errors.set_xlabel("wrong pairs of a class")
    times.set_xlabel("time of a pair, ns")
    for axes in (errors, times):
        axes.tick_params(axis="y", length=0)
    marks = {"a class": {"marker": ".", "alpha": 0.35},
             "typical: the median over classes": {"marker": "o", "markeredgecolor": "black"},
             "worst class, with its name": {"marker": "|", "markersize": 9, "markeredgewidth": 2}}
    handles = [Line2D([], [], color=INK, linestyle="none", label=label, **mark) for label, mark in marks.items()]
    height = figure.legend_above(drawing, handles)
    figure.footer(drawing, run, "accuracy", (remark(cells), "Left is better. Times: medians."), height)
    return drawing
