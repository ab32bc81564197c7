"""The test of Mann and Whitney: whether two samples may be of one distribution, by their ranks alone."""
import numpy

MOST_COUNTED = 20  # values of each sample of which all orders are counted


def p_value(first: numpy.ndarray, second: numpy.ndarray) -> float:
    """The chance of ranks as uneven or more so, either way. Without ties, and with at most 20 of each, it is exact; else it is
    the normal approximation's, with the corrections for ties and continuity. Where a sample is empty it is 1."""
    from scipy.stats import mannwhitneyu

    if not len(first) or not len(second):
        return 1.0
    both = numpy.concatenate((first, second))
    is_exact = max(len(first), len(second)) <= MOST_COUNTED and len(numpy.unique(both)) == len(both)
    return float(mannwhitneyu(first, second, alternative="two-sided", method="exact" if is_exact else "asymptotic").pvalue)
