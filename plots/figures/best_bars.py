"""The figure of `best`: the best builders or pipelines of each scene as bars, with stages stacked and the ratio to the best."""
import dataclasses
import textwrap
from collections.abc import Callable, Sequence

import matplotlib.pyplot as plt
from matplotlib.patches import Patch

from ..draw import figure, pipelines
from ..read import ranking_text, results
from ..read.cells import grouped
from ..read.ranking import OF_QUERY, Ranking, Row, chosen, method
from ..words import names
from ..words.tables import three_digits
from . import frame_bars

MOST_MORE = 5  # bars beside the best of each family and the one to take
MOST_SCENES = 8
TITLE = {1: 60, 2: 40}  # most letters of a line above a panel, by the figure's columns
ROW = {1: pipelines.ROW, 2: 0.135}  # inches for each bar
BYTES = (("tree", "tree_bytes", "#009E73"), ("scratch", "scratch_bytes", "#56B4E9"), ("query", "query_bytes", "#E69F00"),
         ("narrow phase", "narrow_bytes", "#D55E00"))
# The name of each part of a frame, by its colour.
PARTS = {colour: names.part(stages, names.STAGES) for stages, colour in frame_bars.PARTS} | {frame_bars.BETWEEN: names.BETWEEN}
REST = ("in no stage", frame_bars.BETWEEN)  # of the wall clock
Part = tuple[str, str, float]  # name, colour, milliseconds or megabytes


def parts_of(row: Row, objective: str, by_wall: bool) -> list[Part]:
    if by_wall and objective != "memory":
        parts = [part for part in parts_of(row, objective, False) if part[1] != frame_bars.BETWEEN]
        return [*parts, (*REST, 1e-6 * row.ns - sum(width for _, _, width in parts))]
    if objective == "memory":
        return [(name, colour, 1e-6 * row.mean(counter)) for name, counter, colour in BYTES if row.mean(counter) > 0]
    shown = pipelines.Pipeline(row.first.scene, row.cells)
    if objective != "query":
        return [(PARTS[colour], colour, row.scale * width) for colour, width in frame_bars.parts_of(shown)]
    parts = [(PARTS[colour], colour, row.scale * sum(shown.stage_ms(stage) for stage in stages if stage in OF_QUERY))
             for stages, colour in frame_bars.PARTS]
    return [part for part in parts if part[2] > 0]


def draw_scene(axes: plt.Axes, rows: list[Row], objective: str, by_wall: bool, label: Callable[[Row], str],
               first: int, take: Row | None, columns: int) -> set[tuple[str, str]]:
    """Draws the bars of one scene and returns the names and colours of their parts. `first` is the scene's first frame."""
    drawn = [parts_of(row, objective, by_wall) for row in rows]
    wholes = [sum(width for _, _, width in parts) if objective == "memory" else 1e-6 * row.ns
              for row, parts in zip(rows, drawn, strict=True)]
    limit = frame_bars.MOST * wholes[0]
    for place, (row, parts, whole) in enumerate(zip(rows, drawn, wholes, strict=True)):
        mark = "=" if row.tied and place else f"× {ranking_text.number(row.ratio)}"
        is_compared = by_wall or row.first.on_host == rows[0].first.on_host  # by one clock
        marks = f"  {mark}" * (place > 0 and is_compared) + "  take" * (take is not None and method(row.first) == method(take.first))
        frame_bars.bar(axes, place, [part[1:] for part in parts], limit, f"{three_digits(whole)} {'MB' if objective == 'memory' else 'ms'}{marks}")
    pipelines.dress_rows(axes, [label(row) for row in rows])
    axes.set_xlim(0, (1.1 + 0.2 * columns) * min(limit, max(wholes)))
    title = pipelines.scene_title([pipelines.Pipeline(row.first.scene, row.cells) for row in rows])
    title += " after the first" * (min(row.first.frame for row in rows) > first)
    axes.set_title(textwrap.fill(title, TITLE[columns]), loc="left")
    return {(name, colour) for parts in drawn for name, colour, _ in parts}


def draw(run: results.Run, found: Ranking, label: Callable[[Row], str] = lambda row: ranking_text.label(row.first),
         remarks: Sequence[str] = (), columns: int = 1) -> plt.Figure:
    take = chosen(found.rows)
    scenes = [ranking_text.shown_of(rows, MOST_MORE, take) for rows in found.scenes.values()][:MOST_SCENES]
    drawing, panels = figure.stacked([len(rows) + 1.4 + 0.8 * columns for rows in scenes], ROW[columns], 0.9, columns)
    first = {scene: min(cell.frame for cell in cells) for scene, cells in grouped(run.all_cells, lambda cell: cell.scene).items()}
    there = set().union(*(draw_scene(axes, rows, found.objective, found.by_wall, label, first[rows[0].first.scene], take, columns)
                          for axes, rows in zip(panels, scenes, strict=True)))
    for axes in panels[-columns:]:
        axes.set_xlabel("megabytes" if found.objective == "memory" else f"milliseconds {ranking_text.UNIT[found.objective]}")
    every = [(name, colour) for name, _, colour in BYTES] if found.objective == "memory" else \
        [*((name, colour) for colour, name in PARTS.items()), REST]
    stages = {stage for rows in scenes for row in rows for cell in row.cells for stage in cell.samples[0]}
    handles = [Patch(facecolor=colour, label=" + ".join(word for word in name.split(" + ") if word in stages) or name)
               for name, colour in every if (name, colour) in there]
    height = figure.legend_above(drawing, handles)
    remarks = [*remarks, "Ratios are to the first bar by the same clock; = is as fast within noise" + (", take holds the least memory of these." if take else ".")]
    remarks += ["Times are by the wall clock: some are from outside."] if found.by_wall and found.objective != "memory" else []
    remarks += ["No bar: what starts from the frame before, where there is one frame."] if found.unplaced else []
    remarks += ["Times of the beaten are scaled to those of the best."] if any(row.scale != 1 for rows in scenes for row in rows) else []
    remarks += [frame_bars.SHORTENED] if any(row.ratio > frame_bars.MOST for rows in scenes for row in rows) else []
    remarks += [f"Of each scene the best of each family and at most {MOST_MORE + 1} others."] if sum(map(len, found.scenes.values())) > sum(map(len, scenes)) else []
    remarks += [f"The first {MOST_SCENES} of {len(found.scenes)} scenes."] if len(found.scenes) > MOST_SCENES else []
    measured = dataclasses.replace(run, cells=[cell for rows in scenes for row in rows for cell in row.cells])
    figure.footer(drawing, measured, run.all_cells[0].experiment, tuple(remarks), height)
    return drawing
