"""Tables 2 and 3 as bars: the time of a frame of each scene by each pipeline, the paper's printed beside it."""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

import figure
import pipelines
import results
import style

MARKS = {"oibvh": ("d", "the paper's Oi-BVH"), "wang-2018": ("v", "Wang et al. 2018"), "i-cloth": ("v", "I-Cloth")}
ROW = 0.2  # inches a bar


def draw_scene(axes: plt.Axes, shown: list[pipelines.Pipeline], printed: list[dict]) -> None:
    for row, pipeline in enumerate(shown):
        times = pipeline.frame_ms()
        mean = float(times.mean())
        axes.barh(row, mean, 0.72, color=pipeline.colour, hatch=pipeline.hatch, edgecolor=pipelines.ink(pipeline.colour),
                  linewidth=0)
        if len(times) > 1:
            axes.plot([times.min(), times.max()], [row, row], color="black", linewidth=0.8)
        memory = pipeline.mean("memory_bytes")
        text = f" {mean:.3g} ms" + (f", {memory / 1e6:.1f} MB" if memory else "")
        axes.annotate(text, (max(mean, float(times.max())), row), (3, 0), textcoords="offset points", va="center",
                      fontsize=style.SMALL)
    for line in printed:
        axes.plot(line["frame_ms"], len(shown) - 0.1, MARKS[line["method"]][0], color="black", markersize=4.5,
                  markerfacecolor="none", clip_on=False)
    pipelines.dress(axes, shown, 0.8 if printed else 0)


def draw(run: results.Run, table: str) -> plt.Figure:
    scenes = pipelines.of(run, table)
    paper = results.printed(table)
    printed, device = paper["rows"], paper["device"].removeprefix("NVIDIA GeForce ")
    rows = [len(shown) + 2.2 for shown in scenes.values()]
    drawing, panels = plt.subplots(len(scenes), 1, figsize=(style.PAGE_WIDTH, ROW * sum(rows) + 0.7), squeeze=False,
                                   height_ratios=rows, layout="constrained", sharex=True)
    values: list[float] = []
    methods: list[str] = []
    for axes, (scene, shown) in zip(panels[:, 0], scenes.items()):
        of = shown[0].first.stand_in_for or scene
        lines = [line for line in printed if line["scene"] == of]
        draw_scene(axes, shown, lines)
        values += [float(time) for pipeline in shown for time in pipeline.frame_ms()] + [line["frame_ms"] for line in lines]
        methods += [line["method"] for line in lines if line["method"] not in methods]
    panels[-1, 0].set_xscale("log")
    panels[-1, 0].set_xlim(min(values) / 1.6, max(values) * 4)
    figure.log_ticks(panels[-1, 0].xaxis, min(values), max(values))
    panels[-1, 0].set_xlabel("milliseconds a frame")
    handles = [Line2D([], [], marker=MARKS[method][0], color="black", markersize=4.5, markerfacecolor="none",
                      linestyle="none", label=f"{MARKS[method][1]}, printed ({device}, another machine)")
               for method in methods]
    height = figure.legend_above(drawing, handles) if handles else 0
    figure.footer(drawing, run, table,
                  ("A frame is all from moved vertices to exact contacts: boxes, order, trees, pairs, contacts. Bars are means "
                   "over frames of their medians, lines reach from the fastest frame to the slowest.",
                   "Memory is all that a pipeline reserves on the device.", *pipelines.remarks(scenes)), height)
    return drawing
