#!/usr/bin/env python3
"""Tests sweeps: killed and resumed, crashed, sharded, merged and drawn. SWEEP_SEED seeds the times of kills (1)."""
import collections
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

from program import KEPT, PATIENCE_S, PROGRAM, SCHEMA, SOURCE, at_work, children, expect, main, ours, planted_karras, run, valid, wait_until

PRODUCT = ("--scenes", "soup:70,torus:500", "--builders", "perfect,karras", "--orders", "morton30,hilbert30", "--samples", "2",
           "--warm-up", "0")


def about(cell: dict) -> str:
    """Returns what identifies a cell, independent of its outcome."""
    scene = cell["scene"]
    key = [cell["experiment"], scene["name"], scene.get("frame", 0), cell["builder"], cell.get("collider"), cell["operation"]]
    return json.dumps(key, sort_keys=True)


def cells_of(path: str) -> collections.Counter:
    """Returns how often each cell is in a result file."""
    document = valid(path)
    known = {source["id"] for source in document.get("merged_from", [])}
    assert not known or all(cell["run"] in known for cell in document["cells"]), path
    return collections.Counter(about(cell) for cell in document["cells"])


def statuses(path: str) -> collections.Counter:
    return collections.Counter(cell["status"] for cell in valid(path)["cells"])


def finished(folder: str) -> list[str]:
    """Returns the samples of each finished cell of a sweep, from its journal or, if it has ended, from its result file."""
    file, journal = pathlib.Path(folder, "sweep.json"), pathlib.Path(folder, "sweep.json.journal")
    lines = journal.read_text().split("\n")[:-1] if journal.exists() else []
    cells = [json.loads(line)["cell"] for line in lines if '"cell"' in line]
    return [json.dumps(cell["samples"]) for cell in (json.loads(file.read_text())["cells"] if file.exists() else cells)]


def test_killed_three_times_it_has_the_cells_of_one_that_was_not():
    seed = int(os.environ.get("SWEEP_SEED", 1))
    draw = random.Random(seed)
    whole = expect(0, "sweep", *PRODUCT, "--out", "whole", says="8 cells: 8 measured, 0 skipped, 0 failed")
    assert len(re.findall(r"^\[[1-7]/8\] .*: agrees, [0-9.]+ s; about \d+ (?:s|min) left$", whole, re.MULTILINE)) == 7, whole
    wanted = cells_of("whole/sweep.json")
    assert len(wanted) == 8 and set(wanted.values()) == {1}, wanted
    before: list[str] = []
    progress = []
    for kill in range(3):
        with at_work("sweep", *PRODUCT, "--out", "killed") as process:
            # Kills after a new cell has finished, so that there is something to resume. The last kill hits only the sweep itself.
            wait_until(lambda: len(finished("killed")) > len(before) or process.poll() is not None)
            time.sleep(draw.uniform(0, 0.8))  # only chooses where the kill strikes
            if kill < 2:
                os.killpg(process.pid, signal.SIGKILL)
            else:
                process.kill()
        wait_until(lambda: not ours())  # killed processes are gone after a moment
        now = finished("killed")
        assert now[:len(before)] == before, "a finished cell was measured again"
        before = now
        progress.append(len(before))
    print(f"  seed {seed}: killed with {progress} of 8 cells done")
    assert 1 <= progress[0] <= 8, progress
    done = expect(0, "sweep", *PRODUCT, "--out", "killed", says="8 cells: 8 measured, 0 skipped, 0 failed")
    assert done.count("\n[") in (8 - len(before), 9 - len(before)), done  # killed between a cell and the end of its part
    assert cells_of("killed/sweep.json") == wanted
    assert finished("killed")[:len(before)] == before
    assert sorted(os.listdir("killed")) == ["plan.json", "sweep.json"]
    done = expect(0, "sweep", *PRODUCT, "--out", "killed", says="8 cells: 8 measured")
    assert "[" not in done and cells_of("killed/sweep.json") == wanted, done
    more = (*PRODUCT[:3], "perfect,karras,apetrei", *PRODUCT[4:])  # a finished sweep may get more builders
    done = expect(0, "sweep", *more, "--out", "killed", says="12 cells: 12 measured")
    assert done.count("\n[") == 4 and wanted <= cells_of("killed/sweep.json"), done


