"""The experiments rebuild and pairs, and Figure 9: milliseconds a frame of each scene by each pipeline, by stage."""
import functools
import textwrap

import matplotlib.pyplot as plt
from matplotlib.patches import Patch

from ..draw import figure, pipelines
from ..read import results
from ..words import names, tables

# Each experiment, and what a frame of it includes.
EXPERIMENTS = {
    "rebuild": "A frame is all from moved vertices to exact contacts: trees built anew, or refitted and a front moved.",
    "pairs": "A frame is all from vertices to pairs of overlapping boxes, in one set of triangles.",
}
# The stages of each part of a frame, and its colour.
PARTS = tuple(zip(names.PARTS, ("#999999", "#56B4E9", "#0072B2", "#009E73", "#E69F00", "#D55E00"), strict=True))
BETWEEN = "#DDDDDD"
MOST = 12  # longest bar drawn, in multiples of the scene's shortest bar
SHORTENED = f"Bars with a white stroke are shortened to {MOST} times their scene's shortest; the stages keep their shares."
ROOM = 1.45  # for the number at the end of the longest bar, relative to that bar
HALF_TITLE = 34  # letters in a line of a title, in two columns
WIDER = 1.4  # in two columns the same text takes a larger part of the axis
IN_ONE_COLUMN = 3  # panels; more are drawn in two columns if all have the same pipelines


def parts_of(pipeline: pipelines.Pipeline) -> list[tuple[str, float]]:
    """Returns colour and milliseconds of each part. Together with the time between stages they make up the whole frame."""
    parts = [(colour, sum(pipeline.stage_ms(stage) for stage in stages)) for stages, colour in PARTS]
    between = float(pipeline.frame_ms().mean()) - sum(width for _, width in parts)
    return [part for part in (*parts, (BETWEEN, between)) if part[1] > 0]


def legend_of(shown: list[pipelines.Pipeline]) -> list[Patch]:
    """Returns a patch for each part that takes time, named after the stages that do."""
    stages = {stage for pipeline in shown for stage in names.STAGES if pipeline.stage_ms(stage) > 0}
    colours = {colour for pipeline in shown for colour, _ in parts_of(pipeline)}
    named = [(names.part(those, stages), colour) for those, colour in PARTS] + [(names.BETWEEN, BETWEEN)]
    return [Patch(facecolor=colour, label=name) for name, colour in named if colour in colours]


def bar(axes: plt.Axes, row: int, parts: list[tuple[str, float]], limit: float, text: str) -> None:
    """Draws a bar of stacked parts, each a colour and a width, and a text at its end. A bar longer than `limit` is drawn in
    proportion, as long as the limit, with a white stroke."""
    whole = sum(width for _, width in parts)
    left, scale = 0.0, min(1.0, limit / whole) if whole > 0 else 1.0
    for colour, width in parts:
        axes.barh(row, scale * width, 0.72, left=left, color=colour, linewidth=0)
        left += scale * width
    if whole > limit:
        axes.plot([0.96 * limit, 0.975 * limit], [row + 0.45, row - 0.45], color="white", linewidth=2)
    pipelines.told(axes, row, left, text, 2)


def draw_scene(axes: plt.Axes, shown: list[pipelines.Pipeline]) -> bool:
    """Draws the bars of one scene, of its frames after the first, and returns whether a bar was shortened."""
    firsts = [one.first_ms for one in shown]
    shown = [one.later for one in shown]
    wholes = [float(pipeline.frame_ms().mean()) for pipeline in shown]
    limit = MOST * min(wholes) if max(wholes) > 1.5 * MOST * min(wholes) else max(wholes)  # cutting off less helps nobody
    end = max(min(whole, limit) for whole in wholes)
    for row, (pipeline, whole, first) in enumerate(zip(shown, wholes, firsts, strict=True)):
        text = f"{tables.three_digits(whole)} ms" + (f", first {tables.three_digits(first)}" if first is not None else "")
        bar(axes, row, parts_of(pipeline), limit, text)
    axes.set_xlim(0, ROOM * end)
    return max(wholes) > limit


def panels_for(scenes: dict[str, list[pipelines.Pipeline]]) -> tuple[plt.Figure, list[plt.Axes], int]:
    """Returns the figure, its panels, and their number of columns."""
    shown = list(scenes.values())
    same = all(pipelines.labels(one) == pipelines.labels(shown[0]) for one in shown)
    columns = 2 if same and len(shown) > IN_ONE_COLUMN else 1
    return *figure.stacked([len(one) + 2.2 + 0.6 * columns for one in shown], pipelines.ROW, 0.9, columns), columns


def draw(run: results.Run, experiment: str, remarks: tuple[str, ...] = ()) -> plt.Figure:
    scenes = pipelines.of(run, experiment)
    drawing, panels, columns = panels_for(scenes)
    shortened = [draw_scene(axes, shown) for axes, shown in zip(panels, scenes.values(), strict=True)]
    for axes, shown in zip(panels, scenes.values(), strict=True):
        pipelines.dress(axes, shown)
    shown = list(scenes.values())
    for place, axes in enumerate(panels):
        if columns > 1:  # a title has half the width
            axes.set_title("", loc="right")
            axes.set_xlim(0, WIDER * axes.get_xlim()[1])
            axes.set_title(textwrap.fill(pipelines.scene_title(shown[place]), HALF_TITLE), loc="left")
        if place % columns:
            axes.set_yticklabels([])
        if place // columns == (len(panels) - 1) // columns:
            axes.set_xlabel("milliseconds a frame")
    height = figure.legend_above(drawing, legend_of([pipeline for one in shown for pipeline in one]))
    lines = (*remarks, f"Means {pipelines.apart(scenes)}: of their medians at the end of a bar, of their stages' medians in it. The first "
             "of several frames is in the text. "
             "Each scene has a scale of its own.", *pipelines.remarks(scenes))
    if any(shortened):
        lines += (SHORTENED,)
    figure.footer(drawing, run, experiment, lines, height)
    return drawing


# Figures by the name of the picture.
FIGURES: dict[str, figure.Draw] = {name: functools.partial(draw, experiment=name, remarks=(what,))
                                   for name, what in EXPERIMENTS.items()}
