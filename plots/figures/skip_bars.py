"""What each rule that skips work avoids and saves: the experiment skips.

A panel a scene, a row a rule. Left: the time of a frame without the rule over that with it, a mark for each pipeline; right of 1
the rule saves time. Right: the share of the work that it avoids. Rules with nothing to skip say so.
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from ..draw import figure, style
from ..read import results, savings
from ..read.savings import Saving

EXPERIMENT = "skips"
ROW = 0.22  # inches for each rule
NOTHING = "nothing to skip"
# A look for each pipeline, in the order of the file. The colours are Okabe and Ito's.
LOOKS = (("#0072B2", "o"), ("#56B4E9", "s"), ("#009E73", "D"), ("#D55E00", "^"), ("#CC79A7", "v"), ("#E69F00", "P"), ("#000000", "X"),
         ("#999999", "*"))


def draw_scene(panels: list[plt.Axes], scene: list[Saving], rules: list[str], looks: dict[str, tuple[str, str]]) -> None:
    """Draws times and shares of work of one scene."""
    step = 0.6 / max(len(looks) - 1, 1)
    for one in scene:
        if not one.skips_something:
            continue
        colour, marker = looks[one.pipeline]
        place = rules.index(one.rule) + (list(looks).index(one.pipeline) - (len(looks) - 1) / 2) * step
        face = "white" if one.is_forced else colour
        values = (savings.times(one), 100 * one.share(one.work))
        for axes, value in zip(panels, values, strict=True):
            axes.plot(value, place, marker=marker, color=colour, markerfacecolor=face, markersize=3.5, linestyle="none", zorder=3)
    for row, rule in enumerate(rules):
        there = [one for one in scene if one.rule == rule]
        if not any(one.skips_something for one in there):
            for axes, (x, align) in zip(panels, ((1.02, "left"), (50, "center")), strict=True):
                axes.text(x, row, NOTHING if there else "not measured", fontsize=style.SMALL, color="#777777", va="center", ha=align)


def draw(run: results.Run) -> plt.Figure:
    found = [one for one in savings.of_scenes(run.frames(EXPERIMENT)) if one.rule != savings.ALL]
    if not found:
        raise results.Refused(f"{run.path}: no cell of {EXPERIMENT} is without a rule")
    rules = sorted({one.rule for one in found}, key=savings.order)
    looks = {name: LOOKS[place % len(LOOKS)] for place, name in enumerate(dict.fromkeys(one.pipeline for one in found))}
    scenes = results.grouped(found, lambda one: one.first.scene)
    drawing, grid = figure.grid(len(scenes), 2, 1.1 + len(scenes) * (0.45 + ROW * len(rules)), width_ratios=(3, 2), sharex="col", sharey=True)
    for panels, (scene, those) in zip(grid, scenes.items(), strict=True):
        draw_scene(list(panels), those, rules, looks)
        panels[0].axvline(1, color="#888888", linewidth=0.8, zorder=1)
        panels[0].set_yticks(range(len(rules)), rules)
        panels[0].set_ylim(len(rules) - 0.5, -0.5)
        panels[0].set_title(f"{scene}: {those[0].first.triangles:,} triangles", loc="left")
    ratios = [savings.times(one) for one in found if one.skips_something] or [1.0]
    figure.log_axis(grid[-1, 0].xaxis, min(0.8, *ratios) / 1.1, max(1.25, *ratios) * 1.1, 8)
    grid[-1, 0].set_xlabel("time of a frame without the rule over with it")
    grid[-1, 1].set_xlim(min(0, *(100 * one.share(one.work) for one in found)) - 4, 104)
    grid[-1, 1].set_xlabel("avoided work in %")
    handles = [Line2D([], [], color=colour, marker=marker, markersize=4, linestyle="none", label=name)
               for name, (colour, marker) in looks.items()]
    said = ["Avoided work: " + ", ".join(f"{rule}: {savings.WORK[rule]}" for rule in rules if rule in savings.WORK) + "."]
    if any(one.is_forced for one in found):
        said.append("Hollow: this device does without the rule at this size; it was forced.")
    figure.footer(drawing, run, EXPERIMENT, tuple(said), figure.legend_above(drawing, handles))
    return drawing
