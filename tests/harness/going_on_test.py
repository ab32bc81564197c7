#!/usr/bin/env python3
"""What cannot be measured is a cell that says so, what measured nothing ends with 4, and a signal ends what is at work.

Usage: going_on_test.py <bvhbench> <result schema>
"""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

from program import PROGRAM, SCHEMA, expect, main, run, valid

AT_ONCE_S = 2  # 0.05 where nothing else runs; generous, for machines that are busy


def experiment(path: str, **keys) -> str:
    pathlib.Path(path).write_text(json.dumps({"experiment": "on", "question": "?", "samples": 1, "warm_up": 0, **keys}))
    return path


def cells_of(path: str) -> list[tuple[str, str, str]]:
    """Scene, status and reason of the cells of a run that came to its end."""
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
        "block needs a binary implicit tree": {"builder": "karras", "collider": "block"},
        "order kd lines up one object, not 2": {"builder": {"name": "perfect", "order": "kd"}, "collider": "leaf"}}
    plan = experiment("options.json", scenes=["two-spheres:200:2"], pipelines=[*refused.values(), leaf])
    expect(0, "run", plan, "--out", "options-out.json")
    cells = cells_of("options-out.json")
    assert [cell[1] for cell in cells] == ["skipped"] * len(refused) + ["measured"], cells
    for cell, says in zip(cells, refused):
        assert cell[2].startswith(says), (cell, says)

    plan = experiment("places.json", pipelines=[leaf], scenes=[
        {"scene": "soup:100", "frames": "7:9"}, {"scene": "soup:100", "objects": "mesh"}, {"scene": "soup:100", "between": 2},
        {"scene": "soup:100", "swept": True}, "soup:100"])
    expect(0, "run", plan, "--out", "places-out.json")
    cells = cells_of("places-out.json")
    assert [cell[1] for cell in cells] == ["skipped"] * 4 + ["measured"], cells
    for cell, says in zip(cells, ("has frames 0 to 0, not 7", "has no meshes", "has one frame", "need two frames")):
        assert says in cell[2], (cell, says)


def test_collide_and_accuracy_go_on_after_a_scene_that_is_not_there():
    expect(0, "collide", "--collider", "leaf", "--scene", "soup:10", "--scene", "nonsense", "--scene", "soup:20", "--samples", "1",
           "--json", "collide.json")
    assert [cell[:2] for cell in cells_of("collide.json")] == [("soup:10", "measured"), ("nonsense", "skipped"),
                                                               ("soup:20", "measured")]
    for axis in ("sums", "swept"):
        expect(0, "accuracy", "--axis", axis, "--scene", "nonsense", "--scene", "torus:100", "--samples", "3", "--out", ".",
               says="no scene is called 'nonsense'")
        ends = {cell[:2] for cell in cells_of(f"accuracy-{axis}.json")}
        assert {scene.removeprefix("bend:") for scene, status in ends if status == "measured"} == {"torus:100"}, ends
        assert ("nonsense", "skipped") in ends, ends


def test_what_measured_nothing_ends_with_4_and_says_why():
    nothing = experiment("nothing.json", scenes=["nonsense", "gone.obj"], builders=["perfect"])
    why = "nothing was measured: no scene is called 'nonsense'"
    out = expect(4, "run", nothing, "--out", "nothing-out.json", says="or a path to a mesh file (the first of 2 cells)")
    assert out.endswith("written: nothing-out.json\n") and len(cells_of("nothing-out.json")) == 2, out
    refused = ("--builder", "karras", "--group-size", "65536", "--scene", "soup:10", "--samples", "1", "--json")
    expect(4, "build", *refused, "build-refused.json", says="nothing was measured: a group size is a power of two")
    expect(4, "collide", "--collider", "leaf", *refused, "collide-refused.json", says="nothing was measured: a collider's")
    for path in ("build-refused.json", "collide-refused.json"):
        assert [cell[:2] for cell in cells_of(path)] == [("soup:10", "skipped")], path
    expect(4, "accuracy", "--axis", "sums", "--scene", "nonsense", "--out", "none", says=why)
    expect(4, "sweep", "--scenes", "gone.obj", "--builders", "perfect", "--out", "sweep", says="nothing was measured: ")
    assert [cell[1] for cell in cells_of("sweep/sweep.json")] == ["skipped"]
    pathlib.Path("no-kernels").mkdir()
    expect(4, "check", "--builder", "perfect", "--scene", "torus:300", "--kernels", "no-kernels", says="nothing was checked: kernel source")
    expect(4, "reproduce", "table1", "--quick", "--kernels", "no-kernels", "--out", "table", says="nothing was measured: kernel source")
    assert {cell[1] for cell in cells_of("table/table1.json")} <= {"skipped", "failed"}


