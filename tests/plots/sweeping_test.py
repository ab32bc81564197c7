#!/usr/bin/env python3
"""Tests a sweep's product, units, shards and plan, its estimate of the time left, and its handling of processes that end."""
import collections
import json
import os
import pathlib
import signal
import tempfile
import types
import unittest

import base  # noqa: F401  first: it adds plots to sys.path

import command
from commands import sweep
from json_files import Refused
from output import WrongUsage
from sweeping import folder, planned, processes, product, sizes, units

BUILDERS, COLLIDERS, GENERATORS = ("perfect", "karras", "oibvh-wide4", "oibvh-multi"), ("leaf", "bvtt", "grid"), ("torus", "soup")
USUAL = {"order": "morton30", "group_size": 0, "items": 0, "boxes": "f32", "leaves": "mesh"}


def builder_in_full(described: object) -> dict:
    """Returns a builder with all options, as the program does. Raises ValueError for what the program refuses."""
    given = {"name": described} if isinstance(described, str) else described
    if given["name"] not in BUILDERS:
        raise ValueError(f"no builder is called '{given['name']}'")
    options = {**USUAL, **{key: value for key, value in given.items() if key != "name"}}
    if options["boxes"] not in ("f32", "u16"):
        raise ValueError(f"no format of boxes is called '{options['boxes']}'")
    if options["boxes"] != "f32":
        if given["name"] == "oibvh-wide4":
            raise ValueError("oibvh-wide4 keeps its boxes in its own way")
        options["leaves"] = "sorted"
    options["group_size"] = int(options["group_size"])
    return {"name": given["name"], "options": options}


def collider_in_full(pipeline: dict) -> dict:
    described = pipeline["collider"]
    given = {"name": described} if isinstance(described, str) else described
    if given["name"] not in COLLIDERS:
        raise ValueError(f"no collider is called '{given['name']}'")
    options = {"adjacent": "keep", "no_skip": "", "jump": 0, **{key: value for key, value in given.items() if key != "name"}}
    options |= {key: pipeline[key] for key in ("adjacent", "narrow") if key in pipeline}
    rules = pipeline.get("no_skip", "none")
    options["no_skip"] = {"none": "", "all": "rigid, near"}.get(rules, rules)
    return {"name": given["name"], "options": options}


def answer_to(experiment: dict) -> dict:
    """Returns a simplified version of the program's answer to an experiment."""
    scene, = experiment["scenes"]
    scene = {"scene": scene} if isinstance(scene, str) else scene
    name = scene["scene"]
    if name in GENERATORS:
        return {"sized": True, "error": f"'{name}' has no size"}
    if not name.rpartition(":")[2].isdecimal():
        return {"error": f"no scene is called '{name}'"}
    cell = {"experiment": experiment["experiment"], "scene": {"name": name}, "status": "skipped", "operation": "build"}
    if int(scene.get("between", 0)):
        cell["scene"]["between"] = int(scene["between"])
    try:
        pipeline, = experiment.get("pipelines", [None])
        if pipeline:
            cell |= {"operation": "collide", "collider": collider_in_full(pipeline)}
        described = pipeline.get("builder", "perfect") if pipeline else experiment["builders"][0]
        cell["builder"] = builder_in_full(described)  # an invalid builder is refused even if the collider does not use it
        if cell.get("collider", {}).get("name") == "grid":
            cell["builder"] = {"name": "none", "options": USUAL}
    except ValueError as error:
        return {"error": str(error)}
    return {"cells": [cell], "triangles": int(name.rpartition(":")[2]), "files": []}


def swept(**keys: object) -> planned.Sweep:
    def settle(experiments: list[dict]) -> list[dict]:
        return [answer_to(experiment) for experiment in json.loads(json.dumps(experiments))]

    return product.swept_of(keys, settle)


