#!/usr/bin/env python3
"""Removes resources that the program needs while it runs, and checks the guarantees of docs/reliability.md.

Usage: faults_test.py <bvhbench> <result schema> <opencl_shim.so>

FAULT_KILLS is the number of kills in a test (default 5), FAULT_SEED seeds their times (default 1).
"""
import json
import os
import pathlib
import random
import re
import signal
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from program import (ALL_CASES, PATIENCE_S, SOURCE, at_work, copied_kernels, expect, experiment, limit_for, main, only,  # noqa: E402
                     planted_karras, run, small_disk, valid, wait_until)

SHIM = str(pathlib.Path(sys.argv[3]).resolve())
KILLS, SEED = int(os.environ.get("FAULT_KILLS", 5)), int(os.environ.get("FAULT_SEED", 1))
BUILD = ("build", "--builder", "oibvh-multi", "--scene", "soup:300", "--samples", "1")


def whole(path: pathlib.Path) -> bool:
    """True if a file is complete, judged by the end that its format requires."""
    content = path.read_bytes()
    if path.suffix == ".json":
        json.loads(content)
    return path.suffix not in (".png", ".svg") or content.endswith((b"IEND\xaeB`\x82", b"</svg>\n"))


def test_killed_at_any_time_every_file_that_was_there_is_old_or_new():
    """Kills run, sweep, tune, accuracy and merge, a fifth of the kills each, in a folder with earlier results."""
    kills, draw = KILLS // 5, random.Random(SEED)
    plan = experiment("replaced.json", scenes=["soup:9", "soup:99", "soup:999"], builders=["perfect", "median-split"])
    product = ("--scenes", "soup:9,soup:99", "--builders", "perfect,median-split", "--samples", "1")
    commands = {"run": ("run", plan, "--out", "run/r.json", "--force"),
                "sweep": ("sweep", *product, "--out", "sweep", "--retry-failed"),
                "tune": ("tune", "sort", "--scene", "soup:999", "--quick", "--samples", "3", "--out", "tune/t.json"),
                "accuracy": ("accuracy", "--axis", "sums", "--scene", "soup:99", "--samples", "1", "--out", "accuracy", "--force"),
                "merge": ("merge", "run/r.json", "sweep/sweep.json", "-o", "merge/m.json", "--force", "--other-commits")}
    for name, words in commands.items():
        folder = pathlib.Path(name)
        folder.mkdir()
        began = time.monotonic()
        expect(0, *words)
        seconds, old, new = time.monotonic() - began, 0, 0
        for _ in range(kills):
            if name == "sweep":  # some cells must be measured again
                document = json.loads(pathlib.Path("sweep/sweep.json").read_text())
                pathlib.Path("sweep/sweep.json").write_text(json.dumps(document | {"cells": document["cells"][::2]}))
            before = {path: (path.read_bytes(), path.stat().st_ino) for path in folder.rglob("*")
                      if path.suffix in (".json", ".png", ".svg")}
            with at_work(*words) as process:
                time.sleep(draw.uniform(0, 1.1 * seconds))  # only chooses where the kill strikes
                process.kill()
                process.communicate(timeout=PATIENCE_S)  # the plots that it had started end as well
            for path, (content, _) in before.items():
                assert path.read_bytes() == content or whole(path), (name, path)
            replaced = any(path.stat().st_ino != inode for path, (_, inode) in before.items())
            old, new = old + (not replaced), new + replaced
        if kills > 10:
            print(f"{name}: {kills} kills, {old} left all as it was, {new} replaced something", flush=True)
        expect(0, *words)  # files left by kills must not disturb the next run


def test_a_device_that_is_lost_is_one_sentence():
    for call, says in (("1+", "no OpenCL device"), ("40+", "failed: CL_"), ("2000+", "failed: CL_")):
        expect(3, *BUILD, says=says, LD_PRELOAD=SHIM, BVHBENCH_FAIL_CALL=call)
    expect(0, *BUILD, says="agrees", LD_PRELOAD=SHIM)


def bad_clock(kind: str) -> dict[str, str]:
    return {"LD_PRELOAD": SHIM, "BVHBENCH_BAD_CLOCK": kind}


