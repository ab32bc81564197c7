"""Times of all cells of a scene together. A change that they have in common is not a change of one of them."""
import math
from dataclasses import dataclass, field, replace

import numpy

from cells import Cell, median
from comparing import drift
from comparing.intervals import Interval, median_interval, ratio_interval
from comparing.launches import share_of
from comparing.times import FEWEST_SAMPLES, UNSURE, TimeChange, time_change, verdict_of

FEWEST_CELLS = 4  # with fewer cells, a single changed cell would move the median of all
FEWEST_SCENES = 3  # for a spread of their common changes
# Logarithm of the largest ratio that a machine's state explains, from observations on a shared host. A cell with a larger ratio
# has changed, however much the other cells vary.
MOST_DRIFT = 0.47  # a factor of 1.6


@dataclass(frozen=True)
class SceneChange:
    """A common change of a scene's cells: the device, or code that all of them share, became slower or faster."""

    scene: Cell  # one of its cells
    cells: int  # cells with enough samples
    ratio: Interval  # median of the cells' ratios, with ends from the variation within the runs
    spread: float  # how far a cell's ratio may differ from it by chance, as a ratio
    launches: float  # share of its times that launches may cost more
    verdict: str = UNSURE


@dataclass(frozen=True)
class Against:
    pairs: list[drift.Pair]  # one pair of sample series for each cell
    trend: numpy.ndarray = field(default_factory=lambda: numpy.empty(0))  # by sample index, if runs took turns
    common: Interval = Interval(1, 1, 1)  # ratio common to all cells
    allowance: float = 0  # nanoseconds that a launch may differ by


def each_alone(cells: list[drift.CellPair], allowance: float) -> Against:
    """Compares two builders: what their cells have in common is what is asked for, and is not removed."""
    return Against(drift.counted_pairs(cells), allowance=allowance)


def by_turns(cells: list[drift.CellPair]) -> Against:
    pairs = drift.all_pairs(cells)
    return Against(pairs, trend=drift.common_trend(pairs))


def beside_the_others(cells: list[drift.CellPair], allowance: float, error: float) -> tuple[Against, SceneChange | None]:
    """Compares two runs made at different times. With enough cells, removes their common ratio and reports it; otherwise the
    common ratio stays 1 and only widens the intervals. `allowance`: nanoseconds that a launch may differ by; `error`: allowed for
    the common change."""
    pairs = drift.at_like_speed(cells)
    ratios = log_ratios(pairs)
    if not len(ratios):
        return Against(pairs, common=Interval(0, 1, math.inf)), None
    launches = median([share_of(pair, "", allowance) for pair in pairs])
    middle, spread = math.exp(median(ratios)), spread_of(ratios)
    margin = margin_of(pairs, ratios, spread)
    if len(ratios) < FEWEST_CELLS:
        return Against(pairs, common=Interval(1 / margin, 1, margin), allowance=allowance), None
    margin = math.exp(math.hypot(math.log(margin), *(level_margin([pair[of] for pair in pairs], error) for of in (0, 1))))
    ratio, spread = Interval(middle / margin, middle, middle * margin), math.exp(spread)
    return (Against(pairs, common=Interval(middle / spread, middle, middle * spread), allowance=allowance),
            SceneChange(cells[0][0], len(ratios), ratio, spread, launches))


def judged(changes: list[SceneChange], threshold: float) -> list[SceneChange]:
    """Returns the common changes with their verdicts. Each is widened by the spread of all: the scenes were measured one after
    another, so it shows how much the machine changes from one run to another within such a time."""
    spread = spread_of(numpy.log([change.ratio.value for change in changes])) if len(changes) >= FEWEST_SCENES else 0
    found = []
    for change in changes:
        widened = ratio_interval(change.ratio, Interval(math.exp(-spread), 1, math.exp(spread)))
        found.append(replace(change, ratio=widened, verdict=verdict_of(widened, threshold, change.launches)))
    return found


def of_other_devices(cells: list[drift.CellPair]) -> Against | None:
    """Returns None for a scene with one cell, which has no other to be compared with."""
    pairs = drift.counted_pairs(cells)
    ratios = log_ratios(pairs)
    middle = math.exp(median(ratios))
    return Against(pairs, common=Interval(middle, middle, middle)) if len(ratios) > 1 else None


def log_ratios(pairs: list[drift.Pair]) -> numpy.ndarray:
    """Returns the logarithms of the ratios of medians, for cells with enough samples."""
    medians = [[max(median(series.times_ns()), 1) for series in pair] for pair in pairs
               if min(map(len, pair)) >= FEWEST_SAMPLES]
    return numpy.log([second / first for first, second in medians])


def spread_of(ratios: numpy.ndarray) -> float:
    """Returns how far a ratio may differ from the median by chance: three standard deviations, estimated from the median
    distance, so that a few changed cells do not matter."""
    return min(3 * drift.NORMAL * median(numpy.abs(ratios - median(ratios))), MOST_DRIFT)


def margin_of(pairs: list[drift.Pair], ratios: numpy.ndarray, spread: float) -> float:
    wavered = drift.wavering([first for first, _ in pairs]) + drift.wavering([second for _, second in pairs])
    return math.exp(math.hypot(wavered, spread / math.sqrt(len(ratios))))


def level_margin(cells: list[drift.Series], error: float) -> float:
    """Returns how far the median level of a run may be from where it was during these samples, as a logarithm: half the interval
    of the median of the cells' common course. It is infinite if neighbouring samples are so alike that the run, as long as it
    was, may have met one state of the machine only."""
    course = median_interval(numpy.exp(drift.by_place(cells, 0)), error)
    return max(math.log(course.high / course.value), math.log(course.value / course.low)) if course.has_ends else math.inf


def change_of(pair: drift.Pair, stage: str, against: Against, threshold: float, error: float) -> TimeChange:
    """Returns the change of a stage's time, or of a cell's whole time if `stage` is empty."""
    first, second = (without_trend(series.times_ns(stage), against.trend) for series in pair)
    return time_change(first, second, threshold, error, against.common, share_of(pair, stage, against.allowance))


def without_trend(times: numpy.ndarray, trend: numpy.ndarray) -> numpy.ndarray:
    shared = min(len(times), len(trend))
    return numpy.concatenate((times[:shared] * numpy.exp(-trend[:shared]), times[shared:]))
