"""Tests the model, the stages and the table of `scale`, and how files of it and of `cluster` are shown and compared: on numbers done by hand, and on the files that docs/cluster.md quotes."""
import copy
import json
import pathlib
import unittest
from typing import Any

from base import ROOT  # first: it adds the source root to sys.path

from plots.comparing import ranks as comparing
from plots.comparing.refusals import Rules
from plots.console import rank_table as console
from plots.figures import rank_curves
from plots.files import documents
from plots.files.json_files import Refused
from plots.files.output import WrongUsage
from plots.read import rank_files, results


BILLION, HALO = ROOT / "results" / "h200" / "cluster-billion.json.xz", ROOT / "results" / "pocl-2-cores" / "cluster-halo.json.xz"


def on_four() -> dict:
    """Returns the file of a cell on four ranks, as `cluster` writes it."""
    document = documents.read(BILLION)
    document["cells"][0]["experiment"] = "cluster"
    return document


def cell(count: int, triangles: int, frame_ns: int, sent: int) -> dict:
    """Returns a cell as in a file of `scale`. Rank k needs k + 1 ms for its only stage, but for one slow frame."""
    samples = [[{"stages": [{"stage": "build", "host_ns": ms * 1_000_000}]} for ms in (k + 1, k + 1, 50)] for k in range(count)]
    return {"scene": {"name": f"torus:{triangles}", "triangles": triangles}, "builder": {"name": "oibvh-multi"}, "operation": "cluster",
            "status": "measured", "check": {"verdict": "agrees"},
            "cluster": {"ranks_count": count, "simulated": False, "partition": "rcb", "boxes_count": 64, "frame_ns": frame_ns,
                        "halo_share": count * sent / triangles, "imbalance": 1.0,
                        "ranks": [{"halo_sent_count": sent, "samples": of_rank} for of_rank in samples]}}


def failed(count: int, triangles: int, reason: str) -> dict:
    return cell(count, triangles, 1, 1) | {"status": "failed", "reason": reason, "cluster": {
        "ranks_count": count, "simulated": False, "partition": "rcb", "boxes_count": 64}}


def file(kind: str, *cells: dict) -> results.Run:
    return results.Run(pathlib.Path("of.json"), {"run": {}, "cells": [one | {"experiment": kind} for one in cells]})


def measured(kind: str, *cells: dict) -> list[dict]:
    return rank_files.measured(rank_files.cells_of(file(kind, *cells).document, "of.json"))


def shown(document: dict) -> str:
    return console.text(results.Run(pathlib.Path("of.json"), document))


class Model(unittest.TestCase):
    def test_strong_is_a_share_of_the_work_and_waits_and_messages(self) -> None:
        one, two = measured("strong", cell(2, 8_000_000, 6_000_000, 25_000), cell(1, 8_000_000, 10_000_000, 0))
        self.assertEqual((one["ranks_count"], two["ranks_count"]), (1, 2))  # whatever their order in the file
        self.assertAlmostEqual(rank_curves.model_s(one, two, 1, False), 10e-3)
        self.assertAlmostEqual(rank_curves.model_s(one, two, 2, False), 5e-3 + 100e-6 + (25_000 * 40 + 64 * 24) / 5e9, 9)
        # A quarter of the triangles a rank has half the surface.
        self.assertAlmostEqual(rank_curves.model_s(one, two, 8, False), 1.25e-3 + 100e-6 + (12_500 * 40 + 7 * 64 * 24) / 5e9, 9)

    def test_weak_has_the_same_share_on_all(self) -> None:
        one, two = measured("weak", cell(1, 4_000_000, 10_000_000, 0), cell(2, 8_000_000, 11_000_000, 25_000))
        for count in (2, 8, 64):
            self.assertAlmostEqual(rank_curves.model_s(one, two, count, True), 10e-3 + 100e-6 + (25_000 * 40 + (count - 1) * 64 * 24) / 5e9, 9)

    def test_stages_are_medians_of_each_rank(self) -> None:
        run, = measured("strong", cell(3, 1000, 1, 1))
        self.assertEqual(rank_curves.stages_s(run), {"build": [0.001, 0.002, 0.003]})

    def test_refuses_to_draw_what_is_not_there(self) -> None:
        none = failed(1, 1, "no device")
        for cells, why in (((none,), "no cell was measured"), ((none, cell(2, 1000, 1, 1)), "no cell of one rank")):
            run = file("strong", *cells)
            self.assertEqual(rank_curves.draws_of(run), {})
            self.assertIn(why, rank_curves.why_none(run))

    def test_of_several_experiments_there_are_several(self) -> None:
        both = file("strong", cell(1, 1000, 1, 1))
        both.document["cells"] += file("weak", cell(1, 1000, 1, 1)).document["cells"]
        self.assertEqual(list(rank_curves.draws_of(both)), ["strong", "weak"])
        self.assertEqual([line for line in console.text(both).splitlines() if line.startswith("scale ")], ["scale strong", "scale weak"])