def test_what_cannot_even_begin_ends_with_2_or_3_and_writes_nothing():
    one = ("build", "--builder", "perfect", "--samples", "1", "--json", "none.json", "--scene")
    expect(2, *one, "nonsense", says="no scene is called 'nonsense'")
    expect(3, *one, "gone.obj", says="gone.obj")
    expect(2, "collide", "--collider", "leaf", "--json", "none.json", "--scene", "soup:10", "--frames", "7", says="has frames 0 to 0")
    expect(2, "run", experiment("unknown.json", scenes=["soup:10"], builders=["karas"]), "--out", "none.json", says="karas")
    expect(2, "run", experiment("keys.json", scenes=["soup:10"], builders=["perfect"], sample=3), "--out", "none.json", says="sample")
    expect(2, "stress", "--quick", "--filter", "zzz", "--out", "none.json", says="--filter: no cell of stress matches 'zzz'")
    assert not pathlib.Path("none.json").exists()


@contextlib.contextmanager
def at_work(*words: str, **environment: str) -> Iterator[subprocess.Popen]:
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, **environment}) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_until(happens: Callable[[], object]) -> None:
    until = time.time() + 60
    while not happens():
        assert time.time() < until
        time.sleep(0.02)


def ours() -> list[str]:
    """Command lines of processes that were started in this folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            if entry.name.isdigit() and int(entry.name) != os.getpid() and os.readlink(entry / "cwd") == os.getcwd():
                found.append((entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip())
    return [line for line in found if line]


def ends_at_once(process: subprocess.Popen, sent: signal.Signals = signal.SIGTERM) -> str:
    """What it says. It is at work, and nothing of it is left."""
    assert process.poll() is None, process.communicate()
    began = time.time()
    process.send_signal(sent)
    _, error = process.communicate(timeout=60)
    took = time.time() - began
    assert process.returncode == 128 + sent and took < AT_ONCE_S, (process.args, process.returncode, took, error)
    assert error.splitlines()[-1].startswith("bvhbench: stopped"), (process.args, error)
    wait_until(lambda: not ours())
    print(f"  {process.args[1]}: over {took:.2f} s after {sent.name}")
    return error


def begun(*scenes: str, **keys) -> tuple[str, ...]:
    """Words of a run whose first cell is over soon, and whose second is not."""
    pathlib.Path("signals.json").unlink(missing_ok=True)
    return ("run", experiment("signals-plan.json", scenes=["soup:10", *scenes], **{"builders": ["perfect"], **keys}), "--out",
            "signals.json")


def first_is_kept() -> None:
    result = valid("signals.json")
    assert [cell["status"] for cell in result["cells"]] == ["measured"] and "finished_at" not in result["run"], result["run"]


def test_a_signal_ends_what_reads_and_generates_and_keeps_what_is_done():
    pathlib.Path("large.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + b"f 1 2 3\n" * 3_000_000)
    simulated = "cloth-dress:20000:60"
    for scene, sent in (("large.obj", signal.SIGTERM), (simulated, signal.SIGINT), (simulated, signal.SIGHUP)):
        with at_work(*begun(scene)) as process:
            wait_until(lambda: pathlib.Path("signals.json").exists())
            time.sleep(0.2)
            assert ends_at_once(process, sent) == "bvhbench: stopped; finished cells are kept\n"
        first_is_kept()
    with at_work("build", "--builder", "perfect", "--scene", simulated) as process:
        time.sleep(1)
        assert ends_at_once(process) == "bvhbench: stopped\n"  # there is no file to keep anything in


def test_a_signal_ends_oracles_metrics_and_samples():
    heavy = {"oracle": {"pipelines": [{"builder": "perfect", "collider": "leaf", "narrow": "exact"}]},
             "metrics": {"quality": True},
             "samples": {"samples": 1000000}}
    for what, keys in heavy.items():
        with at_work(*begun("hairball:200000" if what != "samples" else "soup:5000", **keys)) as process:
            if what == "samples":  # which the first scene's are, too
                time.sleep(1.5)
            else:
                wait_until(lambda: pathlib.Path("signals.json").exists())
                time.sleep(1)
            ends_at_once(process)
        if what != "samples":
            first_is_kept()


def test_a_signal_ends_what_compiles():
    for after in (0.3, 0.7, 1.1):
        with at_work("collide", "--builder", "oibvh-multi", "--collider", "bvtt", "--narrow", "exact", "--scene", "soup:3000",
                     "--samples", "1000000", XDG_CACHE_HOME=os.path.abspath(f"cold-{after}"), POCL_CACHE_DIR="") as process:
            time.sleep(after)
            ends_at_once(process)


def test_a_signal_ends_check_accuracy_stress_and_what_draws():
    shutil.copytree(SCHEMA.parents[2] / "plots", "home/plots")
    pathlib.Path("home/plots/all.py").write_text("import time\ntime.sleep(60)\n")
    for words in (("check",), ("accuracy", "--axis", "narrow", "--out", "stopped"),
                  ("stress", "--quick"), ("plot", "scenes-out.json", "--out", "drawn")):
        with at_work(*words, BVHBENCH_HOME=os.path.abspath("home")) as process:
            time.sleep(1.5)
            ends_at_once(process)


def test_under_nohup_a_run_goes_on_after_the_terminal_is_gone():
    with subprocess.Popen(["nohup", PROGRAM, *begun(samples=200)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        time.sleep(0.5)
        process.send_signal(signal.SIGHUP)
        assert process.wait(60) == 0, process.returncode
    assert cells_of("signals.json") == [("soup:10", "measured", "")]


if __name__ == "__main__":
    sys.exit(main(globals()))
