"""Tests that committed result files match their schema, and that the schema refuses invalid ones. Those of the experiment
`agreement` must show that every collider is right over every tree, and match the data sets' references.

The comparison with the references needs the data sets (BVHBENCH_DATA). Without them it is skipped with a message."""
import copy
import json
import lzma
import os
import pathlib
import unittest

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[1]
ALL_CASES = os.environ.get("BVHBENCH_TESTS") == "all"


def read(path: pathlib.Path) -> dict:
    packed = path.read_bytes()
    return json.loads(lzma.decompress(packed) if path.suffix == ".xz" else packed)


class Schema(unittest.TestCase):
    def setUp(self) -> None:
        schema = read(ROOT / "results" / "schema" / "result-1.schema.json")
        jsonschema.Draft202012Validator.check_schema(schema)
        self.validator = jsonschema.Draft202012Validator(schema)
        self.document = read(ROOT / "tests" / "golden" / "table1.json")
        states = [cell["status"] for cell in self.document["cells"]]
        self.measured = self.document["cells"][states.index("measured")]
        self.skipped = self.document["cells"][states.index("skipped")]

    def assert_refused(self, words: str = "") -> None:
        errors = [error.message for error in self.validator.iter_errors(self.document)]
        self.assertTrue(errors)
        self.assertIn(words, " ".join(errors))

    def test_every_result_file_obeys(self) -> None:
        """Covers every format, so that an older committed file is noticed."""
        count = 0
        for folder in (ROOT / "tests" / "golden", ROOT / "results"):
            for path in sorted([*folder.rglob("*.json"), *folder.rglob("*.json.xz")]):
                document = read(path)
                if {"format", "run", "cells"} <= document.keys():
                    count += 1
                    if not ALL_CASES:
                        document["cells"] = document["cells"][::5]
                    for cell in document["cells"]:  # all samples of a cell have the same form: the first and last suffice
                        if len(cell.get("samples", [])) > 2:
                            del cell["samples"][1:-1]
                    for error in self.validator.iter_errors(document):
                        self.fail(f"{path}: {error.json_path}: {error.message}")
        self.assertGreaterEqual(count, 2)

    def test_every_cell_of_several_ranks_is_right(self) -> None:
        seen = set()
        for path in sorted((ROOT / "results").rglob("cluster-*.json.xz")):
            for cell in read(path)["cells"]:
                simulated = cell["cluster"]["simulated"]
                seen.add((cell["experiment"], simulated))
                self.assertEqual(cell["check"]["verdict"], "not_checked" if simulated else "agrees", path)
        self.assertEqual(seen, {("cluster", False), ("strong", False), ("weak", False), ("halo", True)})

    def test_refuses_wrong_cells_of_several_ranks(self) -> None:
        for name, of_simulated in (("pocl-2-cores/cluster-halo", True), ("h200/cluster-most", False)):
            self.document = read(ROOT / "results" / f"{name}.json.xz")
            self.validator.validate(self.document)
            cell = self.document["cells"][0]
            cluster = cell["cluster"]
            rank = cluster["ranks"][0]
            of_both = (cell, "cluster"), (cell, "check"), (cluster, "partition"), (cluster, "halo_share"), (cluster, "ranks")
            of_one = ((cluster, "box_bytes"), (rank, "targets_count")) if of_simulated else ((cluster, "pairs_count"), (rank, "samples"))
            for place, key in (*of_both, *of_one):
                kept = place.pop(key)
                self.assert_refused(f"'{key}' is a required property")
                place[key] = kept
            cell["status"] = "failed"
            self.assert_refused("'reason' is a required property")
            cell |= {"status": "measured"}
            for place in (cluster, rank):
                place["surprise"] = 1
                self.assert_refused("'surprise' was unexpected")
                del place["surprise"]
            rank["halo_sent_count"] = -1
            self.assert_refused("-1 is less than the minimum")

    def test_refuses_a_time_without_a_verdict(self) -> None:
        del self.measured["check"]
        self.assert_refused("'check' is a required property")

    def test_refuses_a_missing_cell_without_a_reason(self) -> None:
        for status in ("skipped", "failed"):
            self.skipped["status"] = status
            self.skipped.pop("reason", None)
            self.assert_refused("'reason' is a required property")

    def test_refuses_an_undeclared_field_at_every_level(self) -> None:
        sample = self.measured["samples"][0]
        for place in (self.document, self.document["run"], self.document["run"]["device"], self.measured,
                      self.measured["scene"], sample, sample["stages"][0], self.measured["check"]):
            place["surprise"] = 1
            self.assert_refused()
            del place["surprise"]

    def test_refuses_a_stage_on_both_clocks_and_on_none(self) -> None:
        stage = self.measured["samples"][0]["stages"][0]
        original = copy.copy(stage)
        stage["wall_ns"] = 1
        self.assert_refused()
        for key in ("wall_ns", "launches", "busy_ns", "span_ns", "moved_bytes"):
            stage.pop(key)
        self.assert_refused()
        stage.update(original)
        self.validator.validate(self.document)

    def test_refuses_errors_that_are_not_counted(self) -> None:
        accuracy = read(ROOT / "tests" / "golden" / "accuracy.json")
        self.document = accuracy | {"cells": accuracy["cells"][1:2]}
        self.validator.validate(self.document)
        cell = self.document["cells"][0]
        missed = cell["counters"].pop("missed_count")
        self.assert_refused()
        cell["counters"]["missed_count"] = missed
        del cell["accuracy"]
        self.assert_refused("'accuracy' is a required property")

    def test_refuses_another_major_format(self) -> None:
        self.document["format"] = "2.0"
        self.assert_refused("does not match")


