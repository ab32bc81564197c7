#!/usr/bin/env python3
"""Tests how samples are taken, according to the program's output and its result files."""
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import threading
import time

from program import PATIENCE_S, PROGRAM, cells_after, copied_kernels, expect, experiment, main, only, valid

BUILD = ("build", "--builder", "oibvh-multi", "--scene", "torus:3000")


def test_a_fixed_number_is_what_was_asked_for() -> None:
    said = expect(0, *BUILD, "--samples", "40", "--json", "a.json", "--force", says="40 samples")
    cell = only("a.json")
    assert len(cell["samples"]) == 40 and cell["sampling"] == {"stopped": "number", "caches": "hot"}
    assert all(sample["calibration_ns"] > 0 for sample in cell["samples"])
    assert cell["first"]["run_ns"] > 0 and "first run" in said
    for stage in (stage for sample in cell["samples"] for stage in sample["stages"]):
        assert stage["queued_ns"] >= 0 and stage["submitted_ns"] >= 0
    assert "q1" in said and "q3" in said and "queued" in said and "submitted" in said


def test_a_target_stops_and_says_why() -> None:
    # Builds that take long: beside them, what other processes delay a sample is little.
    cell, = cells_after(*BUILD[:-1], "torus:300000", "--until", "100%", "--min-samples", "10", says="within 100.0 %")
    assert cell["sampling"] == {"stopped": "steady", "caches": "hot", "until": 1}
    assert 10 <= len(cell["samples"]) < 200
    cell, = cells_after(*BUILD, "--until", "0.01%", "--max-samples", "20", says="no more are allowed")
    assert cell["sampling"]["stopped"] == "most" and len(cell["samples"]) == 20
    cell, = cells_after(*BUILD, "--until", "0.01%", "--min-samples", "9", "--max-samples", "100000", "--time-budget", "0.2")
    assert cell["sampling"]["stopped"] in ("budget", "noisy")
    experiment("until.json", scenes=["soup:500"], builders=["perfect"], until=0.9, caches="cold",
               pipelines=[{"builder": "karras", "collider": "leaf"}])
    for cell in cells_after("run", "until.json"):
        assert cell["sampling"]["caches"] == "cold" and cell["sampling"]["until"] == 0.9, cell
    assert all(len(cell["samples"]) == 2 for cell in cells_after("run", "until.json", "--samples", "2"))


def test_joules_are_counted_where_a_counter_moves() -> None:
    package, begun, is_over = pathlib.Path("power/intel-rapl:0"), time.monotonic(), threading.Event()
    package.mkdir(parents=True)
    for name, text in (("name", "package-0"), ("max_energy_range_uj", "24000000"), ("energy_uj", "0")):
        (package / name).write_text(text)
    shutil.copytree(package, "power/intel-rapl:1")
    pathlib.Path("power/intel-rapl:1/name").write_text("psys")

    def count() -> None:  # 40 W; it begins at 0 again every 0.6 s
        while not is_over.wait(0.01):
            (package / "next").write_text(str(int(40e6 * (time.monotonic() - begun)) % 24000000))
            os.replace(package / "next", package / "energy_uj")

    threading.Thread(target=count, daemon=True).start()
    counters = cells_after(*BUILD, "--device", "cpu", "--energy", "0.5", BVHBENCH_POWERCAP="power")[0]["counters"]
    is_over.set()
    assert 25 < counters["energy_watts"] < 60 and 40e-5 < counters["energy_joules"] < 4, counters
    for folder, why in (("power", "stands still"), ("nowhere", "does not tell its energy: no package of intel-rapl in nowhere")):
        cell, = cells_after(*BUILD, "--device", "cpu", "--energy", "0.1", BVHBENCH_POWERCAP=folder)
        assert why in cell["left_out"]["energy_joules"] and "energy_joules" not in cell["counters"], cell


def test_what_makes_no_sense_is_refused() -> None:
    expect(2, *BUILD, "--until", "2%", "--samples", "9", says="--samples")
    expect(2, *BUILD, "--until", "2", says="a share")
    expect(2, *BUILD, "--min-samples", "9", says="--until begins")
    expect(2, *BUILD, "--until", "2%", "--min-samples", "30", "--max-samples", "20", says="at most 20")
    expect(2, "run", "smoke", "--race", "fastest", says="no race is called 'fastest'; there are: whole, query, memory")
    for turns in ("turns", "turns:1", ":2", "turns:x", "turns:99"):
        expect(2, "run", "smoke", "--turns", turns, says="--turns names a file and how many runs")


