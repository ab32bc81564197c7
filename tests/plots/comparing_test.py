#!/usr/bin/env python3
"""Tests what `compare` reports about times, counters, verdicts and cells of two result files."""
import copy
import math
import pathlib
import unittest
from collections.abc import Callable
from typing import Any

import numpy

from base import Raw  # first: it adds plots to sys.path

import counters
from cells import Cell
from comparing import axes, comparison, report
from comparing.refusals import Rules, require_comparable
from output import WrongUsage

BUILDERS = ["perfect", "karras", "apetrei", "lbvh-levels", "oibvh-single", "oibvh-multi"]
FOUR = ["karras", "apetrei", "perfect", "oibvh-multi"]
SAME, FASTER, SLOWER, UNSURE = "SAME", "FASTER", "SLOWER", "UNSURE"


def steady(_: float) -> float:
    return 1


def cell(builder: str = "karras", median_ns: float = 1e6, seed: int = 1, noise: float = 0.02, samples: int = 40,
         drift: Callable[[float], float] = steady, frame: int = 0, first: int = 0, every: int = 1) -> Raw:
    """Returns a cell whose whole times scatter about the median, equal for equal seeds. `drift` returns the factor on the time of
    a sample at a given share of the run."""
    spread = numpy.random.default_rng(seed).normal(0, noise, samples)
    return {"experiment": "trial", "status": "measured", "scene": {"name": "bunny", "frame": frame, "content_hash": "0" * 16},
            "builder": {"name": builder}, "check": {"verdict": "agrees", "pairs_hash": "1" * 16, "tree_hash": "2" * 16},
            "counters": {"sah_cost": 80.25, "pairs_count": 1000}, "leaves_by_depth": [0, 0, 4],
            "samples": [{"order": first + every * place, "stages": [
                {"stage": stage, "span_ns": int(median_ns / 2 * math.exp(off) * drift(place / samples)), "launches": 2}
                for stage in ("sort", "hierarchy")]} for place, off in enumerate(spread)]}


def document(*cells: Raw, name: str = "run") -> Raw:
    return {"format": "1.9", "cells": list(cells), "run": {
        "id": name, "finished_at": "then",
        "program": {"commit": "c0", "dirty": False, "compiler": "gcc", "build_type": "Release", "arch": "native", "kernels": "embedded"},
        "host": {"name": "host", "cpu": "cpu", "threads": 8, "os": "Linux"},
        "device": {"name": "device", "platform": "platform", "compute_units": 4, "driver": "1"}}}


def builders(seed: int, drift: Callable[[float], float] = steady, karras: float = 1, samples: int = 100) -> Raw:
    """Returns cells of six builders on one scene, with interleaved samples. The n-th builder takes n milliseconds."""
    return document(*(cell(name, 1e6 * (place + 1) * (karras if name == "karras" else 1), 10 * seed + place, 0.02, samples, drift,
                           first=place, every=len(BUILDERS)) for place, name in enumerate(BUILDERS)), name=f"run {seed}")


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


def of_processes(*medians_ns: float, seed: int) -> Raw:
    """Returns a cell with forty samples of each process, which has a median of its own."""
    whole = cell(samples=0)
    for process, median_ns in enumerate(medians_ns):
        own = cell(median_ns=median_ns, seed=seed + process, first=40 * process)["samples"]
        whole["samples"] += [{**sample, "process": process} for sample in own]
    return whole | {"processes": [f"run {process}" for process in range(len(medians_ns))]}


