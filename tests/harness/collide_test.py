#!/usr/bin/env python3
"""Tests the pairs, contacts, files and messages of `collide`."""
import array
import json
import pathlib
import random
import sys

from program import cells_after, expect, main, only, run, valid

TREELESS = ("grid", "all-pairs", "sort-sweep", "brute", "embree", "embree-refit")  # colliders that query no tree


def test_collide_writes_a_valid_result_and_the_pairs():
    common = ("--scene", "sphere:700", "--samples", "3", "--force")
    hashes = set()
    listed = expect(0, "list", "colliders").splitlines()
    present = [line.split()[0] for line in listed if "built without" not in line]
    for collider in [name for name in present if not name.startswith("fcl")]:  # fcl finds contacts instead
        for builder in ("oibvh-multi", "karras"):
            words = ("collide", "--builder", builder, "--collider", collider, *common, "--json", "c.json", "--pairs", "p.csv")
            if builder == "karras" and collider in TREELESS:
                continue  # they take no tree
            out = expect(0, *words, says="verdict: agrees with CGAL boxes, pairs ")
            cell = only("c.json")
            assert cell["operation"] == "collide" and cell["collider"]["name"] == collider, cell
            has_tree = cell["builder"]["name"] != "none"
            assert has_tree == (collider not in TREELESS), cell
            name, over = {"grid": "hierarchical grid"}.get(collider, collider), f"over {builder} " if has_tree else ""
            name += ", jump 1, from " if collider == "bvtt" else f" {over}on sphere"  # the device may choose where bvtt starts
            assert f"\n{name}" in out and f"{over}on sphere:700" in out, out
            assert "\nbroad " in out and (not has_tree or "\nhierarchy " in out), out
            lines = pathlib.Path("p.csv").read_text().splitlines()
            assert lines[0] == "frame,object_a,object_b,a,b" and len(lines) == 1 + cell["counters"]["pairs_count"] > 701, cell
            hashes.add(cell["check"]["pairs_hash"])
    assert len(hashes) == 1, hashes
    perfect = ("collide", "--builder", "perfect", "--collider", "leaf", *common, "--json", "c.json")
    expect(0, *perfect, "--pairs", "p.bin")
    words = array.array("I", pathlib.Path("p.bin").read_bytes())
    assert [f"0,0,0,{a},{b}" for a, b in zip(words[::2], words[1::2])] == lines[1:]
    expect(0, *perfect, "--adjacent", "drop", says="leaf, adjacent dropped over perfect on sphere:700")
    assert only("c.json")["counters"]["pairs_count"] < len(lines) - 1


