#!/usr/bin/env python3
"""Tests the error counts of `accuracy`, and of `collide` with narrow phases that round.

Usage: accuracy_test.py <bvhbench> <result schema>"""
import pathlib
import sys

from program import cells_after, copied_kernels, expect, main, run, valid


def test_accuracy_counts_the_errors_of_each_narrow_phase():
    assert [line.split()[0] for line in expect(0, "list", "accuracy").splitlines()] == ["narrow", "sums", "codes", "input", "place", "boxes", "swept", "frames",
                                                                                          "impacts", "queries", "distance"]
    methods = [name for name in (line.split()[0] for line in expect(0, "list", "narrow").splitlines()) if not name.startswith(("ccd", "within"))]
    assert methods[0] == "filter-f64+exact", methods
    out = expect(0, "accuracy", "--axis", "narrow", "--pairs", "30000", "--samples", "2", "--seed", "5", "--out", "a",
                 says="filter-f64+exact: 0 missed and 0 false of 30,000 pairs")
    assert "\nseed 5\n" in out, out
    cells = valid("a/accuracy-narrow.json")["cells"]
    assert len({cell["scene"]["name"] for cell in cells}) >= 20
    assert [cell["accuracy"]["method"] for cell in cells] == methods * (len(cells) // len(methods))
    assert {cell["accuracy"]["seed"] for cell in cells} == {5}
    wrong = {}
    for cell in cells:
        counters, method = cell["counters"], cell["accuracy"]["method"]
        assert cell["check"]["verdict"] == ("agrees" if method == methods[0] else "counted"), cell
        assert len(cell["samples"]) == 2 and all(isinstance(counters[key], int) for key in counters if key.endswith("_count")), cell
        wrong[method] = wrong.get(method, 0) + counters["missed_count"] + counters["false_count"]
    assert wrong.pop(methods[0]) == 0 and min(wrong.values()) > 250, wrong
    assert pathlib.Path("a/accuracy-narrow.png").exists() or "nothing was drawn" in out
    assert expect(0, "show", "a/accuracy-narrow.json").count(" agrees\n") == len(cells) // len(methods)
    expect(0, "accuracy", "--scene", "soup:300", "--pairs", "3000", "--samples", "1", "--filter", "generic/guigue|soup.*/(f64|morton30)$",
           "--out", "b", says="guigue-f64: 0 missed")
    axes = [cell["accuracy"]["axis"] for cell in valid("b/accuracy.json")["cells"]]
    assert axes == ["narrow", "narrow", "sums", "codes", "boxes"], axes
    expect(2, "accuracy", "--axis", "depth", says="there are: narrow, sums, codes, input, place, boxes, swept, frames, impacts, queries, distance")
    expect(2, "accuracy", "--filter", "nothing", "--axis", "sums", "--scene", "soup:9", "--out", "c", says="no cell matches")
    expect(2, "accuracy", "--pairs", "0", says="--pairs")


def night_test_accuracy_of_swept_boxes_has_both_queries_of_each_method():
    out = expect(0, "accuracy", "--axis", "swept", "--scene", "cloth-ball:600:4", "torus:300", "--samples", "1",
                 "--filter", "/(leaf|grid)", "--out", "d", says="leaf over apetrei-fused")
    cells = valid("d/accuracy-swept.json")["cells"]
    assert [(cell["scene"]["name"], cell["swept"]["pairs"], cell["accuracy"]["method"]) for cell in cells] == [
        (scene, pairs, method) for scene in ("cloth-ball:600:4", "bend:torus:300")
        for pairs in ("vertex-face", "edge-edge") for method in ("leaf over apetrei-fused", "grid")], cells
    for cell in cells:
        assert cell["check"]["verdict"] == "agrees" and cell["check"]["against"] in ("CGAL boxes", "brute"), cell
        assert (cell["counters"]["missed_count"], cell["counters"]["false_count"]) == (0, 0), cell
    assert out.count(" both ") == 4, out
    assert pathlib.Path("d/accuracy-swept.png").exists() or "nothing was drawn" in out


def test_accuracy_of_impacts_counts_what_each_tolerance_finds_too_much_and_misses_nothing():
    out = expect(0, "accuracy", "--axis", "impacts", "--scene", "cloth-ball:1500:8", "bend:torus:1000", "--samples", "1", "--out", "i",
                 says="ccd-1e-4")
    cells = valid("i/accuracy-impacts.json")["cells"]
    methods = [name for name in (line.split()[0] for line in expect(0, "list", "narrow").splitlines()) if name.startswith("ccd")]
    assert [cell["accuracy"]["method"] for cell in cells] == 4 * methods, cells
    for k in range(0, len(cells), len(methods)):
        counters = [cell["counters"] for cell in cells[k:k + len(methods)]]
        assert all(cell["check"]["verdict"] == "counted" for cell in cells), cells
        assert all(one["missed_count"] == 0 for one in counters), counters
        falses = [one["false_count"] for one in counters]
        assert falses == sorted(falses, reverse=True), counters  # tolerances decrease
        assert len({one["contacts_count"] - one["false_count"] for one in counters}) == 1, counters
    assert sum(cell["counters"]["false_count"] for cell in cells) > 0, cells
    assert all(any(stage["stage"] == "narrow" for stage in cell["samples"][0]["stages"]) for cell in cells)
    assert " narrow, ms " in out and out.count(" both ") == 2 * len(methods), out


def test_accuracy_of_distances_misses_nothing_and_says_how_far_off_they_are():
    expect(0, "accuracy", "--axis", "distance", "--scene", "two-spheres:1200:1", "--samples", "1", "--out", "w", says="within-spheres")
    cells = valid("w/accuracy-distance.json")["cells"]
    assert len(cells) == 14 and [cell["check"]["verdict"] for cell in cells] == 2 * (["agrees"] + 6 * ["counted"]), cells
    assert all(cell["counters"].get("missed_count", 0) == 0 for cell in cells), cells
    assert {cell["accuracy"]["method"] for cell in cells if "distance_error_most" in cell["counters"]} == {"within-f32", "within-f64"}, cells


def night_test_accuracy_of_queries_misses_nothing_with_bounds():
    """Two edges that cross at a third of the step, and two that pass each other: by every method."""
    lines = ["-1,1,0,1,0,1", "1,1,0,1,0,1", "0,1,-1,1,1,1", "0,1,1,1,1,1", "-1,1,0,1,0,1", "1,1,0,1,0,1", "0,1,-1,1,-2,1", "0,1,1,1,-2,1"]
    apart = [line.replace("0,1,-1,1", "3,1,-1,1").replace("0,1,1,1,", "3,1,1,1,") for line in lines]
    pathlib.Path("cross_ee.csv").write_text("".join(f"{line},{touches}\n" for touches, query in ((1, lines), (1, apart)) for line in query))
    done = run("accuracy", "--axis", "queries", "--scene", "cross_ee.csv", "nowhere_ee.csv", "--samples", "1", "--out", "r")
    assert done.returncode == 0 and "floats: query 1 is published to touch, and passes" in done.stderr, done
    assert "ccd-f64-1e-10, edge-edge: 0 missed, 0 late and 0 false of 2 queries" in done.stdout, done
    *cells, missing = valid("r/accuracy-queries.json")["cells"]
    assert (missing["scene"]["name"], missing["status"]) == ("nowhere_ee.csv", "skipped"), missing
    assert [cell["accuracy"]["method"] for cell in cells][:1] == ["ccd-f32-1e-2"] and len(cells) == 10, cells
    for cell in cells:
        assert cell["check"]["verdict"] == "counted" and cell["scene"]["name"] == "cross_/edge-edge floats", cell
        assert cell["counters"]["touching_count"] == 1 and cell["counters"]["missed_count"] == 0, cell
        assert 0 <= cell["counters"]["gap_median"] < 0.05, cell
    assert pathlib.Path("r/accuracy-queries.png").exists() or "nothing was drawn" in done.stdout
    expect(0, "accuracy", "--axis", "queries", "--scene", "cross_ee.csv", "--samples", "1", "--out", "q", "--separation", "0.25")
    cells = {cell["accuracy"]["method"]: cell for cell in valid("q/accuracy-queries.json")["cells"]}  # as near at a quarter of the step
    assert all("in one plane" in cell["reason"] if name.startswith("roots") else cell["separation"] == .25 and
               cell["counters"]["late_count"] == 0 <= cell["counters"]["gap_median"] < 0.05 for name, cell in cells.items()), cells


def test_accuracy_of_frames_is_exact_until_the_narrow_phase_or_the_vertices_are_rounded():
    narrow, formats = ([line.split()[0] for line in expect(0, "list", what).splitlines()][1:] for what in ("narrow", "formats"))
    narrow = [name for name in narrow if not name.startswith(("ccd", "within"))]
    out = expect(0, "accuracy", "--axis", "frames", "--scene", "cloth-ball:3000:7", "nonsense", "--samples", "2", "--out", "f",
                 says="exact")
    *cells, missing = valid("f/accuracy-frames.json")["cells"]
    assert (missing["scene"]["name"], missing["status"]) == ("nonsense", "skipped"), missing
    methods = ["exact", *(f"narrow {name}" for name in (*narrow, "none")), *(f"boxes {name}" for name in formats),
               *(f"input {bits} bits" for bits in (20, 16, 12, 8)), "all coarse"]
    assert [(cell["scene"]["frame"], cell["accuracy"]["method"]) for cell in cells] == [
        (frame, method) for frame in (0, 3, 6) for method in methods], cells  # the first, the middle and the last
    last = {cell["accuracy"]["method"]: cell for cell in cells[-len(methods):]}
    right = last["exact"]["counters"]["right_contacts_count"]
    assert right > 50, right
    for method, cell in last.items():
        assert cell["status"] == "measured" and len(cell["samples"]) == 2, cell
        missed, false = cell["counters"]["missed_count"], cell["counters"]["false_count"]
        if method == "exact" or method.startswith("boxes"):
            assert (cell["check"]["verdict"], missed, false) == ("agrees", 0, 0), cell
            assert cell["check"]["contacts_hash"] == last["exact"]["check"]["contacts_hash"], cell
        else:
            assert cell["check"]["verdict"] == "counted", cell
        if method.endswith("bits"):
            assert cell["counters"]["contacts_count"] == right - missed + false, cell
        for key, sizes in (("missed_depth", missed), ("false_gap", false)):
            found = [cell["counters"].get(f"{key}_{of}", 0) for of in ("median", "99_percent", "most")]
            assert found == sorted(found) and (found[2] > 0) == (sizes > 0), cell
            if method.startswith("input"):  # corners move by at most half a step along each axis, and two triangles towards each other
                assert sizes == 0 or 0.05 < found[2] * 2**int(method.split()[1]) < 1.74, cell
    wrong = [sum(last[f"input {bits} bits"]["counters"][name] for name in ("missed_count", "false_count")) for bits in (20, 12, 8)]
    assert wrong[0] < wrong[1] < wrong[2], wrong
    assert last["input 8 bits"]["counters"]["missed_count"] > 5, last["input 8 bits"]
    none = last["narrow none"]["counters"]
    assert (none["missed_count"], none["false_count"]) == (0, none["pairs_count"] - right), none
    assert pathlib.Path("f/accuracy-frames.png").exists() or "nothing was drawn" in out


def test_accuracy_counts_what_formats_of_boxes_add_and_finds_what_they_lose():
    formats = [line.split()[0] for line in expect(0, "list", "formats").splitlines()]
    axis = ("accuracy", "--axis", "boxes", "--scene", "torus:1500", "--samples", "1")
    expect(0, *axis, "--out", "formats", says="torus:1500")
    cells = {cell["accuracy"]["method"]: cell for cell in valid("formats/accuracy-boxes.json")["cells"]}
    assert list(cells) == formats
    false = {method: cell["counters"]["false_count"] for method, cell in cells.items()}
    assert all(cell["counters"]["missed_count"] == 0 for cell in cells.values()), cells
    assert false["f32"] == false["f64"] == 0 < false["u16"] < false["u8"], false
    for method, cell in cells.items():
        assert cell["check"]["verdict"] == ("counted" if false[method] else "agrees"), cell
        assert cell["check"]["contacts_hash"] == cells["f32"]["check"]["contacts_hash"], cell
    # A device rounds sides one at a time or three at once, so both functions are made to round inward.
    copied_kernels("inward", "geometry/box_cells.h", r"\(is_upper \? whole_above\(product\)", "(!is_upper ? whole_above(product)",
                   "builders/stages/stored_box.clh", r"is_upper \? \(near < product", "!is_upper ? (near < product")
    expect(1, *axis, "--filter", "/u8$", "--kernels", "inward", "--out", "inward-out", says="pairs missed")
    cell, = valid("inward-out/accuracy-boxes.json")["cells"]
    assert cell["check"]["verdict"] == "differs" and cell["counters"]["missed_count"] > 100, cell


def test_collide_judges_rounded_boxes_by_what_they_miss():
    command = ("collide", "--collider", "group", "--scene", "torus:1500", "--samples", "1", "--adjacent", "drop")
    cell, = cells_after(*command, "--boxes", "u8", "--narrow", "none", says="0 pairs missed")
    assert cell["builder"]["options"]["boxes"] == "u8" and cell["builder"]["options"]["leaves"] == "sorted", cell
    assert cell["check"]["verdict"] == "counted" and cell["counters"]["false_pairs_count"] > 0, cell
    expect(0, *command, "--boxes", "u8", "--narrow", "exact", says="verdict: agrees with CGAL boxes, CGAL")
    expect(0, *command, "--boxes", "f64", "--narrow", "none", says="verdict: agrees with CGAL boxes")
    expect(2, *command, "--boxes", "u7", says="there are: f32, f64, f16, u16, u8")
    expect(2, *command, "--boxes", "u8", "--leaves", "mesh", says="leaves must be sorted")
    expect(2, *command, "--boxes", "u8", "--builder", "oibvh-wide4", says="oibvh-wide4 keeps its boxes in its own way")
    expect(1, *command, "--boxes", "u8", "--narrow", "none", "--kernels", "inward")


def test_accuracy_finds_a_fault_planted_in_the_exact_narrow_phase():
    narrow = ("accuracy", "--axis", "narrow", "--pairs", "3000", "--samples", "1", "--filter", "^same_place/.*exact$")
    expect(0, *narrow, "--out", "sound", says=" agrees")
    kernels = copied_kernels("faulty", "geometry/orient.h", r"return 0x1.8p-48 \* most.x", "return 0x1.8p-90 * most.x")
    out = expect(1, *narrow, "--kernels", kernels, "--out", "planted")
    cell, = valid("planted/accuracy-narrow.json")["cells"]
    assert cell["check"]["verdict"] == "differs" and cell["counters"]["missed_count"] > 100, cell
    assert "nothing was drawn" in out, out  # a wrong answer has no figure and no time
    line, = (line.split() for line in out.splitlines() if line.startswith("same_place"))
    assert line[-2:] == ["%", "differs"], line


def test_collide_counts_what_a_narrow_phase_that_rounds_gets_wrong():
    common = ("collide", "--collider", "leaf", "--scene", "two-spheres:3000", "--samples", "1")
    cell, = cells_after(*common, "--adjacent", "drop", "--narrow", "guigue-f64", says="contacts missed")
    assert cell["check"]["verdict"] == "counted" and cell["collider"]["options"]["narrow"] == "guigue-f64", cell
    assert {"missed_count", "false_count"} <= set(cell["counters"])
    expect(0, *common, "--adjacent", "drop", "--narrow", "filter-f64+exact", says="verdict: agrees with CGAL boxes, CGAL")
    expect(2, *common, "--narrow", "guigue-f64", says="it needs --adjacent drop")
    expect(2, *common, "--narrow", "guess", says="there are: filter-f64+exact, ")


if __name__ == "__main__":
    sys.exit(main(globals()))
