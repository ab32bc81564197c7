#!/usr/bin/env python3
"""Tests that an impossible cell says why, that a run without measurements exits with 4, and that signals end the program."""
import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import time

from program import ALL_CASES, KEPT, PATIENCE_S, PROGRAM, SOURCE, at_work, children, ended, expect, experiment, main, ours, valid, wait_until

LEAF = ("collide", "--collider", "leaf")


def cells_of(path: str) -> list[tuple[str, str, str]]:
    """Returns scene, status and reason of the cells of a finished run."""
    result = valid(path)
    assert "finished_at" in result["run"], path
    return [(cell["scene"]["name"], cell["status"], cell.get("reason", "")) for cell in result["cells"]]


def test_a_scene_that_is_not_there_is_a_cell_and_the_next_is_measured():
    plan = experiment("scenes.json", scenes=["soup:10", "nonsense", "gone.obj", "torus:5e", "soup:20"], builders=["perfect"])
    expect(0, "run", plan, "--out", "scenes-out.json", says="5 cells, 2 agree")
    cells = cells_of("scenes-out.json")
    assert [cell[1] for cell in cells] == ["measured", "skipped", "skipped", "skipped", "measured"], cells
    for (scene, _, reason), says in zip(cells[1:4], ("no scene is called 'nonsense'", "gone.obj", "torus:5e")):
        assert says in reason, (scene, reason)


def test_what_a_scene_builder_or_collider_has_not_is_a_cell():
    leaf = {"builder": "perfect", "collider": "leaf"}
    refused = {
        "a group size is a power of two": {"builder": {"name": "karras", "group_size": 65536}, "collider": "leaf"},
        "the number of items": {"builder": {"name": "oibvh-multi", "items": 3}, "collider": "leaf"},
        "bvtt jumps at most": {"builder": "perfect", "collider": {"name": "bvtt", "jump": 30}},
        "bvtt starts on level": {"builder": "perfect", "collider": {"name": "bvtt", "start_level": 32}},
        "a collider's group size is": {"builder": "perfect", "collider": {"name": "leaf", "group_size": 65536}},
        "front-leaf needs a binary tree": {"builder": "oibvh-wide4", "collider": "front-leaf"},
        "order kd lines up one object, not 2": {"builder": {"name": "perfect", "order": "kd"}, "collider": "leaf"}}
    places = {"has frames 0 to 0, not 7": {"frames": "7:9"}, "has no meshes": {"objects": "mesh"}, "has one frame": {"between": 2},
              "need two frames": {"swept": True}}
    for sentences, plan in (
            (refused, experiment("options.json", scenes=["two-spheres:200:2"], pipelines=[*refused.values(), leaf])),
            (places, experiment("places.json", pipelines=[leaf],
                                scenes=[*({"scene": "soup:100", **place} for place in places.values()), "soup:100"]))):
        expect(0, "run", plan, "--out", "out.json", "--force")
        cells = cells_of("out.json")
        assert [cell[1] for cell in cells] == ["skipped"] * len(sentences) + ["measured"], cells
        for cell, says in zip(cells, sentences):
            assert says in cell[2], (cell, says)


def night_test_an_oracle_that_hangs_fails_the_cells_that_need_it():
    pipelines = [{"builder": "perfect", "collider": name, "narrow": narrow}
                 for name, narrow in (("leaf", "exact"), ("leaf", "none"), ("group", "exact"))]
    scenes = ["soup:100", "soup:200"] if ALL_CASES else ["soup:100"]
    plan = experiment("oracle.json", scenes=scenes, pipelines=pipelines)
    expect(0, "run", plan, "--out", "compiled.json")
    expect(0, "run", plan, "--out", "oracle-out.json", "--time-limit", "5", BVHBENCH_STOP="contacts:0",
           says=f"{3 * len(scenes)} cells, {len(scenes)} agree")
    late = "the oracle of contacts took longer than 5 s and was ended; --time-limit gives it more"
    cells = cells_of("oracle-out.json")
    assert [cell[1:] for cell in cells] == len(scenes) * [("failed", late), ("measured", ""), ("failed", late)], cells