def night_test_a_clock_that_lies_is_not_believed():
    plan = experiment("clock.json", scenes=["soup:300"], builders=["oibvh-multi", "karras"], samples=5)
    collide = ("collide", "--builder", "oibvh-multi,karras", "--collider", "leaf", "--scene", "soup:300", "--samples", "3")
    commands = (BUILD, collide, ("run", plan, "--out", "r.json"), ("best", "soup:300", "--out", "best.json"), ("smoke",))
    offers = "; --clock host takes the host's\n"
    for kind, says in (("zero", "began at 0"), ("back", "ended before it began"), ("huge", "took longer than on the host's"),
                       ("slow", "ns on the host's"), ("host", "the host's clock went back")):
        for words in commands if kind == "zero" or ALL_CASES else commands[:1]:
            done = run(*words, **bad_clock(kind))
            assert done.returncode == 3 and says in done.stderr and not done.stdout, (kind, done)
            assert done.stderr.endswith(offers) == (kind != "host") and done.stderr.count("\n") == 1, (kind, done)
        assert not pathlib.Path("r.json").exists() and not pathlib.Path("best.json").exists()
    for kind in ("zero", "back", "huge", "slow", "some") if ALL_CASES else ("slow", "some"):
        expect(0, "run", plan, "--out", "host.json", "--force", "--clock", "host", says="2 agree", **bad_clock(kind))
        result = valid("host.json")
        assert result["run"]["clock"] == "host"
        times = [(stage["span_ns"], sample["wall_ns"]) for cell in result["cells"] for sample in cell["samples"]
                 for stage in sample["stages"]]
        assert times and all(0 < span <= wall for span, wall in times), times
    expect(0, "run", plan, "--out", "device.json", says="2 agree")
    expect(2, "compare", "device.json", "host.json", "--allow-dirty", says="device.json was timed by the device's clock and host.json by the host's")


def test_a_program_that_is_stopped_now_and_then_still_believes_the_devices_clock():
    expect(0, *BUILD, says="agrees", **bad_clock("stalls"))


def night_test_samples_with_impossible_times_are_dropped_and_too_many_fail_the_cell():
    """Which launches are told wrong depends on how many the start takes: it may end with 3 already, and never with 0."""
    plan = experiment("some.json", scenes=["soup:300"], builders=["oibvh-multi", "perfect"], samples=5)
    for words, codes in ((("run", plan, "--out", "some-out.json"), (3, 4)), (("smoke",), (1, 3)),
                         (("collide", "--builder", "oibvh-multi,karras", "--collider", "leaf", "--scene", "soup:300", "--samples", "3"), (3, 4)),
                         (("best", "soup:300", "--builders", "oibvh-multi", "--orders", "hilbert30", "--colliders", "leaf,group", "--out",
                           "some-best.json"), (3, 4))):
        done = run(*words, **bad_clock("some"))
        assert done.returncode in codes, (words, done)
        assert done.returncode == 1 or "a launch began at 0 or ended before it began" in done.stderr, done
    if os.path.exists("some-out.json"):
        cells = valid("some-out.json")["cells"]
        assert all(cell["status"] == "failed" and "--clock host" in cell["reason"] for cell in cells), cells
        expect(0, "run", plan, "--out", "good-out.json")
        compared = run("compare", "good-out.json", "some-out.json", "--allow-dirty")
        assert compared.returncode == 1 and compared.stdout.count("failed (") == 2, compared


def test_a_host_clock_that_steps_back_now_and_then_leaves_no_time_below_zero():
    """Where in the program the steps fall is chance: each outcome is right but a time that cannot be."""
    commands = (("build", "--builder", "oibvh-multi", "--scene", "soup:300", "--samples", "20", "--json", "jumped.json", "--force"),
                ("collide", "--builder", "perfect", "--collider", "leaf", "--scene", "soup:300", "--samples", "20", "--json", "jumped.json",
                 "--force"))
    for words in commands:
        pathlib.Path("jumped.json").unlink(missing_ok=True)
        done = run(*words, **bad_clock("jumps"))
        assert done.returncode in (0, 3, 4), done
        assert done.returncode == 0 or "clock went back" in done.stderr, done
        assert not re.search(r" -\d[\d.]* [num]?s\b", done.stdout), done
        cells = valid("jumped.json")["cells"] if os.path.exists("jumped.json") else []
        times = [value for cell in cells for sample in cell.get("samples", []) for entry in (sample, *sample["stages"])
                 for key, value in entry.items() if key.endswith("_ns")]
        assert all(value >= 0 for value in times), times


def test_no_device_is_one_sentence():
    pathlib.Path("no-vendors").mkdir()
    for vendors, has in ((os.getcwd() + "/no-vendors", "has none"), ("/nonexistent", "is no folder")):
        expect(3, *BUILD, says=f"there is no OpenCL device: drivers are named in '{vendors}' (OCL_ICD_VENDORS), which {has}; ",
               OCL_ICD_VENDORS=vendors)
    expect(3, *BUILD, says="; POCL_DEVICES is 'gpu'; Debian's pocl-opencl-icd brings one", POCL_DEVICES="gpu")


