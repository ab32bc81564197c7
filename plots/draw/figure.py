"""What all figures share: axes, bands, legends, the footer with what is missing, and how pictures are written."""
import functools
import math
import pathlib
import textwrap
from collections.abc import Callable, Iterator, Sequence

import matplotlib.pyplot as plt
import numpy
from matplotlib.axis import Axis
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

from ..files import output
from ..read import results
from . import style

MISSING_SHOWN = 4
LEGEND, HANDLE = 130, 7  # widths of the page and of a legend's symbol, in characters of the legend
FOOTER = 4  # lines of the footer that a figure's height includes
Draw = Callable[[results.Run], plt.Figure]
Curve = list[tuple[int, results.Quantiles]]  # triangles and a quantity, by size
Figures = dict[str, Callable[[], plt.Figure]]  # by the name of the picture


def listed(names: list[str]) -> str:
    return ("; " if any("," in name for name in names) else ", ").join(names)


def notes(run: results.Run, experiment: str) -> list[str]:
    """Returns remarks on how cells were timed, which were not checked, and which are missing."""
    cells = [cell for cell in run.cells if cell.experiment == experiment and cell.operation in ("build", "collide")]
    lines = []
    on_host = sorted({cell.called for cell in cells if cell.on_host})
    if on_host:
        lines.append(f"On the host and its clock: {listed(on_host)} ({run.facts['host']['cpu']}).")
    unchecked = sorted({cell.called for cell in cells if not cell.checked})
    if unchecked:
        lines.append(f"Answers not checked: {listed(unchecked)}.")
    missing = run.left_out(experiment)
    if len(missing) > MISSING_SHOWN:
        missing[MISSING_SHOWN:] = [f"and {len(missing) - MISSING_SHOWN} more reasons for missing cells"]
    return lines + missing


def log_ticks(axis: Axis, low: float, high: float) -> None:
    """Labels a logarithmic axis with plain numbers at powers of ten, and between them if the range is small."""
    steps = (1,) if high / low > 300 else (1, 2, 5)
    axis.set_major_locator(LogLocator(subs=steps, numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.10g}"))
    axis.set_minor_formatter(NullFormatter())


def powers_of_two(axes: plt.Axes, base: int, most: int) -> None:
    """Sets a base-2 logarithmic axis of triangles, labelled at powers of `base`, with at most `most` labels."""
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(LogLocator(base=base, numticks=most))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"$2^{{{round(math.log2(value))}}}$"))


def step_between(sizes: list[int]) -> int:
    """Returns the base whose powers are labelled: 16 for a wide range of sizes, otherwise 4."""
    return 16 if max(sizes) / min(sizes) > 2**10 else 4


def by_size(cells: list[results.Cell], values_of: Callable[[results.Cell], Sequence[float]]) -> Curve:
    """Returns the quantiles of each cell that has values, sorted by number of triangles."""
    points = [(cell.triangles, results.quantiles(values)) for cell in cells if len(values := values_of(cell))]
    return sorted(points, key=lambda point: point[0])


def band(axes: plt.Axes, points: Curve, scaled: Callable[[numpy.ndarray], numpy.ndarray], look: style.Look, alpha: float = 0.25,
         **line: object) -> None:
    """Draws medians as a line, and a band from the 10th to the 90th percentile. `scaled` converts the values to be drawn."""
    sizes = numpy.array([size for size, _ in points])
    first, middle, last = (scaled(numpy.array(column)) for column in zip(*(found for _, found in points), strict=True))
    axes.fill_between(sizes, numpy.minimum(first, last), numpy.maximum(first, last), color=look.colour, alpha=alpha, linewidth=0)
    axes.plot(sizes, middle, color=look.colour, marker=look.marker, **line)


def ticks_between(low: float, high: float, most: int) -> list[float]:
    """Returns round numbers for a logarithmic axis, as many as possible but at most `most`."""
    found: list[float] = []
    for steps in ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7), (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8)):
        decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        ticks = [float(f"{step}e{decade}") for decade in decades for step in steps]
        ticks = [tick for tick in ticks if low <= tick <= high]
        if len(ticks) <= most:
            found = ticks
    return found


