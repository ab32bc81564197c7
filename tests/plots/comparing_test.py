"""Tests what `compare` reports about times, counters, verdicts and cells of two result files, and its statistics against tables."""
import argparse
import copy
import math
import pathlib
import unittest
from collections.abc import Callable
from typing import Any

import numpy

from base import Raw  # first: it adds the source root to sys.path

from plots.comparing import axes, comparison, comparison_text, sides, times
from plots.comparing.refusals import Rules, require_comparable
from plots.files.output import WrongUsage
from plots.read import counters, student
from plots.read.cells import Cell
from plots.read.ranking import rank_below

BUILDERS = ["perfect", "karras", "apetrei", "lbvh-levels", "oibvh-single", "oibvh-multi"]
FOUR = ["karras", "apetrei", "perfect", "oibvh-multi"]
SAME, FASTER, SLOWER, UNSURE = "SAME", "FASTER", "SLOWER", "UNSURE"


def cell(builder: str = "karras", median_ns: float = 1e6, seed: int = 1, noise: float = 0.02, samples: int = 40, frame: int = 0) -> Raw:
    """Returns a cell whose whole times scatter about the median, equal for equal seeds."""
    spread = numpy.random.default_rng(seed).normal(0, noise, samples)
    return {"experiment": "trial", "status": "measured", "scene": {"name": "bunny", "frame": frame, "content_hash": "0" * 16},
            "builder": {"name": builder}, "check": {"verdict": "agrees", "pairs_hash": "1" * 16, "tree_hash": "2" * 16},
            "counters": {"sah_cost": 80.25, "pairs_count": 1000}, "leaves_by_depth": [0, 0, 4],
            "samples": [{"order": place, "stages": [{"stage": stage, "span_ns": int(median_ns / 2 * math.exp(off)), "launches": 2}
                                                    for stage in ("sort", "hierarchy")]} for place, off in enumerate(spread)]}


def document(*cells: Raw, name: str = "run", **run: Any) -> Raw:
    return {"format": "1.0", "cells": list(cells), "run": {
        "id": name, "started_at": "then", "finished_at": "then", "command": [],
        "program": {"commit": "c0", "dirty": False, "compiler": "gcc", "build_type": "Release", "arch": "native", "kernels": "embedded"},
        "host": {"name": "host", "cpu": "cpu", "threads": 8, "os": "Linux"},
        "device": {"name": "device", "platform": "platform", "compute_units": 4, "driver": "1"}, **run}}


def side_of(processes: list[Raw]) -> Raw:
    return sides.side_of([pathlib.Path(f"{place}.json") for place in range(len(processes))], processes)


def side(seed: int, processes: int = 8, deviation: float = 0.02, slower: dict[str, float] | None = None, all_slower: float = 1,
         first: int = 0, samples: int = 20) -> Raw:
    """Returns one side: several processes of six builders on one scene. Each process is slower or faster by a factor that its cells
    share for the greater part. The n-th of them starts `first` + n minutes after the hour; the n-th builder takes n milliseconds."""
    random = numpy.random.default_rng(seed)
    made = []
    for process in range(processes):
        shared = random.normal(0, deviation * math.sqrt(0.7))
        factors = [math.exp(shared + random.normal(0, deviation * math.sqrt(0.3))) * all_slower * (slower or {}).get(name, 1) for name in BUILDERS]
        made.append(document(*(cell(name, 1e6 * (place + 1) * factor, int(random.integers(1 << 30)), 0.02, samples)
                               for place, (name, factor) in enumerate(zip(BUILDERS, factors))),
                             name=f"run {seed}-{process}", started_at=f"2026-01-01T00:{first + process:02}:00Z"))
    return side_of(made)


def compared(first: Raw, second: Raw, **rules: Any) -> comparison.Comparison:
    return comparison.compare(first, second, Rules(**rules))


def verdicts(first: Raw, second: Raw, **rules: Any) -> list[str]:
    return [each.verdict for each in compared(first, second, **rules).cells]


def with_sentences(change: Callable[[Raw], Any], builder: str = "karras", **rules: Any) -> tuple[list[str], list[str]]:
    """Returns the sentences about a changed cell: regressions, and others."""
    before = document(cell(builder))
    after = copy.deepcopy(before)
    change(after["cells"][0])
    only, = compared(before, after, **rules).cells
    return only.regressions, only.changes


