#!/usr/bin/env python3
"""Tests `collide --within`: pairs within a distance, what cells tell, and the messages for what does not go with it."""
import itertools
import math
import pathlib
import random
import sys
from fractions import Fraction

from program import cells_after, copied_kernels, expect, experiment, main, only, valid

COLLIDE = ("collide", "--collider", "leaf", "--samples", "2", "--force", "--scene")
HEADING = "frame,object_a,object_b,a,b,distance,ax,ay,az,bx,by,bz"


def lines_of(*words: str) -> list[list[str]]:
    """Returns the values of the lines of --contacts, whose heading beside --within is HEADING."""
    expect(0, *COLLIDE, *words, "--json", "w.json", "--contacts", "w.csv")
    assert {cell["check"]["verdict"] for cell in valid("w.json")["cells"]} == {"agrees"}
    heading, *lines = pathlib.Path("w.csv").read_text().splitlines()
    assert heading == HEADING[:None if "--within" in words else HEADING.index(",distance")].replace(
        ",object_a,object_b", "" if "--features" in words else ",object_a,object_b"), heading
    return [line.split(",") for line in lines]


def dot(p: list, q: list) -> Fraction:
    return sum((x * y for x, y in zip(p, q)), Fraction(0))


def square_of(p: list, q: list, r: list) -> Fraction:
    """Returns the exact square of the distance of a triangle, which may have no area, from the origin."""
    squares = []
    for a, b in ((p, q), (q, r), (r, p)):
        side = [y - x for x, y in zip(a, b)]
        t = min(max(-dot(a, side) / (dot(side, side) or 1), 0), 1)
        squares.append(sum((x + t * y) ** 2 for x, y in zip(a, side)))
    u, v = ([y - x for x, y in zip(p, other)] for other in (q, r))
    if area := dot(u, u) * dot(v, v) - dot(u, v) ** 2:
        s, t = ((dot(p, y) * dot(x, y) - dot(p, x) * dot(y, y)) / area for x, y in ((u, v), (v, u)))
        if s >= 0 <= t and s + t <= 1:
            squares.append(sum((x + s * y + t * z) ** 2 for x, y, z in zip(p, u, v)))
    return min(squares)


def square_between(a: list, b: list) -> Fraction:
    """Returns the exact square of the distance of a vertex from a face, or of two edges, whose differences are a parallelogram."""
    ways = [[y - x for x, y in zip(p, q)] for p in a for q in b]
    return square_of(*ways) if len(a) == 1 else min(square_of(ways[0], way, ways[3]) for way in ways[1:3])


