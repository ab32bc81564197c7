"""Tests a sweep's product, its plan and shards."""
import json
import unittest

import base  # noqa: F401  first: it adds the source root to sys.path

from plots.commands import sweep
from plots.files.output import WrongUsage
from plots.sweeping import planned, product, sizes

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
    def expand(experiments: list[dict]) -> list[dict]:
        return [answer_to(experiment) for experiment in json.loads(json.dumps(experiments))]

    return product.swept_of(keys, expand)


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


class Parts(unittest.TestCase):
    def test_they_are_cells_or_scenes_with_what_they_are_called(self) -> None:
        keys = {"scenes": ["soup:9", "torus:9"], "builders": ["perfect"], "colliders": ["leaf", "bvtt"]}
        apart, together = (sweep.parts_of(swept(**keys), is_together) for is_together in (False, True))
        self.assertEqual([len(cells) for cells in apart], [1, 1, 1, 1])
        plan = sweep.plan_of(swept(**keys), together)
        self.assertEqual([part["label"] for part in plan["parts"]], ["soup:9, 2 cells", "torus:9, 2 cells"])
        self.assertEqual([len(part["pipelines"]) for part in plan["parts"]], [2, 2])

    def test_more_builders_and_other_spellings_leave_a_part_what_it_is(self) -> None:
        def parts(*builders: object) -> list[str]:
            one = swept(scenes=["soup:9"], builders=list(builders), colliders=["leaf", "grid"])
            return [json.dumps(part) for part in sweep.plan_of(one, sweep.parts_of(one, False))["parts"]]

        self.assertLess(set(parts("karras")), set(parts("perfect", "karras")))
        self.assertEqual(parts("karras"), parts({"name": "karras", "order": "morton30", "group_size": 0}))

    def test_shards_are_all_of_it_each_once(self) -> None:
        every = sweep.parts_of(swept(scenes=["torus"], sizes="1000:8000000:x2", builders=["perfect", "karras"]), False)
        shares = [sweep.share_of(every, (number, 4)) for number in (1, 2, 3, 4)]
        self.assertEqual(sorted(id(part) for share in shares for part in share), sorted(map(id, every)))
        self.assertLessEqual(max(map(len, shares)) - min(map(len, shares)), 1)
        self.assertEqual((sweep.shard_called("2/8"), sweep.shard_called("")), ((2, 8), (1, 1)))
        for text in ("4/3", "0/3", "1", "1/3/5", "a/b", "1/0", "1/"):
            with self.subTest(text), self.assertRaises(WrongUsage):
                sweep.shard_called(text)

    def test_what_cannot_be_is_in_the_plan_with_its_reason(self) -> None:
        one = swept(scenes=["soup:9"], builders=["perfect", "oibvh-wide4"], set={"boxes": ["u16"]})
        plan = sweep.plan_of(one, sweep.parts_of(one, False))
        self.assertEqual([(cell["status"], cell["reason"]) for cell in plan["impossible"]],
                         [("skipped", "oibvh-wide4 keeps its boxes in its own way")])
        self.assertEqual(len(plan["parts"]), 1)
