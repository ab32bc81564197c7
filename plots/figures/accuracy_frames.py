"""Draws what whole frames take and how many contacts are wrong, by the setting that rounds: a panel a scene."""
import math
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter

from ..draw import figure, pipelines, style
from ..read import results
from .accuracy_points import METHODS, by_input, look

NONE = 2.0  # half the height of the band of settings without wrong contacts, in decades
ONE = 2.5  # height of one wrong contact
# The heading in the legend of each kind of setting, which is the first word of a method's name.
KINDS = {"exact": "nothing rounded", "narrow": "narrow phase", "boxes": "boxes of the tree", "input": "vertices' coordinates",
         "all": "guigue-f32,\nu16 boxes, 12 bits"}
MARK = {"markersize": 4.5, "markeredgewidth": 0.9, "linestyle": "none"}


class Setting(NamedTuple):
    """One setting over the frames of one scene: mean quantiles of a frame in milliseconds, and contacts of all frames."""

    method: str
    time: results.Quantiles
    missed: int
    false: int


def setting_of(method: str, cells: list[results.Cell]) -> Setting:
    times = [results.quantiles(cell.times_s()) for cell in cells]
    missed, false = (int(sum(cell.counters[key] for cell in cells)) for key in ("missed_count", "false_count"))
    return Setting(method, results.Quantiles(*(1e3 * sum(one) / len(times) for one in zip(*times, strict=True))), missed, false)


def settings_of(cells: list[results.Cell]) -> list[Setting]:
    return [setting_of(*one) for one in results.grouped(cells, lambda cell: cell.accuracy["method"]).items()]


def kind_of(method: str) -> str:
    return method.split()[0]


def heights(settings: list[Setting]) -> dict[str, list[float]]:
    """Returns where the points of each method are: above the band for false contacts, below it for missed ones. Settings without
    either have a line each in the band, in the order of METHODS."""
    found = {one.method: [sign * (ONE + math.log10(count)) for sign, count in ((1, one.false), (-1, one.missed)) if count > 0]
             for one in settings}
    right = [method for method in METHODS["frames"] if found.get(method) == []]
    return found | {method: [NONE * (1 - (2 * row + 1) / len(right))] for row, method in enumerate(right)}


def label_of(height: float) -> str:
    power = round(abs(height) - ONE)
    return f"{10**power:,}" if power < 4 else f"$10^{{{power}}}$"


def draw_scene(axes: plt.Axes, settings: list[Setting]) -> None:
    axes.axhspan(-NONE, NONE, color="#EEEEEE", linewidth=0, zorder=1)  # above the lines of the grid
    places = heights(settings)
    for setting in settings:
        seen, low, middle, high = look("frames", setting.method), *setting.time
        ends = places[setting.method]
        span, line = ((-NONE, NONE), "-") if abs(ends[0]) < NONE else ((min(ends), max(ends)), ":")
        axes.vlines(middle, *span, color=seen.colour, linewidth=0.6, linestyle=line, zorder=2)
        for height in ends:
            axes.errorbar(middle, height, xerr=[[middle - low], [high - middle]], color=seen.colour, marker=seen.marker,
                          markerfacecolor="white", elinewidth=0.8, zorder=3, **MARK)
    low, high = min(one.time.p10 for one in settings) / 1.2, max(one.time.p90 for one in settings) * 1.2
    figure.log_axis(axes.xaxis, low, high, 6)
    axes.grid(axis="x")


def set_counts(axes: plt.Axes, settings: list[Setting]) -> None:
    """Sets the axis of counts: 0 in the middle, false contacts above and missed ones below, on logarithmic scales."""
    top, bottom = (ONE + math.ceil(math.log10(max(1, *(getattr(one, name) for one in settings))) + 0.3) for name in ("false", "missed"))
    ticks = [sign * (ONE + power) for sign, most in ((1, top), (-1, bottom)) for power in range(0, round(most - ONE) + 1, 2)]
    axes.set_ylim(-bottom, top)
    axes.yaxis.set_major_locator(FixedLocator([0, *ticks]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda height, _: "none" if height == 0 else label_of(height)))


def title(cells: list[results.Cell], frames: int) -> str:
    one = cells[0]
    right = sum({cell.frame: cell.counters["right_contacts_count"] for cell in cells}.values())
    return (f"{pipelines.scene_name(one)}\n{one.triangles:,} triangles, {frames} frame{'' if frames == 1 else 's'}, "
            f"{right:,.0f} contacts")


def draw_legend(axes: plt.Axes, methods: set[str]) -> None:
    """Fills the last panel with the looks of the settings, by kind: a column on the left and one on the right."""
    axes.set_axis_off()
    for place, kinds in ((0, ("exact", "all", "narrow")), (0.52, ("boxes", "input"))):
        handles = []
        for kind in kinds:
            own = [method for method in METHODS["frames"] if method in methods and kind_of(method) == kind]
            heading = KINDS[kind]
            if len(own) > 1:
                handles.append(Line2D([], [], linestyle="none", label=f"{heading}:"))
            for method in own:
                seen, text = look("frames", method), method.removeprefix(f"{kind} ") if len(own) > 1 else f"{method}: {heading}"
                text += ": pairs of boxes" if text == "none" else ""
                handles.append(Line2D([], [], color=seen.colour, marker=seen.marker, markerfacecolor="white", label=text, **MARK))
        axes.add_artist(Legend(axes, handles, [str(one.get_label()) for one in handles], loc="upper left",
                               bbox_to_anchor=(place, 1), fontsize=style.SMALL))


def draw(run: results.Run, cells: list[results.Cell]) -> plt.Figure:
    scenes = by_input(cells)
    drawing, grid, columns = figure.panels(len(scenes) + 1, 2, (0.8, 2.5))
    settings = {scene: settings_of(group) for scene, group in scenes.items()}
    for number, (axes, (scene, group)) in enumerate(zip(grid, scenes.items())):
        draw_scene(axes, settings[scene])
        set_counts(axes, [one for those in settings.values() for one in those])
        axes.set_title(title(group, len({cell.frame for cell in group})), loc="left")
        axes.set_xlabel("frame, ms")
        if number % columns == 0:
            axes.set_ylabel("missed  ←  contacts  →  false")
    draw_legend(grid[-1], {one.method for those in settings.values() for one in those})
    starred = any(pipelines.stands_in(group[0]) for group in scenes.values())
    figure.footer(drawing, run, "accuracy", (
        "Whole frames, from vertices to contacts, of all frames together; against CGAL's contacts of the vertices as given. Left is faster; "
        "up are false contacts, down are missed ones; a dotted line joins both of one setting. In the grey band are settings without "
        "either: height means nothing there, and their lines cross all of it.",
        "Times: the mean over frames of the medians, whiskers from the 10th to the 90th percentile.",
        *(["* was not there: the scene in brackets stands in."] if starred else [])))
    return drawing
