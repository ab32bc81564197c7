"""Figure 10: how large the tree of tested pairs grows: the most entries that wait in a queue, the mean over frames."""

import matplotlib.pyplot as plt

from ..draw import figure, pipelines
from ..read import results


def draw(run: results.Run) -> plt.Figure:
    scenes = {scene: [one for one in shown if one.mean("bvtt_peak_count") is not None]
              for scene, shown in pipelines.of(run, "table2").items()}
    scenes = {scene: shown for scene, shown in scenes.items() if shown}
    if not scenes:
        raise results.Refused(f"{run.path}: no pipeline of table2 counts its node pairs (bvtt_peak_count)")
    drawing, panels = pipelines.panels(scenes, 2.4)
    values = []
    for axes, shown in zip(panels, scenes.values(), strict=True):
        for row, pipeline in enumerate(shown):
            peak, pairs = pipeline.later.mean("bvtt_peak_count"), pipeline.later.mean("pairs_count")
            values.append(peak)
            pipelines.mark(axes, row, peak, pipeline)
            pipelines.told(axes, row, peak, f"{peak:,.0f} for {pairs:,.0f} pairs")
        pipelines.dress(axes, shown)
    panels[-1].set(xscale="log", xlim=(min(values) / 3, max(values) * 40), xlabel="node pairs waiting at once, at most")
    figure.log_ticks(panels[-1].xaxis, min(values), 60 * max(values))  # the axis has room for text
    figure.footer(drawing, run, "table2", (f"Means {pipelines.apart(scenes)}. The paper prints its sizes as a picture without numbers.",
                                           *pipelines.remarks(scenes)))
    return drawing
