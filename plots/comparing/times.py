"""Compares the times of one cell or stage in two files."""
import functools
import math
from dataclasses import dataclass

import numpy

from comparing.intervals import NOTHING_KNOWN, Interval, median_interval, ratio_interval

SAME, FASTER, SLOWER, UNSURE = "SAME", "FASTER", "SLOWER", "UNSURE"
FEWEST_SAMPLES = 9  # in each file, for a verdict on times
MOST_COUNTED = 20  # samples of each file up to which the Mann-Whitney test is exact


@dataclass(frozen=True)
class TimeChange:
    """The change of one cell or stage. Medians are in nanoseconds. The ratio is the second median over the first, divided by the
    scene's common ratio."""

    first: Interval = NOTHING_KNOWN
    second: Interval = NOTHING_KNOWN
    ratio: Interval = NOTHING_KNOWN
    p: float = 1.0  # of the Mann-Whitney test
    counts: tuple[int, int] = (0, 0)  # numbers of samples
    verdict: str = UNSURE


def time_change(first: numpy.ndarray, second: numpy.ndarray, threshold: float, error: float,
                common: Interval = Interval(1, 1, 1), launches: float = 0) -> TimeChange:
    """Compares times in the order taken; `common` is the ratio shared by the scene's cells, and `launches` the share of the first
    median that launches may cost more. FASTER and SLOWER require all of: 9 samples in each file, a median ratio beyond the
    threshold and beyond `launches`, an interval of the ratio without 1, and a Mann-Whitney p below `error`. SAME requires an
    interval within the threshold. Everything else is UNSURE."""
    medians = median_interval(first, error), median_interval(second, error)
    ratio = ratio_interval(ratio_interval(medians[1], medians[0]), common)
    p, counts = p_value(first, second / common.value), (len(first), len(second))
    enough = min(counts) >= FEWEST_SAMPLES
    return TimeChange(*medians, ratio, p, counts, verdict_of(ratio, threshold, launches, p < error) if enough else UNSURE)


def p_value(first: numpy.ndarray, second: numpy.ndarray) -> float:
    """Returns the two-sided p of the Mann-Whitney test: the probability of ranks at least this uneven if both samples had one
    distribution. It is exact without ties and with at most 20 values each, otherwise the normal approximation with corrections
    for ties and continuity. It is 1 if a sample is empty."""
    counts, pairs = (len(first), len(second)), len(first) * len(second)
    if not pairs:
        return 1.0
    ascending = numpy.sort(second)
    below = sum(numpy.searchsorted(ascending, first, side).sum() for side in ("left", "right")) / 2  # of pairs; equal ones count half
    most = max(below, pairs - below)
    _, repeats = numpy.unique(numpy.concatenate((first, second)), return_counts=True)
    if max(counts) <= MOST_COUNTED and max(repeats) == 1:
        of_order = orders_by_pairs(*counts)
        return min(1.0, 2 * sum(of_order[int(most):]) / sum(of_order))
    size = sum(counts)
    variance = pairs / 12 * (size + 1 - sum(repeats**3 - repeats) / (size * (size - 1)))
    distance = most - pairs / 2 - 0.5
    return min(1.0, math.erfc(distance / math.sqrt(2 * variance))) if variance > 0 else 1.0


@functools.cache
def orders_by_pairs(first: int, second: int) -> list[int]:
    """Returns how many ways there are to mix two ordered samples of `first` and `second` values, by the number of pairs whose
    larger value is in the first sample: the coefficients of the Gaussian binomial."""
    orders = [1] + [0] * (first * second)
    for k in range(1, first + 1):
        for pairs in range(first * second, second + k - 1, -1):
            orders[pairs] -= orders[pairs - second - k]
        for pairs in range(k, first * second + 1):
            orders[pairs] += orders[pairs - k]
    return orders


def verdict_of(ratio: Interval, threshold: float, launches: float = 0, differs: bool = True) -> str:
    smallest = 1 + max(threshold, launches)
    if differs and ratio.low > 1 and ratio.value >= smallest:
        return SLOWER
    if differs and ratio.high < 1 and ratio.value <= 1 / smallest:
        return FASTER
    return SAME if ratio.low > 1 / (1 + threshold) and ratio.high < 1 + threshold else UNSURE