class Sizes(unittest.TestCase):
    def test_lists_products_and_sums(self) -> None:
        self.assertEqual(sizes.called("1000:1000000:x10"), [1000, 10000, 100000, 1000000])
        self.assertEqual(sizes.called("1000:999999:x10"), [1000, 10000, 100000])
        self.assertEqual(sizes.called("10:60:+25"), [10, 35, 60])
        self.assertEqual(sizes.called("8:20:x1.5"), [8, 12, 18])
        self.assertEqual(sizes.called("1:10:x1.0001"), list(range(1, 11)))  # each once
        self.assertEqual(sizes.called("500,70,500,60:70:+10"), [60, 70, 500])
        self.assertEqual(sizes.called("1e3,0.5k,2.88M,1k:100k:x10"), [500, 1000, 10000, 100000, 2880000])

    def test_what_are_no_sizes(self) -> None:
        for text in ("", ",", "a", "0", "-5", "1:2", "1:2:3", "1:2:x", "1:2:x0.5", "1:2:+0.5", "1:2:x2:3", "2:1:x2", "1.5", "k", "1.0005k",
                     "99999999999", "1:2:xnan", "1:2:xinf", "1_000", " 7", "1:20000:+1"):
            with self.subTest(text), self.assertRaises(WrongUsage):
                sizes.called(text)


class Product(unittest.TestCase):
    def test_each_cell_is_there_once(self) -> None:
        sweep = swept(scenes=["torus", "soup:9", "refine:bunny:{size}"], sizes="10:100:x10",
                      builders=["perfect", "karras", "perfect"], orders=["morton30", "kd"], set={"leaves": ["mesh", "sorted"]})
        self.assertEqual(len(sweep.cells), 5 * 2 * 2 * 2)
        self.assertEqual(sweep.product, "5 scenes x 3 builders x 2 orders x 2 values of leaves")
        self.assertEqual([sweep.cells[place].scene["scene"] for place in (0, -1)], ["torus:10", "refine:bunny:100"])
        self.assertEqual(sweep.cells[-1].triangles, 100)

    def test_a_collider_without_a_tree_is_there_once_whoever_builds(self) -> None:
        sweep = swept(scenes=["soup:9"], builders=["oibvh-wide4", "karras"], colliders=["leaf", "grid"], set={"boxes": ["u16"]})
        self.assertEqual([(one.cell.builder, one.cell.collider, bool(one.why_not)) for one in sweep.cells],
                         [("oibvh-wide4", "leaf", True), ("none", "grid", False), ("karras", "leaf", False)])

    def test_a_combination_that_cannot_be_is_a_cell_and_a_wrong_word_is_refused(self) -> None:
        sweep = swept(scenes=["soup:9"], builders=["perfect", "oibvh-wide4"],
                      set={"boxes": ["f32", "u16"], "builder.group_size": ["64"]})
        self.assertEqual([one.why_not for one in sweep.cells], ["", "", "", "oibvh-wide4 keeps its boxes in its own way"])
        self.assertEqual(sweep.cells[3].raw["builder"]["options"], {"group_size": 64, "boxes": "u16"})
        self.assertEqual(sweep.cells[3].triangles, 9)
        self.assertEqual(len(units.units_of(sweep, False, "")), 3)
        with self.assertRaisesRegex(WrongUsage, "no format of boxes is called 'u15'"):
            swept(scenes=["soup:9"], builders=["oibvh-wide4"], set={"boxes": ["u15"]})

    def test_several_values_of_a_scenes_option_are_told_apart_also_where_there_is_no_cell(self) -> None:
        sweep = swept(scenes=["soup:9"], builders=["perfect", "oibvh-wide4"], colliders=["leaf"],
                      set={"boxes": ["f32", "u16"], "between": [0, 2]})
        self.assertEqual(len({one.cell.identity for one in sweep.cells}), 8)
        self.assertEqual(sum(bool(one.why_not) for one in sweep.cells), 2)
        with self.assertRaisesRegex(WrongUsage, "'frames' may have one value"):
            swept(scenes=["soup:9"], colliders=["leaf"], set={"frames": ["0:1", "1:2"]})
        with self.assertRaisesRegex(WrongUsage, "the scene 'soup:9' is there twice"):
            swept(scenes=["soup:9", {"scene": "soup:9", "frames": "0:1"}], colliders=["leaf"])

    def test_an_experiment_says_all_options(self) -> None:
        sweep = swept(scenes=["soup:9"], builders=["karras"], colliders=["bvtt", {"name": "grid"}],
                      set={"jump": [2], "adjacent": ["drop"], "no_skip": ["none", "all"]})
        first, second, third, _ = (sweep.experiment([one])["pipelines"][0] for one in sweep.cells)
        self.assertEqual(first["builder"], {"name": "karras", **USUAL})
        self.assertEqual(first, {"builder": first["builder"], "collider": {"name": "bvtt", "jump": "2"}, "adjacent": "drop"})
        self.assertEqual(second, first | {"no_skip": "all"})  # in experiments' notation of rules, not result files'
        self.assertNotIn("builder", third)

    def test_what_is_no_sweep(self) -> None:
        soup = {"scenes": ["soup:9"], "builders": ["perfect"]}
        for keys in ({"question": 5}, {"builders": [5], "orders": ["kd"]}, {"builders": [{}]}, {"builders": [None]},
                     {"builders": "perfect"}, {"builders": [{"name": "perfect", "order": "kd"}], "orders": ["kd"]},
                     {"orders": []}, {"colliders": [0]}, {"colliders": [{}]}, {"colliders": [None]}, {"set": 5},
                     {"set": {"boxes": "u16"}}, {"set": {"colour": [1]}}, {"set": {"jump": [2]}}, {"sizes": None},
                     {"sizes": [70]}, {"samples": 0}, {"samples": True}, {"warm_up": -1}, {"sweep": "a b"}, {"quality": "yes"},
                     {"scene": ["soup:9"]}, {"scenes": [5]}, {"scenes": ["soup"]}, {"scenes": ["soup:{size}"]},
                     {"scenes": [{"scene": "soup:9", "frames": "0:1"}]}):
            with self.subTest(str(keys)), self.assertRaises(WrongUsage):
                swept(**soup | keys)
        for keys, says in (({"samples": None}, "not null$"), ({"quality": ["a"]}, r'not \["a"\]$'),
                           ({"warm_up": True}, "not true$")):
            with self.assertRaisesRegex(WrongUsage, says):
                swept(**soup | keys)
        with self.assertRaisesRegex(WrongUsage, "--sah-inner: must be a number from 0 to 1000000, not '1000001'"):
            sweep.parser().parse_args(["--out", "x", "--sah-inner", "1000001"])


