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
FEWEST = 3  # samples of a frame, without drift, from which intervals are compared
FEWEST_OF_BEST = 5  # samples, of all frames, without which nothing is named the best
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
    low: float = math.nan  # ends of its interval in multiples of the best; NaN where it is not ranked by time
    high: float = math.nan

    @property
    def first(self) -> Cell:
        return self.cells[0]

    @property
    def bytes(self) -> float:
        return self.amount("memory")

    def amount(self, objective: str) -> float:
        """Returns the mean amount that an objective of AMOUNTS ranks by, or 0 for a time."""
        return mean([AMOUNTS[objective](cell) for cell in self.cells]) if objective in AMOUNTS else 0

    def host_ns(self, frames: Container[int]) -> float:
        """Returns the mean over these frames by the host's clock, with the copies of vertices to the device and of what is found back."""
        return mean([(cell.wall_ns or cell.median_ns()) + sum(cell.counters.get(f"{copy}_ns", 0) for copy in ("upload", "read_back"))
                     for cell in self.cells if cell.frame in frames])

    @property
    def counts(self) -> list[int]:
        """Returns the number of samples of each cell that statistics use."""
        return [len(cell.samples) for cell in self.cells]

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


def levels(cells: list[Cell], measure: Measure) -> dict[int, float]:
    """Returns, by id, the median of each cell of a frame, as it would have been while the frame's best cell was sampled: that of a beaten
    one in proportion to the median of the best's samples up to its own last, or to the best's first sample."""
    best = min([cell for cell in cells if not was_beaten(cell)] or cells, key=measure.middle)
    ordered = list(zip([raw["order"] for raw in counted(best.all_samples)], measure.values(best), strict=True))
    found = {}
    for cell in cells:
        last = counted(cell.all_samples)[-1]["order"] if was_beaten(cell) and cell is not best else math.inf
        beside = median([value for order, value in ordered if order <= last] or [ordered[0][1]])
        found[id(cell)] = measure.middle(cell) * (measure.middle(best) / beside if beside > 0 else 1)
    return found


def method(cell: Cell) -> tuple[Hashable, ...]:
    """Returns what is ranked: a builder or pipeline, or a method along an axis of accuracy."""
    return *cell.key("operation", "builder", "collider", "caches"), cell.accuracy.get("method")


def band(row: Row, measure: Measure) -> tuple[float, float]:
    """Returns the ends of the interval of the row's mean time, in nanoseconds. A cell's interval also holds the medians of all processes
    that its samples are from."""
    parts = [(measure.middle(cell), [*ends_of(measure.values(cell)), *map(measure.middle, cell.processes)]) for cell in row.cells]
    below, above = math.hypot(*(middle - min(ends) for middle, ends in parts)), math.hypot(*(max(ends) - middle for middle, ends in parts))
    middle, scale = sum(middle for middle, _ in parts), row.scale / len(parts)
    return scale * (middle - below), scale * (middle + above)


def set_ends(row: Row, best: Row, measure: Measure, times: float) -> None:
    """Sets the ends of the row's interval, in multiples of the best's time; `times` is the row's own time in these. What was beaten begins
    at its median, because the race has compared the intervals. Few samples tell only what is far apart."""
    row.low, row.high = math.nextafter(times / FAR, math.inf), times  # FAR times is far enough
    if min(row.counts + best.counts) >= FEWEST:
        row.low, row.high = (times * end / max(row.ns, 1) for end in band(row, measure))
    if any(map(was_beaten, row.cells)):
        row.low = times


