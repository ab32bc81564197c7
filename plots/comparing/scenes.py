"""Times of all cells of a scene together. A change that they have in common is not a change of one of them."""
import math
from dataclasses import dataclass, field

import numpy

from cells import Cell, median
from comparing import drift
from comparing.intervals import Interval
from comparing.times import FEWEST_SAMPLES, TimeChange, time_change, verdict_of

FEWEST_CELLS = 4  # with fewer cells, a single changed cell would move the median of all
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
    verdict: str


@dataclass(frozen=True)
class Against:
    pairs: list[drift.Pair]  # one pair of sample series for each cell
    trend: numpy.ndarray = field(default_factory=lambda: numpy.empty(0))  # by sample index, if runs took turns
    common: Interval = Interval(1, 1, 1)  # ratio common to all cells


def by_turns(cells: list[drift.CellPair]) -> Against:
    pairs = drift.all_pairs(cells)
    return Against(pairs, trend=drift.common_trend(pairs))


def beside_the_others(cells: list[drift.CellPair], threshold: float) -> tuple[Against, SceneChange | None]:
    """Compares two runs made at different times. With enough cells, removes their common ratio and reports it; otherwise the
    common ratio stays 1 and only widens the intervals."""
    pairs = drift.at_like_speed(cells)
    ratios = log_ratios(pairs)
    if not len(ratios):
        return Against(pairs, common=Interval(0, 1, math.inf)), None
    middle, spread = math.exp(median(ratios)), spread_of(ratios)
    margin = margin_of(pairs, ratios, spread)
    if len(ratios) < FEWEST_CELLS:
        return Against(pairs, common=Interval(1 / margin, 1, margin)), None
    ratio, spread = Interval(middle / margin, middle, middle * margin), math.exp(spread)
    return (Against(pairs, common=Interval(middle / spread, middle, middle * spread)),
            SceneChange(cells[0][0], len(ratios), ratio, spread, verdict_of(ratio, threshold)))


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


def change_of(pair: drift.Pair, stage: str, against: Against, threshold: float, error: float) -> TimeChange:
    """Returns the change of a stage's time, or of a cell's whole time if `stage` is empty."""
    first, second = (without_trend(series.times_ns(stage), against.trend) for series in pair)
    return time_change(first, second, threshold, error, against.common)


def without_trend(times: numpy.ndarray, trend: numpy.ndarray) -> numpy.ndarray:
    shared = min(len(times), len(trend))
    return numpy.concatenate((times[:shared] * numpy.exp(-trend[:shared]), times[shared:]))
