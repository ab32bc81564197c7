"""What each rule that skips work avoids and saves: the experiment skips.

A panel a scene, a row a rule. Left: the time of a frame without the rule over that with it, a mark for each pipeline; right of 1
the rule saves time. Right: the share of the work that it avoids. A rule with nothing to skip has no row.
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from ..draw import figure, style
from ..read import results, savings
from ..read.savings import Saving

EXPERIMENT = "skips"
ROW, HEAD = 0.14, 0.28  # inches for each rule, and for a scene's title


def draw_scene(panels: list[plt.Axes], scene: list[Saving], rules: list[str], looks: dict[str, style.Look]) -> None:
    """Draws times and shares of work of one scene."""
    step = 0.6 / max(len(looks) - 1, 1)
    for one in scene:
        look = looks[one.pipeline]
        place = rules.index(one.rule) + (list(looks).index(one.pipeline) - (len(looks) - 1) / 2) * step
        face = "white" if one.is_forced else look.colour
        values = (savings.times(one), 100 * one.share(one.work))
        for axes, value in zip(panels, values, strict=True):
            axes.plot(value, place, marker=look.marker, color=look.colour, markerfacecolor=face, markersize=3.5, linestyle="none", zorder=3)


def draw(run: results.Run) -> plt.Figure:
    found = [one for one in savings.of_scenes(run.frames(EXPERIMENT)) if one.rule != savings.ALL]
    if not found:
        raise results.Refused(f"{run.path}: no cell of {EXPERIMENT} is without a rule")
    rules = sorted({one.rule for one in found}, key=savings.order)
    looks = {name: style.VARIANT_LOOKS[place % len(style.VARIANT_LOOKS)] for place, name in enumerate(dict.fromkeys(one.pipeline for one in found))}
    scenes = results.grouped((one for one in found if one.skips_something), lambda one: one.first.scene)
    rows = {scene: sorted({one.rule for one in those}, key=savings.order) for scene, those in scenes.items()}
    heights = [HEAD + ROW * len(of) for of in rows.values()]
    drawing, grid = figure.grid(len(scenes), 2, 1.1 + sum(heights), width_ratios=(3, 2), height_ratios=heights, sharex="col", sharey="row")
    for panels, (scene, those) in zip(grid, scenes.items(), strict=True):
        draw_scene(list(panels), those, rows[scene], looks)
        panels[0].axvline(1, color="#888888", linewidth=0.8, zorder=1)
        panels[0].set_yticks(range(len(rows[scene])), rows[scene])
        panels[0].set_ylim(len(rows[scene]) - 0.5, -0.5)
        panels[0].set_title(f"{scene}: {those[0].first.triangles:,} triangles", loc="left")
    ratios = [savings.times(one) for one in found if one.skips_something] or [1.0]
    figure.log_axis(grid[-1, 0].xaxis, min(0.8, *ratios) / 1.1, max(1.25, *ratios) * 1.1, 8)
    grid[-1, 0].set_xlabel("time of a frame without the rule over with it")
    grid[-1, 1].set_xlim(min(0, *(100 * one.share(one.work) for one in found)) - 4, 104)
    grid[-1, 1].set_xlabel("avoided work in %")
    handles = [Line2D([], [], color=look.colour, marker=look.marker, markersize=4, linestyle="none", label=name) for name, look in looks.items()]
    said = ["Avoided work: " + ", ".join(f"{rule}: {savings.WORK[rule]}" for rule in rules if rule in savings.WORK) + ". A rule without a row has nothing to skip."]
    if any(one.is_forced for one in found):
        said.append("Hollow: this device does without the rule at this size; it was forced.")
    figure.footer(drawing, run, EXPERIMENT, tuple(said), figure.legend_above(drawing, handles))
    return drawing
