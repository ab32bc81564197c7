#!/usr/bin/env python3
"""Hold the program to one sentence, soon, for what a user gives it: patterns, folders of frames, JSON, and lists of nothing.

Usage: inputs_test.py <bvhbench> <result schema>
"""
import os
import pathlib
import sys
import time

from program import expect, main, run

SHEET = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
LEAF = ("collide", "--collider", "leaf", "--samples", "1", "--scene")


def test_patterns_are_read_and_matched_at_once():
    pathlib.Path("few.json").write_text('{"experiment": "few", "scenes": ["soup:%s"], "builders": ["perfect"]}' % ("1" * 9))
    for command in (("run", "few.json", "--out", "f.json"), ("smoke",), ("stress", "--quick"), ("accuracy", "--axis", "sums", "--out", "a")):
        for pattern in ("(" * 60_000, "[", "(?=x)", "a**"):
            started = time.monotonic()
            expect(2, *command, "--filter", pattern, says="is no regular expression: ")
            assert time.monotonic() - started < 20, (command, pattern[:9])
    name = "soup:" + "1" * 9 + "/perfect"
    for pattern in ("(.*)*(.*)*(.*)*(.*)*x$", "(x+x+)+y", "(a|aa)+$"):
        started = time.monotonic()
        expect(2, "run", "few.json", "--out", "f.json", "--filter", pattern, says=f"matches '{pattern}'")
        assert time.monotonic() - started < 20, pattern
    done = run("run", "few.json", "--out", "f.json", "--memory-limit", "1M", "--filter", f"^{name}$|x{{2}}")
    assert "matches" not in done.stderr and "regular" not in done.stderr, done


def frames_measured(folder: str) -> int:
    return sum(line.startswith(folder) for line in expect(0, *LEAF, folder, "--frames", "0:").splitlines())


def frames(name: str, *numbers: object) -> pathlib.Path:
    folder = pathlib.Path(name)
    folder.mkdir()
    for number in numbers:
        (folder / f"f{number}.obj").write_text(SHEET)
    return folder


def test_a_file_that_is_no_frame_does_not_spoil_a_folder_and_one_that_is_is_named():
    folder = frames("links", 1, 2)
    (folder / "other.txt").symlink_to("other.txt")  # to themselves
    (folder / "other.obj").symlink_to("other.obj")
    (folder / "f3.obj").mkdir()
    assert frames_measured("links/") == 2
    (folder / "f4.obj").symlink_to("f4.obj")
    expect(3, *LEAF, "links/", says="links/f4.obj cannot be read: Too many levels of symbolic links")
    (folder / "f4.obj").unlink()
    (folder / "f5.obj").symlink_to("nowhere")
    expect(3, *LEAF, "links/", says="there is no file links/f5.obj")
    expect(3, *LEAF, "links/f4.obj", says="there is no file links/f4.obj")
    (folder / "mesh.ply").symlink_to("mesh.ply")
    expect(3, *LEAF, "links/", says="links/mesh.ply cannot be read: Too many levels of symbolic links")


def test_a_frame_number_that_is_too_large_is_named():
    frames("numbers", 7, 2**63 - 1)
    assert frames_measured("numbers/") == 2
    pathlib.Path("numbers", f"f{2**63}.obj").write_text(SHEET)
    expect(3, *LEAF, "numbers/", says=f"numbers/f{2**63}.obj has a frame number above 2^63 - 1")


def test_connected_parts_of_frames_are_objects_wherever_their_triangles_are():
    two = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    folder = frames("turns")
    for number in (1, 2):
        (folder / f"{number}.obj").write_text(two + "f 1 2 3\nf 5 6 7\nf 1 3 4\nf 5 7 8\n")
    expect(0, *LEAF, "turns/", "--frames", "0:", "--pairs-of", "within", "--pairs", "turns.csv")
    assert pathlib.Path("turns.csv").read_text().split() == ["frame,object_a,object_b,a,b", "0,0,0,0,2", "0,1,1,1,3", "1,0,0,0,2", "1,1,1,1,3"]


def test_a_list_of_nothing_is_refused():
    expect(2, *LEAF, "torus:50", "--pairs-of", "between", says="'torus:50' is one object, and there are no pairs between objects")
    expect(2, *LEAF, "n-body:610:1", "--objects", "one", "--pairs-of", "between", says="is one object")
    expect(2, *LEAF, "torus:50", "soup:9", "--pairs", "two.csv", says="--pairs and --contacts write those of one scene, and there are 2")
    if "built without" not in next(line for line in expect(0, "list", "colliders").splitlines() if line.startswith("fcl ")):
        expect(2, "collide", "--collider", "fcl", "--scene", "soup:9", "--pairs", "fcl.csv", says="--contacts, not --pairs")
        expect(0, "collide", "--collider", "fcl", "--scene", "soup:90", "--samples", "1", "--adjacent", "drop", "--contacts", "fcl.csv")
        assert pathlib.Path("fcl.csv").read_text().count("\n") > 1
    expect(3, *LEAF, "torus:50", "--pairs", "nonexist/p.csv", says="nonexist/p.csv cannot be written: there is no folder nonexist")
    assert not os.path.exists("nonexist") and not os.path.exists("two.csv")


def test_json_that_is_none_is_a_sentence_without_the_parsers_words():
    texts = ("{", "", "[1, 2", '{"experiment": 3}', '{"experiment": "x", "scenes": [], "builders": []}', '{"a": \x01}', "\xff\xfe",
             '{"experiment": "x", "scenes": [7], "builders": ["perfect"]}', "[" * 5000, '"' + "a" * 100_000)
    for k, text in enumerate(texts):
        pathlib.Path("bad.json").write_text(text, encoding="latin-1")
        for words, code in ((("run", "bad.json", "--out", "o.json"), 2), (("sweep", "bad.json", "--out", "o"), 2),
                            (("show", "bad.json"), 3), (("compare", "bad.json", "bad.json"), 3), (("merge", "bad.json", "-o", "m.json"), 3),
                            (("build", "--builder", "perfect", "--scene", "soup:9", "--tuning", "bad.json"), 3),
                            (("smoke", "--baseline", "bad.json"), 3)):
            if words[0] == "smoke" and k > 3:
                continue  # it takes its time: the device is opened first
            done = run(*words)
            assert done.returncode in (code, 2) and done.stderr.count("\n") == 1, (words, text[:20], done)
            assert "json.exception" not in done.stderr and len(done.stderr) < 500 and done.stderr.strip().isprintable(), done.stderr
            assert "bad.json" in done.stderr, (words, done.stderr)


def test_a_folder_in_the_place_of_a_file_is_a_sentence():
    pathlib.Path("folder.json").mkdir()
    for words in (("show", "folder.json"), ("run", "folder.json"), ("compare", "folder.json", "folder.json"),
                  ("sweep", "folder.json", "--out", "o"), ("merge", "folder.json", "-o", "m.json"), ("smoke", "--baseline", "folder.json")):
        done = run(*words)
        assert done.returncode in (2, 3) and "folder.json" in done.stderr and "basic_" not in done.stderr, (words, done)


if __name__ == "__main__":
    sys.exit(main(globals()))
