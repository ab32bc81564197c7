"""What each choice decides of a frame's time, and which measure of a tree predicts a query's: the experiment effects.

Left: a row a level of each choice, the ratio of its time to the reference level's. Right: a row a collider, below each measure its
rank correlation with the query's time. A small dot is a scene.
"""
import dataclasses
from collections.abc import Iterable

import matplotlib.pyplot as plt
import numpy
from matplotlib.lines import Line2D

from ..draw import figure, pipelines, style
from ..read import effects, results

ROW = 0.165  # inches
# Of kinds of trees: colour, marker, and how far below the middle of a row.
KINDS = {effects.IMPLICIT: ("#009E73", "s", -0.19), effects.POINTERS: ("#CC79A7", "^", 0.19)}
# Of the frame and of the query: colour, marker, name, and how far below the middle of a row.
LOOKS = (("#0072B2", "D", "whole frame", -0.19), ("#D55E00", "o", "query alone", 0.19))
REMARK = ("Left: cells that differ in one choice alone; geometric means over scenes with Student's 95 % interval. Wide trees, and "
          "those of the host, have one way to store leaves, and are held against sorted leaves; those of the host have no order, "
          "and only their queries count. Right: Spearman's rank correlation within a scene, over the trees of a kind; a large marker "
          "is the median. What does not combine was skipped.")


def rows_of(axes: plt.Axes, groups: dict[str, list[str]]) -> dict[tuple[str, str], int]:
    """Sets up a panel of rows below the heads of their groups; returns the place of each row by group and label."""
    rows = [(head, label) for head, labels in groups.items() for label in ("", *labels)]
    pipelines.dress_rows(axes, [label for _, label in rows])
    for place in (place for place, (_, label) in enumerate(rows) if not label):
        axes.text(0.01, place, rows[place][0], transform=axes.get_yaxis_transform(), fontsize=style.SMALL, fontweight="bold",
                  va="center", bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6})
    return {row: place for place, row in enumerate(rows) if row[1]}


def dots(axes: plt.Axes, values: Iterable[float], row: float, colour: str) -> None:
    """Draws a dot for each scene."""
    shown = list(values)
    axes.plot(shown, [row] * len(shown), ".", color=colour, markersize=5, markeredgewidth=0, alpha=0.5, zorder=2)


def draw_effects(axes: plt.Axes, found: list[effects.Effect]) -> None:
    heads = {one.choice: f"{one.choice}, against {effects.CHOICES[one.choice]}" for one in found}
    places = rows_of(axes, {head: [one.level for one in found if one.choice == choice] for choice, head in heads.items()})
    ends = [1.0]
    for one in found:
        for ratio, (colour, marker, _, below) in zip((one.frame, one.query), LOOKS, strict=True):
            if ratio:
                row = places[heads[one.choice], one.level] + below
                dots(axes, ratio.by_scene.values(), row, colour)
                axes.plot(ratio.interval, (row, row), color=colour, linewidth=1, zorder=3)
                axes.plot(ratio.mean, row, marker=marker, color=colour, markersize=3.2, zorder=4)
                ends += ratio.by_scene.values()
    axes.axvline(1, color="#888888", linewidth=0.8, zorder=1)
    axes.set_xlabel("ratio to the time with the reference")
    figure.log_axis(axes.xaxis, min(ends) / 1.2, max(ends) * 1.2, 8)  # intervals of few scenes end at the panel's edge


def draw_correlations(axes: plt.Axes, cells: list[results.Cell]) -> None:
    found = {(measure, kind): there for measure in effects.MEASURES for kind in KINDS
             if (there := effects.correlations(cells, measure, kind))}
    places = rows_of(axes, {measure: list(dict.fromkeys(collider for (of, _), there in found.items() if of == measure for collider in there))
                            for measure in dict.fromkeys(measure for measure, _ in found)})
    for (measure, kind), there in found.items():
        colour, marker, below = KINDS[kind]
        for collider, by_scene in there.items():
            row = places[measure, collider] + below
            dots(axes, by_scene.values(), row, colour)
            axes.plot(numpy.median(list(by_scene.values())), row, marker=marker, color=colour, markersize=3.6, zorder=4)
    axes.axvline(0, color="#888888", linewidth=0.8, zorder=1)
    axes.set(xlim=(-1.05, 1.05), xticks=(-1, -0.5, 0, 0.5, 1), xlabel="rank correlation with the time of `broad`")
    axes.legend(handles=[Line2D([], [], color=colour, marker=marker, markersize=3.6, linestyle="none", label=kind)
                         for kind, (colour, marker, _) in KINDS.items()], loc="lower left", bbox_to_anchor=(0, 1), ncols=2,
                fontsize=style.SMALL, frameon=False, handletextpad=0.3, columnspacing=1)


def draw(run: results.Run) -> plt.Figure:
    cells = run.frames(effects.EXPERIMENT)
    if not (ratios := effects.effects(cells)):
        raise results.Refused(f"{run.path}: no cells of {effects.EXPERIMENT} differ from a reference in one choice alone")
    rows = len(ratios) + len(effects.CHOICES)
    drawing, [[left, right]] = figure.grid(1, 2, 1.0 + ROW * rows, width_ratios=(3, 2))
    draw_effects(left, ratios)
    draw_correlations(right, effects.frames_of(cells))
    handles = [Line2D([], [], color=colour, marker=marker, markersize=3.2, linewidth=1, label=label)
               for colour, marker, label, _ in LOOKS]
    handles.append(Line2D([], [], color="#777777", marker=".", markersize=5, linestyle="none", label="a scene"))
    run = dataclasses.replace(run, without_numbers=[cell for cell in run.without_numbers if cell.status != "skipped"])
    figure.footer(drawing, run, effects.EXPERIMENT, (REMARK,), figure.legend_above(drawing, handles))
    return drawing