def test_collide_goes_through_frames_and_objects_to_contacts():
    common = ("--scene", "n-body:6100:3", "--samples", "2", "--adjacent", "drop", "--narrow", "exact")
    leaf = ("collide", "--collider", "leaf", *common)
    assert [cell["scene"]["frame"] for cell in cells_after(*leaf, "--frames", "1:", "--between", "1")] == [1, 2, 3, 4]
    shown = expect(0, "collide", "--collider", "group", *common, "--pairs-of", "between", "--frames", "0:",
           "--json", "f.json", "--pairs", "p.csv", "--force", "--contacts", "k.csv", "--skips", says="skips:")
    cells = valid("f.json")["cells"]
    assert {cell["scene"]["frame"] for cell in cells} == {0, 1, 2}, cells
    assert {cell["scene"]["objects"] for cell in cells} == {305}
    assert all(cell["check"]["verdict"] == "agrees" for cell in cells), cells
    last = [cell for cell in cells if cell["scene"]["frame"] == 2]
    assert len({cell["check"]["contacts_hash"] for cell in last}) == 1
    assert any(cell["counters"]["refitted_objects_count"] > 1 for cell in last), last
    assert any(cell["counters"]["rebuilt_objects_count"] > 1 and "rigid" in cell["collider"]["options"]["no_skip"]
               for cell in last), last
    for cell in cells:  # in the last frame more than half of the triangles are near
        near = cell["scene"]["frame"] < 2 and "near" not in cell["collider"]["options"]["no_skip"]
        assert near == ("entered_count" in cell["counters"]), cell
        assert near == any(stage["stage"] == "near" for stage in cell["samples"][0]["stages"]), cell
        assert not near or 0 < cell["counters"]["entered_count"] < cell["scene"]["triangles"] / 2, cell
    rows = [line.split() for line in shown.splitlines() if line.split()[2:3] == ["near"]]
    assert [int(row[3].replace(",", "")) > 3050 for row in rows] == [True, True, False], shown
    whole, = cells_after(*leaf, "--pairs-of", "between", "--no-skip", "near")
    assert whole["collider"]["options"]["no_skip"] == "near" and "entered_count" not in whole["counters"], whole
    assert whole["check"]["contacts_hash"] == next(cell for cell in cells if cell["scene"]["frame"] == 0)["check"]["contacts_hash"]
    pairs, contacts = (pathlib.Path(name).read_text().splitlines() for name in ("p.csv", "k.csv"))
    assert set(contacts[1:]) <= set(pairs[1:]), "contacts are among the pairs"
    for kind, lines in (("pairs", pairs), ("contacts", contacts)):
        for frame in (0, 1, 2):
            count = next(cell for cell in cells if cell["scene"]["frame"] == frame)["counters"][f"{kind}_count"]
            assert sum(line.startswith(f"{frame},") for line in lines) == count, (kind, frame)
    assert len(pairs) > 100
    one, = cells_after(*leaf, "--objects", "one", says="verdict: agrees with CGAL boxes, CGAL")
    assert one["scene"]["objects"] == 1
    for code, says, *words in ((2, "has frames 0 to 2, not 2 to before 9", *common, "--frames", "2:9"),
                               (2, "there are: unchanged, rigid, ", *common, "--no-skip", "lunch"),
                               (2, "--narrow exact", "--scene", "soup:9", "--contacts", "k.csv"),
                               (4, "order kd lines up one object, not 9", "--scene", "soup:9", "--order", "kd", "--objects", "components")):
        expect(code, "collide", "--collider", "leaf", *words, says=says)


def test_collide_makes_one_tree_over_many_small_objects_and_says_so():
    row = [f"o {k}\nv {k} 0 0\nv {k}.9 1 0\nv {k + 1} 0 1\nf -3 -2 -1" for k in range(512)]
    pathlib.Path("row.obj").write_text("\n".join(row))
    pathlib.Path("row").mkdir()
    for frame, objects in enumerate((row, row[:1])):  # other triangles from frame to frame
        pathlib.Path(f"row/{frame}.obj").write_text("\n".join(objects))
    words = ("collide", "--collider", "group", "--samples", "1", "--json", "t.json", "--force", "--scene")
    line = "512 objects are small and share one tree; --trees object gives each its own"
    pairs = set()
    for more, trees in (((), "scene"), (("--trees", "object"), "object"), (("--trees", "scene"), "scene")):
        errors = run(*words, "row.obj", *more).stderr
        cell = only("t.json")
        assert cell["collider"]["options"]["trees"] == trees and (line in errors) == (not more), (more, cell, errors)
        pairs.add(cell["counters"]["pairs_count"])
    assert pairs == {511}, pairs
    expect(0, *words, "row", "--frames", "0:")
    assert [cell["collider"]["options"]["trees"] for cell in valid("t.json")["cells"]] == ["object"] * 2


def sheet_and_triangle(z: float) -> str:
    points = ["0 0 0", "1 0 0", "1 1 0", "0 1 0", f".25 .25 {z}", f".75 .25 {z}", f".25 .75 {z}"]
    faces = ["1 2 3", "1 3 4", "5 6 7"]
    return "".join(f"v {point}\n" for point in points) + "".join(f"f {face}\n" for face in faces)