def test_cold_caches_are_emptied_before_each_sample() -> None:
    """Counts lines that the cache-emptying kernel is made to print, because the effect on times depends on the machine."""
    copied_kernels("kernels", "device/limits.cl", r"(kernel void walk\([^)]*\)\s*\{)",
                   r'\1 if (get_global_id(0) == 0) printf("walked\\n");')
    for words, times in (((), 0), (("--caches", "cold"), 1)):
        said = expect(0, *BUILD, "--samples", "5", "--kernels", "kernels", "--json", "a.json", "--force", *words)
        cell = only("a.json")
        assert cell["sampling"]["caches"] == ("cold" if words else "hot") and len(cell["samples"]) == 5
        # Before each sample and each of the 3 warm-up builds, and once when the buffer is created.
        assert said.count("walked\n") == times * (5 + 3 + 1), said


def test_each_kind_of_caches_has_cells_of_its_own() -> None:
    kinds = ["hot", "cold", "host"]
    experiment("kinds.json", scenes=[{"scene": "torus:3000", "objects": "one"}], builders=["oibvh-single"], samples=4,
               pipelines=[{"builder": "oibvh-single", "collider": "block", "narrow": "exact"}, {"collider": "brute"}], caches=kinds)
    cells = cells_after("run", "kinds.json")
    assert [cell["sampling"]["caches"] for cell in cells] == 3 * kinds
    assert all(len(cell["samples"]) == 4 and cell["check"]["verdict"] == "agrees" for cell in cells)
    for cell in cells:
        for sample in cell["samples"]:
            names = [stage["stage"] for stage in sample["stages"]]
            copies = {name: name in names for name in ("upload", "read_back")}
            is_frame, is_host = cell["operation"] == "collide", cell["sampling"]["caches"] == "host"
            if cell["builder"]["name"] == "none":  # brute force on the host has nothing to copy
                assert names == ["broad"] and sample["wall_ns"] >= sample["stages"][0]["wall_ns"]
                continue
            assert copies == {"upload": is_host, "read_back": is_host and is_frame}, (cell["collider"], copies)
            if is_host:
                assert names[0] == "upload" and (names[-1] == "read_back") == is_frame
                assert sample["wall_ns"] >= sum(stage.get("wall_ns", 0) + stage.get("busy_ns", 0) for stage in sample["stages"])
    assert [cell["sampling"]["caches"] for cell in cells_after("run", "kinds.json", "--caches", "host")] == 3 * ["host"]
    expect(2, "run", "kinds.json", "--caches", "warm", says="no state of caches is called 'warm'; there are: hot, cold, host")
    expect(2, "run", "kinds.json", "--race", "whole", says="--caches: a race is with hot or with cold ones")


def test_processes_are_told_apart_in_one_file() -> None:
    for process in range(3):
        expect(0, *BUILD, "--samples", "9", "--json", f"process-{process}.json")
    files = [f"process-{process}.json" for process in range(3)]
    expect(0, "merge", "--processes", *files, "-o", "joined.json", says="1 cell of 3 runs")
    cell = only("joined.json")
    assert [sample["process"] for sample in cell["samples"]] == [0] * 9 + [1] * 9 + [2] * 9
    expect(0, "show", "joined.json", says="27 samples of 3 processes")
    expect(2, "merge", *files, "-o", "two.json", says="not the same of it")


def test_runs_by_turns_know_each_other_and_are_of_one_time() -> None:
    few = experiment("few.json", scenes=["torus:3000", "soup:500"], builders=["perfect", "karras"], samples=20)
    runs = [subprocess.Popen([PROGRAM, "run", few, "--out", f"{name}.json", "--force", "--turns", "turns:2"],
                             stdout=subprocess.DEVNULL) for name in ("a", "b")]
    assert [run.wait(timeout=PATIENCE_S) for run in runs] == [0, 0]
    a, b = valid("a.json"), valid("b.json")
    assert a["run"]["turns_with"] == [b["run"]["id"]] and b["run"]["turns_with"] == [a["run"]["id"]]
    assert len(pathlib.Path("turns").read_text().splitlines()) == 8  # two runs, two scenes, each with a line at its start and end
    for document in (a, b):
        assert all(len(cell["samples"]) == 20 for cell in document["cells"])
        assert statistics.median(sample["order"] for cell in document["cells"] for sample in cell["samples"]) > 20
    expect(2, "run", "few.json", "--out", "c.json", "--turns", "turns:2", says="has been used by others")


sys.exit(main(globals()))
