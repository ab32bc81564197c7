"""Draws a map: coloured cells with short texts, in named rows and columns."""
import itertools

import matplotlib.pyplot as plt
from matplotlib.patches import Rectangle

from . import style

ROW = 0.145  # inches for a line of text
TYPE, NARROW_TYPE = 6.5, 5.5  # points, of the texts in a few columns, and in more than FEW
FEW = 12
LEAST_COLUMNS = 8  # of the map's width, so that few columns do not become wide blocks

Entries = dict[tuple[str, str], tuple[str, str]]  # colour and text of each cell, by row and column


def lines_of(entries: Entries, rows: list[str]) -> dict[str, float]:
    """Returns the height of each row, in lines of text. A row with two lines in a cell is less than twice as high as others."""
    high = {row for (row, _), (_, text) in entries.items() if "\n" in text}
    return {row: 1.75 if row in high else 1.0 for row in rows}


def inches(entries: Entries, rows: list[str]) -> float:
    return ROW * sum(lines_of(entries, rows).values())


def draw(axes: plt.Axes, entries: Entries, rows: list[str], columns: list[str]) -> None:
    """Draws the cells, the names of columns above them, and the names of rows to the left."""
    heights = lines_of(entries, rows)
    tops = dict(zip(rows, itertools.accumulate(heights.values(), initial=0.0)))
    points = TYPE if len(columns) <= FEW else NARROW_TYPE
    for (row, column), (colour, text) in entries.items():
        x, y, height = columns.index(column), tops[row], heights[row]
        axes.add_patch(Rectangle((x, y), 1, height, facecolor=colour, edgecolor="white", linewidth=0.8))
        axes.text(x + 0.5, y + height / 2, text, ha="center", va="center", fontsize=points, linespacing=1.1,
                  color=style.ink_on(colour))
    axes.set_xlim(0, max(len(columns), LEAST_COLUMNS))
    axes.set_ylim(sum(heights.values()), 0)
    axes.grid(False)
    axes.xaxis.tick_top()
    axes.set_xticks([x + 0.5 for x in range(len(columns))], columns, rotation=60, ha="left", fontsize=style.SMALL)
    axes.set_yticks([tops[row] + height / 2 for row, height in heights.items()], rows, fontsize=style.SMALL)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
