#!/usr/bin/env python3
"""Tests the model, the stages and the table of `scale`: on numbers done by hand, and on the files that docs/cluster.md quotes."""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop())
sys.path.insert(0, str(ROOT / "plots"))

import ranks
import scaled
from json_files import Refused, parsed


def cell(count: int, triangles: int, frame_ns: int, sent: int) -> dict:
    """Returns a cell as in a file of `scale`. Rank k needs k + 1 ms for its only stage, but for one slow frame."""
    samples = [[{"stages": [{"stage": "build", "host_ns": ms * 1_000_000}]} for ms in (k + 1, k + 1, 50)] for k in range(count)]
    return {"scene": f"torus:{triangles}", "ranks": count, "partition": "rcb", "status": "measured",
            "result": {"scene": {"name": f"torus:{triangles}", "triangles": triangles}, "partition": "rcb", "frame_ns": frame_ns,
                       "halo_share": count * sent / triangles, "imbalance": 1.0, "check": {"verdict": "agrees"},
                       "ranks": [{"halo_sent_count": sent, "samples": of_rank} for of_rank in samples]}}


def file(kind: str, *cells: dict) -> dict:
    return {"format": "cluster-runs-1.0", "experiment": kind, "runs": list(cells)}


class Model(unittest.TestCase):
    def test_strong_is_a_share_of_the_work_and_waits_and_messages(self) -> None:
        one, two = scaled.measured(file("strong", cell(2, 8_000_000, 6_000_000, 25_000), cell(1, 8_000_000, 10_000_000, 0)))
        self.assertEqual((one["count"], two["count"]), (1, 2))  # whatever their order in the file
        self.assertAlmostEqual(ranks.model_s(one, two, 1, False), 10e-3)
        self.assertAlmostEqual(ranks.model_s(one, two, 2, False), 5e-3 + 100e-6 + (25_000 * 40 + 64 * 24) / 5e9, 9)
        # A quarter of the triangles a rank has half the surface.
        self.assertAlmostEqual(ranks.model_s(one, two, 8, False), 1.25e-3 + 100e-6 + (12_500 * 40 + 7 * 64 * 24) / 5e9, 9)

    def test_weak_has_the_same_share_on_all(self) -> None:
        one, two = scaled.measured(file("weak", cell(1, 4_000_000, 10_000_000, 0), cell(2, 8_000_000, 11_000_000, 25_000)))
        for count in (2, 8, 64):
            self.assertAlmostEqual(ranks.model_s(one, two, count, True), 10e-3 + 100e-6 + (25_000 * 40 + (count - 1) * 64 * 24) / 5e9, 9)

    def test_what_the_document_says_of_the_model(self) -> None:
        runs = scaled.measured(parsed(ROOT / "results" / "h200" / "cluster-strong.json.xz"))
        one, last = runs[0], runs[-1]
        self.assertAlmostEqual(one["frame_ns"] / 1e9 / ranks.model_s(one, last, 2, False), 1.93, delta=0.005)
        self.assertAlmostEqual(one["frame_ns"] / 1e9 / ranks.model_s(one, last, 8, False), 7.3, delta=0.05)

    def test_stages_are_medians_of_each_rank(self) -> None:
        run, = scaled.measured(file("strong", cell(3, 1000, 1, 1)))
        self.assertEqual(ranks.stages_s(run), {"build": [0.001, 0.002, 0.003]})

    def test_refuses_to_draw_what_is_not_there(self) -> None:
        failed = {"scene": "torus:1", "ranks": 1, "partition": "rcb", "status": "failed", "reason": "no device"}
        for cells, why in (((failed,), "no cell was measured"), ((failed, cell(2, 1000, 1, 1)), "no cell of one rank")):
            with self.assertRaisesRegex(Refused, why):
                ranks.draw(file("strong", *cells))


class Table(unittest.TestCase):
    def test_weak_counts_how_much_larger_its_scene_is(self) -> None:
        words = [line.split() for line in scaled.text(file("weak", cell(1, 4000, 10_000_000, 0), cell(2, 8000, 12_500_000, 40)))
                 .splitlines()]
        self.assertTrue(any("1.60" in row and "agrees" in row and "8000" in row[0] for row in words), words)

    def test_a_cell_that_failed_is_named_with_its_reason(self) -> None:
        failed = {"scene": "torus:4000", "ranks": 4, "partition": "rcb", "status": "failed", "reason": "two devices match"}
        self.assertIn("torus:4000 on 4 ranks: two devices match\n", scaled.text(file("strong", cell(1, 4000, 10, 0), failed)))

    def test_what_the_document_says_was_measured(self) -> None:
        for name, factor in (("strong", "1.86"), ("weak", "1.89")):
            self.assertIn(factor, scaled.text(parsed(ROOT / "results" / "h200" / f"cluster-{name}.json.xz")), name)


if __name__ == "__main__":
    unittest.main()