def test_collide_and_accuracy_go_on_after_a_scene_that_is_not_there():
    expect(0, *LEAF, "--scene", "soup:10", "nonsense", "soup:20", "--samples", "1", "--json", "collide.json")
    assert [cell[:2] for cell in cells_of("collide.json")] == [("soup:10", "measured"), ("nonsense", "skipped"), ("soup:20", "measured")]
    for axis in ("sums", "swept"):
        expect(0, "accuracy", "--axis", axis, "--scene", "nonsense", "--scene", "torus:100", "--samples", "3", "--out", ".",
               says="no scene is called 'nonsense'")
        ends = {cell[:2] for cell in cells_of(f"accuracy-{axis}.json")}
        assert {scene.removeprefix("bend:") for scene, status in ends if status == "measured"} == {"torus:100"}, ends
        assert ("nonsense", "skipped") in ends, ends


def test_what_measured_nothing_ends_with_4_and_says_why():
    nothing = experiment("nothing.json", scenes=["nonsense", "gone.obj"], builders=["perfect"])
    why = "nothing was measured: "
    out = expect(4, "run", nothing, "--out", "nothing-out.json", says="or a path to a mesh file (the first of 2 cells)")
    assert out.endswith("written: nothing-out.json\n") and len(cells_of("nothing-out.json")) == 2, out
    refused = ("--builder", "karras", "--group-size", "65536", "--scene", "soup:10", "--samples", "1", "--json")
    pathlib.Path("no-kernels").mkdir()
    broken = ("--kernels", "no-kernels")
    for says, words in ((f"{why}a group size is a power of two", ("build", *refused, "build-refused.json")),
                        (f"{why}a collider's", (*LEAF, *refused, "collide-refused.json")),
                        (f"{why}no scene is called", ("accuracy", "--axis", "sums", "--scene", "nonsense", "--out", "none")),
                        (why, ("sweep", "--scenes", "gone.obj", "--builders", "perfect", "--out", "sweep")),
                        ("nothing was checked: kernel", ("check", "--builder", "perfect", "--scene", "torus:300", *broken))):
        expect(4, *words, says=says)
    for path in ("build-refused.json", "collide-refused.json", "sweep/sweep.json"):
        assert [cell[1] for cell in cells_of(path)] == ["skipped"], path
    if ALL_CASES:
        expect(4, "reproduce", "table1", "--quick", "--out", "table", *broken, says=f"{why}kernel source")
        assert {cell[1] for cell in cells_of("table/table1.json")} <= {"skipped", "failed"}


def test_what_cannot_even_begin_ends_with_2_or_3_and_writes_nothing():
    one = ("build", "--builder", "perfect", "--samples", "1", "--json", "none.json", "--scene")
    unknown = experiment("unknown.json", scenes=["soup:10"], builders=["karas"])
    more = experiment("keys.json", scenes=["soup:10"], builders=["perfect"], sample=3)
    part = {"scenes": ["soup:10"], "builders": ["perfect"]}
    pathlib.Path("twice.json").write_text(json.dumps({"experiment": "twice", "parts": [part, part]}))
    pathlib.Path("parts.json").write_text(json.dumps({"experiment": "parts", "parts": [part]}))
    for code, says, words in ((2, "two parts of the plan are the same", ("run", "twice.json", "--out", "none.json")),
                              (2, "--turns is for an experiment", ("run", "parts.json", "--turns", "t:2", "--out", "none.json")),
                              (2, "--only is i/n", ("run", "parts.json", "--only", "2/1", "--out", "none.json")),
                              (2, "parts has fewer than 2 scenes", ("run", "parts.json", "--only", "2/2", "--out", "none.json")),
                              (2, "need --resume", ("run", "parts.json", "--retry-failed", "--out", "none.json")),
                              (2, "no scene is called 'nonsense'", (*one, "nonsense")), (3, "gone.obj", (*one, "gone.obj")),
                              (2, "has frames 0 to 0", (*LEAF, "--json", "none.json", "--scene", "soup:10", "--frames", "7")),
                              (2, "karas", ("run", unknown, "--out", "none.json")), (2, "sample", ("run", more, "--out", "none.json")),
                              (2, "--filter: no cell of stress matches 'zzz'",
                               ("stress", "--quick", "--filter", "zzz", "--out", "none.json"))):
        expect(code, *words, says=says)
    assert not pathlib.Path("none.json").exists()


def ends_at_once(process: subprocess.Popen, sent: signal.Signals = signal.SIGTERM) -> str:
    """Sends a signal to a working process and returns its standard error. No child process may remain."""
    _, error = ended(process, sent)  # the work itself would take minutes
    assert process.returncode == 128 + sent, (process.args, process.returncode, error)
    assert "bvhbench: stopped" in error.splitlines()[-1], (process.args, error)  # a driver may have begun the line
    wait_until(lambda: not ours())
    return error


