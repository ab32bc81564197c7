"""Figure 8: how construction scales with the number of triangles, one curve per builder.

Medians, with a band from the 10th to the 90th percentile. Marked is the size from which on the multi-kernel
construction stays ahead of the single-kernel one, beside the size the paper gives for its machine.
"""
import math

import matplotlib.pyplot as plt
import numpy

from ..draw import figure, style
from ..read import results
from ..read.crossing import crossing

STAGE = "hierarchy"
Curve = list[tuple[int, results.Quantiles, float]]  # triangles, seconds, nodes; by size


def curve(cells: list[results.Cell]) -> Curve:
    points = [(cell.triangles, results.quantiles(cell.times_s(STAGE)), cell.counters["nodes_count"])
              for cell in cells]
    return sorted(points, key=lambda point: point[0])


def mark_crossing(axes: plt.Axes, triangles: float, text: str, line: str, side: str) -> None:
    axes.axvline(triangles, color="#444444", linestyle=line, linewidth=0.9, zorder=0)
    offset, align = (3, "left") if side == "right" else (-3, "right")
    axes.annotate(text, (triangles, 1), (offset, -2), xycoords=("data", "axes fraction"),
                  textcoords="offset points", ha=align, va="top", fontsize=style.SMALL, color="#444444")


def crossings(curves: dict[style.Series, Curve], panels: list[plt.Axes]) -> None:
    """Marks the crossing measured here, for the first variant of each builder, and the paper's if the sizes include it."""
    printed = results.printed("fig8")
    paper = printed["crossing_triangles"]
    first = {name: points for (name, _), points in reversed(curves.items())}
    ours = None
    single = next((name for name in ("oibvh-single-printed", "oibvh-single") if name in first), None)  # the paper's where it is there
    if single and "oibvh-multi" in first:
        ours = crossing(*({size: seconds.median for size, seconds, _ in first[name]} for name in (single, "oibvh-multi")))
    sizes = [triangles for points in curves.values() for triangles, _, _ in points]
    middle = math.sqrt(min(sizes) * max(sizes))
    texts = [f"paper: multi ahead\nfrom $2^{{{math.log2(paper):.0f}}}$ ({results.printed_device('fig8')})",
             f"here: multi ahead\nfrom $2^{{{math.log2(ours):.1f}}}$" if ours else ""]
    for axes, (paper_text, our_text) in zip(panels, (texts, ("", "")), strict=True):
        if min(sizes) <= paper <= max(sizes):
            left = paper < ours if ours else paper > middle  # away from the other text, or towards the middle
            mark_crossing(axes, paper, paper_text, ":", "left" if left else "right")
        if ours:
            mark_crossing(axes, ours, our_text, "--", "right" if paper < ours else "left")


def draw(run: results.Run) -> plt.Figure:
    cells = run.timed("fig8", STAGE)
    among = style.in_order(cells)
    curves = {series: curve([cell for cell in cells if style.series_of(cell) == series]) for series in among}
    drawing, [[nodes, triangles]] = figure.grid(1, 2, 3.6, sharex=True, sharey=True)
    for series, points in curves.items():
        times = [(size, seconds) for size, seconds, _ in points]
        for axes, place in ((nodes, 2), (triangles, 0)):
            counts = numpy.array([point[place] for point in points])
            figure.band(axes, times, lambda seconds, counts=counts: counts / seconds / 1e9, style.look_in(series, among),
                        label=style.label(series, among))
    for axes, what in ((nodes, "nodes"), (triangles, "triangles")):
        figure.powers_of_two(axes, 4, 20)
        axes.set(yscale="log", xlabel="triangles")
        axes.set_title(what, loc="left")
    nodes.set_ylabel("billion per second")
    low, high = nodes.get_ylim()
    nodes.set_ylim(low, high * (high / low) ** 0.1)  # room for the words at the top
    figure.log_ticks(nodes.yaxis, low, high)
    crossings(curves, [nodes, triangles])
    legend_height = figure.legend_above(drawing, nodes.get_legend_handles_labels()[0])
    figure.footer(drawing, run, "fig8", ("Both panels have one scale. Medians; bands: 10th to 90th percentile.",), legend_height)
    return drawing
