#!/usr/bin/env python3
"""Tests that bad input gives one error sentence quickly: patterns, folders of frames, JSON and empty lists."""
import lzma
import os
import pathlib
import re
import sys

from program import ALL_CASES, expect, experiment, main, run

SHEET = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
LEAF = ("collide", "--collider", "leaf", "--samples", "1", "--scene")


def test_patterns_are_read_and_matched_at_once():
    experiment("few.json", scenes=["soup:%s" % ("1" * 9)], builders=["perfect"])
    few = ("run", "few.json", "--out", "f.json")
    name, none = "soup:" + "1" * 9 + "/perfect", "is no regular expression: "
    for command, pattern, says in (
            *((few, pattern, none) for pattern in ("(" * 60_000, "[", "(?=x)", "a**")),
            *((command, "[", none) for command in (("smoke",), ("stress", "--quick"), ("accuracy", "--axis", "sums", "--out", "a"))),
            *((few, pattern, f"matches '{pattern}'") for pattern in ("(.*)*(.*)*(.*)*(.*)*x$", "(x+x+)+y", "(a|aa)+$"))):
        expect(2, *command, "--filter", pattern, says=says)
    done = run(*few, "--memory-limit", "1M", "--filter", f"^{name}$|x{{2}}")
    assert "matches" not in done.stderr and "regular" not in done.stderr, done


def frames_measured(folder: str) -> int:
    return sum(" agrees" in line for line in expect(0, *LEAF, folder, "--frames", "0:", says=f" on {folder}").splitlines())


def frames(name: str, *numbers: object) -> pathlib.Path:
    folder = pathlib.Path(name)
    folder.mkdir()
    for number in numbers:
        (folder / f"f{number}.obj").write_text(SHEET)
    return folder


def test_a_file_that_is_no_frame_does_not_spoil_a_folder_and_one_that_is_is_named():
    folder = frames("links", 1, 2)
    (folder / "other.txt").symlink_to("other.txt")  # a link to itself
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
    assert pathlib.Path("turns.csv").read_text().split() == ["frame,object_a,object_b,a,b", "0,0,0,0,2", "0,1,1,1,3",
                                                             "1,0,0,0,2", "1,1,1,1,3"]


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


def one_sentence(path: str, *words: str, codes: tuple[int, ...]) -> None:
    done = run(*words)
    assert done.returncode in codes and done.stderr.count("\n") == 1 and path in done.stderr, (words, done)
    assert not re.search("json.exception|basic_|syntax error|Expecting|Traceback|Errno", done.stderr), done.stderr
    assert len(done.stderr) < 500 and done.stderr.strip().isprintable(), done.stderr


# Commands that read a JSON file, with the exit code for one that is none, and commands that take one for a mesh.
READERS = ((("run", "FILE", "--out", "o.json"), 2), (("show", "FILE"), 3),
           (("build", "--builder", "perfect", "--scene", "soup:9", "--tuning", "FILE"), 3), (("sweep", "FILE", "--out", "o"), 2))
SCENE_READERS = (("build", "--builder", "perfect", "--scene", "FILE"), ("collide", "--collider", "leaf", "--scene", "FILE"),
                 ("tune", "sort", "--out", "t.json", "--scene", "FILE"))


def test_json_that_is_none_and_a_folder_are_a_sentence_without_the_parsers_words():
    texts = ("{", "[1, 2]", '{"format": 3}', "", "[1, 2", "7", '{"experiment": 3}', '{"experiment": "x", "scenes": [], "builders": []}',
             '{"a": \x01}', "\xff\xfe", '{"experiment": "x", "scenes": [7], "builders": ["perfect"]}', "[" * 5000, '"' + "a" * 100_000)
    for text in texts if ALL_CASES else texts[::4]:
        pathlib.Path("bad.json").write_text(text, encoding="latin-1")
        for words, code in READERS:
            one_sentence("bad.json", *(word.replace("FILE", "bad.json") for word in words), codes=(code, 2))
    pathlib.Path("folder.json").mkdir()
    pathlib.Path("cut.json.xz").write_bytes(lzma.compress(bytes(range(256)))[:60])
    for path in ("bad.json", "folder.json", "cut.json.xz", "/dev/null", "nothere.json"):
        readers = [words for words, _ in READERS if "--tuning" not in words and path != "bad.json"]
        for words in (*readers, *SCENE_READERS):
            one_sentence(path, *(word.replace("FILE", path) for word in words), codes=(2, 3))


def test_a_result_packed_by_xz_is_read_and_a_damaged_one_is_a_sentence():
    expect(0, "build", "--builder", "karras", "--scene", "soup:100", "--samples", "2", "--json", "r.json")
    packed = lzma.compress(pathlib.Path("r.json").read_bytes())
    pathlib.Path("r.json.xz").write_bytes(packed)
    assert expect(0, "show", "r.json.xz").replace("r.json.xz", "r.json") == expect(0, "show", "r.json")
    expect(0, "report", "r.json.xz", "-o", "r.html")
    assert "<h2>r</h2>" in pathlib.Path("r.html").read_text()
    large = lzma.compress(bytes(257 << 20), preset=0)
    for data, says in ((packed[:-9], "cut off or damaged"), (packed[:40] + b"!" + packed[41:], "cut off or damaged"),
                       (packed + b"more", "cut off or damaged"), (large, "cannot be unpacked: it would be larger than 256 MiB")):
        pathlib.Path("bad.json.xz").write_bytes(data)
        expect(3, "show", "bad.json.xz", says=f"bad.json.xz' {says}" if data is large else says)
    expect(2, "build", "--builder", "karras", "--scene", "soup:10", "--json", "new.json.xz", says="pack it with xz")
    assert not pathlib.Path("new.json.xz").exists()


sys.exit(main(globals()))