def log_axis(axis: Axis, low: float, high: float, most: int) -> None:
    """Sets a logarithmic axis of this range, labelled with at most `most` round numbers."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log", f"{axis.axis_name}lim": (low, high)})
    axis.set_major_locator(FixedLocator(ticks_between(low, high, most)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 1e6:,g} M" if value >= 1e6 else f"{value:,g}"))


def scatter(axes: plt.Axes, points: list[tuple], best: list[tuple], look_of: Callable[[tuple], style.Look],
            more: Callable[[bool], dict] = lambda is_best: {}) -> None:
    """Draws points, each of which begins with a time and a cost or error. Points in `best` are filled and joined by a line."""
    joined = [point[:2] for point in best if point in points]
    axes.plot([time for time, _ in joined], [cost for _, cost in joined], color="#888888", linewidth=0.8, zorder=1)
    for point in points:
        look = look_of(point)
        axes.plot(*point[:2], marker=look.marker, linestyle="none", markeredgecolor=look.colour,
                  markerfacecolor=look.colour if point in best else "white", **more(point in best))
    axes.grid(axis="x")


def grid(rows: int, columns: int, inches: float, **more: object) -> tuple[plt.Figure, numpy.ndarray]:
    """Creates panels of a page's width; returns the figure and its rows of panels."""
    return plt.subplots(rows, columns, figsize=(style.PAGE_WIDTH, inches), squeeze=False, layout="constrained", **more)


def panels(count: int, columns: int, inches: tuple[float, float], **shared: object) -> tuple[plt.Figure, list[plt.Axes], int]:
    """Creates `count` panels in at most `columns` columns; returns figure, panels and columns. `inches`: page and row heights."""
    columns = min(columns, count)
    return *stacked([1] * count, inches[1], inches[0], columns, **shared), columns


def columns_for(labels: list[str], most: int) -> int:
    """Returns the most columns of a legend, up to `most`, that fit on the page."""
    fitting = (columns for columns in range(min(most, len(labels)), 1, -1)
               if sum(HANDLE + max(map(len, column)) for column in numpy.array_split(labels, columns)) <= LEGEND)
    return next(fitting, 1)


def legend_above(figure: plt.Figure, handles: list, columns: int = 7) -> float:
    """Adds a legend above all panels, in at most `columns` columns, and returns its height in inches."""
    columns = columns_for([str(handle.get_label()) for handle in handles], columns)
    figure.legend(handles=handles, loc="upper center", ncols=columns, columnspacing=1.2)
    return 0.1 + 0.16 * math.ceil(len(handles) / columns)


def stacked(rows: list[float], row: float, more: float, columns: int = 1, **shared: object) -> tuple[plt.Figure, list[plt.Axes]]:
    """Creates a panel of `row` inches for each of its `rows`; those beside each other are as high as the highest. `more`: inches."""
    heights = [max(rows[left:left + columns]) for left in range(0, len(rows), columns)]
    drawing, made = grid(len(heights), columns, row * sum(heights) + more, height_ratios=heights, **shared)
    for axes in list(made.flat)[len(rows):]:
        axes.remove()
    return drawing, list(made.flat)[:len(rows)]


def footer(figure: plt.Figure, run: results.Run, experiment: str, extra: tuple[str, ...] = (),
           top_inches: float = 0) -> None:
    """Adds circumstances, remarks and missing cells in small type below the panels, which get the remaining height."""
    sentences = (run.circumstances(), *extra, *notes(run, experiment))
    lines = [piece for sentence in sentences for piece in textwrap.wrap(sentence, 130)]
    height = figure.get_figheight() + 0.128 * max(0, len(lines) - FOOTER)
    figure.set_figheight(height)
    bottom = (0.06 + 0.128 * len(lines)) / height
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom - top_inches / height))
    figure.text(0.01, 0.03 / height, "\n".join(lines), fontsize=style.SMALL, color="#444444", va="bottom",
                linespacing=1.25)


def save_all(run: results.Run, figures: Figures, folder: pathlib.Path, inputs: list[pathlib.Path], force: bool) -> Iterator[pathlib.Path]:
    """Draws and saves each figure and yields the paths. Raises as style.save, and results.Refused if drawing fails."""
    for name, draw in figures.items():
        try:
            yield from style.save(draw(), folder, name, inputs, force)
        except (ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError, Warning) as error:
            plt.close("all")  # what was begun
            raise results.Refused(f"{run.path}: the figure {name} cannot be drawn of it: {output.described(error)}") from error


def named(run: results.Run, draws: dict[str, Draw]) -> Figures:
    """Returns the figures by the name of the picture."""
    return {style.stem(run.path, name): functools.partial(draw, run) for name, draw in draws.items()}
