"""Shared by figures of run time against error: the look of each method, points, scales and legends."""
import math
from collections.abc import Callable
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.axis import Axis
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from ..draw import figure
from ..draw.style import Look
from ..read import pareto, results

# Methods of each axis, in the order of legends; colours as in style.py. To add a method, add its line here.
METHODS = {
    "narrow": {"filter-f64+exact": Look("#0072B2", "o"), "filter-f64": Look("#56B4E9", "o"), "filter-f32": Look("#56B4E9", "v"),
               "guigue-f64": Look("#E69F00", "^"), "guigue-f32": Look("#D55E00", "v"), "moller-f32": Look("#CC79A7", "s"), "sat-f32": Look("#009E73", "D")},
    "sums": {"f32": Look("#D55E00", "v"), "f32-pairwise": Look("#E69F00", "s"), "f32-compensated": Look("#CC79A7", "D"),
             "f64": Look("#0072B2", "^"), "f64-pairwise": Look("#56B4E9", "s"), "f64-compensated": Look("#009E73", "o")},
    "codes": {f"{curve}{bits}{axis}{grid}": Look(colour, marker)
              for curve, axis, colour in (("morton", "", "#0072B2"), ("morton", "-axis", "#56B4E9"),
                                          ("hilbert", "", "#009E73"), ("hilbert", "-axis", "#E69F00"))
              for grid, markers in (("", "oDs"), ("-scene", "v<^"))
              for bits, marker in zip((30, 48, 63), markers, strict=True)}
             | {"kd": Look("#CC79A7", "*"), "radix": Look("#000000", "P")},
    "input": {"f32": Look("#D55E00", "v"), "f32-recentred": Look("#0072B2", "o")},
    "place": {"exact": Look("#0072B2", "o"), "filter-f64": Look("#56B4E9", "v")},
    "boxes": {"f32": Look("#0072B2", "o"), "f64": Look("#56B4E9", "o"), "f16": Look("#CC79A7", "o"),
              "u16": Look("#009E73", "o"), "u8": Look("#D55E00", "o"), "u8-node-local": Look("#E69F00", "s")},
    "frames": {"exact": Look("#000000", "*")}
              | {f"narrow {name}": Look("#0072B2", marker)
                 for name, marker in (("filter-f64", "P"), ("filter-f32", "X"), ("guigue-f64", "^"), ("guigue-f32", "v"), ("moller-f32", "s"), ("sat-f32", "D"),
                                      ("none", "o"))}
              | {f"boxes {name}": Look("#009E73", marker) for name, marker in (("f64", "^"), ("f16", "D"), ("u16", "s"), ("u8", "o"))}
              | {f"input {bits} bits": Look("#D55E00", marker) for bits, marker in ((20, "^"), (16, "s"), (12, "D"), (8, "o"))}
              | {"all coarse": Look("#CC79A7", "P")},
    "impacts": {"ccd-1e-2": Look("#D55E00", "v"), "ccd-1e-4": Look("#E69F00", "s"), "ccd-1e-6": Look("#0072B2", "o"),
                "ccd-f64-1e-4": Look("#CC79A7", "s"), "ccd-f64-1e-6": Look("#009E73", "o")},
    "distance": {"exact": Look("#000000", "*"), "within-f64": Look("#0072B2", "o"), "within-f32": Look("#56B4E9", "v"),
                 "within-capsules": Look("#009E73", "D"), "within-spheres": Look("#E69F00", "s"),
                 "within-rounded-boxes": Look("#CC79A7", "^"), "within-boxes": Look("#D55E00", "P")},
    "queries": {f"ccd-f32-1e-{digits}": Look("#56B4E9", marker) for digits, marker in ((2, "v"), (4, "s"), (6, "o"))}
               | {f"ccd-f64-1e-{digits}": Look("#0072B2", marker) for digits, marker in ((2, "v"), (4, "s"), (6, "o"), (10, "D"))}
               | {"additive-f64": Look("#009E73", "^"), "roots-f64-1e-6": Look("#D55E00", "o"), "roots-f64-1e-10": Look("#D55E00", "D")},
}


class Point(NamedTuple):
    time: float
    error: float
    method: str


OUTSIDE = Look("#000000", "*")  # of methods from outside, which answer single queries or test pairs


def look(axis: str, method: str) -> Look:
    if axis in ("queries", "narrow") and method not in METHODS[axis]:
        return OUTSIDE
    if method not in METHODS[axis]:
        raise results.Refused(f"plots/figures/accuracy_points.py has no look for the method '{method}' of {axis}: add a line to METHODS")
    return METHODS[axis][method]


def by_input(cells: list[results.Cell]) -> dict[str, list[results.Cell]]:
    return results.grouped(cells, lambda cell: cell.scene)


def median_s(cell: results.Cell, stage: str = "") -> float:
    return results.median(cell.times_s(stage))


def draw_points(axes: plt.Axes, axis: str, points: list[Point], on_front: list[Point] | None = None) -> None:
    """Draws points, and the front of all or of those that may be on it."""
    best = pareto.front(points if on_front is None else on_front)
    figure.scatter(axes, points, best, lambda point: look(axis, point.method),
                   lambda is_best: {"clip_on": False, "zorder": 4 if is_best else 3})


def log_times(axes: plt.Axes, points: list[Point], most: int = 6) -> None:
    """Sets a logarithmic axis of the points' times, with at most `most` labels."""
    figure.log_axis(axes.xaxis, min(point.time for point in points) / 1.3, max(point.time for point in points) * 1.3, most)


def from_zero(axis: Axis, errors: list[float], least: float, most: float, text: Callable[[float], str], ticks: int) -> None:
    """Sets a logarithmic axis with one extra step below it for 0. It starts at the decade of the smallest nonzero error (`least`
    if all errors are 0) and ends at `most` or above."""
    least = min((error for error in errors if error > 0), default=least)
    first, last = math.floor(math.log10(least)), math.ceil(math.log10(max(*errors, most)))
    axes, name = axis.axes, axis.axis_name
    getattr(axes, f"set_{name}scale")("symlog", linthresh=10.0**first, linscale=0.5 if name == "y" else 1)
    step = max(1, math.ceil((last - first) / ticks))
    places = [0.0, *(10.0**power for power in range(last, first - 1, -step))]
    axis.set_major_locator(FixedLocator(places))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: "0" if value == 0 else text(value)))
    axes.set(**{f"{name}lim": (0, 10.0**last * 1.3)})


def legend(drawing: plt.Figure, axis: str, cells: list[results.Cell], columns: int) -> float:
    there = {cell.accuracy["method"] for cell in cells}
    handles = [Line2D([], [], color=seen.colour, marker=seen.marker, linestyle="none", label=name)
               for name, seen in [*METHODS[axis].items(), *((name, OUTSIDE) for name in sorted(there - METHODS[axis].keys()))] if name in there]
    return figure.legend_above(drawing, handles, columns)