def test_killed_at_any_time_it_leaves_its_cells_in_a_journal():
    kills, draw = KILLS, random.Random(SEED)
    plan = experiment("killed.json", scenes=[{"scene": "soup:{t}", "t": {"from": 1, "to": 100000}}],
                      builders=["perfect", "median-split"])
    awaited, written = 0, 0
    for number in range(kills):
        path, journal = pathlib.Path(f"killed-{number}.json"), pathlib.Path(f"killed-{number}.json.journal")
        with at_work("run", plan, "--out", str(path)) as process:
            # A quarter are killed at a random time after the start, the others while cells are written.
            if draw.random() < 0.25:
                time.sleep(draw.uniform(0, 0.6))
            else:
                awaited += 1
                wait_until(lambda: journal.exists() and '"cell"' in journal.read_text())
                time.sleep(draw.uniform(0, 1.2))
            process.kill()
            assert process.wait(PATIENCE_S) == -signal.SIGKILL
        assert not path.exists()
        lines = journal.read_text().split("\n")[:-1] if journal.exists() else []
        cells = [json.loads(line)["cell"] for line in lines if '"cell"' in line]
        written += bool(cells)
        for place, cell in enumerate(cells):  # none is missing in between, and each is complete
            assert cell["scene"]["triangles"] == place // 2 + 1 and cell["status"] == "measured", (place, cell)
            assert cell["builder"]["name"] == ("perfect", "median-split")[place % 2], (place, cell)
        if cells and (number % 10 == 0 or kills > 10):
            expect(2, "run", plan, "--out", str(path), says="has cells of a run that did not end")
    assert written >= awaited, f"only {written} of {kills} were killed after the first cell"
    print(f"  killed {kills} times, {written} with cells")


def night_test_a_build_that_hangs_is_given_up_and_the_rest_is_done():
    endless = r"\1\n    while (*(volatile global const uint*)\2 != 0xdeadbeefu) {}\n"
    kernels = planted_karras("hangs", r"(kernel void \w+\(global const \w+\* restrict (\w+)[^{]*\{)", endless)
    scenes = ["soup:1", "soup:200", "soup:300"] if ALL_CASES else ["soup:1", "soup:300"]
    plan = experiment("hangs.json", scenes=scenes, builders=["perfect", "karras", "apetrei"], samples=2)
    # PoCL compiles kernels on their first use; a busy machine must not look like a hang.
    warm = ("run", plan, "--out", "warm.json", "--force", "--kernels", kernels, "--filter", "perfect|apetrei")
    expect(0, *warm)
    limit = limit_for(*warm)
    common = ("--time-limit", str(limit), "--kernels", kernels)
    expect(0, "run", plan, "--out", "hangs-out.json", *common, says=f"{3 * len(scenes)} cells, ")
    result = valid(pathlib.Path("hangs-out.json"))
    cells = [(cell["scene"]["name"], cell["builder"]["name"], cell["status"]) for cell in result["cells"]]
    assert [cell[:2] for cell in cells] == [(scene, builder) for scene in scenes
                                            for builder in ("perfect", "karras", "apetrei")], cells
    failed = [cell for cell in result["cells"] if cell["status"] == "failed"]
    assert [cell["builder"]["name"] for cell in failed] == ["karras"] * (len(scenes) - 1), cells
    assert all(cell["reason"].startswith(f"took longer than {limit} s and was ended") for cell in failed), failed
    orders = [sample["order"] for cell in result["cells"] for sample in cell.get("samples", [])]
    assert len(set(orders)) == len(orders) == 4 * len(scenes) + 2, orders
    assert "finished_at" in result["run"]
    expect(4, "collide", "--builder", "karras", "--collider", "leaf", "--scene", "soup:300", "--samples", "1", "--json",
           "hangs-collide.json", *common, says=f"took longer than {limit} s")
    assert only("hangs-collide.json")["status"] == "failed"
    expect(3, "check", "--builder", "karras", "--scene", "soup:300", *common, says=f"what was to be done took longer than {limit} s")


def test_a_crash_costs_the_cell_that_it_was_in():
    # A cache folder chosen by the user is not checked for broken kernels, so PoCL aborts the process.
    cache = pathlib.Path("cache").resolve()
    cache.mkdir()
    plan = experiment("crash.json", scenes=["soup:300"], builders=["oibvh-multi", "median-split"])
    crash = ("run", plan, "--out", "crashed.json")
    # The programs that every run needs stay intact: only those of the builder are broken.
    expect(0, *crash, "--filter", "median-split", says="verdict: agrees", POCL_CACHE_DIR=str(cache))
    sound = set(cache.rglob("program.bc"))
    os.remove("crashed.json")
    expect(0, *crash, says="2 agree", POCL_CACHE_DIR=str(cache))
    os.remove("crashed.json")
    programs = set(cache.rglob("program.bc")) - sound
    assert programs and sound
    for path in programs:
        path.write_bytes(path.read_bytes()[:100])
    expect(0, *crash, says="1 agree", POCL_CACHE_DIR=str(cache))
    failed, other = valid(pathlib.Path("crashed.json"))["cells"]
    assert failed["reason"].startswith("crashed (signal 6)") and "OpenCL driver's cache" in failed["reason"], failed
    assert other["status"] == "measured", other
    done = run(*BUILD, POCL_CACHE_DIR=str(cache))
    last = done.stderr.splitlines()[-1]  # poCL's own messages come first
    assert done.returncode == 4 and last.startswith("bvhbench: nothing was measured: crashed (signal 6)"), done