class Units(unittest.TestCase):
    def test_they_are_what_is_measured_and_how(self) -> None:
        keys = {"scenes": ["soup:9", "torus:9"], "builders": ["perfect"], "colliders": ["leaf", "bvtt"]}
        apart, together = (units.units_of(swept(**keys), is_together, "a") for is_together in (False, True))
        self.assertEqual([len(unit.cells) for unit in apart], [1, 1, 1, 1])
        self.assertEqual([unit.label for unit in together], ["soup:9, 2 cells", "torus:9, 2 cells"])
        self.assertEqual(len({unit.what for unit in apart}), 4)
        self.assertEqual([unit.what for unit in units.units_of(swept(**keys), False, "a")], [unit.what for unit in apart])
        self.assertFalse({unit.what for unit in units.units_of(swept(**keys), False, "b")} & {unit.what for unit in apart})
        self.assertEqual({unit.kind for unit in apart}, {", leaf over perfect", ", bvtt over perfect"})

    def test_more_builders_and_other_spellings_leave_a_unit_what_it_is(self) -> None:
        def names(*builders: object) -> set[str]:
            sweep = swept(scenes=["soup:9"], builders=list(builders), colliders=["leaf", "grid"])
            return {unit.what for unit in units.units_of(sweep, False, "")}

        self.assertLess(names("karras"), names("perfect", "karras"))
        self.assertEqual(names("karras"), names({"name": "karras", "order": "morton30", "group_size": 0}))

    def test_shards_are_all_of_it_each_once_and_balanced(self) -> None:
        every = units.units_of(swept(scenes=["torus"], sizes="1000:8000000:x2", builders=["perfect", "karras"]), False, "")
        shards = units.shards_of(every, 4)
        self.assertEqual((len(shards), set(shards)), (len(every), {1, 2, 3, 4}))
        load = collections.Counter()
        for unit, shard in zip(every, shards):
            load[shard] += unit.triangles
        self.assertLessEqual(max(load.values()) - min(load.values()), every[-1].triangles)
        self.assertEqual(units.shards_of(every, 4), shards)
        self.assertEqual(units.shard_called("2/8"), units.Shard(2, 8))
        for text in ("4/3", "0/3", "1", "1/3/5", "a/b", "1/0", "", "1/"):
            with self.subTest(text), self.assertRaises(WrongUsage):
                units.shard_called(text)


