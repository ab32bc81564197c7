#!/usr/bin/env python3
"""Tests that interleaved objects keep the file's triangle numbers: in pairs, contacts, hashes, trees and ground truth."""
import array
import csv
import json
import pathlib
import random
import struct
import sys

from program import cells_after, expect, main, valid

IDS = (3, 7)  # object_id of the first and of the last triangles
COUNT, LARGE = 120, 50  # triangles in all, and of the first object
chance = random.Random(5)
POINTS = [[tuple(chance.uniform(0, 4) for _ in range(3)) for _ in range(COUNT)]]  # a corner of each triangle
POINTS.append([tuple(c + chance.uniform(-.2, .2) for c in point) for point in POINTS[0]])
CORNERS = [tuple(chance.uniform(-.7, .7) for _ in range(6)) for _ in range(COUNT)]
MIXED = chance.sample(range(COUNT), COUNT)  # the triangle at each place in the file


def vertices(frame: int) -> list[tuple[float, ...]]:
    all_of_it = []
    for (x, y, z), (a, b, c, d, e, f) in zip(POINTS[frame], CORNERS):
        all_of_it += [(x, y, z), (x + a, y + b, z + c), (x + d, y + e, z + f)]
    return [struct.unpack("3f", struct.pack("3f", *point)) for point in all_of_it]


def ply(order: list[int], with_objects: bool = True) -> str:
    ids = [f" {IDS[k >= LARGE]}" if with_objects else "" for k in order]
    return "\n".join(
        ["ply", "format ascii 1.0", f"element vertex {3 * COUNT}", *(f"property float {axis}" for axis in "xyz"),
         f"element face {COUNT}", "property list uchar int vertex_indices",
         *(["property int object_id"] if with_objects else []), "end_header",
         *(" ".join(map(repr, point)) for point in vertices(0)),
         *(f"3 {3 * k} {3 * k + 1} {3 * k + 2}{of}" for k, of in zip(order, ids))]) + "\n"


def sequence(name: str, order: list[int]) -> str:
    """Writes a folder with both frames, a table of objects and one vertex that hits a face."""
    folder = pathlib.Path(name)
    folder.mkdir()
    (folder / "mesh.ply").write_text(ply(order))
    (folder / "frames.f32").write_bytes(
        array.array("f", [c for frame in (0, 1) for point in vertices(frame) for c in point]).tobytes())
    firsts = [min(order.index(k) for k in part) for part in (range(LARGE), range(LARGE, COUNT))]
    meta = {"objects": [{"name": name, "face_first": first, "face_count": count}
                        for name, first, count in zip("ab", firsts, (LARGE, COUNT - LARGE))]}
    (folder / "meta.json").write_text(json.dumps(meta))
    return name


def rows(path: str) -> list[dict[str, int]]:
    with open(path, newline="") as file:
        return [{key: int(value) for key, value in row.items()} for row in csv.DictReader(file)]


def by_triangle(found: list[dict[str, int]], order: list[int]) -> list[tuple]:
    """Returns the rows' triangles and objects, numbered as in the unmixed scene."""
    mapped = []
    for row in found:
        ends = sorted([(order[row["a"]], row["object_a"]), (order[row["b"]], row["object_b"])])
        assert all(of == IDS[k >= LARGE] for k, of in ends), row
        mapped.append((row["frame"], *ends))
    return sorted(mapped)


def fnv(pairs: list[tuple[int, int]]) -> str:
    value = 1469598103934665603
    for pair in pairs:
        for byte in struct.pack("<2I", *pair):
            value = (value ^ byte) * 1099511628211 % 2**64
    return f"{value:016x}"


def test_pairs_and_contacts_of_all_frames_are_those_of_the_same_scene_in_order():
    plain, mixed = list(range(COUNT)), MIXED
    for name, order in (("plain", plain), ("mixed", mixed)):
        sequence(name, order)
    wanted = {}
    for collider, builder, among in (("leaf", "oibvh-multi", "all"), ("group", "karras", "between"), ("grid", "perfect", "within"),
                                     ("bvtt", "apetrei-fused", "between")):
        for name, order in (("plain", plain), ("mixed", mixed)):
            expect(0, "collide", "--scene", name, "--collider", collider, "--builder", builder, "--pairs-of", among,
                   "--frames", "0:", "--narrow", "exact", "--samples", "1", "--json", "r.json", "--pairs", "p.csv",
                   "--contacts", "k.csv", "--force")
            cells = valid("r.json")["cells"]
            assert [cell["scene"]["frame"] for cell in cells] == [0, 1] and all(cell["scene"]["objects"] == 2 for cell in cells)
            for kind, path in (("pairs", "p.csv"), ("contacts", "k.csv")):
                found = rows(path)
                assert list(found[0]) == ["frame", "object_a", "object_b", "a", "b"], found[0]
                for cell in cells:
                    pairs = [(row["a"], row["b"]) for row in found if row["frame"] == cell["scene"]["frame"]]
                    assert pairs == sorted(pairs) and len(pairs) == cell["counters"][f"{kind}_count"] > 3, (name, kind, pairs)
                    assert fnv(pairs) == cell["check"][f"{kind}_hash"], (name, collider, kind)
                same = by_triangle(found, order)
                assert wanted.setdefault((among, kind), same) == same, (name, collider, kind)
    assert set(wanted["all", "pairs"]) == {*wanted["between", "pairs"], *wanted["within", "pairs"]}