def test_features_are_those_of_exact_distances_of_each_with_each():
    dice = random.Random(1)
    frames = [[dice.choices(range(5), k=3) for _ in range(16)] for _ in range(2)]
    faces = [dice.choices(range(15), k=3) for _ in range(14)]  # some without area, some that name a vertex twice; vertex 15 is in none
    edges = sorted({(max(side), min(side)) for face in faces for side in itertools.combinations(face, 2) if len({*side}) > 1})
    pathlib.Path("few").mkdir()
    for k, points in enumerate(frames):
        pathlib.Path("few", f"{k}.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in points) +
                                                   "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))
    for pairs_of, kind, boxes, pairs in (
            ("between", "vertex-face", 30, [((v, [v]), (16 + k, face)) for v in range(16) for k, face in enumerate(faces)]),
            ("within", "edge-edge", len(edges), list(itertools.combinations(enumerate(edges), 2)))):
        squares = {(frame, a, b): square_between([points[v] for v in of_a], [points[v] for v in of_b])
                   for frame, points in enumerate(frames) for (a, of_a), (b, of_b) in pairs if not {*of_a} & {*of_b}}
        for word in ("0", "5e-324", "1", "1.4142135623730951", "1.414213562373095", "1e30"):
            right = {pair: math.sqrt(square) for pair, square in squares.items() if square <= Fraction(float(word)) ** 2}
            found = lines_of("few/", "--frames", "0:", "--within", word, "--features", "--pairs-of", pairs_of)
            assert [tuple(map(int, line[:3])) for line in found] == sorted(right) and len(found) > 5, (word, pairs_of)
            assert valid("w.json")["cells"][0]["features"] == {"pairs": kind, "primitives": boxes}, only("w.json")
            for line, far in zip(found, (right[pair] for pair in sorted(right))):
                distance, *ends = map(float, line[3:])
                assert math.isclose(distance, far, rel_tol=1e-10) and math.isclose(math.dist(ends[:3], ends[3:]), far, abs_tol=1e-14), line


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


def night_test_frames_objects_and_trees_have_theirs():
    for words in (("n-body:6100:3", "--pairs-of", "between", "--frames", "0:"), ("n-body:6100:3", "--pairs-of", "within"),
                  ("n-body:6100:3", "--pairs-of", "between", "--trees", "scene"), ("two-spheres:1200:1", "--exclude", "0,0"),
                  ("cloth-ball:2000:4", "--frames", "0:", "--update", "refit"), ("cloth-ball:2000:4", "--frames", "0:", "--force-skip", "margin"),
                  ("cloth-ball:2000:4", "--frames", "0:3", "--builder", "karras", "--boxes", "u16"),
                  ("cloth-ball:2000:4", "--frames", "1:3", "--features", "--builder", "oibvh-single", "--boxes", "u16")):
        cells = cells_after(*COLLIDE, *words, "--within", "1%")
        assert {cell["check"]["verdict"] for cell in cells} == {"agrees"} and len({cell["within_distance"] for cell in cells}) == 1, cells


def test_wrong_pairs_differ():
    for file, pattern, text in (("distance_filter.h", r"\) <= low", ") <= 4.0 * low"), ("pad.cl", r"p \+ reach", "p + 0.5f * reach")):
        copied_kernels("k", f"collide/within/{file}", pattern, text)
        for words in ((), ("--features",)):
            cells = cells_after(*COLLIDE, "two-spheres:1200:1", "--within", "2%", *words, "--kernels", "k", code=1)
            assert {cell["check"]["verdict"] for cell in cells} == {"differs"}, cells


def test_others_are_skipped_with_the_reason():
    leaf, brute = cells_after("run", experiment(
        "own.json", scenes=[{"scene": "torus:700", "features": True, "pairs_of": "within"}],
        pipelines=[{"builder": "oibvh-multi", "collider": "leaf", "within": 0.5}, {"collider": "brute", "within": 0.5}]))
    assert leaf["status"] == "measured" and leaf["within_distance"] == 0.5 and leaf["features"]["pairs"] == "edge-edge", leaf
    assert brute["status"] == "skipped" and brute["reason"].startswith("'within' pads boxes on the device"), brute


def test_what_does_not_go_with_it_is_refused_in_one_sentence():
    for words, why in ((("--narrow", "sat-f32", "--adjacent", "drop"), "'within' is about distances, and the narrow phase 'sat-f32' is not; there are: within-f64"),
                       (("--swept",), "'within' is about one moment, and swept boxes are not: there are 'features'"),
                       (("--swept", "--features"), "'features' are of one moment, and 'swept' has those between two"),
                       (("--features", "--objects", "one"), "with 'features', objects are the scene's vertices, faces and edges"),
                       (("--features", "--adjacent", "keep"), "--features leaves out pairs that share a vertex"),
                       (("--features", "--contacts", "p.csv"), "write one list each, and --features finds two"),
                       (("--first",), "'first' ends at a contact, and 'within' is about all pairs"),
                       (("--pairs", "p.csv"), "finds pairs of triangles and none of boxes: --contacts, not --pairs"),
                       (("--narrow", "exact", "--containment"), "needs all exact contacts between objects")):
        expect(2, *COLLIDE, "n-body:6100:3", "--within", "1", *words, says=why)
    expect(2, *COLLIDE, "n-body:6100:3", "--narrow", "within-f32", says="is about a distance: it needs 'within'")
    expect(2, *COLLIDE, "n-body:6100:3", "--features", says="'features' are pairs at most a distance apart: they need 'within'")
    for word in ("-1", "inf", "nan", "1e400", "one", "1%%", "%"):
        expect(2, *COLLIDE, "n-body:6100:3", f"--within={word}", says="'within' takes none, a distance, or a share")


sys.exit(main(globals()))
