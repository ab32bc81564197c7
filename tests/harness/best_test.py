#!/usr/bin/env python3
"""Tests `best` over small generated scenes: its table, its sentence, the command that it prints, its files, and what it refuses."""
import os
import pathlib
import re
import shlex
import signal
import sys

from program import KEPT, at_work, best, copied_kernels, ended, expect, main, run, valid, wait_until

FEW = ("--builders", "karras", "--orders", "morton30", "--colliders", "leaf,group")
NARROWED = ("--builders", "oibvh-multi,karras", "--orders", "morton30,hilbert30", "--colliders", "leaf,group")


def test_answers_with_a_table_a_sentence_a_command_and_files() -> None:
    said = best(0, "torus:2000", *NARROWED, "--max-samples", "5")
    assert said.startswith("pairs of neighbours, which share a vertex index, are kept: --adjacent drop leaves them out, which suits one object that "
                           "meets itself (torus:2000)\n16 candidates for 1 scene\npipeline "), said
    lines = said.splitlines()
    first = next(line for line in lines if line.startswith(("leaf over", "group over")))
    assert first.endswith("agrees") and " 1.00 " in first, said
    sentence, = (line for line in lines if line.startswith("take `"))
    assert re.match(r"take `(leaf|group)` over `(oibvh-multi|karras)`(, [a-z0-9 ]+)*: [0-9.]+ (us|ms) a frame( \(the least: .*\))?[,;.]", sentence), sentence
    again, = (line.removeprefix("again, alone: ") for line in lines if line.startswith("again, alone: "))
    assert re.search(r"\n    [0-9.]+ (us|ms) to [0-9.]+ (us|ms), (within the noise of|not) the race's, [0-9.]+ (us|ms) to", said), said
    words = shlex.split(again)
    assert words[:2] == ["bvhbench", "collide"] and f"`{words[words.index('--collider') + 1]}`" in sentence, (again, sentence)
    expect(0, *words[1:], "--samples", "1", says="verdict: agrees with CGAL boxes")
    result = valid("best.json")
    assert result["run"]["command"][1:3] == ["best", "torus:2000"] and "finished_at" in result["run"]
    cells = result["cells"]
    assert len(cells) == 16 and {cell["experiment"] for cell in cells} == {"best"}
    measured = [cell for cell in cells if cell["status"] == "measured"]
    assert measured and all(cell["check"]["verdict"] == "agrees" and cell["sampling"]["race"] == "whole" for cell in measured)
    assert all(cell["reason"].startswith("cannot win: ") for cell in cells if cell["status"] == "skipped"), cells
    assert max(len(cell["samples"]) for cell in measured) <= 5
    assert os.path.getsize("best.png") > 10000 and "written: best.json, best.png" in said
    shown = expect(0, "show", "best.json")
    assert shown.startswith(said[said.index("pipeline "):said.index("\ntake `")] + "\n" + sentence + "\n"), (shown, said)
    expect(2, "best", "torus:2000", *NARROWED, says="best.json is a result of 16 cells; --force replaces it")


def night_test_is_for_builds_queries_and_memory_too() -> None:
    said = best(0, "soup:500", "--for", "build", "--builders", "oibvh-multi,median-split", "--orders", "morton30", "--out", "b.json")
    assert said.startswith("3 candidates for 1 scene\nbuilder ") and " a build" in said, said
    again, = re.findall("again, alone: bvhbench (build .*)", said)
    expect(0, *shlex.split(again), "--samples", "1", says="verdict: agrees")
    assert {cell["operation"] for cell in valid("b.json")["cells"]} == {"build"}
    said = best(0, "soup:500", *NARROWED, "--for", "query", "--max-samples", "5", "--all", "--out", "q.json")
    assert " a query" in said and said.count(" over ") >= 16 + said.count("`") // 4 - 2, said
    said = best(0, "soup:500", *FEW, "--for", "memory", "--boxes", "f32,u8", "--out", "m.json")
    assert "u8 boxes" in said.splitlines()[3] and "counted" in said.splitlines()[3] and "at least" not in said, said
    assert {cell["status"] for cell in valid("m.json")["cells"]} == {"measured"}


def test_ranks_scenes_one_by_one_and_all_together() -> None:
    said = best(0, "torus:1000", "soup:500", *FEW, "--max-samples", "5", "--frames", "0", "--out", "two.json")
    assert re.search(r"\ntorus:1000\npipeline", said) and re.search(r"\nsoup:500\npipeline", said), said
    assert "all scenes: the geometric mean" in said and "over 2 scenes" in said and said.count("again, alone: ") == 2, said
    # Frames of a moving scene, between its objects, and a pipeline that needs no tree.
    said = best(0, "two-spheres:600:6", "--frames", "3:6", "--pairs-of", "between", "--colliders", "leaf,grid", "--builders", "karras",
                "--orders", "morton30", "--max-samples", "5", "--out", "f.json")
    numbers = {cell["scene"]["frame"] for cell in valid("f.json")["cells"] if cell["status"] == "measured"}
    assert numbers == {3, 4, 5} and "--pairs-of between --frames 3:6" in said, said