class Times(unittest.TestCase):
    def test_of_processes_by_turns_are_told_apart_at_the_threshold(self) -> None:
        for factor, threshold, expected in ((1, 0.05, SAME), (1.01, 0.05, SAME), (1.1, 0.05, SLOWER), (0.9, 0.05, FASTER),
                                            (1.1, 0.5, SAME), (1.6, 0.5, SLOWER)):
            found = compared(side(1, deviation=0.01), side(2, deviation=0.01, slower={"karras": factor}), threshold=threshold)
            self.assertEqual([each.verdict for each in found.cells], [SAME, expected, SAME, SAME, SAME, SAME], (factor, threshold))
            self.assertAlmostEqual(found.cells[1].time.ratio.value, factor, delta=0.02)

    def test_of_all_builders_together_may_be_slower(self) -> None:
        self.assertEqual(verdicts(side(1), side(2, all_slower=1.2)), [SLOWER] * 6)

    def test_of_processes_that_differ_are_unsure_and_the_smallest_change_is_told(self) -> None:
        found = compared(side(1, 3, deviation=0.1), side(2, 3, deviation=0.1, slower={"karras": 1.1}))
        self.assertEqual({each.verdict for each in found.cells}, {UNSURE})
        smallest = found.cells[1].time.smallest
        self.assertGreater(smallest, 1.2)
        self.assertRegex(comparison_text.text(found, show_all=True), f"karras .* {100 * (smallest - 1):.0f} % +3x20 +UNSURE")
        self.assertLess(compared(side(1, 8, 0.01), side(2, 8, 0.01)).cells[1].time.smallest, 1.08)

    def test_of_one_process_a_side_must_differ_by_more_than_processes_do(self) -> None:
        for factor, expected in ((1, UNSURE), (1.5, UNSURE), (1.8, SLOWER), (0.5, FASTER)):
            found = compared(document(cell()), document(cell(median_ns=factor * 1e6, seed=2)))
            self.assertEqual([each.verdict for each in found.cells], [expected], factor)
        self.assertIn("the spread between processes is not known", comparison_text.text(found))
        noisy = [document(cell(seed=seed, median_ns=ns, samples=9, noise=0.6)) for seed, ns in ((1, 1e6), (2, 1.8e6))]
        self.assertEqual(verdicts(*noisy), [UNSURE])

    def test_of_sides_one_after_the_other_are_as_those_of_one_process(self) -> None:
        first = side(1)
        for after, slower, expected in ((8, 1.4, UNSURE), (8, 1.8, SLOWER), (0, 1.4, SLOWER)):
            found = compared(first, side(2, slower={"karras": slower}, first=after))
            self.assertEqual(found.cells[1].verdict, expected)
            self.assertEqual("did not take turns" in comparison_text.text(found), after > 0)
        self.assertIn("the same number of them", comparison_text.text(compared(first, side(2, 7))))

    def test_of_a_process_without_samples_have_no_spread(self) -> None:
        first, second = side(1), side(2, slower={"karras": 1.4})
        lost = second["cells"][3]
        lost["samples"] = [sample for sample in lost["samples"] if sample["process"] != 5]
        del first["cells"][0]["samples"][-1]["process"]  # as in a damaged file
        self.assertEqual(compared(first, second).cells[1].verdict, UNSURE)

    def test_of_fewer_than_nine_samples_are_unsure(self) -> None:
        for samples, expected in ((8, UNSURE), (9, SLOWER)):
            self.assertEqual(verdicts(document(cell(samples=samples)), document(cell(median_ns=3e6, samples=samples))), [expected])
        self.assertEqual(comparison_text.text(compared(document(cell(samples=8)), document(cell()))).splitlines()[-1],
                         "unsure: of 1 cell none has a verdict")
        self.assertIn("1 have fewer than 9 samples", comparison_text.text(compared(document(cell(samples=8)), document(cell()))))
        self.assertNotIn("bunny", comparison_text.text(compared(document(cell(samples=0)), document(cell())), show_all=True))

    def test_under_conditions_that_warn_are_unsure(self) -> None:
        first, second = side(1), side(2, slower={"karras": 1.3})
        second["merged_from"][3]["conditions"] = {"warnings": ["the host is on battery"]}
        found = compared(first, second)
        self.assertEqual((found.cells[1].verdict, found.withheld, found.regressions), (UNSURE, 1, 0))
        self.assertIn("warning: B, process 4: the host is on battery\n", comparison_text.text(found))
        self.assertIn("1 cell may have changed, or the warnings are why\nno regression found, ", comparison_text.text(found))
        self.assertIn("SAME", {each.verdict for each in found.cells})

    def test_of_all_stages_together_decide_and_each_is_shown(self) -> None:
        first, second = side(1), side(2)
        for sample in second["cells"][1]["samples"]:
            sample["stages"][0]["span_ns"] *= 2
        changed = compared(first, second).cells[1]
        self.assertEqual(changed.verdict, SLOWER)
        self.assertAlmostEqual(changed.time.ratio.value, 1.5, delta=0.05)
        self.assertAlmostEqual(changed.stages["sort"].ratio.value, 2, delta=0.06)
        self.assertAlmostEqual(changed.stages["hierarchy"].ratio.value, 1, delta=0.04)
        self.assertEqual(changed.stages["sort"].counts, ("8x20", "8x20"))

    def test_of_one_build_alarm_rarely_and_a_slower_builder_is_found(self) -> None:
        pairs = [(side(3 * seed, samples=9), side(3 * seed + 1, samples=9), side(3 * seed + 2, samples=9, slower={"karras": 1.1}))
                 for seed in range(40)]
        alarms = sum(any(verdict in (SLOWER, FASTER) for verdict in verdicts(before, after)) for before, after, _ in pairs)
        self.assertLessEqual(alarms, 3)  # 5 % are allowed without the threshold
        found = sum(compared(before, slow).cells[1].verdict == SLOWER for before, _, slow in pairs)
        self.assertGreaterEqual(found, 36)

    def test_only_ratios_count_on_other_devices(self) -> None:
        before = document(*map(cell, FOUR, (1e6, 2e6, 1e6), (1, 3, 5)))
        after = document(*map(cell, FOUR, (1e5, 2e5, 3e5), (2, 4, 6)))
        after["cells"][0]["counters"]["sah_cost"] += 1
        found = compared(before, after, other_devices=True)
        self.assertEqual([each.verdict for each in found.cells], [UNSURE, UNSURE, SLOWER])
        self.assertAlmostEqual(found.cells[0].time.ratio.value, 1, delta=0.02)
        self.assertEqual(found.cells[0].regressions, [])
        self.assertEqual(verdicts(document(cell()), document(cell(median_ns=9e6)), other_devices=True), [UNSURE])  # alone