def test_a_file_is_grouped_as_a_sequence_is_and_bin_has_one_frame():
    pathlib.Path("mixed.ply").write_text(ply(MIXED))
    common = ("collide", "--scene", "mixed.ply", "--collider", "leaf", "--samples", "1")
    expect(0, *common, "--pairs-of", "between", "--pairs", "file.csv")
    expect(0, *common, "--pairs-of", "between", "--pairs", "file.bin")
    words = array.array("I", pathlib.Path("file.bin").read_bytes())
    assert list(zip(words[::2], words[1::2])) == [(row["a"], row["b"]) for row in rows("file.csv")]
    by_triangle(rows("file.csv"), MIXED)
    for frames in ("0:", "0:2"):
        expect(2, "collide", "--scene", "mixed", "--collider", "leaf", "--frames", frames, "--pairs", "b.bin", says="several frames")
    expect(0, "collide", "--scene", "mixed", "--collider", "leaf", "--frames", "1", "--samples", "1", "--pairs", "one.bin")
    assert not pathlib.Path("b.bin").exists()


def test_what_takes_all_triangles_as_one_object_takes_them_in_the_order_of_the_file():
    pathlib.Path("without.ply").write_text(ply(MIXED, with_objects=False))
    hashes = []
    for scene in ("mixed.ply", "without.ply"):
        expect(0, "build", "--builder", "oibvh-multi", "--scene", scene, "--samples", "1", "--json", "t.json", "--dump", "t.dump",
               "--force")
        hashes.append(valid("t.json")["cells"][0]["check"]["tree_hash"])
        points = vertices(0)
        leaves = [node for node in json.loads(pathlib.Path("t.dump").read_text())["nodes"] if node["primitive"] >= 0]
        assert sorted(leaf["primitive"] for leaf in leaves) == list(range(COUNT))
        for leaf in leaves:
            k = MIXED[leaf["primitive"]]
            corners = list(zip(*points[3 * k:3 * k + 3]))
            for side, most in (("min", min), ("max", max)):
                assert list(struct.unpack("3f", struct.pack("3f", *leaf["box"][side]))) == list(map(most, corners)), leaf
        cell, = cells_after("collide", "--scene", scene, "--objects", "one", "--collider", "leaf", "--samples", "1")
        hashes.append(cell["check"]["pairs_hash"])
    assert hashes[:2] == hashes[2:], hashes


def test_ground_truth_and_swept_pairs_have_the_numbers_of_the_file():
    swept = ("collide", "--scene", "mixed", "--collider", "leaf", "--swept", "--pairs-of", "between", "--samples", "1",
             "--json", "s.json", "--force")
    expect(0, *swept, "--pairs", "v.csv")
    found = rows("v.csv")
    assert list(found[0]) == ["frame", "a", "b"] and len(found) == valid("s.json")["cells"][0]["counters"]["pairs_count"]
    hits = {(row["a"], MIXED[row["b"] - 3 * COUNT]) for row in found}
    for vertex, k in hits:  # the swept boxes do overlap
        ways = [list(zip(*(vertices(frame)[at] for frame in (0, 1) for at in places))) for places in ([vertex], range(3 * k, 3 * k + 3))]
        assert all(min(a) <= max(b) and min(b) <= max(a) for a, b in zip(*ways)), (vertex, k)
    vertex, face = found[0]["a"], found[0]["b"] - 3 * COUNT
    pathlib.Path("mixed/gt_vf.csv").write_text(f"{vertex},{face},1\n")
    expect(0, *swept)
    assert valid("s.json")["cells"][0]["counters"]["ground_truth_missed"] == 0
    other = next(k for k in range(COUNT) if (vertex, MIXED[k]) not in hits)
    pathlib.Path("mixed/gt_vf.csv").write_text(f"{vertex},{other},1\n")
    assert "1 pairs of the ground truth are missed" in expect(1, *swept)


def test_a_table_of_objects_is_held_to_the_file():
    meta = json.loads(pathlib.Path("mixed/meta.json").read_text())
    meta["objects"][1]["face_first"] += 1
    pathlib.Path("mixed/meta.json").write_text(json.dumps(meta))
    expect(3, "collide", "--scene", "mixed", "--collider", "leaf", says="meta.json has an object, 'b', over 70 triangles from ")


sys.exit(main(globals()))