class Times(unittest.TestCase):
    def test_of_several_processes_differ_only_by_more_than_processes_do(self) -> None:
        one, other = of_processes(1e6, 1e6, 1.2e6, seed=1), of_processes(1e6, 1.2e6, 1.2e6, seed=7)
        self.assertEqual(verdicts(document(one), document(other)), [UNSURE])
        single = [{**each, "samples": [sample for sample in each["samples"] if sample["process"] == process]}
                  for each, process in ((one, 0), (other, 1))]
        self.assertEqual(verdicts(document(single[0]), document(single[1])), [SLOWER])

    def verdict_of(self, factor: float, threshold: float = 0.05, samples: int = 40, noise: float = 0.02) -> str:
        return verdicts(document(cell(samples=samples, noise=noise)),
                        document(cell(median_ns=factor * 1e6, seed=2, samples=samples, noise=noise)), threshold=threshold)[0]

    def test_are_told_apart_at_the_threshold(self) -> None:
        for factor, threshold, expected in ((1, 0.05, SAME), (1.02, 0.05, SAME), (1.1, 0.05, SLOWER), (0.9, 0.05, FASTER),
                                            (1.1, 0.5, SAME), (1.6, 0.5, SLOWER)):
            self.assertEqual(self.verdict_of(factor, threshold), expected, (factor, threshold))

    def test_of_few_samples_or_much_noise_are_unsure(self) -> None:
        self.assertEqual(self.verdict_of(3, samples=8), UNSURE)
        self.assertEqual(self.verdict_of(3, samples=9), SLOWER)
        self.assertEqual(self.verdict_of(1.03, noise=0.4), UNSURE)

    def test_of_many_cells_must_be_surer(self) -> None:
        many = document(*(cell(seed=frame, frame=frame) for frame in range(100)))
        self.assertAlmostEqual(compared(many, many).error_of_each, 0.0005)
        for each in many["cells"]:
            del each["samples"][9:]
        self.assertEqual(verdicts(many, many), [UNSURE] * 100)  # nine samples cannot give enough certainty

    def test_of_all_stages_together_decide_and_each_is_shown(self) -> None:
        after = document(cell(seed=2))
        for sample in after["cells"][0]["samples"]:
            sample["stages"][0]["span_ns"] *= 2
        only, = compared(document(cell()), after).cells
        self.assertEqual(only.verdict, SLOWER)
        self.assertAlmostEqual(only.time.ratio.value, 1.5, delta=0.03)
        self.assertAlmostEqual(only.stages["sort"].ratio.value, 2, delta=0.04)
        self.assertAlmostEqual(only.stages["hierarchy"].ratio.value, 1, delta=0.02)
        self.assertEqual(only.stages["sort"].counts, (40, 40))


class OfAScene(unittest.TestCase):
    def test_cells_are_judged_beside_the_others(self) -> None:
        before = builders(1)
        all_slower = compared(before, builders(2, lambda _: 1.2))
        self.assertEqual([each.verdict for each in all_slower.cells], [SAME] * 6)
        scene, = all_slower.scenes
        self.assertEqual((scene.verdict, scene.cells), (SLOWER, 6))
        self.assertAlmostEqual(scene.ratio.value, 1.2, delta=0.01)
        self.assertEqual(all_slower.regressions, 1)
        self.assertEqual(verdicts(before, builders(2, lambda _: 1.2, karras=1.15)), [SAME, SLOWER, SAME, SAME, SAME, SAME])

    def test_a_run_that_wavered_as_much_as_it_changed_says_nothing(self) -> None:
        found = compared(builders(1, lambda at: 1 if at < 0.5 else 1.25), builders(2, lambda _: 1.3))
        self.assertEqual([scene.verdict for scene in found.scenes], [UNSURE])
        self.assertEqual(found.regressions, 0)

    def test_cells_that_agree_on_nothing_are_unsure_but_of_what_no_drift_makes(self) -> None:
        found = compared(document(*map(cell, FOUR)), document(*map(cell, FOUR, (1e6, 1.2e6, 2e6, 5e5))))
        self.assertEqual([each.verdict for each in found.cells], [UNSURE, UNSURE, SLOWER, FASTER])
        self.assertEqual(found.scenes[0].verdict, UNSURE)

    def test_runs_by_turns_share_their_drift(self) -> None:
        def drift(at: float) -> float:
            return 1 + 0.4 * at + (0.5 if 0.3 < at < 0.6 else 0)

        before, after, slower = builders(1, drift), builders(2, drift, karras=1.08), builders(2, lambda at: 1.1 * drift(at))
        self.assertEqual(verdicts(before, after)[1], UNSURE)
        before["run"]["turns_with"] = ["run 2"]
        self.assertFalse(compared(before, after).by_turns)  # only one of them lists the other
        for other in (after, slower):
            other["run"]["turns_with"] = ["run 1"]
        found = compared(before, after)
        self.assertEqual([each.verdict for each in found.cells], [SAME, SLOWER, SAME, SAME, SAME, SAME])
        self.assertAlmostEqual(found.cells[1].time.ratio.value, 1.08, delta=0.01)
        self.assertEqual(verdicts(before, slower), [SLOWER] * 6)  # nothing else can explain it

    def test_samples_are_compared_that_were_taken_at_like_speed(self) -> None:
        def at_speeds(seed: int, fast_of_ten: int) -> Raw:
            of_two = builders(seed)
            for each in of_two["cells"]:
                for place, sample in enumerate(each["samples"]):
                    sample["calibration_ns"] = 1000 if place % 10 < fast_of_ten else 1500
                    for stage in sample["stages"]:
                        stage["span_ns"] *= sample["calibration_ns"] // 500
            return of_two

        found = compared(at_speeds(1, 7), at_speeds(2, 4))
        self.assertEqual([each.verdict for each in found.cells], [SAME] * 6)
        self.assertEqual(found.cells[0].time.counts, (70, 40))
        self.assertAlmostEqual(found.scenes[0].ratio.value, 1, delta=0.01)
        self.assertEqual(verdicts(at_speeds(1, 10), at_speeds(2, 0)), [UNSURE] * 6)  # they have no speed in common

    def test_only_ratios_count_on_other_devices(self) -> None:
        before = document(*map(cell, FOUR, (1e6, 2e6, 1e6), (1, 3, 5)))
        after = document(*map(cell, FOUR, (1e5, 2e5, 3e5), (2, 4, 6)))
        after["cells"][0]["counters"]["sah_cost"] += 1
        found = compared(before, after, other_devices=True)
        self.assertEqual([each.verdict for each in found.cells], [SAME, SAME, SLOWER])
        self.assertEqual(found.cells[0].regressions, [])
        self.assertEqual(verdicts(document(cell()), document(cell(median_ns=9e6)), other_devices=True), [UNSURE])  # alone


