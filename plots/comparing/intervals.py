"""The median of times that were taken one after the other, and between which two values the true one is."""
import functools
import math
from typing import NamedTuple

import numpy

from cells import median


class Interval(NamedTuple):
    """A value, and between which two the true one is at the confidence asked for. Without enough samples the ends are 0 and
    infinity."""

    low: float
    value: float
    high: float

    @property
    def has_ends(self) -> bool:
        return math.isfinite(self.high) and self.low > 0


NOTHING_KNOWN = Interval(0, 0, math.inf)


def samples_per_independent_one(in_order: numpy.ndarray) -> float:
    """By how much more than independent ones values that were taken in this order vary together, about their median: the
    integrated autocorrelation time of being above it, at least 1. A machine that is slow for a while gives many samples that
    say one thing."""
    side = numpy.sign(in_order - median(in_order))
    variance = side @ side
    time = 1.0
    if variance > 0:
        noise = math.sqrt(2 / len(side))  # of two lags of independent ones
        # Two lags at a time, while there is more than noise (after Geyer's initial positive sequence).
        for lag in range(1, len(side) // 4, 2):
            pair = (side[:-lag] @ side[lag:] + side[:-lag - 1] @ side[lag + 1:]) / variance
            if pair <= noise:
                break
            time += 2 * pair
    return time


@functools.cache
def rank_below(count: int, error: float) -> int:
    """The largest k for which as many independent values have fewer than k below their median with a chance of `error` / 2 at
    most; 0 if they are too few for that."""
    from scipy.stats import binom

    return int(binom.ppf(error / 2, count, 0.5)) if count > 0 else 0


def median_interval(in_order: numpy.ndarray, error: float) -> Interval:
    """The median, and the order statistics that it is between with at most `error` of being outside. How far apart they must be
    is the binomial distribution's, of as many samples as are independent."""
    count = len(in_order)
    if count == 0:
        return NOTHING_KNOWN
    middle = median(in_order)
    independent = int(count / samples_per_independent_one(in_order))
    rank = rank_below(independent, error)
    if rank == 0:
        return Interval(0, middle, math.inf)
    ascending = numpy.sort(in_order)
    place = rank * count // independent  # from 1, from either end
    return Interval(float(ascending[place - 1]), middle, float(ascending[count - place]))


def ratio_interval(numerator: Interval, denominator: Interval) -> Interval:
    """The ratio of two quantities that are above 0, from the interval of each, at the error of each: differences of logarithms,
    whose margins are added as squares (MOVER: Zou and Donner, 2008)."""
    if not (numerator.value > 0 and denominator.value > 0):
        return NOTHING_KNOWN
    with numpy.errstate(divide="ignore", over="ignore"):
        low, value, high = numpy.log(numerator)
        other_low, other_value, other_high = numpy.log(denominator)
        ratio = numpy.log(numerator.value / denominator.value)
        below, above = numpy.hypot(value - low, other_high - other_value), numpy.hypot(high - value, other_value - other_low)
        return Interval(*(float(end) for end in numpy.exp((ratio - below, ratio, ratio + above))))