class TimeLeft(unittest.TestCase):
    def test_it_goes_by_the_triangles_of_a_kind(self) -> None:
        left = units.TimeLeft()

        def expect(kind: str, triangles: int, seconds: float) -> None:
            self.assertAlmostEqual(left.seconds_of(kind, triangles), seconds)

        left.add("a", 100000, 2)
        expect("a", 100000, 2)
        expect("b", 300000, 4)  # starting counts as 100000 triangles
        expect("b", 0, 2)
        left.add("a", 1100000, 12)
        expect("a", 2100000, 22)
        left.add("b", 100000, 20)
        expect("a", 2100000, 22)
        left.add("b", 200000, 40)
        expect("b", 400000, 80)  # the start time is never negative
        left.add("c", 1000, 3)
        left.add("c", 2000, 1)
        expect("c", 50000, 2)  # the time per triangle is never negative

    def test_it_is_told_roughly(self) -> None:
        for seconds, told in ((0.2, "1 s"), (89, "89 s"), (89.5, "2 min"), (3600, "60 min"), (3600 * 5 + 1200, "5 h 20 min"),
                              (7200, "2 h"), (86400 * 2 + 3 * 3600, "2 d 3 h")):
            self.assertEqual(units.rough(seconds), told)


class Folder(unittest.TestCase):
    def test_a_plan_that_is_none_is_refused(self) -> None:
        plan = {"format": 2, "sweep": "s", "product": "p", "device": "d", "programs": ["a"], "units": ["b"]}
        with tempfile.TemporaryDirectory() as where:
            path = pathlib.Path(where, "plan.json")
            path.write_text(json.dumps(plan))
            self.assertEqual(folder.plan_in(path), plan)
            for wrong, says in (({**plan, "format": 1}, "an older program"), ({**plan, "format": 3}, "a newer program"),
                                ({**plan, "format": "x"}, "no plan"), ([], "no plan"), ({**plan, "units": 5}, "no plan"),
                                ({**plan, "units": [5]}, "no plan"), ({"format": 2}, "no plan")):
                path.write_text(json.dumps(wrong))
                with self.subTest(str(wrong)), self.assertRaisesRegex(Refused, says):
                    folder.plan_in(path)


class Ends(unittest.TestCase):
    """Tests the reasons that are given for processes without a result."""

    def loss(self, code: int, said: str = "", given_up: str = "") -> processes.Loss:
        process = types.SimpleNamespace(child=types.SimpleNamespace(returncode=code), given_up=given_up, sentence=lambda: said)
        return processes.loss_of(process)

    def test_each_has_its_reason(self) -> None:
        lost = processes.Loss
        crash = lost("its process crashed (signal 11): near", may_be_the_device=True)
        self.assertEqual(self.loss(-signal.SIGSEGV, "near"), crash)
        self.assertEqual(self.loss(2, "no such"), lost("no such", is_skipped=True))
        self.assertEqual(self.loss(3, "no device"), lost("no device", may_be_the_device=True))
        self.assertEqual(self.loss(1), lost("its process ended with exit code 1 and left no result"))
        self.assertTrue(self.loss(128 + signal.SIGTERM, "stopped").was_stopped and self.loss(-signal.SIGINT).was_stopped)
        self.assertEqual(self.loss(-signal.SIGKILL, "", "it took long"), lost("it took long"))

    def test_only_the_last_of_what_it_says_is_kept(self) -> None:
        process = processes.Process.__new__(processes.Process)
        reader, writer = os.pipe()
        process.errors, process.said = reader, b""
        with os.fdopen(reader), os.fdopen(writer, "wb", buffering=0) as pipe:
            for _ in range(3):
                pipe.write(b"bvhbench: first\n" + b"x" * 40000 + b"\nbvhbench: last\nwords of a driver\n")
                while process.errors in processes.readable([process.errors]):
                    self.assertFalse(process.take())
        self.assertEqual((len(process.said), process.sentence()), (processes.MOST_ERRORS, "last"))

    def test_a_signal_is_remembered_until_the_end(self) -> None:
        before = signal.getsignal(signal.SIGTERM)
        stop = processes.Stop()
        with command.signals_to(stop.remember):
            self.assertEqual(stop.number, 0)
            os.kill(os.getpid(), signal.SIGTERM)
            self.assertEqual(stop.number, signal.SIGTERM)
        self.assertEqual(signal.getsignal(signal.SIGTERM), before)


if __name__ == "__main__":
    unittest.main()
