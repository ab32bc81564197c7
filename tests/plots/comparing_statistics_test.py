#!/usr/bin/env python3
"""Tests the statistics of `compare` and of rankings against tables and a simulation."""
import unittest

import numpy

import base  # noqa: F401  first: it adds the source root to sys.path

from plots.comparing import student, times
from plots.read.ranking import rank_below


class Statistics(unittest.TestCase):
    def test_quantiles_of_student_s_t_are_those_of_the_tables(self) -> None:
        for error, freedom, expected in ((0.05, 1, 12.7062), (0.05, 2, 4.3027), (0.05, 3, 3.1824), (0.05, 10, 2.2281), (0.01, 5, 4.0321),
                                         (0.001, 7, 5.4079), (0.05, 30, 2.0423), (0.01, 120, 2.6174), (0.5, 4, 0.7407)):
            self.assertAlmostEqual(student.quantile(error, freedom), expected, places=4)

    def test_as_many_means_are_outside_as_the_error_says(self) -> None:
        values = numpy.random.default_rng(11).normal(0, 1, (4000, 5))
        margins = student.quantile(0.05, 4) * values.std(axis=1, ddof=1) / numpy.sqrt(5)
        self.assertAlmostEqual(numpy.mean(numpy.abs(values.mean(axis=1)) > margins), 0.05, delta=0.012)

    def test_the_cells_of_a_scene_share_their_spread(self) -> None:
        cells = [numpy.array([0.01, -0.01, 0.03, -0.03]), numpy.array([0.0, 0.0, 0.0, 0.0])]
        spread = times.spread_of(cells)
        self.assertAlmostEqual(spread.deviation**2, 0.002 / 3 / 2)
        self.assertEqual(spread.freedom, 4)  # 3 of a cell alone, 2 c / (c + 1) of them for c cells
        self.assertEqual([times.spread_of([numpy.zeros(8)] * count).freedom for count in (1, 6)], [7, 12])
        self.assertIsNone(times.spread_of([numpy.zeros(1)]))
        even = [numpy.full(9, 100.0)] * 4  # a cell whose own differences are all 0 has the spread of the others
        found = times.time_change(even, even, 0.05, 0.05, spread)
        self.assertAlmostEqual(numpy.log(found.ratio.high), student.quantile(0.05, 4) * spread.deviation / 2)

    def test_a_median_is_between_the_order_statistics_of_the_tables(self) -> None:
        for count, error, rank in ((9, 0.05, 2), (20, 0.05, 6), (30, 0.05, 10), (30, 0.01, 8), (100, 0.05, 40), (5, 0.05, 0), (0, 0.05, 0)):
            self.assertEqual(rank_below(count, error), rank)


if __name__ == "__main__":
    unittest.main()