class OfOneBuild(unittest.TestCase):
    """Two runs of one program on a machine whose speed drifts slowly, and whose launches cost 0.7 or 5.7 us in a whole scene."""

    def run_of(self, random: numpy.random.Generator, slowed: float = 1) -> Raw:
        cells = []
        for scene, work in (("tiny", 1e4), ("large", 1e6)):
            drift = [random.normal(0, 0.05)]
            while len(drift) < 30:
                drift.append(0.95 * drift[-1] + random.normal(0, 0.05 * math.sqrt(1 - 0.95**2)))
            launches = 15 * random.choice((700, 5700))
            for place, name in enumerate(BUILDERS):
                times = (work * (1 + place) * (slowed if (scene, name) == ("large", "karras") else 1) + launches)
                times = times * numpy.exp(random.normal(0, 0.05, 30) + drift)
                cells.append({**cell(name, first=place, every=6), "samples": [
                    {"order": 6 * number + place, "stages": [{"stage": "hierarchy", "span_ns": int(ns), "launches": 15}]}
                    for number, ns in enumerate(times)]})
                cells[-1]["scene"] = {**cells[-1]["scene"], "name": scene}
        made = document(*cells)
        made["run"] |= {"launch_cost_ns": 700}
        made["run"]["device"]["kind"] = "cpu"
        return made

    def test_alarms_are_rare_and_a_slower_builder_is_found(self) -> None:
        random = numpy.random.default_rng(3)
        alarms = sum(compared(self.run_of(random), self.run_of(random)).regressions > 0 for _ in range(30))
        self.assertLessEqual(alarms, 4)  # 5 % are allowed: more than 4 of 30 have a probability of 1 %
        found = sum(compared(self.run_of(random), self.run_of(random, 1.8)).cells[7].verdict == SLOWER for _ in range(6))
        self.assertGreaterEqual(found, 5)

    def test_of_times_that_launches_explain_nothing_is_told(self) -> None:
        def tiny(ns: float, **facts: Any) -> Raw:
            made = document(*(cell(name, ns, seed) for seed, name in enumerate(BUILDERS)))
            made["run"] |= {"launch_cost_ns": 1000, **facts}
            made["run"]["device"]["kind"] = "cpu"
            return made

        before, after = tiny(20e3), tiny(50e3)  # 4 launches may cost 40 us more
        found = compared(before, after)
        self.assertEqual(([scene.verdict for scene in found.scenes], found.regressions), ([UNSURE], 0))
        self.assertEqual([scene.verdict for scene in compared(after, before).scenes], [UNSURE])
        for factor, verdict in ((2.5, UNSURE), (4, SLOWER)):
            changed = copy.deepcopy(before)
            for sample in changed["cells"][1]["samples"]:
                for stage in sample["stages"]:
                    stage["span_ns"] *= factor
            self.assertEqual(verdicts(before, changed)[1], verdict)
        after["run"]["device"]["kind"] = "gpu"
        before["run"]["device"]["kind"] = "gpu"  # 4 launches may cost 2 us more
        self.assertEqual([scene.verdict for scene in compared(before, after).scenes], [SLOWER])
        for run in (before, after):
            del run["run"]["launch_cost_ns"]  # as before format 1.5
        self.assertEqual([scene.verdict for scene in compared(before, after).scenes], [SLOWER])