def test_no_process_outlives_a_sweep_that_is_killed():
    words = ("sweep", "--scenes", "soup:70", "--builders", "perfect", "--samples", "1000000", "--out", "outlived")
    with at_work(*words) as process:
        wait_until(lambda: any(" run outlived/" in line for line in ours()))
        process.kill()
    wait_until(lambda: not ours())


def test_an_interrupt_ends_it_and_keeps_what_is_done():
    # Two cells that take a moment, and two over a simulation of minutes.
    words = ("--scenes", "soup:70,cloth-dress:20000:60", "--builders", "perfect,karras", "--samples", "2")
    with at_work("sweep", *words, "--out", "stopped") as process:
        next(line for line in process.stdout if line.startswith("[2/4]"))
        os.killpg(process.pid, signal.SIGINT)  # like a terminal, which also signals the cell's process
        output, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130 and errors == KEPT, (process.returncode, errors)
    kept = cells_of("stopped/sweep.json")
    assert len(kept) == 2 and "written:" not in output, (kept, output)
    assert "finished_at" not in valid("stopped/sweep.json")["run"]
    assert not ours()


def test_a_process_that_is_killed_for_lack_of_memory_costs_its_part():
    words = ("sweep", "--scenes", "cloth-dress:20000:60,soup:70", "--builders", "perfect", "--samples", "1", "--out", "short")
    with at_work(*words) as process:
        wait_until(pathlib.Path("short/sweep.json.journal").exists)  # the device is open
        time.sleep(0.5)  # only chooses where the kill strikes: the scene is simulated for minutes
        os.kill(children(children(process.pid)[0])[0], signal.SIGKILL)
        output, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 0, (output, errors)
    (first, second) = valid("short/sweep.json")["cells"]
    assert first["status"] == "failed" and first["reason"].startswith("was killed (signal 9)"), first
    assert second["status"] == "measured" and "2 cells: 1 measured, 0 skipped, 1 failed" in output, (second, output)


def test_a_crash_costs_one_cell():
    crash = r"\1\n    *(volatile global uint*)(ulong)(get_global_size(0) & 0) = 1;\n"  # writes to an invalid address
    kernels = planted_karras("crashing", r"(kernel void \w+\([^{]*\{)", crash)
    words = ("sweep", "--scenes", "soup:70", "--builders", "perfect,karras,median-split", "--samples", "2", "--out", "crash",
             "--kernels", kernels)
    expect(0, *words, says="3 cells: 2 measured, 0 skipped, 1 failed")
    cells = {cell["builder"]["name"]: cell for cell in valid("crash/sweep.json")["cells"]}
    assert cells["karras"]["status"] == "failed", cells["karras"]
    assert re.match(r"crashed \(signal (6|11)\)", cells["karras"]["reason"]), cells["karras"]
    assert cells["perfect"]["check"]["verdict"] == cells["median-split"]["check"]["verdict"] == "agrees"
    assert "[" not in expect(0, *words, says="1 failed")  # a failed cell is finished
    good = pathlib.Path("crash/sweep.json")
    text = good.read_text()
    good.write_text(text.replace('"verdict":"agrees"', '"verdict":"differs"', 1))
    expect(1, *words)  # a wrong answer sets the exit code, however long ago it was found
    good.write_text(text)
    assert "[2/3] soup:70, karras: failed" in expect(0, *words, "--retry-failed", says="1 failed")


def night_test_a_device_that_goes_away_ends_it_with_what_is_done():
    vendors = pathlib.Path("vendors").resolve()
    vendors.mkdir()
    given = pathlib.Path(os.environ.get("OCL_ICD_VENDORS", "/etc/OpenCL/vendors"))
    for path in given.glob("*.icd") if given.is_dir() else [given]:
        shutil.copy(path, vendors)
    words = ("sweep", "--scenes", "soup:70,torus:500,soup:71", "--builders", "perfect,karras,apetrei,median-split", "--samples", "1", "--out",
             "gone")
    with at_work(*words, OCL_ICD_VENDORS=str(vendors)) as process:
        next(line for line in process.stdout if line.startswith("[1/12]"))
        shutil.rmtree(vendors)
        _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 3 and re.match("bvhbench: there is no OpenCL device: ", errors), errors
    assert statuses("gone/sweep.json").keys() == {"measured"}
    expect(0, *words, says="12 cells: 12 measured")