class TwoBuilders(unittest.TestCase):
    PATHS = pathlib.Path("a.json"), pathlib.Path("b.json")

    def held(self, first: Raw, second: Raw, pair: str = "karras,perfect") -> comparison.Comparison:
        names = axes.pair_of(pair)
        return compared(*axes.between_builders(self.PATHS, first, second, names), builders=names)

    def test_of_one_file_or_two_are_compared(self) -> None:
        both = document(cell("karras"), cell("perfect", 4e5, seed=2), cell("apetrei"))
        alone = document(cell("karras")), document(cell("perfect", 4e5, seed=2))
        for first, second in ((both, both), alone):
            found = self.held(first, second)
            only, = found.cells
            self.assertEqual((only.verdict, found.regressions), (FASTER, 0))
            self.assertAlmostEqual(only.time.ratio.value, 0.4, delta=0.02)
            self.assertIn("bunny: perfect against karras", comparison_text.text(found))
            self.assertIn("1 cell of perfect against karras: 0 SAME, 1 FASTER", comparison_text.text(found))
        self.assertEqual(self.held(both, both, "perfect,karras").regressions, 0)  # slower is no regression

    def test_a_common_speed_of_all_colliders_is_not_removed(self) -> None:
        cells = [{**cell(name, ns, seed), "operation": "collide", "collider": {"name": collider}}
                 for name, ns in (("karras", 1e6), ("perfect", 2e6))
                 for seed, collider in enumerate(("leaf", "group", "bvtt", "front", "block"))]
        both = document(*cells)
        self.assertEqual([each.verdict for each in self.held(both, both).cells], [SLOWER] * 5)

    def test_another_answer_is_wrong_and_another_tree_is_not(self) -> None:
        both = document(cell("karras"), cell("perfect"))
        both["cells"][1]["check"]["tree_hash"] = "3" * 16
        both["cells"][1]["counters"]["sah_cost"] = 999
        found = self.held(both, both)
        self.assertEqual((found.cells[0].regressions, found.cells[0].changes), ([], []))
        both["cells"][1]["check"]["pairs_hash"] = "4" * 16
        found = self.held(both, both)
        self.assertEqual(found.regressions, 1)
        self.assertIn("WRONG bunny: perfect against karras: other pairs", comparison_text.text(found))

    def test_that_have_nothing_in_common_are_refused(self) -> None:
        only, other = document(cell("karras")), document(cell("perfect", frame=2))
        for first, second, says in ((only, only, "b.json has no cell of perfect; it has karras$"),
                                    (only, other, "no cell of perfect has the scene and options of one of karras: "
                                                  "they differ in frame: 0 against 2$")):
            with self.assertRaisesRegex(WrongUsage, says):
                self.held(first, second)
        for wrong in ("karras", "karras,", "karras,karras", "a,b,c"):
            with self.assertRaises(argparse.ArgumentTypeError):
                axes.pair_of(wrong)