class Table(unittest.TestCase):
    def test_weak_counts_how_much_larger_its_scene_is(self) -> None:
        words = [line.split() for line in console.text(file("weak", cell(1, 4000, 10_000_000, 0), cell(2, 8000, 12_500_000, 40)))
                 .splitlines()]
        self.assertTrue(any("1.60" in row and "agrees" in row and "8000" in row[0] for row in words), words)

    def test_a_cell_that_failed_is_named_with_its_reason(self) -> None:
        text = console.text(file("strong", cell(1, 4000, 10, 0), failed(4, 4000, "two devices match")))
        self.assertIn("torus:4000 on 4 ranks: two devices match\n", text)

    def test_a_file_of_cluster_has_its_ranks_stages_and_verdict(self) -> None:
        text = shown(on_four())
        for words in ("torus:1000000000: 1,000,000,000 triangles, block over oibvh-multi along hilbert48, adjacent keep, narrow none, 4 ranks, rcb\n",
                      "agrees with the other partition, brute over a sample, 6,366,301,999 pairs, set hash "):
            self.assertIn(words, text)
        rows = [line.split() for line in text.splitlines()]
        self.assertEqual([row[0] for row in rows if "vm" in row[1:2]], ["0", "1", "2", "3"])
        build = next(row for row in rows if row[:2] == ["rank", "clock"]).index("build")
        self.assertEqual(sum(row[1:2] == ["host"] and row[0] in "0123" and float(row[build]) > 0 for row in rows), 4)

    def test_a_file_without_times_says_so(self) -> None:
        document = on_four()
        cluster = document["cells"][0]["cluster"]
        del cluster["frame_ns"], cluster["partition_ns"]
        for rank in cluster["ranks"]:
            rank["samples"] = []
        self.assertIn("ranks shared a device: there are no times\n", shown(document))
        run = results.Run(BILLION, document)
        self.assertEqual(rank_curves.draws_of(run), {})
        self.assertIn("no times", rank_curves.why_none(run))

    def test_simulated_ranks_are_summed_up(self) -> None:
        document = documents.read(HALO)
        one = document["cells"][-1] | {"experiment": "cluster"}
        one["cluster"] |= {"part_ns": 2_000_000, "model_ns": 3_000_000}
        text = shown(document | {"cells": [one]})
        most = max(rank["halo_received_count"] for rank in one["cluster"]["ranks"])
        self.assertIn(f"receives {most:,} triangles at most", text)
        self.assertIn("a frame by the model: 3.00 ms, of which the largest part takes 2.00 ms\n", text)


class Broken(unittest.TestCase):
    def assert_refused(self, document: dict, words: str) -> None:
        with self.assertRaisesRegex(Refused, words):
            rank_files.cells_of(document, "of.json")

    def test_is_a_file_without_a_key_that_all_have(self) -> None:
        document = documents.read(HALO)
        del document["cells"][0]["cluster"]["ranks"]
        self.assert_refused(document, r"of.json is no result file: cells\[0\].cluster has no 'ranks'")
        del document["cells"][0]["cluster"]
        self.assert_refused(document, r"cells\[0\].cluster is no object")

    def test_are_ranks_and_samples_that_are_uneven(self) -> None:
        whole = json.loads((ROOT / "tests/fuzz/results/cluster_frames.json").read_text(encoding="utf-8"))
        for change, words in ((lambda ranks: ranks[1]["samples"].pop(), "ranks with different numbers of samples"),
                              (lambda ranks: ranks[0]["samples"].clear(), "ranks with different numbers of samples"),
                              (lambda ranks: ranks[1]["samples"][2]["stages"].pop(), "samples with different stages"),
                              (lambda ranks: ranks[0]["samples"][0].update(stages=[]), "samples with different stages")):
            document = copy.deepcopy(whole)
            change(document["cells"][0]["cluster"]["ranks"])
            self.assert_refused(document, words)