def test_shards_together_are_the_whole():
    words = ("sweep", "--scenes", "soup:70,torus:500", "--builders", "perfect,oibvh-wide4", "--set", "boxes=f32,u16", "--samples",
             "1", "--warm-up", "0")
    cannot_be = "oibvh-wide4 keeps its boxes in its own way"
    expect(0, *words, "--out", "all", "--dry-run", says="8 cells, 2 of which cannot be")
    parts = ("part/sweep-1of3.json", "elsewhere/sweep-2of3.json", "part/sweep-3of3.json")  # two share a folder
    pathlib.Path("part").mkdir()
    for shard, path in zip(("1/3", "2/3", "3/3"), parts):
        out = os.path.dirname(path)
        expect(0, *words, "--out", out, "--shard", shard, says="written: ")
        assert statuses(path)["measured"] == 2
    expect(0, "merge", *parts, "-o", "merged.json", says="8 cells of 3 runs")
    assert list(cells_of("merged.json").values()) == [1] * 8
    skipped = [cell for cell in valid("merged.json")["cells"] if cell["status"] == "skipped"]
    assert len(skipped) == 2 and all(cell["reason"].startswith(cannot_be) for cell in skipped), skipped
    expect(0, "show", "merged.json", says="merged from 3 runs on ")
    # Merges again with one of the parts: each cell appears once, unchanged.
    expect(0, "merge", "merged.json", parts[0], "-o", "again.json", says="8 cells of 3 runs; in more than one file, the same in each: 4\n")
    assert cells_of("again.json") == cells_of("merged.json")


def test_cells_from_warm_and_empty_caches_are_two():
    for name, words in (("hot", ()), ("cold", ("--caches", "cold"))):
        expect(0, "build", "--builder", "perfect", "--scene", "soup:70", "--samples", "2", "--json", f"{name}.json", *words)
    expect(0, "merge", "hot.json", "cold.json", "-o", "both.json", says="2 cells of 2 runs")
    frames = ("collide", "--collider", "group", "--scene", "cloth-ball:500:2", "--frames", "1", "--samples", "1")
    expect(0, *frames, "--json", "two.json")
    expect(0, *frames, "--between", "3", "--json", "between.json")
    assert valid("between.json")["cells"][0]["scene"]["between"] == 3
    expect(0, "merge", "two.json", "between.json", "-o", "frames.json", says="2 cells of 2 runs")
    assert sorted(cell["sampling"]["caches"] for cell in valid("both.json")["cells"]) == ["cold", "hot"]


def night_test_two_processes_over_two_devices():
    # PoCL creates as many devices as POCL_DEVICES names.
    words = ("sweep", *PRODUCT, "--out", "jobs")
    done = expect(0, *words, "--device", "0", "--device", "1", says="8 cells: 8 measured", POCL_DEVICES="pthread pthread")
    assert "note: processes share a device" in done, done
    commands = [source["command"] for source in valid("jobs/sweep.json")["merged_from"]]
    on = collections.Counter(words[words.index("--device") + 1] for words in commands)
    assert set(on) == {"0", "1"}, on
    assert cells_of("jobs/sweep.json") == cells_of("whole/sweep.json")
    assert "\n[" not in expect(0, *words, "--device", "0", "--device", "1", says="8 cells: 8 measured", POCL_DEVICES="pthread pthread")
    expect(3, *words, "--device", "7", says="no OpenCL device matches '7'")


