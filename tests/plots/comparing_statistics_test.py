#!/usr/bin/env python3
"""Tests the statistics of `compare` against tables, SciPy's manual and simulations."""
import math
import unittest
from collections.abc import Callable

import numpy

import base  # noqa: F401  first: it adds plots to sys.path

from comparing.intervals import Interval, median_interval, ratio_interval, samples_per_independent_one
from comparing.times import p_value


def shuffled(count: int, seed: int = 3) -> numpy.ndarray:
    return numpy.random.default_rng(seed).permutation(numpy.arange(1.0, count + 1))


def independent(count: int) -> numpy.ndarray:
    """Returns 1 to `count` in a random order without autocorrelation about the median."""
    return next(values for seed in range(1000) if samples_per_independent_one(values := shuffled(count, seed)) == 1)


class Statistics(unittest.TestCase):
    def outside(self, trials: int, interval: Callable[[numpy.random.Generator], Interval], true: float) -> float:
        """Returns the share of intervals that do not contain the true value."""
        random = numpy.random.default_rng(11)
        found = [interval(random) for _ in range(trials)]
        return sum(not each.low <= true <= each.high for each in found) / trials

    def test_p_is_counted_for_few_and_approximated_for_many_or_ties(self) -> None:
        men, women = numpy.array([19, 22, 16, 29, 24]), numpy.array([20, 11, 17, 12])  # from SciPy's manual
        self.assertAlmostEqual(p_value(men, women), 14 / 126)
        self.assertAlmostEqual(p_value(women, men), 14 / 126)
        # Calculated by hand: ranks 1, 3, 3, 3, 5.5, 5.5, 7, 8; ties 24 + 6; variance 16/12 (9 - 30/56).
        self.assertAlmostEqual(p_value(numpy.array([1, 2, 2, 3]), numpy.array([2, 3, 4, 5])),
                               math.erfc(5 / math.sqrt(2 * 16 / 12 * (9 - 30 / 56))))
        for count, p in ((20, 0.0304), (21, 0.0346)):  # exact, and approximated
            self.assertAlmostEqual(p_value(numpy.arange(count), numpy.arange(count) + 4.5), p, places=4)
        self.assertEqual(p_value(numpy.ones(3), numpy.ones(2)), 1)
        self.assertEqual(p_value(numpy.ones(0), numpy.ones(2)), 1)

    def test_a_median_is_between_the_order_statistics_of_the_tables(self) -> None:
        for count, error, low, high in ((9, 0.05, 2, 8), (20, 0.05, 6, 15), (30, 0.05, 10, 21), (30, 0.01, 8, 23)):
            self.assertEqual(median_interval(independent(count), error), (low, (count + 1) / 2, high))
        self.assertEqual(median_interval(independent(5), 0.05), (0, 3, math.inf))  # 2 of 32 orders are outside
        self.assertEqual(median_interval(numpy.empty(0), 0.05), (0, 0, math.inf))

    def test_neighbours_that_say_the_same_count_as_fewer(self) -> None:
        drifting = numpy.arange(1.0, 101)
        self.assertGreater(samples_per_independent_one(drifting), 10)
        self.assertLess(samples_per_independent_one(shuffled(1000)), 1.5)
        self.assertEqual(samples_per_independent_one(numpy.full(50, 2.0)), 1)
        self.assertEqual(median_interval(independent(100), 0.05).low, 40)
        self.assertFalse(median_interval(drifting, 0.05).has_ends)

    def test_margins_of_logarithms_are_added_as_squares(self) -> None:
        ratio = ratio_interval(Interval(90, 100, 120), Interval(45, 50, 52))
        expected = (2 * math.exp(-math.hypot(math.log(100 / 90), math.log(52 / 50))), 2,
                    2 * math.exp(math.hypot(math.log(120 / 100), math.log(50 / 45))))
        for end, true in zip(ratio, expected):
            self.assertAlmostEqual(end, true)
        self.assertEqual(ratio_interval(Interval(0, 3, math.inf), Interval(2, 2, 2))[::2], (0, math.inf))
        self.assertEqual(ratio_interval(Interval(1, 1, 1), Interval(0, 0, 0)), (0, 0, math.inf))

    def test_are_wrong_as_often_as_they_say(self) -> None:
        def times(random: numpy.random.Generator, median: float = 1, count: int = 40) -> numpy.ndarray:
            return median * random.lognormal(0, 0.3, count)

        share = self.outside(2000, lambda random: median_interval(times(random), 0.05), 1)
        self.assertTrue(0.01 < share < 0.065, share)
        share = self.outside(1000, lambda random: ratio_interval(median_interval(times(random, 1.5), 0.05),
                                                                 median_interval(times(random), 0.05)), 1.5)
        self.assertTrue(0.01 < share < 0.07, share)
        random = numpy.random.default_rng(7)
        share = sum(p_value(times(random, 1, 30), times(random, 1, 25)) < 0.05 for _ in range(1000)) / 1000
        self.assertTrue(0.03 < share < 0.07, share)


if __name__ == "__main__":
    unittest.main()
