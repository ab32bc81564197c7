"""A figure for result files that have no figure of their own: a bar with the median time of each builder or pipeline, by scene."""
import numpy
from matplotlib.ticker import MaxNLocator

from ..draw import figure, style
from ..read import results
from ..read.cells import Cell, grouped, later
from ..read.ranking import is_by_wall, middle_of
from ..words.tables import counted, duration

MOST_SCENES, MOST_BARS = 12, 24  # drawn; a remark counts the others
ROW = 0.17  # inches, of a bar
NO_TREE = "#666666"  # the colour of what needs no tree
Bar = tuple[str, float, Cell]  # name, mean over the later frames of the medians in nanoseconds, one of its cells


def draws_of(run: results.Run) -> dict[str, figure.Draw]:
    return {"overview": draw} if bars_of(run) else {}


def bars_of(run: results.Run) -> dict[tuple[str, str, str], list[Bar]]:
    """Returns the bars of each panel: those of an experiment, a scene and an operation, the shortest first. They are by the wall clock if
    a method from outside is among the cells."""
    timed = [cell for cell in run.cells if cell.has_times and cell.operation != "accuracy"]
    middle = middle_of(timed)
    return {key: sorted(((name, float(numpy.mean(list(map(middle, cells)))), cells[0])
                         for name, cells in grouped(later(those), lambda cell: cell.pipeline).items()), key=lambda bar: bar[1])
            for key, those in grouped(timed, lambda cell: (cell.experiment, cell.scene, cell.operation)).items()}


def draw(run: results.Run) -> figure.plt.Figure:
    panels = list(bars_of(run).items())
    left_out = [counted(len(panels) - MOST_SCENES, "more scene") + " not drawn."] if len(panels) > MOST_SCENES else []
    panels = panels[:MOST_SCENES]
    drawing, stack = figure.stacked([min(len(bars), MOST_BARS) + 2.6 for _, bars in panels], ROW, 0.5)
    for axes, (key, bars) in zip(stack, panels, strict=True):
        draw_panel(axes, *key, bars[:MOST_BARS])
        left_out += [f"{key[1]}: {len(bars) - MOST_BARS} slower ones not drawn."] if len(bars) > MOST_BARS else []
    clock = " by the wall clock" if is_by_wall(cell for _, bars in panels for _, _, cell in bars) else ""
    stack[-1].set_xlabel(f"milliseconds{clock}")
    figure.footer(drawing, run, panels[0][0][0], ("Medians of the samples; of several frames the mean of those after the first.", *left_out))
    return drawing


def draw_panel(axes: figure.plt.Axes, experiment: str, scene: str, operation: str, bars: list[Bar]) -> None:
    for row, (_, ns, cell) in enumerate(bars):
        axes.barh(row, 1e-6 * ns, 0.72, color=NO_TREE if cell.builder == "none" else style.look(cell.builder).colour, linewidth=0)
        axes.annotate(duration(ns), (1e-6 * ns, row), (2, 0), textcoords="offset points", va="center", fontsize=style.SMALL)
    axes.set_yticks(range(len(bars)), [name for name, _, _ in bars], fontsize=style.SMALL)
    axes.set_ylim(len(bars) - 0.5, -0.5)
    axes.set_xlim(0, 1.15e-6 * bars[-1][1] or 1)
    axes.xaxis.set_major_locator(MaxNLocator(6))
    star = f" (for {bars[0][2].stand_in_for})" if bars[0][2].stand_in_for else ""
    axes.set_title(f"{scene}{star}, {operation}, {experiment}", loc="left")