def test_a_file_says_what_the_command_line_does_not():
    keys = {"sweep": "mine", "question": "?", "builders": ["perfect", {"name": "oibvh-multi", "boxes": "u16"}],
            "colliders": ["leaf", {"name": "bvtt", "jump": 2}, "grid"], "set": {"adjacent": ["drop"]}, "samples": 1, "warm_up": 0}
    scenes = {"scenes": ["soup", {"scene": "cloth-ball:1300:3", "frames": "0:2"}], "sizes": [70, "200:400:+200"]}
    pathlib.Path("s.json").write_text(json.dumps(keys | scenes))
    pathlib.Path("t.json").write_text(json.dumps(keys | {"scenes": ["cloth-ball:1300:3"]}))
    listed = expect(0, "sweep", "s.json", "--out", "mine", "--dry-run",
                    says="mine: 4 scenes x 2 builders x 3 colliders x 1 value of adjacent: 20 cells\n")
    assert listed.count("bvtt") == 8 and listed.count(" grid") == 4 and not pathlib.Path("mine").exists(), listed
    expect(0, "sweep", "t.json", "--colliders", "leaf,grid", "--set", "frames=0:2", "--out", "mine", "--together", "scene",
           says="[1/1] cloth-ball:1300:3, 3 cells: 6 results")
    result = valid("mine/mine.json")
    found = [(cell["collider"]["name"], cell["builder"]["name"], cell["scene"]["frame"]) for cell in result["cells"]]
    assert sorted(found) == [("grid", "none", 0), ("grid", "none", 1), ("leaf", "oibvh-multi", 0), ("leaf", "oibvh-multi", 1),
                             ("leaf", "perfect", 0), ("leaf", "perfect", 1)], found
    assert all(cell["experiment"] == "mine" and cell["collider"]["options"]["adjacent"] == "drop" for cell in result["cells"])
    orders = sorted(sample["order"] for cell in result["cells"] for sample in cell["samples"])
    assert orders == list(range(6)), "samples of one process are counted through"
    expect(2, "sweep", "s.json", "--scenes", "soup:70,cloth-ball:1300:3", "--out", "mine",
           says="s.json: none of the scenes has room for a size")


def test_what_cannot_be_is_one_sentence():
    pathlib.Path("taken").mkdir()
    shutil.copy("hot.json", "taken/sweep.json")
    soup, one = "--scenes soup:70 --builders perfect", "--scenes soup --builders perfect"
    for says, words in (
            ("no builder is called 'perfekt'; did you mean 'perfect'?", "--scenes soup:70 --builders perfekt"),
            ("no scene is called 'sooup:70'; did you mean 'soup:N'?", "--scenes sooup:70 --builders perfect"),
            ("'group_size' takes a power of two up to 65536, 0 for the builder's choice, not '3'", f"{soup} --set builder.group_size=3"),
            ("where a triangle count from 1 to", one),
            ("frames 2:1 are none", f"{soup} --colliders leaf --set frames=2:1"),
            ("'1000:10:x10' are no sizes: 1000 is more than 10", f"{one} --sizes 1000:10:x10"),
            ("a sweep needs builders or colliders", "--scenes soup:70"),
            ("a sweep needs scenes", "--builders perfect"),
            ("--set is KEY=V1,V2, not 'boxes'", f"{soup} --set boxes"),
            ("'scene' is no key of a sweep; there are: sweep, question, scenes", '{"scene":["soup:70"]}'),
            ("must be an object", "[]"), ("not JSON, at line 1, column 2", "{"), ("--out is required", ""),
            ("whole/sweep.json has 8 of 8 parts that are none of this plan, or were measured with other options; choose another --out",
             f"{soup} --out whole"),
            ("taken/sweep.json is a result, and its cells do not say of which part of a plan they are", f"{soup} --out taken")):
        if words[:1] in ("{", "["):
            pathlib.Path("bad.json").write_text(words)
            words = "bad.json"
        out = () if "--out" in says + words else ("--out", "refused")
        expect(2, "sweep", *words.split(), *out, says=says)
    expect(3, "sweep", "nowhere.json", "--out", "refused", says="the sweep's file 'nowhere.json' cannot be read")
    expect(3, "sweep", *soup.split(), "--out", "/proc/sweep", says="the folder /proc/sweep cannot be made")
    assert not pathlib.Path("refused").exists()


def night_test_the_documented_examples_work():
    text = (SOURCE / "docs/sweeps.md").read_text()
    assert "docs/sweep.json --out" in text and "docs/sweep.sbatch docs/sweep.json" in text
    expect(0, "sweep", str(SOURCE / "docs/sweep.json"), "--out", "example", "--dry-run",
           says="orders-by-size: 9 scenes x 3 builders x 3 orders: 81 cells\n")
    pathlib.Path("tiny.json").write_text('{"scenes": ["soup:70", "torus:70"], "builders": ["perfect"], "samples": 1}')
    script = str(SOURCE / "docs/sweep.sbatch")
    for task in "1", "2":
        environment = {"BVHBENCH": str(PROGRAM), "BVHBENCH_DEVICE": "0", "SLURM_ARRAY_TASK_ID": task, "SLURM_ARRAY_TASK_MAX": "2"}
        done = subprocess.run([script, "tiny.json", "array"], env={**os.environ, **environment}, capture_output=True, text=True,
                              check=False)
        assert done.returncode == 0 and f"written: array/sweep-{task}of2.json" in done.stdout, done
    expect(0, "merge", "array/sweep-1of2.json", "array/sweep-2of2.json", "-o", "array.json", says="2 cells of 2 runs")
    alone = subprocess.run([script, "tiny.json", "array"], capture_output=True, text=True, check=False)
    assert alone.returncode != 0 and "submit it as an array" in alone.stderr, alone