class NothingShared(unittest.TestCase):
    def told(self, first: Raw, second: Raw) -> str:
        with self.assertRaises(WrongUsage) as caught:
            axes.require_shared(TwoBuilders.PATHS, *([Cell(raw) for raw in made["cells"]] for made in (first, second)))
        return str(caught.exception)

    def test_is_told_with_what_differs_and_what_to_do(self) -> None:
        ordered = cell("karras")
        ordered["builder"]["options"] = {"order": "kd"}
        one = document(cell("karras"), cell("karras", frame=1))
        start = "a.json and b.json have no cell in common: they differ in "
        self.assertEqual(self.told(one, document(cell("perfect"))), start + "builder: karras against perfect; "
                         "to compare builders: bvhbench compare a.json b.json --builders karras,perfect")
        self.assertIn(start + "builder: karras against karras, order kd; `bvhbench report a.json b.json`",
                      self.told(one, document(ordered)))
        self.assertIn(start + "frame: 0 or 1 against 7; ", self.told(one, document(cell(frame=7))))

    def test_is_not_told_of_files_that_share_a_cell(self) -> None:
        axes.require_shared(TwoBuilders.PATHS, [Cell(cell()), Cell(cell("perfect"))], [Cell(cell("perfect"))])


class Facts(unittest.TestCase):
    def test_every_counter_that_is_not_what_it_was_is_told(self) -> None:
        self.assertEqual(with_sentences(lambda raw: None), ([], []))
        self.assertEqual(with_sentences(lambda raw: raw["counters"].update(sah_cost=math.nextafter(80.25, 81))),
                         (["sah_cost 80.25000000000001, was 80.25"], []))
        self.assertEqual(with_sentences(lambda raw: raw["counters"].update(sah_cost=70)), ([], ["sah_cost 70, was 80.25"]))
        for pairs in (999, 1001):
            self.assertEqual(with_sentences(lambda raw: raw["counters"].update(pairs_count=pairs)),
                             ([f"pairs_count {pairs}, was 1000"], []))

    def test_a_counter_that_no_library_promises_is_told_and_no_regression(self) -> None:
        for builder, is_ours in (("karras", True), ("embree-low", False), ("fcl-aabb", False), ("embreelike", True)):
            told = with_sentences(lambda raw: raw["counters"].update(sah_cost=81), builder)
            self.assertEqual(told, (["sah_cost 81, was 80.25"], [])[::1 if is_ours else -1], builder)
            self.assertEqual(with_sentences(lambda raw: raw["counters"].update(pairs_count=1001), builder),
                             (["pairs_count 1001, was 1000"], []), builder)

    def test_a_counter_that_is_not_there_is_a_regression_unless_allowed(self) -> None:
        def lose(raw: Raw) -> None:
            del raw["counters"]["sah_cost"]
            raw["left_out"] = {"sah_cost": "the tree is wrong"}

        lost = ["no sah_cost (the tree is wrong), was 80.25"]
        self.assertEqual(with_sentences(lose), (lost, []))
        self.assertEqual(with_sentences(lose, allow_missing=True), ([], lost))
        self.assertEqual(with_sentences(lambda raw: raw["counters"].update(new=1)), ([], []))

    def test_another_answer_is_a_regression_and_another_tree_is_not(self) -> None:
        self.assertEqual(with_sentences(lambda raw: raw["check"].update(pairs_hash="3" * 16)),
                         ([f"other pairs: {'3' * 16}, were {'1' * 16}"], []))
        self.assertEqual(with_sentences(lambda raw: raw["check"].update(tree_hash="3" * 16)),
                         ([], [f"another tree: {'3' * 16}, was {'2' * 16}"]))
        self.assertEqual(with_sentences(lambda raw: raw.update(leaves_by_depth=[0, 1, 2, 1])),
                         ([], ["leaves by depth 1–3, half by 2, were 2"]))
        self.assertEqual(with_sentences(lambda raw: raw["scene"].update(content_hash="3" * 16)),
                         ([f"another scene of the same name: content {'3' * 16}, was {'0' * 16}"], []))

    def test_where_errors_are_counted_they_tell_whether_another_answer_is_worse(self) -> None:
        for errors, worse in ((7, []), (9, ["false_count 9, was 8"])):
            first = document(cell() | {"check": {"verdict": "counted", "contacts_hash": "1" * 16},
                                       "counters": {"missed_count": 0, "false_count": 8, "contacts_count": 108}})
            second = copy.deepcopy(first)
            second["cells"][0]["check"]["contacts_hash"] = "3" * 16
            second["cells"][0]["counters"] |= {"false_count": errors, "contacts_count": 100 + errors}
            found = compared(first, second).cells[0]
            self.assertEqual((found.regressions, len(found.changes)), (worse, 3 - len(worse)))

    def test_a_lost_verdict_is_a_regression_and_a_won_one_is_not(self) -> None:
        good, wrong = document(cell()), document(cell())
        wrong["cells"][0]["check"] = {"verdict": "differs", "detail": "box 3"}
        lost = [(wrong, "differs (box 3), was agrees")]
        for status in ("skipped", "failed"):
            none = cell()
            for key in ("samples", "counters", "check"):
                del none[key]
            lost.append((document({**none, "status": status, "reason": "no room"}), f"{status} (no room), was agrees"))
        for bad, sentence in lost:
            self.assertEqual(compared(good, bad).cells[0].regressions, [sentence])
            self.assertEqual(compared(bad, good).regressions, 0)
            self.assertEqual(len(compared(bad, good).cells[0].changes), 1)
            self.assertEqual(verdicts(good, bad), [UNSURE])
            self.assertEqual(verdicts(bad, bad), [UNSURE if "samples" in bad["cells"][0] else SAME])

    def test_counters_that_are_times_or_unsteady_are_left_out(self) -> None:
        names = ["compile_ns", "copy_rate_bytes_per_s", "energy_joules", "tree_bytes", "pairs_count"]
        self.assertEqual([counters.is_time(name) for name in names], [True, True, True, False, False])
        of_group, of_leaf = (Cell({**cell(), "collider": {"name": name}}) for name in ("group", "leaf"))
        self.assertFalse(counters.is_exact("box_tests_count", of_group))
        self.assertTrue(counters.is_exact("pairs_count", of_group) and counters.is_exact("box_tests_count", of_leaf))
        of_bvtt = Cell({**cell(), "collider": {"name": "bvtt"}})
        self.assertEqual([counters.differs("query_bytes", 1000, now, of_bvtt) for now in (1002, 1011)], [False, True])
        self.assertTrue(counters.differs("tree_bytes", 1000, 1001, of_bvtt))


