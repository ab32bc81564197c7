#!/usr/bin/env python3
"""Tests the adapter of Bullet: its pairs and its tree are right, and what it cannot take it refuses. Times it in plugin_loop.

Usage: adapters_test.py <bvhbench> <result schema> <adapter of Bullet> <plugin_loop>"""
import pathlib
import re
import subprocess
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


def test_the_loop_times_all_calls_without_bvhbench():
    pathlib.Path("two.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    done = subprocess.run([sys.argv[4], BULLET, "two.obj", "3"], capture_output=True, text=True)
    assert done.returncode == 0 and re.search(r"^bullet-dbvt:  build [\d.]+  query [\d.]+$", done.stderr, re.MULTILINE), done
    assert subprocess.run([sys.argv[4], "two.obj", "two.obj"], capture_output=True).returncode == 2
    pathlib.Path("quad.obj").write_text(pathlib.Path("two.obj").read_text() + "f 1 2 3 4\n")
    assert subprocess.run([sys.argv[4], BULLET, "quad.obj"], capture_output=True).returncode == 3


sys.exit(main(globals()))
