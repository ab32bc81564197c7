#!/usr/bin/env python3
"""Tests `collide --within`: pairs within a distance, what cells tell, and the messages for what does not go with it."""
import json
import math
import pathlib
import sys

from program import copied_kernels, expect, main, only, valid

COLLIDE = ("collide", "--collider", "leaf", "--samples", "2", "--force", "--scene")
HEADING = "frame,object_a,object_b,a,b,distance,ax,ay,az,bx,by,bz"


def lines_of(*words: str) -> list[list[str]]:
    """Returns the values of the lines of --contacts, whose heading beside --within is HEADING."""
    expect(0, *COLLIDE, *words, "--json", "w.json", "--contacts", "w.csv")
    assert {cell["check"]["verdict"] for cell in valid("w.json")["cells"]} == {"agrees"}
    heading, *lines = pathlib.Path("w.csv").read_text().splitlines()
    assert heading == HEADING[:None if "--within" in words else HEADING.index(",distance")], heading
    return [line.split(",") for line in lines]


def rows_of(*words: str) -> set[str]:
    return {",".join(line[:5]) for line in lines_of(*words)}


def test_a_cell_has_the_pairs_and_the_distance():
    exact = rows_of("two-spheres:1200:1", "--narrow", "exact", "--adjacent", "drop")
    before = set()
    for word in ("0", "1e-2", "2%"):
        rows = rows_of("two-spheres:1200:1", "--within", word, "--adjacent", "drop")
        cell = only("w.json")
        stages = [stage["stage"] for stage in cell["samples"][0]["stages"]]
        assert cell["collider"]["options"]["within"] == word and stages[0] == "pad" and stages[-2:] == ["narrow", "exact"], cell
        assert cell["counters"]["contacts_count"] == len(rows) and before | exact <= rows and "pairs_hash" not in cell["check"], cell
        assert word == "2%" or cell["within_distance"] == float(word), cell
        before = rows
    assert exact < before and len(rows_of("two-spheres:1200:1", "--within", "0", "--adjacent", "drop")) == len(exact)
    adjacent = rows_of("two-spheres:1200:1", "--within", "0")
    assert exact < adjacent, "pairs that share a corner are 0 apart"


def test_lines_have_distances_and_closest_points():
    pathlib.Path("turns").mkdir()
    for frame, z in enumerate((3, 3.25)):  # two parts, whose triangles are in turn and are sorted; the second is z above the first
        pathlib.Path("turns", f"{frame}.obj").write_text(
            f"v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 {z}\nv 1 1 9\nv 2 1 9\nv -4 0 0\nv 2 1 20\nf 1 2 3\nf 4 5 6\nf 1 3 7\nf 4 6 8\n")
    lines = lines_of("turns/", "--frames", "0:", "--within", "3.5", "--pairs-of", "between")
    assert [",".join(line[3:]) for line in lines] == [
        f"{pair},{points}" for z in ("3", "3.25") for pair, points in (
            ("0,1", f"{z},1,1,0,1,1,{z}"), ("0,3", f"{z},1,1,0,1,1,{z}"),
            ("1,2", f"{math.hypot(1, float(z))!r},1,1,{z},0,1,0"), ("2,3", f"{math.hypot(1, float(z))!r},0,1,0,1,1,{z}"))], lines
    pathlib.Path("turns", "1.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 8 8 8\nv 8 8 9\nv 9 8 9\nv 0 0 2\nv 1 0 3\nv 0 1 3\n"
                                              "f 4 5 6\nf 1 2 3\nf 7 8 9\n")  # other triangles than the frame before
    *_, last = lines_of("turns/", "--frames", "0:", "--within", "3.5", "--pairs-of", "between")
    assert ",".join(last) == "1,1,2,1,2,2,0,0,0,0,0,2", last
    frames = lines_of("cloth-ball:2000:4", "--frames", "0:", "--adjacent", "drop", "--within", "0.5%")
    for line in frames:
        distance, *points = map(float, line[5:])
        assert math.isclose(math.dist(points[:3], points[3:]), distance, rel_tol=1e-9, abs_tol=1e-14), line
    assert len({line[0] for line in frames}) == 4 and max(float(line[5]) for line in frames) <= 1.0001 * valid("w.json")["cells"][0]["within_distance"]


def test_frames_objects_and_trees_have_theirs():
    for words in (("n-body:6100:3", "--pairs-of", "between", "--frames", "0:"), ("n-body:6100:3", "--pairs-of", "within"),
                  ("n-body:6100:3", "--pairs-of", "between", "--trees", "scene"), ("two-spheres:1200:1", "--exclude", "0,0"),
                  ("cloth-ball:2000:4", "--frames", "0:", "--update", "refit"), ("cloth-ball:2000:4", "--frames", "0:", "--force-skip", "margin"),
                  ("cloth-ball:2000:4", "--frames", "0:3", "--builder", "karras", "--boxes", "u16")):
        expect(0, *COLLIDE, *words, "--within", "1%", "--json", "w.json")
        cells = valid("w.json")["cells"]
        assert {cell["check"]["verdict"] for cell in cells} == {"agrees"} and len({cell["within_distance"] for cell in cells}) == 1, cells


def test_wrong_pairs_differ():
    for file, pattern, text in (("distance_filter.h", r"\) <= low", ") <= 4.0 * low"), ("pad.cl", r"p \+ reach", "p + 0.5f * reach")):
        copied_kernels("k", f"collide/within/{file}", pattern, text)
        expect(1, *COLLIDE, "two-spheres:1200:1", "--within", "2%", "--kernels", "k", "--json", "w.json")
        assert only("w.json")["check"]["verdict"] == "differs", only("w.json")


def test_others_are_skipped_with_the_reason():
    pathlib.Path("own.json").write_text(json.dumps({
        "experiment": "own", "scenes": ["torus:700"], "samples": 1,
        "pipelines": [{"builder": "oibvh-multi", "collider": "leaf", "within": 0.5}, {"collider": "brute", "within": 0.5}]}))
    expect(0, "run", "own.json", "--out", "own.out.json", "--force")
    leaf, brute = valid("own.out.json")["cells"]
    assert leaf["status"] == "measured" and leaf["within_distance"] == 0.5, leaf
    assert brute["status"] == "skipped" and brute["reason"].startswith("'within' pads boxes on the device"), brute


def test_what_does_not_go_with_it_is_refused_in_one_sentence():
    for words, why in ((("--narrow", "sat-f32", "--adjacent", "drop"), "'within' is about distances, and the narrow phase 'sat-f32' is not; there are: within-f64"),
                       (("--swept",), "'within' is about triangles of one moment, and swept boxes are not"),
                       (("--first",), "'first' ends at a contact, and 'within' is about all pairs"),
                       (("--pairs", "p.csv"), "finds pairs of triangles and none of boxes: --contacts, not --pairs"),
                       (("--narrow", "exact", "--containment"), "needs all exact contacts between objects")):
        expect(2, *COLLIDE, "n-body:6100:3", "--within", "1", *words, says=why)
    expect(2, *COLLIDE, "n-body:6100:3", "--narrow", "within-f32", says="is about a distance: it needs 'within'")
    for word in ("-1", "inf", "nan", "1e400", "one", "1%%", "%"):
        expect(2, *COLLIDE, "n-body:6100:3", f"--within={word}", says="'within' takes none, a distance, or a share")


sys.exit(main(globals()))
