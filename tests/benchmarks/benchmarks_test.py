#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests bvhbench_benchmarks: the cells it lists, and that its times, counters and verdicts are those of `bvhbench run`.

Usage: benchmarks_test.py <bvhbench> <result schema> <bvhbench_benchmarks>
"""
import json
import os
import pathlib
import subprocess
import sys
from typing import Any

import jsonschema

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from program import SOURCE, copied_kernels, expect, experiment, main, valid

BENCHMARKS = pathlib.Path(sys.argv[3]).resolve()
SCHEMA = json.loads((SOURCE / "tests/google_benchmark.schema.json").read_text())
FUSED = "baselines/radix/apetrei_fused.cl"
FEW = ("--benchmark_min_time=0.0001",)
MIXED = {"scenes": ["bend:torus:2048"], "builders": ["oibvh-multi", {"name": "karras", "order": "hilbert30"}],
         "operations": ["build", "refit"],
         "pipelines": [{"builder": "oibvh-multi", "collider": ["leaf", "grid"], "adjacent": "drop", "narrow": "exact"}]}
NAMES = ["oibvh-multi", "oibvh-multi/refit", "karras/order:hilbert30", "karras/order:hilbert30/refit",
         "oibvh-multi/leaf/adjacent:drop/narrow:exact", "grid/adjacent:drop/narrow:exact"]


def benchmarks(code: int, *words: str, says: str = "", **environment: str) -> str:
    """Runs the program and returns its standard output. Tests the exit code, and that standard error holds `says`."""
    done = subprocess.run([BENCHMARKS, *words], capture_output=True, text=True, timeout=600, env={**os.environ, **environment})
    assert done.returncode == code and says in done.stderr, (words, done)
    return done.stdout


def measured(code: int, *words: str) -> list[dict[str, Any]]:
    """Runs the program and returns the rows of its JSON."""
    benchmarks(code, *words, "--benchmark_out=out.json", "--benchmark_out_format=json", "--force")
    document = json.loads(pathlib.Path("out.json").read_text())
    jsonschema.Draft202012Validator(SCHEMA).validate(document)
    return document["benchmarks"]


def cells_of(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [row for row in rows if row["run_type"] == "iteration"]


def listed(*words: str) -> list[str]:
    """Returns the names of the cells listed where there is no device."""
    names = benchmarks(0, *words, "--benchmark_list_tests", OCL_ICD_VENDORS="/nowhere").splitlines()
    assert len(set(names)) == len(names) and any(name.startswith("host/") for name in names), names
    assert all(name.endswith("/manual_time") for name in names if not name.startswith("host/")), names
    return [name.removesuffix("/manual_time") for name in names if not name.startswith("host/")]


def test_all_cells_of_an_experiment_are_listed_without_a_device() -> None:
    told = json.loads((SOURCE / "harness/experiments/smoke.json").read_text())
    told["builders"].remove("outside")  # stands for what is from outside: nothing here
    told["pipelines"] = [one for one in told["pipelines"] if "outside" not in (one.get("builder"), one["collider"])]
    pipelines = sum(len(one.get("builder", ["none"]) if isinstance(one.get("builder", []), list) else ["one"])
                    * (len(one["collider"]) if isinstance(one["collider"], list) else 1) for one in told["pipelines"])
    names = listed()
    assert len(names) == len(told["scenes"]) * (len(told["builders"]) + pipelines), names
    assert "smoke/torus:2048/oibvh-multi/leaf/adjacent:drop/narrow:exact/whole" in names
    assert sorted(listed("--experiment", experiment("mixed.json", **MIXED))) == sorted(
        f"test/bend:torus:2048/{name}/whole" for name in NAMES)
    assert listed("--experiment", experiment("one.json", scenes=["soup:5"], builders=["perfect"], stages=["hierarchy"])) == [
        "test/soup:5/perfect/hierarchy"]
    swept = {"scenes": [{"scene": "bend:torus:300", "swept": True}], "pipelines": [{"builder": "perfect", "collider": "leaf"}]}
    assert listed("--experiment", experiment("swept.json", **swept)) == [
        f"test/bend:torus:300/swept:true/perfect/leaf/pairs_of:{among}/adjacent:drop/whole" for among in ("between", "within")]
    for path in (SOURCE / "harness/experiments").glob("*.json"):
        assert listed("--experiment", path.stem)


def test_counters_and_verdicts_are_those_of_a_run() -> None:
    experiment("mixed.json", **MIXED)
    expect(0, "run", "mixed.json", "--out", "run.json")
    rows = measured(0, "--experiment", "mixed.json", "--benchmark_filter=^test/", "--benchmark_repetitions=2",
                    "--benchmark_enable_random_interleaving=true", *FEW)
    cells = valid("run.json")["cells"]
    assert len(cells) == len(NAMES) and len(cells_of(rows)) == 2 * len(NAMES)
    for cell in cells:
        words = [cell["builder"]["name"], cell.get("collider", {}).get("name", "")]
        same = [row for row in cells_of(rows) if ("refit" == cell["operation"]) == ("/refit/" in row["name"])
                and [word for word in words if word not in ("", "none")] == [
                    part for part in row["name"].split("/") if part in ("oibvh-multi", "karras", "leaf", "grid")]]
        assert len(same) == 2, (words, same)
        for row in same:
            counters = {key: count for key, count in cell["counters"].items() if not key.endswith("_ns")}
            assert {key: row[key] for key in counters} == counters and set(cell["counters"]) <= set(row), (row, cell)
            assert row["label"] == cell["check"]["verdict"] == "agrees"
            stages = {f"{stage['stage']}_ns" for stage in cell["samples"][0]["stages"]}
            assert stages <= set(row) and 1000 * row["real_time"] >= 0.999 * sum(row[stage] for stage in stages), row
    assert {row["aggregate_name"] for row in rows if row["run_type"] == "aggregate"} == {"mean", "median", "stddev", "cv"}


def test_the_time_of_one_stage() -> None:
    row, = measured(0, "--benchmark_filter=torus:2048/oibvh-multi/hierarchy", "--stage", "hierarchy", *FEW)
    assert abs(1000 * row["real_time"] - row["hierarchy_ns"]) < 1e-3 * row["hierarchy_ns"], row
    row, = measured(4, "--benchmark_filter=torus:2048/oibvh-multi/gather", "--stage", "gather", *FEW)
    assert row["error_message"].startswith("a sample has no stage 'gather'"), row


def test_what_is_wrong_or_missing_is_an_error_of_its_benchmark() -> None:
    kernels = copied_kernels("wrong", FUSED, r"at.box = merged\(at.box, (?=child_box\(leaf_boxes, ids, nodes, sibling\)\);)", "at.box = (")
    experiment("wrong.json", scenes=["soup:300", "missing.obj"], builders=["apetrei-fused", "oibvh-multi"])
    rows = measured(1, "--experiment", "wrong.json", "--kernels", kernels, "--benchmark_filter=^test/",
                    "--benchmark_repetitions=2", *FEW)
    for name, error in (("soup:300/apetrei-fused", "the result is wrong: "), ("missing.obj/apetrei-fused", "missing.obj"),
                        ("missing.obj/oibvh-multi", "missing.obj")):
        same = [row for row in cells_of(rows) if row["name"].startswith(f"test/{name}/")]
        assert len(same) == 2 and all(row["error_occurred"] and error in row["error_message"] for row in same), same
    assert [row["label"] for row in cells_of(rows) if "soup:300/oibvh-multi" in row["name"]] == ["agrees", "agrees"]


def test_code_of_the_host_needs_no_device() -> None:
    benchmarks(0, "--benchmark_filter=^host/", "--benchmark_min_time=0.001", "--benchmark_out=host.json",
               OCL_ICD_VENDORS="/nowhere")
    rows = json.loads(pathlib.Path("host.json").read_text())["benchmarks"]
    assert len(rows) > 20 and all(row["label"] == "agrees" for row in rows), rows


def test_wrong_words_are_one_sentence() -> None:
    pathlib.Path("mine.json").write_text("kept")
    for code, words, says in ((2, ["--experiment", "no-such"], "no experiment is called 'no-such'"),
                              (2, ["--benchmark_filter=no-such"], "no benchmark matches 'no-such'"),
                              (2, ["--benchmark_filter=("], "--benchmark_filter"),
                              (2, ["--benchmark_no-such=1"], "'--benchmark_no-such=1' is no option of this program or of Google Benchmark"),
                              (2, ["--no-such"], "--no-such"),
                              (2, ["--benchmark_out=mine.json"], "mine.json"),
                              (3, ["--benchmark_filter=soup:1/", "--device", "no-such"], "no-such")):
        benchmarks(code, *words, says=says)
    assert pathlib.Path("mine.json").read_text() == "kept"
    told = benchmarks(0, "--help")
    assert all(word in told for word in ("--experiment", "--device", "--benchmark_repetitions")), told


sys.exit(main(globals()))
