#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The committed results of the experiment `agreement` say that every collider is right over every tree, and what they
found is what the data sets' references list.

Usage: agreement_test.py <source root>

The second half needs the data sets (BVHBENCH_DATA); without, it is skipped, saying so.
"""
import json
import lzma
import os
import pathlib
import sys
import unittest

ROOT = pathlib.Path()


def result_files() -> list[pathlib.Path]:
    return sorted((ROOT / "results").glob("*/agreement.json.xz"))


def read(path: pathlib.Path) -> dict:
    packed = path.read_bytes()
    return json.loads(lzma.decompress(packed) if path.suffix == ".xz" else packed)


def frame_of(cell: dict) -> tuple[str, int]:
    return pathlib.Path(cell["scene"]["source"]).stem, cell["scene"]["frame"]


def pipeline_of(cell: dict) -> tuple[str, str]:
    return cell["builder"]["name"], cell["collider"]["name"]


def references(data: pathlib.Path) -> dict[tuple[str, int], dict]:
    """By scene and frame, what a separate program counted."""
    found = {}
    for name, reference in read(data / "static" / "reference.json").items():
        found[pathlib.Path(name).stem, 0] = reference
    for meta in sorted((data / "dynamic").glob("*/meta.json")):
        for reference in read(meta)["reference"]:
            found[meta.parent.name, reference["index"]] = reference
    return found


class Agreement(unittest.TestCase):
    def test_there_is_a_file_to_check(self) -> None:
        self.assertTrue(result_files())

    def test_every_cell_was_measured_and_agrees(self) -> None:
        for path in result_files():
            for cell in read(path)["cells"]:
                where = f"{path}: {cell['scene']['name']}, {pipeline_of(cell)}"
                self.assertEqual(cell["status"], "measured", where)
                self.assertEqual(cell["check"]["verdict"], "agrees", where)

    def test_every_collider_ran_over_every_tree_on_every_frame(self) -> None:
        trees = ["oibvh-single", "oibvh-multi", "perfect", "karras", "apetrei", "apetrei-fused", "lbvh-levels"]
        wanted = {(tree, collider) for tree in trees for collider in ("leaf", "group", "bvtt", "front")}
        wanted |= {("none", collider) for collider in ("grid", "embree", "fcl", "fcl-refit")}
        for path in result_files():
            frames: dict[tuple, set] = {}
            for cell in read(path)["cells"]:
                frames.setdefault(frame_of(cell), set()).add(pipeline_of(cell))
            self.assertGreaterEqual(len(frames), 47, path)
            for frame, pipelines in frames.items():
                self.assertEqual(wanted - pipelines, set(), f"{path}: {frame}")

    def test_what_was_found_is_what_the_references_list(self) -> None:
        data = os.environ.get("BVHBENCH_DATA")
        if not data:
            self.skipTest("BVHBENCH_DATA is not set: nothing is compared with the data sets")
        known = references(pathlib.Path(data))
        for path in result_files():
            compared = 0
            for cell in read(path)["cells"]:
                options = cell["collider"]["options"]
                if options["adjacent"] != "drop" or options["pairs_of"] != "all":
                    continue
                frame = frame_of(cell)
                reference, check, where = known[frame], cell["check"], f"{path}: {frame}, {pipeline_of(cell)}"
                if "pairs_hash" in check:
                    self.assertEqual(check["pairs_hash"], reference["aabb_hash"], where)
                    self.assertEqual(cell["counters"]["pairs_count"],
                                     reference["aabb_inter"] + reference["aabb_self_nonadj"], where)
                    compared += 1
                if "contacts_hash" in check and reference["pairs_with_degenerate"] == 0:
                    self.assertEqual(check["contacts_hash"], reference["exact_hash"], where)
                    self.assertEqual(cell["counters"]["contacts_count"],
                                     reference["exact_inter"] + reference["exact_self_nonadj"], where)
                    compared += 1
            self.assertGreater(compared, 47 * 30, path)


if __name__ == "__main__":
    ROOT = pathlib.Path(sys.argv.pop(1))
    unittest.main()
