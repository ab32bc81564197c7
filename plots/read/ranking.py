"""Ranks builders or pipelines by time or by an amount, over one scene or several.

Times are those of the stages. If one of the cells is from outside, all times are by the wall clock: a method from outside says itself
what its stages took, and bvhbench measures its calls. Between a method of the host and one of the device, ratios are by the host's clock,
with copies.

Times of cells that lost a race (docs/races.md) were taken while the machine may have been faster or slower than
later. Such a cell is therefore compared with the samples that the best had until then, and its time is scaled by what the best
took later.

Frames are compared over those after the first (cells.later). On a scene with one frame, what starts from the frame before has no place.
"""
import functools
import itertools
import math
from collections.abc import Callable, Container, Hashable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy

from . import families
from .cells import Cell, Sample, counted, elapsed_ns, grouped, later, median, whole_ns
from .results import USUAL_COSTS

OBJECTIVES = ("frame", "query", "build", "memory")
OF_QUERY = ("near", "margin", "pad", "filter", "ropes", "collapse", "broad", "copy", "narrow", "exact", "read_back")  # stages that follow the tree
FEWEST = 3  # samples from which intervals are compared
LEAST = 0.005  # differences below this are none: the best of two runs differ by more (docs/races.md)
FAR = 3  # ratio from which fewer samples are enough
ERROR = 0.05


@dataclass
class Row:
    """A builder or pipeline over the frames of one scene, or over several scenes."""

    cells: list[Cell]
    ns: float = 0.0  # mean over the later frames of the medians of what it is ranked by; of the beaten as scaled (see above)
    scale: float = 1.0  # by which the medians of its samples were scaled
    ratio: float = math.inf  # to the best; of several scenes the geometric mean of the ratios
    tied: bool = False  # the best is not better by more than the noise
    complete: bool = True  # measured in every frame
    by_scene: list[float] = field(default_factory=list)  # the ratio of each scene, if there are several

    @property
    def first(self) -> Cell:
        return self.cells[0]

    @property
    def bytes(self) -> float:
        return self.amount("memory")

    @property
    def sah(self) -> float:
        """Returns the mean surface area cost, or NaN if it is unknown."""
        return self.amount("cost")

    def amount(self, objective: str) -> float:
        """Returns the mean amount that an objective of AMOUNTS ranks by, or 0 for a time."""
        return mean([AMOUNTS[objective](cell) for cell in self.cells]) if objective in AMOUNTS else 0

    @property
    def is_on_host(self) -> bool:
        return families.of_cell(self.first) in families.ON_HOST

    def host_ns(self, frames: Container[int]) -> float:
        """Returns the mean over these frames by the host's clock, with the copies of vertices to the device and of what is found back."""
        return mean([(cell.wall_ns or cell.median_ns()) + sum(cell.counters.get(f"{copy}_ns", 0) for copy in ("upload", "read_back"))
                     for cell in self.cells if cell.frame in frames])

    @property
    def is_right(self) -> bool:
        return all(cell.checked for cell in self.cells)

    def mean(self, counter: str) -> float:
        """Returns the mean of a counter over the cells, or NaN if one lacks it."""
        return mean([cell.counters.get(counter, math.nan) for cell in self.cells])

    @property
    def wrong(self) -> str:
        """Returns how many pairs or contacts are missed and false on average: "3 missed, 1 false"; empty if none is known."""
        counts = (self.mean("missed_count"), "missed"), (self.mean("false_count"), "false"), (self.mean("false_pairs_count"), "false")
        return ", ".join(f"{count:,.0f} {what}" for count, what in counts if count > 0)


@dataclass
class Ranking:
    objective: str
    by_wall: bool  # times are by the wall clock
    rows: list[Row]  # best first
    scenes: dict[str, list[Row]]  # of each scene
    wrong: list[Cell]  # cells whose answer is wrong; they are in no row
    without: list[Cell]  # cells without times
    unplaced: list[Cell]  # cells that start from the frame before, of scenes with one frame


def mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else math.nan


def bytes_of(cell: Cell) -> float:
    """Returns the bytes that a cell's builder, collider and narrow phase hold, or NaN if it does not say."""
    counters = cell.counters
    return counters.get("memory_bytes", counters.get("tree_bytes", math.nan) + counters.get("scratch_bytes", 0))


def sah_of(cell: Cell) -> float:
    """Returns the surface area cost of the cell's tree, at the usual costs if the cell has the areas alone; NaN if unknown."""
    inner, triangle = USUAL_COSTS
    areas = inner * cell.counters.get("sah_inner", math.nan) + triangle * cell.counters.get("sah_leaf", math.nan)
    return cell.counters.get("sah_cost", areas)


