#!/usr/bin/env python3
"""Figure 9: where a frame's time goes, the stages of each pipeline stacked.

    plots/fig9.py FILE... --out DIR
"""
from __future__ import annotations

import sys

import matplotlib.pyplot as plt
from matplotlib.patches import Patch

import figure
import frame_bars
import pipelines
import results
import style

# The paper's words, the stages they are made of here, and a colour each.
PARTS = (("boxes", ("near", "bounds"), "#999999"), ("MC eval", ("codes",), "#56B4E9"), ("MC sort", ("sort", "order"), "#0072B2"),
         ("build", ("gather", "hierarchy", "refit", "ropes"), "#009E73"), ("broad phase", ("broad", "copy"), "#E69F00"),
         ("narrow phase", ("narrow",), "#D55E00"))


def draw_scene(axes: plt.Axes, shown: list[pipelines.Pipeline]) -> None:
    for row, pipeline in enumerate(shown):
        left = 0.0
        for _, stages, colour in PARTS:
            width = sum(pipeline.stage_ms(stage) for stage in stages)
            axes.barh(row, width, 0.72, left=left, color=colour, linewidth=0)
            left += width
    axes.set_yticks(range(len(shown)), [pipeline.label for pipeline in shown], fontsize=style.SMALL)
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.set_xlim(0, None)
    axes.set_title(pipelines.scene_title(shown), loc="left")
    axes.grid(axis="x")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)


def draw(run: results.Run) -> plt.Figure:
    scenes = pipelines.of(run, "table2")
    rows = [len(shown) + 2.8 for shown in scenes.values()]
    drawing, panels = plt.subplots(len(scenes), 1, figsize=(style.PAGE_WIDTH, frame_bars.ROW * sum(rows) + 0.8),
                                   squeeze=False, height_ratios=rows, layout="constrained")
    for axes, shown in zip(panels[:, 0], scenes.values()):
        draw_scene(axes, shown)
    panels[-1, 0].set_xlabel("milliseconds a frame")
    height = figure.legend_above(drawing, [Patch(facecolor=colour, label=part) for part, _, colour in PARTS])
    figure.footer(drawing, run, "table2", ("Means over frames of the stages' medians. Each scene has a scale of its own.",),
                  height)
    return drawing


if __name__ == "__main__":
    sys.exit(figure.command_line("fig9", __doc__, draw))
