"""Tests what `smoke` keeps of a run, and which differences it reports as regressions."""
import copy
import json
import unittest

from base import ROOT  # first: it adds the source root to sys.path

from plots.comparing import baseline, baseline_changes
from plots.files.json_files import Refused
from plots.read.cells import Cell

KEPT = ROOT / "results" / "baseline" / "smoke-cpu.json"
LIBRARIES = ("embree", "fcl")


def times(*fastest: float) -> list[dict]:
    """Returns cells of one scene that differ in their times."""
    return [{"cell": f"soup: {number}", "scene": "soup build", "verdict": "agrees",
             "counters": {"nodes_count": 7, "depth_mean": 1.25}, "hashes": {"tree": "0" * 16},
             "fastest_ns": ns} for number, ns in enumerate(fastest)]


def told(before: list[dict], now: list[dict], tolerance: float = 5, some: bool = False) -> tuple[list[str], list[str]]:
    found = baseline_changes.compare(before, now, tolerance, some)
    return found.regressions, found.remarks


def raw(builder: str, **more: object) -> dict:
    stages = [[{"stage": "hierarchy", "launches": 1, "span_ns": span, "start_ns": 0}] for span in (900, 700)]
    return {"experiment": "smoke", "scene": {"name": "soup", "triangles": 3, "frame": 0},
            "builder": {"name": builder, "options": {}}, "status": "measured",
            "samples": [{"order": 0, "stages": each} for each in stages],
            "counters": {"scratch_bytes": 9, "pairs_count": 4, "nodes_count": 5, "build_ns": 3},
            "check": {"verdict": "agrees", "tree_hash": "1" * 16, "pairs_hash": "2" * 16}, **more}


class Kept(unittest.TestCase):
    def kept(self, builder: str, **more: object) -> dict:
        return baseline.kept_of(Cell(raw(builder, **more)), LIBRARIES)

    def test_what_no_machine_changes_is_kept(self) -> None:
        kept = self.kept("karras")
        self.assertEqual(kept, {"cell": "soup: karras, from sorted leaves", "scene": "soup build", "verdict": "agrees",
                                "counters": {"nodes_count": 5, "pairs_count": 4}, "hashes": {"pairs": "2" * 16, "tree": "1" * 16},
                                "fastest_ns": 700})

    def test_of_a_library_what_it_found_is_kept(self) -> None:
        collider = {"collider": {"name": "fcl-refit", "options": {}}, "operation": "collide"}
        for kept in (self.kept("fcl-aabb"), self.kept("embree-low"), self.kept("none", **collider)):
            self.assertEqual((kept["counters"], kept["hashes"]), ({"pairs_count": 4}, {"pairs": "2" * 16}))
            self.assertNotIn("fastest_ns", kept)

    def test_a_time_of_the_host_or_of_a_wrong_answer_is_not_kept(self) -> None:
        host = [{"order": 0, "stages": [{"stage": "build", "wall_ns": 5}]}]
        for kept in (self.kept("median-split", samples=host), self.kept("karras", check={"verdict": "differs"})):
            self.assertNotIn("fastest_ns", kept)
        self.assertEqual(kept["verdict"], "differs")

    def test_a_baseline_comes_back_as_it_was(self) -> None:
        text = KEPT.read_bytes()
        document = baseline.parsed(text, "it")
        self.assertEqual(baseline.text_of(document["device_kind"], document["cells"]).encode(), text)

    def test_what_is_no_baseline_is_refused(self) -> None:
        good = json.loads(KEPT.read_text(encoding="utf-8"))
        for change, says in ((lambda it: it.pop("format"), "key 'format' not found"),
                             (lambda it: it.pop("cells"), "key 'cells' not found"),
                             (lambda it: it["cells"][0].pop("counters"), r"cells\[0\] has no 'counters'"),
                             (lambda it: it.update(cells=[1]), r"cells\[0\] is no object"),
                             (lambda it: it.update(cells=1), "not iterable")):
            bad = copy.deepcopy(good)
            change(bad)
            with self.assertRaisesRegex(Refused, f"^it is no baseline of smoke: .*{says}"):
                baseline.parsed(json.dumps(bad).encode(), "it")
            self.assertFalse(baseline.is_baseline(json.dumps(bad).encode()))
        self.assertTrue(baseline.is_baseline(KEPT.read_bytes()))
        with self.assertRaisesRegex(Refused, '^it has format "smoke-9"; this program reads "smoke-1"$'):
            baseline.parsed(b'{"format": "smoke-9"}', "it")