def frame_of(cell: dict) -> tuple[str, int]:
    return pathlib.Path(cell["scene"]["source"]).stem, cell["scene"]["frame"]


def references(data: pathlib.Path) -> dict[tuple[str, int], dict]:
    """Returns the counts of a separate program, by scene and frame."""
    found = {(pathlib.Path(name).stem, 0): reference for name, reference in read(data / "static" / "reference.json").items()}
    for meta in sorted((data / "dynamic").glob("*/meta.json")):
        found |= {(meta.parent.name, reference["index"]): reference for reference in read(meta)["reference"]}
    return found


def asks_one_object_for_one_tree(cell: dict) -> bool:
    return cell["status"] == "skipped" and "the scene is one object" in cell["reason"]


class Agreement(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.files = {path: [cell for cell in read(path)["cells"] if not asks_one_object_for_one_tree(cell)]
                     for path in sorted((ROOT / "results").glob("*/agreement.json.xz"))}

    def test_every_collider_ran_over_every_tree_on_every_frame_and_agrees(self) -> None:
        trees = ["oibvh-single", "oibvh-multi", "perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels"]
        wanted = {(tree, collider) for tree in trees for collider in ("leaf", "group", "bvtt", "front")}
        wanted |= {("none", collider) for collider in ("grid", "embree", "fcl", "fcl-refit")}
        self.assertTrue(self.files)
        for path, cells in self.files.items():
            frames: dict[tuple, set] = {}
            for cell in cells:
                pipeline = cell["builder"]["name"], cell["collider"]["name"]
                self.assertEqual((cell["status"], cell["check"]["verdict"]), ("measured", "agrees"), f"{path}: {cell['scene']}, {pipeline}")
                frames.setdefault(frame_of(cell), set()).add(pipeline)
            self.assertGreaterEqual(len(frames), 47, path)
            for frame, pipelines in frames.items():
                self.assertEqual(wanted - pipelines, set(), f"{path}: {frame}")

    def test_what_was_found_is_what_the_references_list(self) -> None:
        data = os.environ.get("BVHBENCH_DATA")
        if not data:
            self.skipTest("BVHBENCH_DATA is not set: nothing is compared with the data sets")
        known = references(pathlib.Path(data))
        for path, cells in self.files.items():
            compared = 0
            for cell in cells:
                options, check = cell["collider"]["options"], cell["check"]
                if options["adjacent"] != "drop" or options["pairs_of"] != "all":
                    continue
                reference, where = known[frame_of(cell)], f"{path}: {frame_of(cell)}, {cell['builder']['name']}, {cell['collider']['name']}"
                for kind, listed, is_listed in (("pairs", "aabb", True),
                                                ("contacts", "exact", reference["pairs_with_degenerate"] == 0)):
                    if f"{kind}_hash" in check and is_listed:
                        self.assertEqual(check[f"{kind}_hash"], reference[f"{listed}_hash"], where)
                        self.assertEqual(cell["counters"][f"{kind}_count"],
                                         reference[f"{listed}_inter"] + reference[f"{listed}_self_nonadj"], where)
                        compared += 1
            self.assertGreater(compared, 47 * 30, path)
