#!/usr/bin/env python3
"""Tests the adapter of Bullet: its pairs and its tree are right, and what it cannot take it refuses.

Usage: adapters_test.py <bvhbench> <result schema> <adapter of Bullet>"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from program import main, run, valid  # noqa: E402

BULLET = str(pathlib.Path(sys.argv[3]).resolve())
BOTH = ("bullet-dbvt", "bullet-quantized")


def collided(*words: str) -> list[dict]:
    done = run("collide", "--plugin", BULLET, "--collider", ",".join((*BOTH, "grid")), *words, "--json", "r.json", "--force")
    assert done.returncode == 0, done
    return valid("r.json")["cells"]


def test_both_find_the_pairs_of_the_oracle():
    cells = collided("--scene", "cloth-ball:400:3", "--frames", "0:3", "--samples", "2")
    assert [cell["collider"]["name"] for cell in cells] == 3 * [*BOTH, "grid"]
    assert {cell["check"]["verdict"] for cell in cells} == {"agrees"}
    for frame in (cells[:3], cells[3:6], cells[6:]):
        assert len({cell["check"]["pairs_hash"] for cell in frame}) == 1
    for cell in cells[:2]:
        outside = cell["outside"]
        assert outside["library"] == "Bullet" and outside["licence"] == "Zlib" and outside["device"] == "host", outside
        assert re.fullmatch(r"\d+\.\d+", outside["version"]), outside
        assert [stage["stage"] for stage in cell["samples"][0]["stages"]] == ["bounds", "build", "broad"]
        assert cell["counters"]["memory_bytes"] > 0


def test_few_triangles_are_taken():
    for count in (1, 2, 3):
        cells = collided("--scene", f"torus:{count}", "--samples", "1")
        assert {cell["check"]["verdict"] for cell in cells} == {"agrees"}, cells


def test_the_tree_is_judged():
    run("build", "--plugin", BULLET, "--builder", "bullet-dbvt", "--scene", "torus:500", "--samples", "2", "--json", "b.json")
    cell, = valid("b.json")["cells"]
    assert cell["check"]["verdict"] == "agrees" and cell["check"]["against"] == "contract"
    assert cell["counters"]["sah_cost"] > 0


sys.exit(main(globals()))