def chosen(rows: Sequence[Row]) -> Row | None:
    """Returns which of the ranked rows to take: of those that tie with the best and whose median is in its interval, the one that holds
    the least memory, to two digits; then the plain builder of a family, as apetrei before apetrei-fused; then the fastest. What is built
    as printed comes last. None if none has enough samples."""
    def place(row: Row) -> tuple[float, ...]:
        held, builder = math.inf if math.isnan(row.bytes) else float(f"{row.bytes:.1e}"), row.first.builder
        return "printed" in builder, held, any(builder.startswith(f"{one.first.builder}-") for one in near), row.ratio, row.ns

    near = [row for row in rows if row is rows[0] or (row.tied and row.ratio <= rows[0].high)]
    enough = [row for row in near if min(row.counts) >= FEWEST and sum(len(cell.all_samples) for cell in row.cells) >= FEWEST_OF_BEST]
    return min(enough, key=place, default=None)


def rows_of_scene(cells: list[Cell], measure: Measure) -> list[Row]:
    """Ranks the cells of one scene, all of which have times. Rows that lack frames come after the others of a like ratio."""
    objective, level, rows = measure.objective, {}, []
    frames = grouped(cells, lambda cell: cell.frame)
    for there in frames.values():
        level |= levels(there, measure)
    for there in grouped(cells, method).values():
        ns, own = mean([level[id(cell)] for cell in there]), mean([measure.middle(cell) for cell in there])
        rows.append(Row(there, ns, ns / own if own > 0 else 1, complete=len({cell.frame for cell in there}) == len(frames)))

    def total(row: Row, numbers: Container[int]) -> float:
        return sum(level[id(cell)] for cell in row.cells if cell.frame in numbers)

    full = [row for row in rows if row.complete and (objective in AMOUNTS or min(row.counts) >= FEWEST)] or [row for row in rows if row.complete] or rows
    best = min(full, key=lambda row: (row.amount(objective), total(row, frames)))
    for row in rows:
        there = {cell.frame for cell in row.cells} & {cell.frame for cell in best.cells}
        own, least = row.amount(objective), best.amount(objective)
        row.ratio = total(row, there) / max(total(best, there), 1e-9) if there else math.inf
        on_host = [families.of_cell(one.first) in families.ON_HOST for one in (row, best)]
        if there and not measure.by_wall and on_host[0] != on_host[1]:
            row.ratio = row.host_ns(there) / best.host_ns(there)
        set_ends(row, best, measure, row.ratio if objective not in AMOUNTS else row.ns / max(best.ns, 1e-9))
        if objective in AMOUNTS:
            row.ratio = own / least if least > 0 else 1 if own == least else math.inf
    for row in rows:  # the best's interval is there
        is_as_fast = row.low <= best.high or (objective not in AMOUNTS and row.ratio < 1 + LEAST)
        row.tied = row is best or (row.complete and row.amount(objective) == best.amount(objective) and is_as_fast)
        row.low = math.nan if objective in AMOUNTS else row.low
    return sorted(rows, key=lambda row: (row is not best, row.ratio, not row.complete, row.ns))


def over_scenes(scenes: dict[str, list[Row]], objective: str) -> list[Row]:
    """Ranks the pipelines that have a time in every scene by the geometric mean of their ratios; so is the noise."""
    found = grouped(itertools.chain(*scenes.values()), lambda row: method(row.first))
    merged = []
    for rows in found.values():
        if len(rows) == len(scenes) and all(row.ratio > 0 for row in rows):
            ratio, low, high = (float(numpy.exp(numpy.mean(numpy.log([getattr(row, key) for row in rows])))) for key in ("ratio", "low", "high"))
            merged.append(Row([cell for row in rows for cell in row.cells], mean([row.ns for row in rows]), 1, ratio,
                              all(row.tied for row in rows), all(row.complete for row in rows), [row.ratio for row in rows], low, high))
    merged.sort(key=lambda row: row.ratio)
    for row in merged:
        row.tied = row is merged[0] or (row.complete and row.low <= merged[0].high) if objective not in AMOUNTS else row.tied
    return merged


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
    rows = next(iter(scenes.values())) if len(scenes) == 1 else over_scenes(scenes, objective)
    without = [cell for cell in cells if not cell.has_times and cell.verdict != "differs"]
    return Ranking(objective, measure.by_wall, rows, scenes, wrong, without, unplaced)