class Cells(unittest.TestCase):
    def test_are_told_apart_by_all_that_they_are(self) -> None:
        one = cell()
        others = [{**one, key: value} for key, value in (
            ("experiment", "fig8"), ("operation", "refit"), ("collider", {"name": "leaf"}),
            ("collider", {"name": "leaf", "options": {"narrow": "exact"}}),
            ("collider", {"name": "leaf", "options": {"no_skip": "rigid"}}), ("swept", {"pairs": "vertex-face", "to_frame": 5}),
            ("accuracy", {"axis": "sums", "method": "float", "seed": 1}),
            ("accuracy", {"axis": "sums", "method": "float", "seed": 2}),
            ("samples", [{"order": 0, "stages": [{"stage": "hierarchy", "span_ns": 100, "launches": 1}]}]))]
        others += [{**one, "scene": {**one["scene"], key: value}}
                   for key, value in (("name", "dragon"), ("frame", 1), ("between", 3), ("objects_by", "mesh"))]
        others += [{**one, "builder": {"name": "karras", "options": {key: value}}}
                   for key, value in (("order", "kd"), ("group_size", 64), ("leaves", "sorted"), ("boxes", "u16"))]
        for other in others:
            self.assertEqual(len(comparison.matched_cells([Cell(one)], [Cell(other)])[0]), 0, other)
            self.assertEqual(len(comparison.matched_cells([Cell(other)], [Cell(other)])[0]), 1)
        self.assertEqual(len(comparison.matched_cells([Cell(one), Cell(one)], [Cell(one)])[1]), 1)

    def test_of_one_file_only_are_listed_and_b_must_not_lack_any(self) -> None:
        first, second = document(cell("karras"), cell("apetrei")), document(cell("apetrei"), cell("perfect"))
        found = compared(first, second)
        self.assertEqual([each.builder for each in found.only_first], ["karras"])
        self.assertEqual([each.builder for each in found.only_second], ["perfect"])
        self.assertEqual((found.regressions, compared(first, second, allow_missing=True).regressions), (1, 0))
        self.assertIn("REGRESSION bunny: karras: not in B\nnew bunny: perfect: only in B\n", comparison_text.text(found))

    def test_are_shown_worst_first(self) -> None:
        first, second = (document(*(cell(name, median, seed=seed + place, frame=place)  # each on a frame of its own
                                    for place, (name, median) in enumerate(zip(FOUR, medians))))
                         for seed, medians in ((0, [1e6] * 4), (9, [1e6, 1.2e6, 2e6, 5e5])))
        text = comparison_text.text(compared(first, second))
        self.assertLess(text.index("perfect"), text.index("apetrei"))
        self.assertLess(text.index("apetrei"), text.index("oibvh-multi"))
        self.assertNotIn("karras", text)
        self.assertIn("4 cells: 0 SAME, 1 FASTER, 1 SLOWER, 2 UNSURE at 5.0 %\n1 regression found, 2 cells unsure\n", text)
        self.assertIn("karras", comparison_text.text(compared(first, second), show_all=True))