def test_a_full_disk_is_one_sentence_and_keeps_what_was_there():
    expect(3, *BUILD, "--json", "/dev/full/r.json", says="/dev/full/r.json cannot be written: there is no folder /dev/full")
    with small_disk(8) as disk:
        if disk is None:
            return
        old = disk / "r.json"
        expect(0, *BUILD, "--json", str(old))
        text = old.read_text()
        (disk / "fill").write_bytes(bytes(4096 * (2 - -(-len(text) // 4096))))
        expect(3, *BUILD, "--json", str(old), "--force", says="cannot be written: No space left on device")
        expect(3, *BUILD, "--dump", str(disk / "d.json"), says="d.json cannot be written: No space left on device")
        collide = ("collide", "--collider", "leaf", "--scene", "soup:3000", "--samples", "1", "--narrow", "exact")
        for option in ("--pairs", "--contacts"):
            expect(3, *collide, option, str(disk / "p.csv"), says="p.csv cannot be written: No space left on device")
        expect(0, "show", str(old))
        assert old.read_text() == text and sorted(os.listdir(disk)) == ["fill", "r.json"], os.listdir(disk)


def night_test_a_disk_that_fills_up_keeps_the_cells_that_found_room():
    with small_disk(128) as disk:
        if disk is None:
            return
        plan = experiment("fills.json", scenes=[{"scene": "soup:{t}", "t": {"from": 1, "to": 2000}}], builders=["perfect"])
        expect(3, "run", plan, "--out", str(disk / "r.json"), says="cannot be written: No space left on device")
        assert os.listdir(disk) == ["r.json.journal"], os.listdir(disk)
        expect(0, "show", str(disk / "r.json.journal"), says=" agree")


def test_a_folder_that_may_not_be_written_is_one_sentence():
    if os.geteuid() == 0:  # root may write everywhere except in /proc and /sys
        expect(3, *BUILD, "--json", "/proc/r.json", says="/proc/r.json cannot be written")
        expect(3, *BUILD, "--json", "/sys/r.json", says="/sys/r.json cannot be written")
    else:
        pathlib.Path("mine").mkdir(mode=0o500)
        expect(3, *BUILD, "--json", "mine/r.json", says="mine/r.json cannot be written: Permission denied")


def test_names_with_blanks_and_quotes_are_names_and_nothing_else():
    folder = pathlib.Path("it's a \"name\"; touch owned $(touch owned) `touch owned` & * \\ end")
    folder.mkdir()
    mesh = folder / "a b's.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n")
    out = folder / "r 1.json"
    expect(0, "build", "--builder", "oibvh-multi", "--scene", str(mesh), "--samples", "1", "--json", str(out), "--dump",
           str(folder / "d 'x'.json"), says="agrees")
    assert valid(out)["cells"][0]["scene"]["name"] == str(mesh)
    expect(0, "show", str(out), says="agrees")
    kernels = copied_kernels(str(folder / "ker nels"))
    expect(0, "build", "--builder", "oibvh-multi", "--scene", "soup:30", "--samples", "1", "--kernels", kernels, says="agrees")
    expect(0, *BUILD, "--data", str(folder), says="agrees", BVHBENCH_DATA=str(folder))
    plan = experiment(str(folder / "p 'q'.json"), scenes=[str(mesh)], builders=["perfect", "$(touch owned)"])
    expect(2, "run", plan, "--out", str(out), says="no builder is called '$(touch owned)'")
    expect(0, "build", "--builder", "median-split", *BUILD[3:], says="agrees", XDG_CACHE_HOME=str(folder.resolve()), POCL_CACHE_DIR="")
    assert (folder / "bvhbench/pocl").is_dir()
    found = [path for path in pathlib.Path(".").rglob("owned")]
    assert not found, found


def test_no_shell_is_ever_asked():
    asks = [f"{path.relative_to(SOURCE)}:{number}" for path in SOURCE.rglob("*")
            if path.suffix in (".cpp", ".h", ".py") and path.relative_to(SOURCE).parts[0] not in ("build", "tests")
            for number, line in enumerate(path.read_text().splitlines(), 1)
            if any(word in line for word in ("popen(", "std::system(", "execlp(", "os.system", "shell=True"))
            or line.strip().startswith("system(")]
    assert not asks, asks


sys.exit(main(globals()))