# Objectives that are no time. What holds the same amount is ranked by time.
AMOUNTS = {"memory": bytes_of, "cost": sah_of, "error": lambda cell: cell.counters.get("relative_error", math.nan)}


def is_by_wall(cells: Iterable[Cell]) -> bool:
    """True if the cells are compared by the wall clock, because one is from outside."""
    return any(cell.outside for cell in cells)


def stages_ns(sample: Sample, of_query: bool) -> int:
    """Returns the sum of the stages that follow the tree, or of the others."""
    return sum(elapsed_ns(stage) for name, stage in sample.items() if (name in OF_QUERY) == of_query)


class Measure(NamedTuple):
    """What cells are compared by."""

    objective: str
    by_wall: bool

    def values(self, cell: Cell) -> numpy.ndarray:
        """Returns the nanoseconds of each sample that count. A query by the wall clock is what the tree's stages leave of the sample.
        Samples without a wall clock count by their stages."""
        of_query = self.objective == "query"
        if self.by_wall:
            walls = [raw.get("wall_ns", whole_ns(sample)) for raw, sample in zip(counted(cell.all_samples), cell.samples, strict=True)]
            return numpy.array([wall - of_query * stages_ns(sample, False)
                                for wall, sample in zip(walls, cell.samples, strict=True)], float)
        return numpy.array([stages_ns(sample, True) if of_query else whole_ns(sample) for sample in cell.samples], float)

    def middle(self, cell: Cell) -> float:
        return median(self.values(cell))


def middle_of(cells: Iterable[Cell]) -> Callable[[Cell], float]:
    """Returns the function that gives the time by which one of these cells is compared with the others."""
    return Measure("frame", is_by_wall(cells)).middle


def ends_of(values: numpy.ndarray) -> tuple[float, float]:
    """Returns the order statistics that hold the median with a probability of 95 %, or the range of fewer than 6 values."""
    ascending = numpy.sort(values)
    rank = max(1, rank_below(len(values), ERROR))
    return float(ascending[rank - 1]), float(ascending[len(values) - rank])


@functools.cache
def rank_below(count: int, error: float) -> int:
    """Returns the largest k for which fewer than k of `count` independent values are below their median with a probability of at
    most `error` / 2; 0 if `count` is too small."""
    if count == 0:
        return 0
    factorials = numpy.cumsum(numpy.log(numpy.maximum(numpy.arange(count + 1), 1)))  # their logarithms
    shares = numpy.exp(factorials[-1] - factorials - factorials[::-1] - count * math.log(2))  # with k values below the median
    return int(numpy.searchsorted(numpy.cumsum(shares), error / 2))


def was_beaten(cell: Cell) -> bool:
    return cell.raw.get("sampling", {}).get("stopped") == "beaten"


class Frame:
    """All cells of one frame, and the one that the others are compared with."""

    def __init__(self, cells: list[Cell], measure: Measure) -> None:
        self.measure = measure
        stayed = [cell for cell in cells if not was_beaten(cell)] or cells
        self.base = min(stayed, key=measure.middle)

    def base_until(self, order: float) -> float:
        """Returns the median of the base's samples up to the given order, or its first sample's value."""
        values = self.measure.values(self.base)
        until = [value for value, raw in zip(values, counted(self.base.all_samples), strict=True) if raw["order"] <= order]
        return median(until or values[:1])

    def level(self, cell: Cell) -> float:
        """Returns the cell's median, as it would have been while the frame's best cell was sampled."""
        own = self.measure.middle(cell)
        if not was_beaten(cell) or cell is self.base:
            return own
        beside = self.base_until(counted(cell.all_samples)[-1]["order"])
        return own * self.measure.middle(self.base) / beside if beside > 0 else own


def method(cell: Cell) -> tuple[Hashable, ...]:
    """Returns what is ranked: a builder or pipeline, or a method along an axis of accuracy."""
    return *cell.key("operation", "builder", "collider", "caches"), cell.accuracy.get("method")


def interval_of(cell: Cell, measure: Measure) -> tuple[float, float, float]:
    """Returns the median and the ends of its interval, which also holds the medians of all processes that samples are from."""
    values = measure.values(cell)
    ends = [*ends_of(values), *map(measure.middle, cell.processes)]
    return median(values), min(ends), max(ends)


def margins(row: Row, measure: Measure) -> tuple[float, float, float]:
    """Returns the sum of the medians of the row's cells, and by how much its interval goes below and above it."""
    parts = [interval_of(cell, measure) for cell in row.cells]
    return (sum(middle for middle, _, _ in parts), math.hypot(*(middle - low for middle, low, _ in parts)),
            math.hypot(*(high - middle for middle, _, high in parts)))