def begun(*scenes: str, **keys) -> tuple[str, ...]:
    """Returns the words of a run whose first cell finishes soon and whose second does not."""
    pathlib.Path("signals.json").unlink(missing_ok=True)
    return ("run", experiment("signals-plan.json", scenes=["soup:10", *scenes], **{"builders": ["perfect"], **keys}), "--out",
            "signals.json")


def test_a_signal_ends_what_reads_generates_judges_and_measures_and_keeps_what_is_done():
    pathlib.Path("large.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + b"f 1 2 3\n" * 3_000_000)
    simulated, journal = "cloth-dress:20000:60", pathlib.Path("signals.json.journal")
    oracle = {"pipelines": [{"builder": "perfect", "collider": "leaf", "narrow": "exact"}]}
    for sent, seconds, scene, keys in ((signal.SIGTERM, 0.2, "large.obj", {}), (signal.SIGINT, 0.2, simulated, {}),
                                       (signal.SIGHUP, 0.2, simulated, {}), (signal.SIGTERM, 1, "hairball:200000", oracle),
                                       (signal.SIGTERM, 1, "hairball:500000", {"quality": True})):
        with at_work(*begun(scene, **keys)) as process:
            wait_until(lambda: journal.exists() and '"cell"' in journal.read_text())
            time.sleep(seconds)  # only chooses where the signal strikes
            assert ends_at_once(process, sent) == KEPT
        result = valid("signals.json")
        assert [cell["status"] for cell in result["cells"]] == ["measured"] and "finished_at" not in result["run"], result["run"]


def night_test_a_signal_ends_what_compiles_samples_checks_and_draws():
    shutil.copytree(SOURCE / "plots", "home/plots")
    pathlib.Path("home/plots/figures/catalog.py").write_text("import pathlib\nimport time\npathlib.Path('begun').touch()\ntime.sleep(600)\n")
    compiled = (*LEAF[:2], "bvtt", "--builder", "oibvh-multi", "--narrow", "exact", "--scene", "soup:3000", "--samples", "1000000")
    for seconds, words in (*((after, compiled) for after in (0.3, 0.7, 1.1)),
                           (1.5, begun(samples=1000000)), (1, ("build", "--builder", "perfect", "--scene", "cloth-dress:20000:60")),
                           (1.5, ("check",)), (1.5, ("accuracy", "--axis", "narrow", "--out", "stopped")), (1.5, ("stress", "--quick")),
                           (1.5, ("plot", "scenes-out.json", "--out", "drawn"))):
        cold = {"XDG_CACHE_HOME": os.path.abspath(f"cold-{seconds}"), "POCL_CACHE_DIR": ""} if words == compiled else {}
        with at_work(*words, BVHBENCH_HOME=os.path.abspath("home"), **cold) as process:
            wait_until(lambda: pathlib.Path("begun").exists() if words[0] == "plot" else children(process.pid))
            time.sleep(seconds)  # only chooses where the signal strikes
            error = ends_at_once(process)
            assert words[0] != "build" or error == "bvhbench: stopped\n"  # there is no file to keep cells in


def test_a_stopped_search_keeps_what_it_has_found():
    own, terminal = pty.openpty()  # on which alone it tells how far it is
    with subprocess.Popen([PROGRAM, "tune", "oibvh-multi", "--scene", "torus:20000", "--samples", "2000", "--out", "stopped.json"],
                          stdout=subprocess.PIPE, stderr=terminal, text=True) as process, os.fdopen(own, "rb", buffering=0) as shown:
        os.close(terminal)
        error = b""
        while b"tune: oibvh-multi, " not in error:
            error += shown.read(4096)
        out, _ = ended(process, signal.SIGINT)
        error += shown.read(4096)
    assert process.returncode == 130 and b"stopped" in error, (process.returncode, error)
    assert out.startswith("tuned: oibvh-multi over torus:20000"), out
    assert json.loads(pathlib.Path("stopped.json").read_text())["format"] == "tuning 1"


def test_under_nohup_a_run_goes_on_after_the_terminal_is_gone():
    with subprocess.Popen(["nohup", PROGRAM, *begun(samples=200)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        wait_until(lambda: children(process.pid))
        process.send_signal(signal.SIGHUP)
        assert process.wait(PATIENCE_S) == 0, process.returncode
    assert cells_of("signals.json") == [("soup:10", "measured", "")]


sys.exit(main(globals()))