def test_collide_finds_pairs_of_swept_boxes_and_holds_them_to_the_folders_ground_truth():
    folder = pathlib.Path("fall")
    folder.mkdir()
    for frame, z in enumerate((1, -1)):
        (folder / f"{frame}.obj").write_text(sheet_and_triangle(z))
    swept = ("collide", "--scene", "fall/", "--collider", "leaf", "--samples", "2", "--swept", "--json", "s.json", "--force")

    def cells() -> tuple[dict, dict]:
        vf, ee = valid("s.json")["cells"]
        assert (vf["swept"], ee["swept"]) == ({"pairs": "vertex-face", "to_frame": 1, "primitives": 10},
                                              {"pairs": "edge-edge", "to_frame": 1, "primitives": 8})
        assert (vf["counters"]["pairs_count"], ee["counters"]["pairs_count"]) == (8, 3)
        return vf, ee

    expect(0, *swept, says="agrees with CGAL boxes, pairs ")
    assert all("ground_truth_pairs" not in cell["counters"] for cell in cells())
    (folder / "gt_vf.csv").write_text("4,0,1\n6,1,0\n")
    (folder / "gt_ee.csv").write_text("0,2,5,4,1\r\n")
    shown = expect(0, *swept, says="agrees with CGAL boxes, ground truth, pairs ")
    assert " 2 " in shown and "4.0" in shown, shown  # eight pairs, two of the ground truth
    for cell, listed in zip(cells(), (2, 1)):
        assert (cell["counters"]["ground_truth_pairs"], cell["counters"]["ground_truth_missed"]) == (listed, 0), cell
    expect(0, *swept, "--pairs-of", "within", "--pairs", "p.csv")
    assert pathlib.Path("p.csv").read_text().splitlines() == ["frame,a,b", "0,1,5", "0,1,6", "0,1,7"]
    assert [cell["swept"]["pairs"] for cell in valid("s.json")["cells"]] == ["edge-edge"]

    # A listed pair that does not overlap is missed, and makes the answer wrong. So does a count other than the author's.
    (folder / "gt_vf.csv").write_text("4,0,1\n0,2,1\n")
    assert "1 pairs of the ground truth are missed" in expect(1, *swept)
    assert valid("s.json")["cells"][0]["counters"]["ground_truth_missed"] == 1
    (folder / "gt_vf.csv").unlink()
    meta = {"frame_labels": [0, 1], "ccd": {"from_frame": "0", "to_frame": "1", "swept_vf": 8, "swept_ee": 4}}
    (folder / "meta.json").write_text(json.dumps(meta))
    assert "meta.json counts 4 pairs" in expect(1, *swept)
    expect(0, *swept, "--pairs-of", "between", says="agrees with CGAL boxes, meta.json, pairs ")

    # At half time the corners of the triangle fall through the sheet, one of them on its diagonal, which all sides cross.
    meta["ccd"] |= {"swept_ee": 3}
    (folder / "meta.json").write_text(json.dumps(meta))
    (folder / "gt_vf.csv").write_text("4,0,1\n6,0,0\n")
    (folder / "gt_ee.csv").write_text("0,2,5,4,1\n0,2,4,6,1\n")
    expect(0, *swept, "--narrow", "ccd-1e-4", says="counted: 0 contacts missed, 0 false")
    for cell, contacts, truth in zip(cells(), (4, 3), (1, 2)):
        counters = cell["counters"]
        assert cell["check"]["against"] == "CGAL boxes, CGAL, ground truth, meta.json", cell
        assert (counters["contacts_count"], counters["missed_count"], counters["false_count"]) == (contacts, 0, 0), counters
        assert (counters["ground_truth_pairs"], counters["ground_truth_missed"]) == (truth, 0), counters
        assert 0.49 < counters["earliest_impact"] <= 0.5, counters
    expect(0, *swept, "--narrow", "ccd-1e-6", "--pairs-of", "within", "--contacts", "c.csv")
    heading, *lines = pathlib.Path("c.csv").read_text().splitlines()
    assert heading == "frame,a,b,time" and [line.rsplit(",", 1)[0] for line in lines] == ["0,1,5", "0,1,6", "0,1,7"], lines
    assert all(0.49 < float(line.rsplit(",", 1)[1]) <= 0.5 for line in lines), lines
    (folder / "gt_vf.csv").write_text("1,1,1\n")  # its swept box overlaps, and it does not touch
    assert "1 pairs of the ground truth are missed" in expect(1, *swept, "--narrow", "ccd-1e-4")
    expect(2, "collide", "--scene", "fall/", "--collider", "leaf", "--adjacent", "drop", "--narrow", "ccd-1e-4",
           says="'ccd-1e-4' looks at the way between two frames: it needs swept boxes")

    for options, sentence in ((("--narrow", "exact"), "'exact' looks at one moment"),
                              (("--narrow", "guigue-f64"), "'guigue-f64' looks at one moment; there are: ccd-1e-2, "),
                              (("--contacts", "c.csv", "--narrow", "ccd-1e-4"), "choose by --pairs-of"),
                              (("--adjacent", "keep"), "there are none for --adjacent keep"),
                              (("--objects", "one"), "nobody chooses them"),
                              (("--order", "kd"), "order kd lines up one object"),
                              (("--pairs", "p.csv"), "choose by --pairs-of")):
        expect(2, *swept, *options, says=sentence)
    expect(2, *swept, "--frames", "1", says="has steps 0 to 0, not 1 to before 2")
    expect(3, "collide", "--scene", "torus:500", "--collider", "leaf", "--swept", says="bend:torus:500 has two")


