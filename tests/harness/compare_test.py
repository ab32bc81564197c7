#!/usr/bin/env python3
"""What `compare` says of files that the program wrote: runs of one build, a slowed builder, changed counters.

Usage: compare_test.py <bvhbench> <result schema>
"""
import copy
import json
import pathlib
import statistics
import sys

from program import expect, main, run, valid

EXPERIMENT = {"experiment": "trial", "scenes": ["torus:3000"], "builders": ["perfect", "karras", "oibvh-multi"],
              "samples": 100, "warm_up": 2}


def measured(name: str, **environment: str) -> dict:
    pathlib.Path("trial.json").write_text(json.dumps(EXPERIMENT))
    expect(0, "run", "trial.json", "--out", name, **environment)
    return valid(name)


def written(name: str, document: dict) -> str:
    document["run"]["program"]["dirty"] = False  # the working tree may be
    pathlib.Path(name).write_text(json.dumps(document))
    return name


def compared(code: int, *words: str, says: str = "") -> str:
    done = run("compare", *words)
    assert done.returncode == code and says in done.stdout and not done.stderr, (words, done)
    return done.stdout


def steady(document: dict, **slower: float) -> dict:
    """As a quiet machine would have measured it, so that verdicts do not depend on what else runs beside the test: each
    sample a cell's first one, to a per cent, some builders' longer by a factor."""
    document = copy.deepcopy(document)
    for each in document["cells"]:
        first = copy.deepcopy(each["samples"][0])
        for k, sample in enumerate(each["samples"]):
            longer = slower.get(each["builder"]["name"], 1) * (1 + (k * 37 % 101 - 50) / 5000)
            sample["calibration_ns"] = first["calibration_ns"]
            sample["stages"] = [{**stage, **{key: round(stage[key] * longer) for key in ("busy_ns", "span_ns", "start_ns")}}
                                for stage in first["stages"]]
    return document


def median_ns(document: dict, builder: str) -> float:
    return statistics.median(sum(stage["busy_ns"] for stage in sample["stages"])
                             for sample in cell(document, builder)["samples"])


def cell(document: dict, builder: str) -> dict:
    return next(cell for cell in document["cells"] if cell["builder"]["name"] == builder)


def test_a_file_is_the_same_as_itself() -> None:
    written("measured.json", measured("a.json"))
    assert "no regression" in compared(0, "measured.json", "measured.json")  # however unsteady the machine was
    written("a.json", steady(valid("a.json")))
    said = compared(0, "a.json", "a.json", says="3 SAME, 0 FASTER, 0 SLOWER")
    assert "no regression" in said and "karras" not in said, said
    assert "karras" in compared(0, "a.json", "a.json", "--all")


def test_a_builder_that_takes_a_tenth_longer_is_found_and_is_no_result() -> None:
    slow = measured("slow.json", BVHBENCH_SLOW="karras:30")
    assert slow["run"]["test_hooks"] == {"BVHBENCH_SLOW": "karras:30"}
    assert median_ns(slow, "karras") > 3 * median_ns(valid("measured.json"), "karras")
    tenth = steady(valid("a.json"), karras=1.1)
    tenth["run"]["test_hooks"] = slow["run"]["test_hooks"]
    written("slow.json", tenth)
    expect(2, "compare", "a.json", "slow.json", says="it is no result")
    said = compared(1, "a.json", "slow.json", "--test-hooks", says="karras")
    line = next(line for line in said.splitlines() if "torus:3000: karras" in line)
    assert line.endswith("SLOWER"), said
    assert "1 regression\n" in said and "2 SAME" in said, said
    assert "NO RESULT" in expect(0, "show", "slow.json")
    said = compared(0, "slow.json", "a.json", "--test-hooks")
    assert next(line for line in said.splitlines() if "torus:3000: karras" in line).endswith("FASTER"), said
    assert "3 SAME" in compared(0, "a.json", "slow.json", "--test-hooks", "--threshold", "30%")


def test_a_hook_that_cannot_be_read_is_refused_and_none_may_tune() -> None:
    for value in ("karras", "karras:", "karras:0", "karras:x", ":2", "karras:2:3", "karras:1e9"):
        expect(2, "build", "--builder", "karras", "--scene", "soup:9", says="BVHBENCH_SLOW", BVHBENCH_SLOW=value)
    expect(2, "tune", "sort", "--scene", "soup:99", says="BVHBENCH_SLOW", BVHBENCH_SLOW="sort:2")


def test_changed_counters_and_verdicts_are_found() -> None:
    before = valid("a.json")
    for counter, change in (("sah_cost", 1e-9), ("tree_bytes", 24), ("nodes_count", 1), ("depth_max", 1)):
        after = copy.deepcopy(before)
        cell(after, "karras")["counters"][counter] += change
        compared(1, "a.json", written("b.json", after), says=f"REGRESSION torus:3000: karras: {counter} ")
    after = copy.deepcopy(before)
    cell(after, "karras")["counters"]["sah_cost"] -= 1e-9
    compared(0, "a.json", written("b.json", after), says="changed torus:3000: karras: sah_cost")
    after = copy.deepcopy(before)
    cell(after, "karras")["check"] = {"verdict": "differs", "detail": "box 7"}
    compared(1, "a.json", written("b.json", after), says="karras: differs (box 7), was agrees")
    after = copy.deepcopy(before)
    after["cells"].remove(cell(after, "karras"))
    compared(1, "a.json", written("b.json", after), says="REGRESSION torus:3000: karras: not in B")
    compared(0, "a.json", "b.json", "--allow-missing", says="torus:3000: karras: not in B")


def test_another_number_of_pairs_is_found() -> None:
    expect(0, "collide", "--collider", "leaf", "--scene", "soup:500", "--samples", "1", "--json", "pairs.json")
    before = valid("pairs.json")
    written("pairs.json", before)
    for change in (-1, 1):
        after = copy.deepcopy(before)
        after["cells"][0]["counters"]["pairs_count"] += change
        compared(1, "pairs.json", written("b.json", after), says="pairs_count")


def test_what_cannot_be_compared_is_refused_in_a_sentence() -> None:
    before = valid("a.json")
    for keys, value, says in ((("run", "program", "dirty"), True, "no commit has"),
                              (("run", "device", "name"), "another", "--other-devices"),
                              (("run", "node_costs", "inner"), 2, "sah_cost"),
                              (("format",), "1.3", "before 1.4"), (("cells",), [], "no cells")):
        after = copy.deepcopy(before)
        written("b.json", after)
        inner = after
        for key in keys[:-1]:
            inner = inner[key]
        inner[keys[-1]] = value
        pathlib.Path("b.json").write_text(json.dumps(after))
        expect(2, "compare", "a.json", "b.json", says=says)
    after["cells"], after["format"] = before["cells"], "2.0"
    pathlib.Path("b.json").write_text(json.dumps(after))
    expect(3, "compare", "a.json", "b.json", says="format 2.0")
    expect(3, "compare", "a.json", "nowhere.json", says="nowhere.json")
    for threshold in ("-1%", "five", "5%%", "nan", ""):
        expect(2, "compare", "a.json", "a.json", "--threshold", threshold, says="a share")
    assert run("compare", "a.json").returncode == 2


sys.exit(main(globals()))
