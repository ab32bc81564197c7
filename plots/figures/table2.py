"""Tables 2 and 3 as points: milliseconds a frame, from vertices to exact contacts, of each scene by each pipeline."""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from ..draw import figure, pipelines
from ..read import results
from ..words import tables

WORDS = {"oibvh": ("d", "the paper's Oi-BVH"), "wang-2018": ("v", "Wang et al. 2018"), "i-cloth": ("v", "I-Cloth")}
MARK = {"color": "black", "markersize": 4.5, "markerfacecolor": "none"}


def draw_scene(axes: plt.Axes, shown: list[pipelines.Pipeline], printed: list[dict]) -> None:
    for row, pipeline in enumerate(shown):
        times, first = pipeline.later.frame_ms(), pipeline.first_ms
        mean = float(times.mean())
        pipelines.mark(axes, row, mean, pipeline)
        if len(times) > 1:
            axes.plot([times.min(), times.max()], [row, row], color="black", linewidth=0.8)
        if first is not None:
            axes.plot(first, row, "|", color="black", markersize=6, markeredgewidth=0.8)
        memory = pipeline.later.mean("memory_bytes")
        text = f"{tables.three_digits(mean)} ms" + (f", {memory / 1e6:.1f} MB" if memory else "")
        text += f", first {tables.three_digits(first)}" if first is not None else ""
        pipelines.told(axes, row, max(mean, float(times.max()), first or 0), text)
    for line in printed:
        axes.plot(line["frame_ms"], len(shown) - 0.1, WORDS[line["method"]][0], clip_on=False, **MARK)
    pipelines.dress(axes, shown, 0.8 if printed else 0)


def draw(run: results.Run, table: str = "table2") -> plt.Figure:
    """Draws Table 2 or 3, with the paper's numbers beside the measured ones."""
    scenes = pipelines.of(run, table)
    drawing, panels = pipelines.panels(scenes, 2.2)
    values: list[float] = []
    methods: dict[str, None] = {}
    for axes, (scene, shown) in zip(panels, scenes.items(), strict=True):
        of = shown[0].first.stand_in_for or scene
        lines = [line for line in results.printed(table)["rows"] if line["scene"] == of]
        draw_scene(axes, shown, lines)
        values += [float(time) for pipeline in shown for time in pipeline.frame_ms()] + [line["frame_ms"] for line in lines]
        methods |= dict.fromkeys(line["method"] for line in lines)
    panels[-1].set(xscale="log", xlim=(min(values) / 1.6, max(values) * 16), xlabel="milliseconds a frame")
    figure.log_ticks(panels[-1].xaxis, min(values), max(values))
    printed_on = f"printed ({results.printed_device(table)}, another machine)"
    handles = [Line2D([], [], marker=WORDS[method][0], linestyle="none", label=f"{WORDS[method][1]}, {printed_on}", **MARK)
               for method in methods]
    height = figure.legend_above(drawing, handles) if handles else 0
    figure.footer(drawing, run, table,
                  ("A frame is all from moved vertices to exact contacts: boxes, order, trees, pairs, contacts. Points are means "
                   f"of medians, {pipelines.apart(scenes)}. Lines reach from the fastest of these frames to the slowest. The first "
                   "of several frames is a stroke across, and in the text.",
                   "Memory is all that a pipeline reserves on the device.", *pipelines.remarks(scenes)), height)
    return drawing
