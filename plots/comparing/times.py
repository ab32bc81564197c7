"""Compares the times of one cell or stage in the processes of two sides.

Two processes of one program differ for as long as they run: in where their memory lies, and in what the machine does meanwhile. The
samples of one process say nothing of that. So each process counts as one value, the logarithm of its median, and the spread of the
differences between processes that ran beside each other tells which difference chance explains."""
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy

from ..read import student
from ..read.cells import median

SAME, FASTER, SLOWER, UNSURE = "SAME", "FASTER", "SLOWER", "UNSURE"
FEWEST_SAMPLES = 9  # of each side, for a verdict
# The largest ratio that two processes of one program had on a shared host. Without a spread between processes, only a larger
# one is a change.
MOST_DRIFT = 1.6
OFTEN = 0.9  # the smallest change that is told is found this often
LARGEST_EXPONENT = 700.0  # exp of a larger one is beyond a double
NORMAL, OF_MEDIAN = 1.4826, 1.2533  # standard deviation over median distance; standard error of the median over the mean's

Times = Sequence[numpy.ndarray]  # nanoseconds, an array for each process of a side


class Interval(NamedTuple):
    low: float
    value: float
    high: float


@dataclass(frozen=True)
class Spread:
    """The standard deviation of the differences of a scene's cells between the sides, one difference for each pair of processes, and
    its degrees of freedom."""

    deviation: float
    freedom: int


@dataclass(frozen=True)
class TimeChange:
    """The change of one cell or stage. Medians are in nanoseconds, over all processes of a side. The ratio is the second over the
    first, divided by the scene's common ratio. `smallest` is the ratio of the smallest change that would be found."""

    first: float = 0
    second: float = 0
    ratio: Interval = Interval(0, 1, math.inf)
    smallest: float = math.inf
    counts: tuple[str, str] = ("", "")  # of samples, "60" or "8x60"; empty without samples
    verdict: str = UNSURE


def log_medians(times: Times) -> numpy.ndarray:
    return numpy.log([max(median(each), 1) for each in times])


def differences(first: Times, second: Times) -> numpy.ndarray:
    """Returns the logarithm of the ratio of medians of each pair of processes."""
    return log_medians(second) - log_medians(first)


def spread_of(cells: Sequence[numpy.ndarray]) -> Spread | None:
    """Returns the spread of the differences of all cells of a scene; nothing for one pair of processes. The cells of one process
    deviate together, at a correlation of about 0.7, so that of c cells each adds less than the first: 2 c / (c + 1) in all."""
    if len(cells[0]) < 2:
        return None
    variance = float(numpy.mean([each.var(ddof=1) for each in cells]))
    return Spread(math.sqrt(variance), (len(cells[0]) - 1) * 2 * len(cells) // (len(cells) + 1))


def time_change(first: Times, second: Times, threshold: float, error: float, spread: Spread | None = None,
                common: float = 1) -> TimeChange:
    """Compares two sides. With a `spread` their processes are pairs. FASTER and SLOWER require 9 samples of each side, a ratio beyond
    the threshold, and an interval of the ratio without 1; SAME an interval within the threshold. Everything else is UNSURE.
    `error`: that of the interval; `common`: the ratio that all cells of the scene share."""
    if not all(map(len, first)) or not all(map(len, second)):
        return TimeChange()
    middle = float(log_medians(second).mean() - log_medians(first).mean()) - math.log(common)
    if spread is None:
        deviation = math.hypot(*(error_of_median(each) for each in (*first, *second)))
        margin = math.hypot(math.log(MOST_DRIFT), 3 * deviation)
    else:
        deviation = max(spread.deviation, float(differences(first, second).std(ddof=1))) / math.sqrt(len(first))
        margin = student.quantile(error, spread.freedom) * deviation
    often = 0 if spread is None else student.quantile(2 * (1 - OFTEN), spread.freedom) * deviation
    ratio = Interval(*(math.exp(max(-LARGEST_EXPONENT, min(LARGEST_EXPONENT, middle + of * margin))) for of in (-1, 0, 1)))
    counts = counts_of(first), counts_of(second)
    enough = min(sum(map(len, first)), sum(map(len, second))) >= FEWEST_SAMPLES
    exponent = max(margin, math.log1p(threshold)) + often
    smallest = math.exp(exponent) if enough and exponent < LARGEST_EXPONENT else math.inf
    return TimeChange(median(numpy.concatenate(first)), median(numpy.concatenate(second)), ratio, smallest, counts,
                      verdict_of(ratio, threshold) if enough else UNSURE)


def error_of_median(times: numpy.ndarray) -> float:
    """Returns the standard error of the logarithm of a median, from the distances to it."""
    logarithms = numpy.log(numpy.maximum(times, 1))
    return OF_MEDIAN * NORMAL * median(numpy.abs(logarithms - median(logarithms))) / math.sqrt(len(times))


def counts_of(times: Times) -> str:
    numbers = "-".join(str(count) for count in dict.fromkeys((min(map(len, times)), max(map(len, times)))))
    return numbers if len(times) == 1 else f"{len(times)}x{numbers}"


def verdict_of(ratio: Interval, threshold: float) -> str:
    if ratio.low > 1 and ratio.value >= 1 + threshold:
        return SLOWER
    if ratio.high < 1 and ratio.value <= 1 / (1 + threshold):
        return FASTER
    return SAME if ratio.low > 1 / (1 + threshold) and ratio.high < 1 + threshold else UNSURE


def without_verdict(change: TimeChange) -> TimeChange:
    """Returns the change as one that is not sure, if it was called faster or slower."""
    return replace(change, verdict=UNSURE) if change.verdict in (FASTER, SLOWER) else change