def test_another_commit_is_said_and_refused_unless_asked_for():
    words = ("sweep", "--scenes", "soup:70", "--builders", "perfect,karras", "--samples", "1", "--out", "older")
    expect(0, *words, says="2 cells: 2 measured")
    path = pathlib.Path("older/sweep.json")
    document = valid(str(path))
    document["run"]["program"]["commit"] = "0123456789" * 4
    del document["cells"][1]
    path.write_text(json.dumps(document))
    expect(2, *words, says="older/sweep.json has cells by commit 0123456789")
    done = expect(0, *words, "--continue-other-commit", says="2 cells: 2 measured")
    assert "[2/2] soup:70, karras" in done and "[1/2]" not in done, done
    result = valid(str(path))
    assert cells_of(str(path)).total() == 2
    assert len(result["merged_from"]) == 2 and result["merged_from"][0]["commit"][:10] == "0123456789", result
    path.write_text(path.read_text().replace('"device":"pthread', '"device":"another'))
    expect(2, *words, "--continue-other-commit", says="older/sweep.json has cells of another")


def test_merge_refuses_what_is_not_alike():
    build = ("build", "--builder", "perfect", "--scene", "soup:70", "--samples", "1", "--json")
    expect(0, *build, "a.json")
    expect(0, *build, "b.json")
    document = valid("b.json")

    def merge(code: int, *files: str, says: str = "") -> None:
        expect(code, "merge", *files, "-o", "m.json", "--force", says=says)

    def changed(name: str, change) -> str:
        other = json.loads(json.dumps(document))
        change(other)
        pathlib.Path(name).write_text(json.dumps(other))
        return name

    merge(2, "a.json", "b.json", says="a.json and b.json both have soup:70, perfect, and not the same of it")
    merge(0, "a.json", "a.json", says="1 cell of 1 run; in more than one file, the same in each: 1\n")
    merge(3, "a.json", "nowhere.json", says="the result file 'nowhere.json' cannot be read")
    merge(3, "a.json", str(SCHEMA), says="is no result file")
    device = changed("device.json", lambda other: other["run"]["device"].update(name="other"))
    merge(2, "a.json", device, says="--other-devices merges them all the same")
    merge(0, "a.json", device, "--other-devices", says="2 cells of 2 runs")
    assert sorted(source["device"] for source in valid("m.json")["merged_from"])[0] == "other"
    expect(0, "show", "m.json", says="of several devices: ")
    refused = run("plot", "m.json", "--out", "pictures", BVHBENCH_HOME=str(SOURCE))
    assert refused.returncode == 3 and "merged from several devices" in refused.stderr, refused
    commit = changed("commit.json", lambda other: (other["run"]["program"].update(commit="0" * 40),
                                                   other["cells"][0]["builder"].update(name="karras")))
    merge(2, "a.json", commit, says="--other-commits merges them all the same")
    merge(0, "a.json", commit, "--other-commits", says="2 cells of 2 runs")
    merge(1, changed("wrong.json", lambda other: other["cells"][0]["check"].update(verdict="differs")))


def test_plot_draws_what_there_is_or_says_what_there_is():
    environment = {"BVHBENCH_HOME": str(SOURCE)}
    drawn = expect(0, "plot", "whole/sweep.json", "--out", "pictures", says="drawn into pictures", **environment)
    assert "pictures/sweep-orders.svg" in drawn and pathlib.Path("pictures/sweep-orders.png").exists(), drawn
    expect(0, "plot", "a.json", "--out", "pictures", says="pictures/a-overview.png", **environment)
    expect(3, "plot", "nowhere.json", "--out", "pictures", says="nowhere.json", **environment)
    expect(3, "plot", "a.json", BVHBENCH_HOME="/nowhere", says="/nowhere/plots/__main__.py is not there")


sys.exit(main(globals()))