class TwoBuilders(unittest.TestCase):
    PATHS = pathlib.Path("a.json"), pathlib.Path("b.json")

    def held(self, first: Raw, second: Raw, pair: str = "karras,perfect") -> comparison.Comparison:
        names = axes.pair_of(pair)
        return compared(*axes.between_builders(self.PATHS, first, second, names), builders=names)

    def test_of_one_file_or_two_are_compared(self) -> None:
        both = document(cell("karras"), cell("perfect", 5e5, seed=2), cell("apetrei"))
        alone = document(cell("karras")), document(cell("perfect", 5e5, seed=2))
        for first, second in ((both, both), alone):
            found = self.held(first, second)
            only, = found.cells
            self.assertEqual((only.verdict, found.regressions), (FASTER, 0))
            self.assertAlmostEqual(only.time.ratio.value, 0.5, delta=0.02)
            self.assertIn("bunny: perfect against karras", report.text(found))
            self.assertIn("1 cell of perfect against karras: 0 SAME, 1 FASTER", report.text(found))
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
        self.assertIn("WRONG bunny: perfect against karras: other pairs", report.text(found))

    def test_that_have_nothing_in_common_are_refused(self) -> None:
        only, other = document(cell("karras")), document(cell("perfect", frame=2))
        for first, second, says in ((only, only, "b.json has no cell of perfect; it has karras$"),
                                    (only, other, "no cell of perfect has the scene and options of one of karras: "
                                                  "they differ in frame: 0 against 2$")):
            with self.assertRaisesRegex(WrongUsage, says):
                self.held(first, second)
        for wrong in ("karras", "karras,", "karras,karras", "a,b,c"):
            with self.assertRaises(ValueError):
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
        names = ["compile_ns", "copy_rate_bytes_per_s", "tree_bytes", "pairs_count"]
        self.assertEqual([counters.is_time(name) for name in names], [True, True, False, False])
        of_group, of_leaf = (Cell({**cell(), "collider": {"name": name}}) for name in ("group", "leaf"))
        self.assertFalse(counters.is_exact("box_tests_count", of_group))
        self.assertTrue(counters.is_exact("pairs_count", of_group) and counters.is_exact("box_tests_count", of_leaf))


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
        self.assertIn("REGRESSION bunny: karras: not in B\nnew bunny: perfect: only in B\n", report.text(found))

    def test_are_shown_worst_first(self) -> None:
        first, second = (document(*(cell(name, median, seed=seed + place, frame=place)  # each on a frame of its own
                                    for place, (name, median) in enumerate(zip(FOUR, medians))))
                         for seed, medians in ((0, [1e6] * 4), (9, [1e6, 1.2e6, 2e6, 5e5])))
        text = report.text(compared(first, second))
        self.assertLess(text.index("perfect"), text.index("apetrei"))
        self.assertLess(text.index("apetrei"), text.index("oibvh-multi"))
        self.assertNotIn("karras", text)
        self.assertIn("4 cells: 1 SAME, 1 FASTER, 2 SLOWER, 0 UNSURE at 5.0 %\n2 regressions\n", text)
        self.assertIn("karras", report.text(compared(first, second), show_all=True))


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
                (lambda raw: raw.update(format="1.3"), "a has format 1.9 and b 1.3", None),
                (lambda raw: raw["run"].update(node_costs={"inner": 1, "triangle": 1}), "sah_cost", None),
                (lambda raw: raw["run"]["device"].update(name="another"), "--other-devices", {"other_devices": True}),
                (lambda raw: raw["run"]["host"].update(threads=2), "--other-devices", {"other_devices": True})):
            self.assertIn(says, self.said(change))
            if rules:
                self.assertEqual(self.said(change, **rules), "")
        self.assertEqual(self.said(lambda raw: raw.update(format="1.4")), "")
        self.assertEqual(self.said(lambda raw: raw["run"].update(node_costs={"inner": 1.2, "triangle": 1})), "")


if __name__ == "__main__":
    unittest.main()