class Changed(unittest.TestCase):
    def test_the_same_is_no_change(self) -> None:
        cells = json.loads(KEPT.read_text(encoding="utf-8"))["cells"]
        found = baseline_changes.compare(cells, cells, 5, False)
        self.assertEqual((found.regressions, found.remarks, found.compared), ([], [], len(cells)))
        self.assertEqual(found.timed, sum("fastest_ns" in cell for cell in cells))
        self.assertTrue(baseline_changes.report(found, 5).endswith(" times within 5 times the ratio there: as before\n"))

    def test_counters_and_hashes_are_held_exactly(self) -> None:
        zeros, ones, finer = "0" * 16, "1" * 16, 1.2500000000000002
        for change, says in ((lambda cell: cell["counters"].update(depth_mean=finer), f"depth_mean {finer}, was 1.25"),
                             (lambda cell: cell["counters"].pop("nodes_count"), "no nodes_count, was 7"),
                             (lambda cell: cell["counters"].update(new_count=8), "new_count is new: 8"),
                             (lambda cell: cell["hashes"].update(tree=ones), f"other tree than before: hash {ones}, was {zeros}"),
                             (lambda cell: cell["hashes"].pop("tree"), f"other tree than before: hash none, was {zeros}")):
            before, now = times(1e6), times(1e6)
            change(now[0])
            self.assertEqual(told(before, now), ([f"soup: 0: {says}"], []))

    def test_a_verdict_may_get_better(self) -> None:
        before, now = times(1e6), times(1e6)
        before[0]["verdict"] = "not checked"
        self.assertEqual(told(before, now), ([], ["soup: 0: agrees, was not checked"]))
        self.assertEqual(told(now, before), (["soup: 0: not checked, was agrees"], []))

    def test_what_was_not_measured_has_no_facts(self) -> None:
        before, now = times(1e6), times(1e6)
        now[0].update(verdict="skipped", counters={}, hashes={})
        self.assertEqual(told(before, now), (["soup: 0: skipped, was agrees"], []))

    def test_cells_of_one_side_are_told_unless_some_were_asked_for(self) -> None:
        both, first = times(1e6, 1e6), times(1e6)
        self.assertEqual(told(both, first), (["soup: 1: is in the baseline only"], []))
        self.assertEqual(told(both, first, some=True), ([], []))
        found = baseline_changes.compare(first, both, 5, True)
        self.assertEqual((found.regressions, found.remarks, found.new), ([], [], ["soup: 1"]))
        self.assertIn("new: soup: 1: not in the baseline; `bvhbench smoke --update` adds it\n", baseline_changes.report(found, 5))

    def test_times_are_compared_with_the_others_of_their_scene(self) -> None:
        before, slower = times(1e6, 2e6, 3e6), times(3e6, 6e6, 9e6)  # another machine
        self.assertEqual(told(before, slower), ([], []))
        slower[0]["fastest_ns"] = 3e6 * 5.26
        says = "soup: 0: takes 5.3 times as long beside the others of its scene as it did"
        self.assertEqual(told(before, slower), ([says], []))
        self.assertEqual(told(before, slower, tolerance=6), ([], []))

    def test_what_takes_some_launches_has_no_ratio(self) -> None:
        before, now = times(1e3, 1e6, 1e6), times(50e3, 1e6, 1e6)
        self.assertEqual(told(before, now), ([], []))
        now[0]["fastest_ns"] = 52e3
        self.assertEqual(len(told(before, now)[0]), 1)

    def test_each_regression_is_a_line(self) -> None:
        before, now = times(1e6, 1e6), times(1e6, 1e6)
        for cell in now:
            cell["counters"]["nodes_count"] = 8
        text = baseline_changes.report(baseline_changes.compare(before, now, 1e9, False), 1e9)
        self.assertEqual(text, "REGRESSION soup: 0: nodes_count 8, was 7\nREGRESSION soup: 1: nodes_count 8, was 7\n"
                               "2 cells compared with the baseline, 2 times within 1e+09 times the ratio there: 2 regressions\n")
