"""The cells of a scene together: what they have in common, which is no change of one of them."""
import math
from dataclasses import dataclass, field

import numpy

from cells import Cell, median
from comparing import drift
from comparing.intervals import Interval
from comparing.times import FEWEST_SAMPLES, TimeChange, time_change, verdict_of

FEWEST_CELLS = 4  # of fewer, one that was changed moves the median of all
# Logarithm of a ratio that no state of a machine makes, by what was seen on a shared host: beyond it a cell has changed, however
# little the others agree.
MOST_DRIFT = 0.47  # 1.6


@dataclass(frozen=True)
class SceneChange:
    """The cells of a scene together: the device, or what all of them share, became slower or faster."""

    scene: Cell  # one of its cells
    cells: int  # with samples enough
    ratio: Interval  # median of the cells'; between what the runs wavered by
    spread: float  # how far off that a cell's ratio may be by chance, as a ratio
    verdict: str


@dataclass(frozen=True)
class Against:
    pairs: list[drift.Pair]  # the samples of each cell
    trend: numpy.ndarray = field(default_factory=lambda: numpy.empty(0))  # of samples by their place, where runs took turns
    common: Interval = Interval(1, 1, 1)  # ratio that is not a cell's own


def by_turns(cells: list[drift.CellPair]) -> Against:
    pairs = drift.all_pairs(cells)
    return Against(pairs, trend=drift.common_trend(pairs))


def beside_the_others(cells: list[drift.CellPair], threshold: float) -> tuple[Against, SceneChange | None]:
    """Of two runs that were apart. What cells of a scene have in common is told where they are enough; else it is nothing but how
    sure anything is."""
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
    """None of a cell that is alone on its scene: there is nothing to hold it against."""
    pairs = drift.counted_pairs(cells)
    ratios = log_ratios(pairs)
    middle = math.exp(median(ratios))
    return Against(pairs, common=Interval(middle, middle, middle)) if len(ratios) > 1 else None


def log_ratios(pairs: list[drift.Pair]) -> numpy.ndarray:
    """Logarithms of the ratios of medians, of cells with samples enough."""
    medians = [[max(median(series.times_ns()), 1) for series in pair] for pair in pairs
               if min(map(len, pair)) >= FEWEST_SAMPLES]
    return numpy.log([second / first for first, second in medians])


def spread_of(ratios: numpy.ndarray) -> float:
    """By how much one may be off their median by chance: three standard deviations, as the median of their distances tells them
    where a few of them are changed."""
    return min(3 * drift.NORMAL * median(numpy.abs(ratios - median(ratios))), MOST_DRIFT)


def margin_of(pairs: list[drift.Pair], ratios: numpy.ndarray, spread: float) -> float:
    wavered = drift.wavering([first for first, _ in pairs]) + drift.wavering([second for _, second in pairs])
    return math.exp(math.hypot(wavered, spread / math.sqrt(len(ratios))))


def change_of(pair: drift.Pair, stage: str, against: Against, threshold: float, error: float) -> TimeChange:
    """How a stage's time changed, or the whole time of a cell if `stage` is empty."""
    first, second = (without_trend(series.times_ns(stage), against.trend) for series in pair)
    return time_change(first, second, threshold, error, against.common)


def without_trend(times: numpy.ndarray, trend: numpy.ndarray) -> numpy.ndarray:
    shared = min(len(times), len(trend))
    return numpy.concatenate((times[:shared] * numpy.exp(-trend[:shared]), times[shared:]))
