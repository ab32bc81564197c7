#!/usr/bin/env python3
"""Figure 10: how large the tree of tested pairs grows: the most entries that wait in a queue, the mean over frames.

    plots/fig10.py FILE... --out DIR
"""
import sys

import matplotlib.pyplot as plt

import figure
import frame_bars
import pipelines
import results
import style


def draw(run: results.Run) -> plt.Figure:
    scenes = {scene: [one for one in shown if one.mean("bvtt_peak_count") is not None]
              for scene, shown in pipelines.of(run, "table2").items()}
    scenes = {scene: shown for scene, shown in scenes.items() if shown}
    if not scenes:
        raise results.Refused(f"{run.path}: no pipeline of table2 counts its node pairs (bvtt_peak_count)")
    rows = [len(shown) + 2.4 for shown in scenes.values()]
    drawing, panels = plt.subplots(len(scenes), 1, figsize=(style.PAGE_WIDTH, frame_bars.ROW * sum(rows) + 0.7),
                                   squeeze=False, height_ratios=rows, layout="constrained", sharex=True)
    values = []
    for axes, shown in zip(panels[:, 0], scenes.values()):
        for row, pipeline in enumerate(shown):
            peak = pipeline.mean("bvtt_peak_count")
            values.append(peak)
            axes.barh(row, peak, 0.72, color=pipeline.colour, hatch=pipeline.hatch, edgecolor=pipelines.ink(pipeline.colour),
                      linewidth=0)
            pairs = pipeline.mean("pairs_count")
            axes.annotate(f" {peak:,.0f} for {pairs:,.0f} pairs", (peak, row), (3, 0), textcoords="offset points",
                          va="center", fontsize=style.SMALL)
        pipelines.dress(axes, shown)
    panels[-1, 0].set_xscale("log")
    panels[-1, 0].set_xlim(min(values) / 3, max(values) * 8)
    figure.log_ticks(panels[-1, 0].xaxis, min(values), max(values))
    panels[-1, 0].set_xlabel("node pairs waiting at once, at most")
    figure.footer(drawing, run, "table2", ("Means over frames. The paper prints its sizes as a picture without numbers.",
                                           *pipelines.remarks(scenes)))
    return drawing


if __name__ == "__main__":
    sys.exit(figure.command_line("fig10", __doc__, draw))
