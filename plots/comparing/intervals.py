"""Medians of times taken in sequence, with confidence intervals."""
import functools
import math
from typing import NamedTuple

import numpy

from cells import median


class Interval(NamedTuple):
    """A value with the ends of its confidence interval. With too few samples the ends are 0 and infinity."""

    low: float
    value: float
    high: float

    @property
    def has_ends(self) -> bool:
        return math.isfinite(self.high) and self.low > 0


NOTHING_KNOWN = Interval(0, 0, math.inf)


def samples_per_independent_one(in_order: numpy.ndarray) -> float:
    """Returns the integrated autocorrelation time (at least 1) of being above the median: the number of values in this order
    that carry as much information as one independent value. A machine that is slow for a while gives many samples that say the
    same."""
    side = numpy.sign(in_order - median(in_order))
    variance = side @ side
    time = 1.0
    if variance > 0:
        noise = math.sqrt(2 / len(side))  # of two lags of independent values
        # Adds two lags at a time, while they exceed the noise (after Geyer's initial positive sequence).
        for lag in range(1, len(side) // 4, 2):
            pair = (side[:-lag] @ side[lag:] + side[:-lag - 1] @ side[lag + 1:]) / variance
            if pair <= noise:
                break
            time += 2 * pair
    return time


@functools.cache
def rank_below(count: int, error: float) -> int:
    """Returns the largest k for which fewer than k of `count` independent values are below their median with a probability of at
    most `error` / 2; 0 if `count` is too small."""
    if count == 0:
        return 0
    factorials = numpy.cumsum(numpy.log(numpy.maximum(numpy.arange(count + 1), 1)))  # their logarithms
    shares = numpy.exp(factorials[-1] - factorials - factorials[::-1] - count * math.log(2))  # with k values below the median
    return int(numpy.searchsorted(numpy.cumsum(shares), error / 2))


def median_interval(in_order: numpy.ndarray, error: float) -> Interval:
    """Returns the median and the order statistics around it that contain the true median with an error of at most `error`. Their
    distance follows the binomial distribution for the number of independent samples."""
    count = len(in_order)
    if count == 0:
        return NOTHING_KNOWN
    middle = median(in_order)
    independent = int(count / samples_per_independent_one(in_order))
    rank = rank_below(independent, error)
    if rank == 0:
        return Interval(0, middle, math.inf)
    ascending = numpy.sort(in_order)
    place = rank * count // independent  # from 1, counted from each end
    return Interval(float(ascending[place - 1]), middle, float(ascending[count - place]))


def ratio_interval(numerator: Interval, denominator: Interval) -> Interval:
    """Returns the ratio of two positive quantities with its interval, at the error of the given intervals. Differences of
    logarithms have margins that are added in quadrature (MOVER: Zou and Donner, 2008)."""
    if not (numerator.value > 0 and denominator.value > 0):
        return NOTHING_KNOWN
    with numpy.errstate(divide="ignore", over="ignore"):
        low, value, high = numpy.log(numerator)
        other_low, other_value, other_high = numpy.log(denominator)
        ratio = numpy.log(numerator.value / denominator.value)
        below, above = numpy.hypot(value - low, other_high - other_value), numpy.hypot(high - value, other_value - other_low)
        return Interval(*(float(end) for end in numpy.exp((ratio - below, ratio, ratio + above))))