def test_collide_in_doubles_finds_touches_that_floats_lose_far_from_the_origin():
    chance, touching, vertices, faces = random.Random(1), 0, ["", "", ""], ""
    for k in range(60):  # a tilted face at rest, and a corner that comes to 1e-9 above or below its inside, and goes back
        a, b, c, above = chance.random(), chance.random(), chance.random(), chance.choice((1e-9, -1e-9))
        touching += above < 0
        inside = a / 2 + (b + c) / 4
        for frame, z in enumerate((inside + 1e-3, inside + above, inside + 1e-3)):
            for point in ((0, 0, a), (1, 0, b), (0, 1, c), (.25, .25, z), (.5, .25, z + 1), (.25, .5, z + 1)):
                vertices[frame] += f"v {1e6 + 4 * k + point[0]!r} {1e6 + point[1]!r} {1e6 + point[2]!r}\n"
        faces += "".join(f"f {6 * k + n} {6 * k + n + 1} {6 * k + n + 2}\n" for n in (1, 4))
    pathlib.Path("far").mkdir()
    for frame, lines in enumerate(vertices):
        pathlib.Path(f"far/{frame}.obj").write_text(lines + faces)
    swept = ("collide", "--scene", "far/", "--collider", "leaf", "--samples", "1", "--swept", "--frames", "0:", "--pairs-of", "between",
             "--json", "far.json", "--force", "--narrow")
    for method, doubles in (("ccd-f64-1e-4", "kept"), ("ccd-f64-1e-6", "kept"), ("ccd-f64-1e-6", "recentred"), ("ccd-f64-1e-6", "as-is")):
        expect(0, *swept, method, "--doubles", doubles, says="0 contacts missed, ")
        for cell in valid("far.json")["cells"]:
            right = cell["counters"]["contacts_count"] - cell["counters"]["false_count"]
            assert cell["scene"]["doubles"]["how"] == doubles and (right == touching) == (doubles == "kept"), (cell, touching)
            assert doubles != "kept" or 0 <= cell["counters"]["gap_median"] <= cell["counters"]["gap_99_percent"] <= 1, cell
    expect(4, *swept, "ccd-1e-6", "--doubles", "kept", says="take one that is called ccd-f64-*")
    expect(3, *swept, "ccd-f64-1e-6", "--doubles", "kept", "--between", "1", says="has doubles that cannot be kept")


sys.exit(main(globals()))
