#!/usr/bin/env python3
"""Tables of the axes of accuracy, where samples or counters are at an edge.

Usage: axis_pages_test.py <source root>
"""
import pathlib
import sys
import unittest
from typing import Any

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "plots"))

import results  # noqa: E402
from console import accuracy  # noqa: E402

Raw = dict[str, Any]


def page(*cells: Raw) -> list[list[str]]:
    """The words of each line."""
    run = results.Run(pathlib.Path("made.json"), {"run": {}, "cells": list(cells)})
    return [line.split() for line in accuracy.text(run).splitlines()]


def cell(axis: str, method: str, counters: dict[str, float], *samples: dict[str, int]) -> Raw:
    """A sample is stage to nanoseconds on the host, one stage after the other."""
    return {"experiment": "accuracy", "operation": "accuracy", "scene": {"name": "slivers"}, "builder": {"name": "none"},
            "accuracy": {"axis": axis, "method": method, "seed": 5}, "status": "measured", "check": {"verdict": "counted"},
            "counters": counters,
            "samples": [{"order": 0, "stages": [{"stage": name, "wall_ns": ns} for name, ns in stages.items()]}
                        for stages in samples]}


def narrow(method: str, pairs: int, ns: int, missed: int = 0) -> Raw:
    return cell("narrow", method, {"pairs_count": pairs, "meeting_count": 3, "missed_count": missed, "false_count": 0,
                                   "narrow_exact_count": 0}, {"narrow": ns})


class OfNarrow(unittest.TestCase):
    def test_times_stand_beside_those_of_the_yardstick(self) -> None:
        _, yardstick, fast, *totals = page(narrow("guigue-f64", 10, 1000), narrow("guigue-f32", 10, 250, missed=2))
        self.assertEqual(yardstick[-3:], ["100.00", "1.00", "counted"])
        self.assertEqual(fast[-3:], ["25.00", "0.25", "counted"])
        self.assertEqual([" ".join(line) for line in totals], [
            "guigue-f64: 0 missed and 0 false of 10 pairs, wrong in 0 of 1 classes",
            "guigue-f32: 2 missed and 0 false of 10 pairs, wrong in 1 of 1 classes", "seed 5"])

    def test_a_class_without_pairs_and_a_time_of_0_are_told(self) -> None:
        _, none, no_time, *_ = page(narrow("guigue-f64", 0, 1000), narrow("guigue-f32", 10, 0))
        self.assertEqual(none, ["slivers", "guigue-f64", "0", "3", "0", "0", "inf", "nan", "counted"])
        self.assertEqual(no_time[-3:], ["0.00", "0.00", "counted"])


    def test_a_counter_that_must_be_there_is_missed(self) -> None:
        for key in ("pairs_count", "meeting_count", "missed_count", "false_count", "narrow_exact_count"):
            raw = narrow("guigue-f32", 10, 250)
            del raw["counters"][key]
            with self.assertRaisesRegex(KeyError, key):
                page(raw)


class OfCodes(unittest.TestCase):
    def test_a_build_is_all_but_the_query_of_samples_that_have_one(self) -> None:
        counters = {"duplicates_count": 1, "longest_run_count": 1, "box_tests_count": 1, "missed_count": 0, "false_count": 0}
        stages = {"codes": 1000, "sort": 2000, "broad": 50000}
        for samples, build, query in (((stages, stages), "3.00", "50.0"),
                                      ((stages, {"codes": 900000, "sort": 1}), "3.00", "50.0"),
                                      (({"codes": 1000, "sort": 2000},), "0", "0")):
            row = page(cell("codes", "morton30", counters, *samples))[1]
            times = [word for word, unit in zip(row, row[1:]) if unit in ("ns", "us", "ms")]
            self.assertEqual(times[1:], [build, query], row)


if __name__ == "__main__":
    unittest.main()