def test_a_wrong_pipeline_never_wins() -> None:
    folder = copied_kernels("wrong", "baselines/radix/apetrei_fused.cl",
                            r"at.box = merged\(at.box, (?=child_box\(leaf_boxes, ids, nodes, sibling\)\);)", "at.box = (")
    said = best(1, "torus:2000", "--builders", "apetrei-fused,karras", "--orders", "morton30", "--colliders", "leaf", "--kernels", folder,
                "--out", "wrong.json")
    assert "WRONG: torus:2000, frame 0: leaf over apetrei-fused: " in said, said
    assert "take `leaf` over `karras`" in said and "over apetrei-fused " not in said, said
    assert not run("show", "wrong.json").stdout.startswith("take"), "the file has a wrong answer"


def night_test_takes_all_frames_unless_some_are_named() -> None:
    said = best(0, *(words := ("two-spheres:600:3", *FEW, "--pairs-of", "between")), "--out", "all.json")
    assert said.startswith("two-spheres:600:3: all 3 frames; --frames a:b takes those from a to before b\n4 ") and " --frames 0:\n" in said, said
    assert {cell["scene"]["frame"] for cell in valid("all.json")["cells"]} == {0, 1, 2}
    assert "frames" not in best(0, *words, "--frames", "1", "--out", "one.json").split("candidates")[0]
    assert best(0, words[0], *FEW[:4], "--for", "build", "--out", "first.json").startswith("two-spheres:600:3: frame 0 of 3\n")


def test_refuses_before_it_measures() -> None:
    pathlib.Path("wrong.npz").write_text("no mesh")
    pathlib.Path("broken.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 9\n")
    for code, words, says in (
            (2, ["nosuch"], "no scene is called 'nosuch'"), (2, ["soup"], "ends in '' where a triangle count"), (3, ["none.obj"], "none.obj"),
            (3, ["wrong.npz"], "wrong.npz is of a format that is not read"), (2, ["--frames", "0:2"], "none is named"),
            (3, ["soup:70", "broken.obj"], "broken.obj has a triangle, 0, with vertex 8 of 2"), (2, ["soup:70", "--builders", "karas"], "karas"),
            (2, ["soup:70", "--colliders", "leaf,"], "no collider is called ''"), (2, ["soup:70", "--frames", "3:1"], "frames 3:1 are none"),
            (2, ["soup:70", "--for", "speed"], "speed"), (2, ["soup:70", "--max-samples", "4"], "4 is not from 5 to 1000000"),
            *((2, ["soup:70", "--for", "build", *words], f"{words[0]} is for pairs") for words in (
                ("--within", "1%"), ("--frames", "0:2"), ("--colliders", "leaf"))),
            (2, ["soup:70", "--within", "1%", "--features"], "choose by --pairs-of between, of vertices and faces, or within, of edges"),
            (2, ["soup:70", "--builders", "oibvh-wide4", "--boxes", "u8", "--colliders", "leaf"], "nothing can be measured: oibvh-wide4 keeps its boxes"),
            (3, ["soup:70", "--out", "no/folder.json"], "there is no folder no"), (3, ["soup:70", "--device", "nosuch"], "nosuch")):
        expect(code, "best", *words, says=says)
    expect(0, "best", "soup:70", "--builders", "karras", "--colliders", "leaf", "--within", "1%", "--features", "--pairs-of", "within",
           "--out", "edges.json", says="--pairs-of within --within 1% --features\n")
    assert not pathlib.Path("best.json").exists()
    pathlib.Path("there.png").write_text("a text")
    expect(2, "best", "soup:70", "--out", "there.json", says="there.png is there already")
    # Frames that a scene does not have are found when it is read.
    expect(4, "best", "soup:70", *NARROWED, "--frames", "2:4", says="nothing was measured: scene 'soup:70' has frames 0 to 0")


def test_stopped_keeps_the_frames_that_are_done() -> None:
    os.mkdir("made")
    words = ("cloth-ball:3000:200", "--frames", "0:", "--builders", "oibvh-multi", "--orders", "morton30", "--colliders", "leaf,group")
    with at_work("best", *words, TMPDIR=os.path.abspath("made")) as process:
        wait_until(lambda: any('"cell"' in path.read_text() for path in pathlib.Path("made").glob("bvhbench-*/result.json.journal")))
        said, errors = ended(process, signal.SIGINT)
    assert process.returncode == 130 and KEPT in errors, (process.returncode, said, errors)
    result = valid("best.json")
    assert result["cells"] and "finished_at" not in result["run"] and "take `" in said, said
    assert not list(pathlib.Path("made").iterdir())


if __name__ == "__main__":
    sys.exit(main(globals(), begin=lambda: None))
