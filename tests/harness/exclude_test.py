#!/usr/bin/env python3
"""Tests `collide --exclude`: which pairs of objects are left out, what cells tell, and the messages for wrong words."""
import csv
import itertools
import pathlib
import sys

from program import ALL_CASES, cells_after, expect, experiment, main, only

LINKS = ("base", "upper_arm", "lower", "hand")
COLLIDE = ("collide", "--scene", "arm.obj", "--samples", "1", "--force")
FOUND = ("--json", "f.json", "--pairs", "f.csv")


def write_arm() -> None:
    """Writes four objects of two triangles each, all of whose boxes overlap."""
    lines = []
    for k, name in enumerate(LINKS):
        lines += [f"o {name}", f"v 0 0 {k / 10}", f"v 1 0 {k / 10 + 1}", f"v 0 1 {k / 10}", f"v 1 1 {k / 10 + 1}"]
        lines += [f"f {4 * k + 1} {4 * k + 2} {4 * k + 3}", f"f {4 * k + 2} {4 * k + 4} {4 * k + 3}"]
    pathlib.Path("arm.obj").write_text("\n".join(lines) + "\n")


def objects_found(*words: str, collider: str = "leaf") -> set[tuple[int, int]]:
    expect(0, *COLLIDE, "--collider", collider, *words, *FOUND, says="verdict: agrees")
    with open("f.csv", newline="") as file:
        return {tuple(sorted((int(row["object_a"]), int(row["object_b"])))) for row in csv.DictReader(file)}


ALL = set(itertools.combinations_with_replacement(range(len(LINKS)), 2))


def test_pairs_of_excluded_objects_are_not_in_the_answer():
    write_arm()
    for collider in ("leaf", "group", "block", "bvtt", "brute") if ALL_CASES else ("group", "bvtt"):
        assert objects_found(collider=collider) == ALL
        assert objects_found("--exclude", "base,upper_arm", "--exclude", "3, 2", collider=collider) == ALL - {(0, 1), (2, 3)}
        assert objects_found("--exclude", "1,1;hand,base", collider=collider) == ALL - {(1, 1), (0, 3)}
    scene = only("f.json")["scene"]
    assert scene["exclude"] == "1,1; hand,base" and len(scene["filter_hash"]) == 16, scene
    assert objects_found("--exclude", "0,1", "--exclude", "none") == ALL
    assert "exclude" not in only("f.json")["scene"] and "filter_hash" not in only("f.json")["scene"]
    assert objects_found("--exclude", "0,1", "--pairs-of", "between") == {(a, b) for a, b in ALL if a != b} - {(0, 1)}
    assert objects_found("--exclude", "2,2", "--pairs-of", "within", collider="bvtt") == {(0, 0), (1, 1), (3, 3)}


def test_contacts_are_of_the_same_objects():
    write_arm()
    cell, = cells_after(*COLLIDE, "--collider", "leaf", "--narrow", "exact", "--exclude", "0,1", says="CGAL")
    assert cell["check"]["verdict"] == "agrees"


def test_a_file_has_pairs_groups_and_masks():
    write_arm()
    pathlib.Path("arm.filter").write_text("# the arm\n\nexclude base 1  # neighbours\ngroup hand 2 0xfffffffd\n"
                                          "group lower 0x2 1\ngroup 0 1 4294967295\n")
    assert objects_found("--exclude", "@arm.filter") == ALL - {(0, 1), (2, 3)}  # hand and lower do not accept each other
    hashes = [only("f.json")["scene"]["filter_hash"]]
    pathlib.Path("arm.filter").write_text("exclude base 1\n")
    assert objects_found("--exclude", "@arm.filter") == ALL - {(0, 1)}
    hashes.append(only("f.json")["scene"]["filter_hash"])
    assert objects_found("--exclude", "0,1") == ALL - {(0, 1)}
    assert hashes[0] != hashes[1] == only("f.json")["scene"]["filter_hash"]


def test_experiments_have_the_same_key():
    write_arm()
    leaf, grid = cells_after("run", experiment("own.json", scenes=[{"scene": "arm.obj", "exclude": "0,1; 2,3"}], pipelines=[
        {"builder": "oibvh-multi", "collider": ["leaf", "grid"]}]))
    assert leaf["status"] == "measured" and leaf["scene"]["exclude"] == "0,1; 2,3", leaf
    assert grid["status"] == "skipped" and "leaf, bvtt, group, block, brute" in grid["reason"], grid


def test_wrong_words_are_refused_in_one_sentence():
    write_arm()
    leaf = (*COLLIDE, "--collider", "leaf")
    for word in ("base", "base,", ",", "a,b,c", "@"):
        expect(2, *leaf, "--exclude", word, says=f"'exclude' takes none, a pair of objects A,B or @FILE, not '{word}'")
    there = "scene 'arm.obj' has no object '{}'; it has 4: 0 'base', 1 'upper_arm', 2 'lower', 3 'hand'"
    for name in ("4", "foot"):
        expect(2, *leaf, "--exclude", f"base,{name}", says=f"'exclude' base,{name}: " + there.format(name))
    for line, why in (("exclude base", "a line is 'exclude A B' or 'group A WORD MASK', of 32 bits, not 'exclude base'"),
                      ("group base 1 4294967296", "a line is 'exclude A B'"), ("group base x 1", "a line is 'exclude A B'"),
                      ("exclude base foot", there.format("foot"))):
        pathlib.Path("wrong.filter").write_text(f"exclude 0 1\n{line}\n")
        expect(2, *leaf, "--exclude", "@wrong.filter", says=f"wrong.filter:2: {why}")
    expect(3, *leaf, "--exclude", "@no.filter", says="the filter file 'no.filter' cannot be read")
    expect(2, *leaf, "--exclude", "0,1", "--swept", says="swept, objects are the scene's vertices, faces and edges")
    expect(2, *leaf, "--exclude", "0,1", "--narrow", "exact", "--containment", says="without --swept, --exclude, --first, --within and")
    lines = pathlib.Path("arm.obj").read_text().replace("o hand", "o base")
    pathlib.Path("arm.obj").write_text(lines)
    expect(2, *leaf, "--exclude", "base,1", says="2 objects of scene 'arm.obj' are called 'base': give the number of one")


def test_what_cannot_filter_says_so():
    write_arm()
    for words, why in ((("--collider", "grid"), "finds pairs of all objects; these leave out what 'exclude' names: leaf, bvtt"),
                       (("--collider", "leaf", "--trees", "scene"), "with 'exclude' 'trees' is object"),
                       (("--collider", "leaf", "--no-skip", "apart"), "where the rule 'apart' is, which therefore cannot be switched")):
        expect(4, *COLLIDE, *words, "--exclude", "0,1", says=why)


sys.exit(main(globals()))