class Compared(unittest.TestCase):
    def setUp(self) -> None:
        self.first = documents.read(ROOT / "results" / "h200" / "cluster-strong.json.xz")
        self.first["run"]["program"]["dirty"] = False
        del self.first["cells"][::2]
        self.second = copy.deepcopy(self.first)

    @property
    def cell(self) -> dict:
        """Returns the first cell of the second file."""
        return self.second["cells"][0]

    def compared(self, show_all: bool = False, **rules: Any) -> tuple[str, int]:
        return comparing.compare((pathlib.Path("a"), self.first), (pathlib.Path("b"), self.second), Rules(**rules), show_all)

    def test_a_file_is_itself(self) -> None:
        text, regressions = self.compared(True)
        self.assertEqual((regressions, text.splitlines()[-1]), (0, "no regression"))
        frame, *stages = [line.split() for line in text.splitlines()[1:-1]]
        self.assertEqual((frame[0], frame[-1]), ("frame", "UNSURE"))
        self.assertEqual([row[0] for row in stages], ["build", "boxes", "select", "exchange", "self", "halo"])

    def test_another_answer_is_a_regression_whatever_the_ranks(self) -> None:
        self.cell["cluster"]["ranks"].pop()
        self.cell["cluster"]["ranks_count"] = 1
        text, regressions = self.compared()
        self.assertEqual(regressions, 0, text)
        self.assertIn("changed ranks 1, was 2\n", text)
        self.cell["cluster"]["pairs_count"] += 1
        text, regressions = self.compared()
        self.assertEqual(regressions, 1)
        self.assertIn(f"REGRESSION other pairs: {self.cell['cluster']['pairs_count']} of set hash ", text)
        self.cell["collider"]["options"]["adjacent"] = "drop"  # another question has another answer
        self.assertEqual(self.compared()[1], 0)

    def test_a_slower_frame_and_a_worse_verdict_are_regressions(self) -> None:
        for sample in self.cell["cluster"]["ranks"][0]["samples"]:
            sample["whole_ns"] *= 2
        self.cell["check"] |= {"verdict": "differs", "detail": "it finds 3 pairs"}
        text, regressions = self.compared()
        self.assertEqual(regressions, 2)
        self.assertIn("REGRESSION differs (it finds 3 pairs), was agrees\n", text)
        self.assertRegex(text, r"frame .* SLOWER\n(.*\n)*REGRESSION the frame takes [12]\.\d+ times as long")
        self.cell["cluster"]["partition"] = "curve"  # asked for, so slower is no regression
        self.assertEqual(self.compared()[1], 1)

    def test_a_frame_that_is_slower_under_conditions_that_warn_is_no_regression(self) -> None:
        for sample in self.cell["cluster"]["ranks"][0]["samples"]:
            sample["whole_ns"] *= 2
        for source in self.second["merged_from"]:
            source.setdefault("conditions", {})["warnings"] = ["the host is on battery"]
        text, regressions = self.compared()
        self.assertEqual(regressions, 0)
        self.assertRegex(text, "^warning: B: the host is on battery\\n(.*\\n)*frame .* UNSURE\\n")

    def test_refuses_what_cannot_be_compared(self) -> None:
        self.cell["scene"]["name"] = "grid:4"
        with self.assertRaisesRegex(WrongUsage, "a is of torus:67108864 and b of grid:4"):
            self.compared()
        self.second = copy.deepcopy(self.first)
        self.second["run"]["device"]["name"] = "another"
        with self.assertRaisesRegex(WrongUsage, "another.*--other-devices compares only verdicts"):
            self.compared()
        self.assertNotIn("frame", self.compared(other_devices=True)[0])
        with self.assertRaisesRegex(WrongUsage, "these are of several ranks"):
            self.compared(builders=("karras", "apetrei"))
        self.first["run"]["program"]["dirty"] = True
        with self.assertRaisesRegex(WrongUsage, "changes that no commit has"):
            self.compared()

    def test_files_of_scale_are_compared_cell_by_cell(self) -> None:
        self.first, self.second = documents.read(HALO), documents.read(HALO)
        self.assertRegex("%s%d" % self.compared(allow_dirty=True), r"(warning: .*\n)+no regression\n0$")
        self.cell["cluster"]["ranks"][0]["halo_sent_count"] += 1
        del self.second["cells"][1]
        text, regressions = self.compared(allow_dirty=True)
        self.assertEqual(regressions, 1)
        self.assertIn("REGRESSION torus:1152000, ranks 2, rcb, boxes 64: not in B\n", text)
        self.assertIn("changed torus:1152000, ranks 2, rcb, boxes 1: halo_sent_count of the rank with the most ", text)
        self.assertEqual(self.compared(allow_dirty=True, allow_missing=True)[1], 0)
