"""Pairs of swept boxes a second, by pipeline and sequence.

A panel a sequence, two bars a pipeline: pairs of vertices and faces and of edges, both together, over the time from two
frames' vertices to written pairs of both, and below it, paler, over the time of the queries alone. A pipeline that has
one of the two queries has bars of that one, and says so.
"""
import matplotlib.pyplot as plt
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter

from ..draw import figure, pipelines
from ..read import results
from ..words import tables

KINDS = ("vertex-face", "edge-edge")
QUERY = ("ropes", "collapse", "broad")
ROW = 0.25  # inches for the two bars of a pipeline
HEIGHT = 0.4  # of a bar, relative to the row
PALE = 0.4


class Step:
    """One pipeline over the steps of one scene: its cells of both kinds of query."""

    def __init__(self, cells: list[results.Cell]) -> None:
        self.cells = cells
        self.first = cells[0]
        self.kinds = [kind for kind in KINDS if any(cell.swept["pairs"] == kind for cell in cells)]

    def total(self, counter: str) -> float:
        return sum(cell.counters.get(counter, 0) for cell in self.cells)

    def seconds(self) -> float:
        return sum(results.median(cell.times_s()) for cell in self.cells)

    def query_seconds(self) -> float:
        return sum(results.median(sum(cell.times_s(stage) for stage in QUERY if stage in cell.samples[0]))
                   for cell in self.cells)

    @property
    def label(self) -> str:
        return self.first.called + ("" if len(self.kinds) == len(KINDS) else f", {self.kinds[0]} only")


def title(steps: list[Step]) -> str:
    """Returns scene, steps and numbers of pairs, which are the same for all pipelines that have both queries."""
    first = max(steps, key=lambda step: len(step.kinds))
    name, frames = pipelines.scene_name(first.first), len({one.frame for one in first.cells})
    pairs = first.total("pairs_count")
    count = f"{pairs * 1e-6:,.1f} M" if pairs >= 1e5 else f"{pairs:,.0f}"
    text = f"{name}, {frames} step{'' if frames == 1 else 's'}: {count} pairs"
    truth = first.total("ground_truth_pairs")
    return text + (f", {first.total('pairs_count') / truth:,.0f} for each of the ground truth" if truth else "")


def draw_cells(run: results.Run, cells: list[results.Cell], experiment: str) -> plt.Figure:
    scenes = [[Step(group) for group in pipelines.grouped_by_pipeline(there, "pairs_of")]
              for there in results.grouped(cells, lambda cell: cell.scene).values()]
    drawing, panels = figure.stacked([len(steps) + 1.5 for steps in scenes], ROW, 1.2)
    for axes, steps in zip(panels, scenes, strict=True):
        for row, step in enumerate(steps):
            pairs = step.total("pairs_count") * 1e-6
            colour = pipelines.Pipeline(step.first.scene, step.cells).colour
            for place, seconds, alpha in ((row - HEIGHT / 2, step.seconds(), 1), (row + HEIGHT / 2, step.query_seconds(), PALE)):
                axes.barh(place, pairs / seconds, height=HEIGHT, color=colour, alpha=alpha, linewidth=0)
                pipelines.told(axes, place, pairs / seconds, tables.three_digits(pairs / seconds), 0)
        pipelines.dress_rows(axes, [step.label for step in steps])
        axes.set_title(title(steps), loc="left", x=-0.4)
        axes.margins(x=0.08)
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.10g}"))
    panels[-1].set_xlabel("million pairs a second")
    handles = [Patch(color="#555555", label="from two frames' vertices to pairs"),
               Patch(color="#555555", alpha=PALE, label="by the queries alone, trees given")]
    missed = sum(cell.counters.get("ground_truth_missed", 0) for cell in cells)
    truth = any("ground_truth_pairs" in cell.counters for cell in cells)
    starred = any(pipelines.stands_in(steps[0].first) for steps in scenes)
    said = ["Pairs whose boxes, around the way from one frame to the next, overlap, and that share no vertex; the sweep's "
            "in every cell." + (f" Of the ground truth {missed:,.0f} are missed." if truth else "")]
    if starred:
        said.append("* was not there: the scene in brackets stands in.")
    figure.footer(drawing, run, experiment, tuple(said), figure.legend_above(drawing, handles, 2))
    return drawing


def draw(run: results.Run) -> plt.Figure:
    return draw_cells(run, [cell for cell in run.frames("swept") if cell.swept], "swept")