class Refusals(unittest.TestCase):
    def said(self, change: Callable[[Raw], Any], **rules: Any) -> str:
        good, changed = document(cell()), document(cell())
        change(changed)
        try:
            require_comparable((pathlib.Path("a"), good), (pathlib.Path("b"), changed), Rules(**rules))
        except WrongUsage as refusal:
            return str(refusal)
        return ""

    def test_say_what_cannot_be_compared(self) -> None:
        hooks = {"BVHBENCH_SLOW": "karras:2"}
        for change, says, rules in (
                (lambda raw: raw["run"]["program"].update(dirty=True, changed_files=["a.h", "b.h", "c.h", "d.h"]),
                 "b was made by a program with changes that no commit has (a.h, b.h, c.h and 1 more)", {"allow_dirty": True}),
                (lambda raw: raw["run"]["program"].update(commit="unknown"), "b was made by a program of unknown commit",
                 {"allow_dirty": True}),
                (lambda raw: raw["run"].update(test_hooks=hooks), "under BVHBENCH_SLOW=karras:2", {"allow_test_hooks": True}),
                (lambda raw: raw["cells"].clear(), "no cells", None),
                (lambda raw: [stage.update(span_ns=0) for sample in raw["cells"][0]["samples"] for stage in sample["stages"]],
                 "b has launches that took no time: the device's clock was wrong", None),
                (lambda raw: raw["run"].update(node_costs={"inner": 1, "triangle": 1}), "sah_cost", None),
                (lambda raw: raw["run"]["device"].update(name="another"), "--other-devices", {"other_devices": True}),
                (lambda raw: raw["run"]["host"].update(threads=2), "--other-devices", {"other_devices": True})):
            self.assertIn(says, self.said(change))
            if rules:
                self.assertEqual(self.said(change, **rules), "")
        self.assertEqual(self.said(lambda raw: raw["run"].update(node_costs={"inner": 1.2, "triangle": 1})), "")


class Statistics(unittest.TestCase):
    def test_quantiles_of_student_s_t_are_those_of_the_tables(self) -> None:
        for error, freedom, expected in ((0.05, 1, 12.7062), (0.05, 2, 4.3027), (0.05, 3, 3.1824), (0.05, 10, 2.2281), (0.01, 5, 4.0321),
                                         (0.001, 7, 5.4079), (0.05, 30, 2.0423), (0.01, 120, 2.6174), (0.5, 4, 0.7407)):
            self.assertAlmostEqual(student.quantile(error, freedom), expected, places=4)

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
        unknown = times.time_change(even[:2], even[:2], 0.05, 1e-7, times.Spread(2, 1))  # two processes and very many cells
        self.assertEqual((unknown.verdict, unknown.smallest), (times.UNSURE, math.inf))
        self.assertEqual(comparison_text.row_of("", unknown)[4:6], ["unknown", "too few"])

    def test_a_median_is_between_the_order_statistics_of_the_tables(self) -> None:
        for count, error, rank in ((9, 0.05, 2), (20, 0.05, 6), (30, 0.05, 10), (30, 0.01, 8), (100, 0.05, 40), (5, 0.05, 0), (0, 0.05, 0)):
            self.assertEqual(rank_below(count, error), rank)