def is_tied(row: Row, best: Row, measure: Measure) -> bool:
    """True if the intervals of both overlap or the times hardly differ. Few samples tell only what is far apart."""
    if row is best:
        return True
    if not row.complete:
        return False
    if measure.objective not in AMOUNTS and row.ratio < 1 + LEAST:
        return True
    if any(was_beaten(cell) for cell in row.cells):
        return False
    if min(len(cell.samples) for cell in row.cells + best.cells) < FEWEST:
        return row.ns < FAR * best.ns
    (own, below, _), (other, _, above) = margins(row, measure), margins(best, measure)
    return own - below <= other + above


def rows_of_scene(cells: list[Cell], measure: Measure) -> list[Row]:
    """Ranks the cells of one scene, all of which have times. Rows that lack frames come after the others of a like ratio."""
    objective = measure.objective
    frames = {number: Frame(there, measure) for number, there in grouped(cells, lambda cell: cell.frame).items()}
    levels = {id(cell): frames[cell.frame].level(cell) for cell in cells}
    rows = []
    for there in grouped(cells, method).values():
        ns, own = mean([levels[id(cell)] for cell in there]), mean([measure.middle(cell) for cell in there])
        rows.append(Row(there, ns, ns / own if own > 0 else 1, complete=len({cell.frame for cell in there}) == len(frames)))

    def total(row: Row, numbers: set[int]) -> float:
        return sum(levels[id(cell)] for cell in row.cells if cell.frame in numbers)

    full = [row for row in rows if row.complete] or rows
    best = min(full, key=lambda row: (row.amount(objective), total(row, set(frames))))
    for row in rows:
        there = {cell.frame for cell in row.cells} & {cell.frame for cell in best.cells}
        own, least = row.amount(objective), best.amount(objective)
        row.ratio = total(row, there) / max(total(best, there), 1e-9) if there else math.inf
        if there and not measure.by_wall and row.is_on_host != best.is_on_host:
            row.ratio = row.host_ns(there) / best.host_ns(there)
        if objective in AMOUNTS:
            row.ratio = own / least if least > 0 else 1 if own == least else math.inf
        row.tied = own == least and is_tied(row, best, measure)
    return sorted(rows, key=lambda row: (row is not best, row.ratio, not row.complete, row.ns))


def over_scenes(scenes: dict[str, list[Row]]) -> list[Row]:
    """Ranks the pipelines that have a time in every scene by the geometric mean of their ratios."""
    found = grouped(itertools.chain(*scenes.values()), lambda row: method(row.first))
    every = [rows for rows in found.values() if len(rows) == len(scenes) and all(row.ratio > 0 for row in rows)]
    merged = [Row([cell for row in rows for cell in row.cells], mean([row.ns for row in rows]), 1,
                  float(numpy.exp(numpy.mean(numpy.log([row.ratio for row in rows])))), all(row.tied for row in rows),
                  all(row.complete for row in rows), [row.ratio for row in rows]) for rows in every]
    return sorted(merged, key=lambda row: row.ratio)


def ranked(cells: Iterable[Cell], objective: str = "frame", trusts_stages: bool = False) -> Ranking:
    """Ranks builders or pipelines. Cells that are wrong are named apart and never ranked; neither is what has no times. With
    `trusts_stages`, the stages of methods from outside are taken as they say."""
    cells = list(cells)
    wrong = [cell for cell in cells if cell.verdict == "differs"]
    bad = {(cell.scene, method(cell)) for cell in wrong}
    timed = [cell for cell in cells if cell.has_times and (cell.scene, method(cell)) not in bad
             and (objective not in AMOUNTS or not math.isnan(AMOUNTS[objective](cell)))]
    still = {scene for scene, there in grouped(timed, lambda cell: cell.scene).items() if len({cell.frame for cell in there}) == 1}
    unplaced = [cell for cell in timed if cell.scene in still and cell.is_frame
                and families.keeps(cell.collider or "", dict(cell.collider_options).get("update", ""))]
    placed = [cell for cell in timed if cell not in unplaced]
    measure = Measure(objective, not trusts_stages and is_by_wall(placed))
    scenes = {scene: rows_of_scene(later(there), measure) for scene, there in grouped(placed, lambda cell: cell.scene).items()}
    rows = next(iter(scenes.values())) if len(scenes) == 1 else over_scenes(scenes)
    without = [cell for cell in cells if not cell.has_times and cell.verdict != "differs"]
    return Ranking(objective, measure.by_wall, rows, scenes, wrong, without, unplaced)
