"""How times of the second of two files relate to the first's."""
from dataclasses import dataclass

import numpy

from comparing.intervals import NOTHING_KNOWN, Interval, median_interval, ratio_interval

SAME, FASTER, SLOWER, UNSURE = "SAME", "FASTER", "SLOWER", "UNSURE"
FEWEST_SAMPLES = 9  # of each file that times are judged by
MOST_COUNTED = 20  # values of each sample of which the test of Mann and Whitney counts all orders


@dataclass(frozen=True)
class TimeChange:
    """Of one cell or stage. Medians are in nanoseconds; the ratio is the second's over the first's, over what the scene's have in
    common."""

    first: Interval = NOTHING_KNOWN
    second: Interval = NOTHING_KNOWN
    ratio: Interval = NOTHING_KNOWN
    p: float = 1.0  # of Mann and Whitney
    counts: tuple[int, int] = (0, 0)  # samples
    verdict: str = UNSURE


def time_change(first: numpy.ndarray, second: numpy.ndarray, threshold: float, error: float,
                common: Interval = Interval(1, 1, 1)) -> TimeChange:
    """Judge times in the order taken; `common` is a ratio that has nothing to do with the cell. Faster and slower need all of: 9
    samples of each; a median that is off by the threshold; an interval of the ratio without 1; and a p of Mann and Whitney below
    `error`. Same is an interval within the threshold. The rest is unsure."""
    medians = median_interval(first, error), median_interval(second, error)
    ratio = ratio_interval(ratio_interval(medians[1], medians[0]), common)
    p, counts = p_value(first, second / common.value), (len(first), len(second))
    enough = min(counts) >= FEWEST_SAMPLES
    return TimeChange(*medians, ratio, p, counts, verdict_of(ratio, threshold, p < error) if enough else UNSURE)


def p_value(first: numpy.ndarray, second: numpy.ndarray) -> float:
    """The chance of ranks as uneven or more so, either way, if both samples were of one distribution (Mann and Whitney). Without
    ties, and with at most 20 of each, it is exact; else it is the normal approximation's, with the corrections for ties and
    continuity. Where a sample is empty it is 1."""
    from scipy.stats import mannwhitneyu

    if not len(first) or not len(second):
        return 1.0
    has_ties = len(numpy.unique(numpy.concatenate((first, second)))) < len(first) + len(second)
    is_exact = max(len(first), len(second)) <= MOST_COUNTED and not has_ties
    return float(mannwhitneyu(first, second, alternative="two-sided", method="exact" if is_exact else "asymptotic").pvalue)


def verdict_of(ratio: Interval, threshold: float, differs: bool = True) -> str:
    if differs and ratio.low > 1 and ratio.value >= 1 + threshold:
        return SLOWER
    if differs and ratio.high < 1 and ratio.value <= 1 / (1 + threshold):
        return FASTER
    return SAME if ratio.low > 1 / (1 + threshold) and ratio.high < 1 + threshold else UNSURE
