"""Figures of cells of several ranks: speed-up, efficiency and stages over the number of ranks; the share of the halo.

strong and weak: left the speed-up (of weak: the efficiency) against ranks, with the ideal and the model's curve; right the median
time of each stage, least, median and most over the ranks. halo: triangles sent, in per cent, by partition and boxes a rank.
"""
import functools
import statistics
from typing import Any

import matplotlib.pyplot as plt
import numpy

from ..draw import figure, style
from ..read import rank_files, results
from ..read.cells import grouped
from ..read.rank_files import measured, stage_times

HALO_BYTES, BOX_BYTES, MESSAGES_S, WAITS, WAIT_S = 40, 24, 5e9, 5, 20e-6  # of the model: docs/cluster.md, cluster/simulate.cpp
COLOURS = {"build": "#0072B2", "boxes": "#999999", "select": "#E69F00", "exchange": "#CC79A7", "self": "#56B4E9",
           "halo": "#009E73", "narrow": "#8C510A"}


def model_s(one: dict[str, Any], largest: dict[str, Any], ranks: float, is_weak: bool) -> float:
    """Returns the frame's time by the model: the work of one rank, waits, and the way of the halo and of all boxes. The halo of a
    rank grows with the square root of its triangles; its size is that of the largest number of ranks measured."""
    share = one["scene"]["triangles"] * (1 if is_weak else 1 / ranks)
    measured_share = largest["scene"]["triangles"] / largest["ranks_count"]
    sent = max(rank["halo_sent_count"] for rank in largest["ranks"]) * (share / measured_share) ** 0.5
    alone = one["frame_ns"] / 1e9 * share / one["scene"]["triangles"]
    boxes = (ranks - 1) * largest["boxes_count"]
    return alone + (ranks > 1) * (WAITS * WAIT_S + (sent * HALO_BYTES + boxes * BOX_BYTES) / MESSAGES_S)


def stages_s(run: dict[str, Any]) -> dict[str, list[float]]:
    """Returns the median time of each stage on each rank, by the host's clock."""
    return {stage: [value / 1e9 for value in values] for stage, values in stage_times(run).items() if max(values) > 0}


def draw_curve(axes: plt.Axes, runs: list[dict[str, Any]], is_weak: bool) -> None:
    one, last = runs[0], runs[-1]
    most = max(8, last["ranks_count"])
    ranks = numpy.geomspace(1, most, 50)
    first = one["frame_ns"] / 1e9
    model = numpy.array([first / model_s(one, last, count, is_weak) for count in ranks])
    axes.plot(ranks, numpy.ones_like(ranks) if is_weak else ranks, color="#999999", lw=0.8, label="ideal")
    axes.plot(ranks, model, color="#E69F00", lw=1, ls="--", label="model")
    axes.plot([run["ranks_count"] for run in runs], [one["frame_ns"] / run["frame_ns"] for run in runs], "o-", color="#0072B2", ms=4,
              label="measured")
    axes.set_xscale("log", base=2)
    axes.set_xticks([count for count in (1, 2, 4, 8, 16, 32, 64) if count <= most])
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    if is_weak:
        axes.set_ylim(0, 1.1)
    else:
        axes.set_yscale("log", base=2)
        axes.set_yticks(axes.get_xticks())
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.set_xlabel("ranks, a device each")
    axes.set_title("efficiency" if is_weak else "speed-up", loc="left")
    axes.legend(frameon=False)


def draw_stages(axes: plt.Axes, runs: list[dict[str, Any]]) -> None:
    ticks, names = [], []
    for place, run in enumerate(runs):
        for k, (name, pick) in enumerate((("least", min), ("median", statistics.median), ("most", max))):
            if len(run["ranks"]) == 1 and name != "median":
                continue
            bottom, at = 0.0, 3.6 * place + k - (len(runs[0]["ranks"]) == 1) * 1.0 * (place > 0)
            for stage, values in stages_s(run).items():
                height = pick(values) * 1e3
                axes.bar(at, height, 0.8, bottom, color=COLOURS[stage], label=stage if place == len(runs) - 1 and k == 1 else None)
                bottom += height
            ticks.append(at)
            names.append(f"{run['ranks_count']}\n{name}" if len(run["ranks"]) > 1 else "1")
    axes.set_xticks(ticks, names)
    axes.set_xlabel("ranks")
    axes.set_title("stages over ranks, host's clock, ms", loc="left")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], frameon=False, loc="upper left", bbox_to_anchor=(1, 1))


def draw_halo(runs: list[dict[str, Any]]) -> plt.Figure:
    drawing, axes = plt.subplots(figsize=(style.PAGE_WIDTH * 0.8, 2.6), layout="constrained")
    for partition, colour in (("rcb", "#0072B2"), ("curve", "#D55E00")):
        for boxes, line in ((1, "o--"), (64, "s-")):
            some = [run for run in runs if run["partition"] == partition and run["boxes_count"] == boxes]
            if some:
                axes.plot([run["ranks_count"] for run in some], [100 * run["halo_share"] for run in some], line, color=colour, ms=4, lw=1,
                          label=f"{partition}, {boxes} box{'es' * (boxes > 1)} a rank")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xticks(sorted({run["ranks_count"] for run in runs}))
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    figure.log_ticks(axes.yaxis, *axes.get_ylim())
    axes.set_xlabel("ranks")
    axes.set_title(f"halo of {runs[0]['scene']['name']}, % of its triangles", loc="left")
    axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    return drawing


def experiments_of(run: results.Run) -> dict[str, list[dict[str, Any]]]:
    """Returns the measured cells of several ranks by experiment."""
    experiments = grouped(rank_files.cells_of(run.document, str(run.path)), lambda cell: cell["experiment"])
    return {kind: measured(cells) for kind, cells in experiments.items()}


def why_none(run: results.Run) -> str:
    """Returns why there is no figure of the cells of several ranks; empty if there is one, or no such cell."""
    reasons = [why_not(kind, runs) for kind, runs in experiments_of(run).items()]
    return "; ".join(reasons) if all(reasons) else ""


def why_not(kind: str, runs: list[dict[str, Any]]) -> str:
    if not runs:
        return "no cell was measured"
    if kind == "halo":
        return ""
    if any(one["simulated"] for one in runs):
        return "of simulated ranks, only files of `bvhbench scale halo` have a figure"
    if any("frame_ns" not in one for one in runs):
        return "its ranks shared a device, so there are no times"
    return "" if kind == "cluster" or runs[0]["ranks_count"] == 1 else "there is no cell of one rank to compare with"


def draws_of(run: results.Run) -> dict[str, figure.Draw]:
    """Returns the figure of each experiment that can have one."""
    return {kind: functools.partial(draw, kind=kind, runs=runs) for kind, runs in experiments_of(run).items() if not why_not(kind, runs)}


def draw(_: results.Run, kind: str, runs: list[dict[str, Any]]) -> plt.Figure:
    if kind == "halo":
        return draw_halo(runs)
    if kind == "cluster":
        drawing, right = plt.subplots(figsize=(style.PAGE_WIDTH * 0.6, 2.8), layout="constrained")
    else:
        drawing, [[left, right]] = figure.grid(1, 2, 2.8, width_ratios=(1, 1.4))
        draw_curve(left, runs, kind == "weak")
    draw_stages(right, runs)
    drawing.suptitle(f"{runs[0]['scene']['name']}{' and as much on every rank' if kind == 'weak' else ''}, "
                     f"{runs[0]['ranks'][0]['device']}", x=0.01, ha="left", fontsize=8)
    return drawing
