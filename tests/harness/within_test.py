#!/usr/bin/env python3
"""Tests `collide --within`: pairs within a distance, what cells tell, and the messages for what does not go with it."""
import json
import pathlib
import sys

from program import copied_kernels, expect, main, only, valid

COLLIDE = ("collide", "--collider", "leaf", "--samples", "2", "--force", "--scene")


def rows_of(*words: str) -> set[str]:
    expect(0, *COLLIDE, *words, "--json", "w.json", "--contacts", "w.csv")
    assert only("w.json")["check"]["verdict"] == "agrees", only("w.json")
    return set(pathlib.Path("w.csv").read_text().splitlines()[1:])


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
    for words, why in ((("--narrow", "sat-f32", "--adjacent", "drop"), "beside 'within' 'narrow' is none or exact"),
                       (("--swept",), "'within' is about triangles of one moment, and swept boxes are not"),
                       (("--first",), "'first' ends at a contact, and 'within' is about all pairs"),
                       (("--pairs", "p.csv"), "finds pairs of triangles and none of boxes: --contacts, not --pairs"),
                       (("--narrow", "exact", "--containment"), "needs all exact contacts between objects")):
        expect(2, *COLLIDE, "n-body:6100:3", "--within", "1", *words, says=why)
    for word in ("-1", "inf", "nan", "1e400", "one", "1%%", "%"):
        expect(2, *COLLIDE, "n-body:6100:3", f"--within={word}", says="'within' takes none, a distance, or a share")


sys.exit(main(globals()))
