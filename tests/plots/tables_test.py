#!/usr/bin/env python3
"""Tables and numbers of the console.

Usage: tables_test.py <source root>
"""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "plots"))

from tables import Table, counted, duration, exact, size  # noqa: E402


class OfTables(unittest.TestCase):
    def test_words_stand_left_and_numbers_right_by_characters(self) -> None:
        table = Table("<name", "ms")
        for row in (["a–b", "1"], ["longer", "10"], ["c"]):
            table.row(*row)
        self.assertEqual(table.text(), "name    ms\na–b      1\nlonger  10\nc\n")

    def test_without_titles_there_are_only_rows(self) -> None:
        table = Table("<", "")
        table.row("a", "10")
        self.assertEqual(table.text(), "a  10\n")


class OfNumbers(unittest.TestCase):
    def test_have_three_digits_and_a_unit(self) -> None:
        self.assertEqual([duration(ns) for ns in (0, 950, 999.7, 71230, 1300000)],
                         ["0 ns", "950 ns", "1.00 us", "71.2 us", "1.30 ms"])
        self.assertEqual([size(512), size(6914400)], ["512 B", "6.91 MB"])
        self.assertEqual([counted(1, "cell"), counted(1200, "cell")], ["1 cell", "1,200 cells"])

    def test_exact_ones_have_the_digits_that_tell_them_from_others(self) -> None:
        self.assertEqual([exact(value) for value in (3.0, 0.1, 1e-7, 1234.5)], ["3", "0.1", "1e-07", "1234.5"])


if __name__ == "__main__":
    unittest.main()
