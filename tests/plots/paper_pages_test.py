#!/usr/bin/env python3
"""What `reproduce` prints beside the paper's numbers.

Usage: paper_pages_test.py <source root>
"""
import pathlib
import sys
import unittest
from typing import Any

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "plots"))

import results  # noqa: E402
from cells import Cell  # noqa: E402
from console import paper, tree_costs  # noqa: E402

Raw = dict[str, Any]


def cell(builder: str, ns: int = 100000, scene: str = "bunny", sah_cost: float | None = None, **facts: Any) -> Raw:
    """The hierarchy of a tree over 144,046 triangles."""
    counters = {"nodes_count": 288100} if sah_cost is None else {"sah_cost": sah_cost}
    return {"experiment": "table1", "scene": {"name": scene, "triangles": 144046, **facts}, "builder": {"name": builder},
            "status": "measured", "counters": counters, "check": {"verdict": "agrees"},
            "samples": [
                {"order": 7, "stages": [{"stage": "hierarchy", "span_ns": ns + off, "launches": 2, "moved_bytes": 50000000}]}
                for off in (10000, 0, -10000)]}


def run_of(*cells: Raw, **facts: Any) -> results.Run:
    return results.Run(pathlib.Path("made.json"), {"run": {"copy_rate_bytes_per_s": 1e12, **facts}, "cells": list(cells)})


class OfTable1(unittest.TestCase):
    def test_stands_beside_the_paper_and_marks_stand_ins(self) -> None:
        run = run_of(cell("oibvh-multi"), cell("oibvh-single", scene="torus:144046", stand_in_for="bunny"))
        titles, *lines, about, mark = paper.table1(run).splitlines()
        self.assertEqual(titles.split()[3:], "nodes padding % paper ms p10–p90 Mtris/s moved % of copy paper ms".split())
        self.assertEqual([line.split() for line in lines], [
            "bunny 144,046 oibvh-multi 288,100 3.1e-3 3.1e-3 0.1000 0.0920–0.1080 1440 50.0 MB 50.0 % 0.077".split(),
            "bunny * 144,046 oibvh-single 288,100 3.1e-3 3.1e-3 0.1000 0.0920–0.1080 1440 50.0 MB 50.0 % 0.074".split()])
        self.assertEqual(about, "ms: the stage hierarchy from sorted leaves, median; paper ms: NVIDIA GeForce GTX 1080")
        self.assertTrue(mark.startswith("* a generated stand-in"))

    def test_a_wrong_tree_has_no_time(self) -> None:
        wrong = {**cell("oibvh-multi"), "check": {"verdict": "differs"}}
        line = paper.table1(run_of(wrong)).splitlines()[1]
        self.assertEqual(line.split(), ["bunny", "144,046", "oibvh-multi", "288,100", "3.1e-3", "3.1e-3", "differs", "0.077"])

    def test_padding_is_cut_as_in_the_paper(self) -> None:
        perfect = Cell(cell("perfect"))
        perfect.counters["nodes_count"] = 524287
        self.assertEqual(paper.padding_text(paper.padding_percent(perfect)), "45.05")
        shares = (0, 100 * 7 / 825337, 100 * 10 / 2174947, 100 * 5 / 5759999, 0.01)
        self.assertEqual([paper.padding_text(share) for share in shares], ["0", "8.4e-4", "4.5e-4", "8.6e-5", "1.0e-2"])


class OfFig8(unittest.TestCase):
    def test_finds_the_size_from_which_multi_stays_ahead(self) -> None:
        made = [cell(builder, ns, triangles=1024 << size) for size, times in enumerate(((20, 25), (30, 29), (50, 51), (80, 70)))
                for builder, ns in zip(("oibvh-single", "oibvh-multi"), (1000 * time for time in times))]
        self.assertIn("oibvh-multi is the faster one from 8,192 triangles on;", paper.fig8(run_of(*made)))
        self.assertIn("do not cross here", paper.fig8(run_of(*made[:2])))


class OfTreeCosts(unittest.TestCase):
    def test_table4_stands_beside_the_paper_and_says_what_is_missing(self) -> None:
        buddha = "happy_buddha_1087716"
        absent = {**cell("apetrei-fused", sah_cost=0), "status": "skipped", "reason": "no such builder"}
        run = run_of(cell("apetrei-fused", scene=buddha, sah_cost=86.02), cell("oibvh-multi", scene=buddha, sah_cost=228.01),
                     cell("oibvh-single", scene=buddha, sah_cost=228.01), absent, cell("oibvh-multi", sah_cost=100))
        self.assertEqual(tree_costs.table4(run), (
            "mesh                    triangles  order     radix  paper  Oi-BVH   paper  times  paper\n"
            "happy_buddha_1087716 +    144,046  morton30  86.02  86.00  228.01  229.16   2.65   2.66\n"
            "bunny                     144,046  morton30                100.00                        skipped: no such builder\n"
            "surface area cost, an inner node 1.2, a triangle 1\n"
            "+ another edition of the paper's model, with another triangle count\n"))

    def test_table4_does_not_compare_costs_of_other_constants(self) -> None:
        made = [cell(builder, scene="buddha", sah_cost=90) for builder in ("apetrei-fused", "oibvh-multi")]
        usual, text = (tree_costs.table4(run_of(*made, **facts)) for facts in ({}, {"node_costs": {"inner": 2.5, "triangle": 1}}))
        self.assertEqual([len(page.splitlines()[1].split()) for page in (usual, text)], [9, 6])
        self.assertIn("an inner node 2.5, a triangle 1; the paper's are for others\n", text)

    def test_fig13_says_which_tree_suffers_more(self) -> None:
        made = [cell(builder, 1000, f"outlier:bunny:0:{far}", cost, outlier={"of": "bunny", "triangle": 0, "diameters": far})
                for far, costs in ((0, (10, 20)), (10, (10, 70))) for builder, cost in zip(("karras", "oibvh-single"), costs)]
        text = tree_costs.fig13(run_of(*made))
        self.assertIn("bunny  morton30         0       10.0  10.00   70.00   7.00\n", text)
        self.assertIn("relative to the radix tree's grows, from 2.00 to 7.00 times", text)


if __name__ == "__main__":
    unittest.main()
