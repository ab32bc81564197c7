#!/usr/bin/env python3
"""Tests the output and exit codes of `compare` for files that the program wrote: a run and itself, a slowed builder, changed
facts. How times and facts are judged is tested in tests/plots/comparing_test.py."""
import json
import pathlib
import statistics
import sys

from program import expect, experiment, main, run, valid


def written(name: str, document: dict) -> str:
    document["run"]["program"]["dirty"] = False  # the working tree may have changes
    pathlib.Path(name).write_text(json.dumps(document))
    return name


def measured(name: str, **environment: str) -> dict:
    plan = experiment("trial.json", scenes=["torus:3000"], builders=["perfect", "karras", "oibvh-multi"], samples=20, warm_up=2)
    expect(0, "run", plan, "--out", name, **environment)
    return valid(written(name, valid(name)))


def compared(code: int, *words: str, says: str = "") -> str:
    done = run("compare", *words)
    assert done.returncode == code and says in done.stdout and not done.stderr, (words, done)
    return done.stdout


def test_a_file_is_the_same_as_itself() -> None:
    measured("a.json")
    assert "karras" not in compared(0, "a.json", "a.json", says="unsure: of 3 cells none has a verdict")  # however unsteady the machine was
    assert "karras" in compared(0, "a.json", "a.json", "--all")


def test_a_slowed_builder_is_found_and_is_no_result() -> None:
    slow = measured("slow.json", BVHBENCH_SLOW="karras:30")
    assert slow["run"]["test_hooks"] == {"BVHBENCH_SLOW": "karras:30"}
    expect(2, "compare", "a.json", "slow.json", says="it is no result")
    assert "NO RESULT" in expect(0, "show", "slow.json")
    assert "karras" in run("compare", "a.json", "slow.json", "--test-hooks", "--all").stdout
    before, after = (statistics.median(sum(stage["busy_ns"] for stage in sample["stages"]) for sample in document["cells"][1]["samples"])
                     for document in (valid("a.json"), slow))
    assert after > 3 * before, (before, after)


def test_a_hook_that_cannot_be_read_is_refused_and_none_may_tune() -> None:
    for value in ("karras", "karras:", "karras:0", "karras:x", ":2", "karras:2:3", "karras:1e9"):
        expect(2, "build", "--builder", "karras", "--scene", "soup:9", says="BVHBENCH_SLOW", BVHBENCH_SLOW=value)
    expect(2, "tune", "sort", "--scene", "soup:99", says="BVHBENCH_SLOW", BVHBENCH_SLOW="sort:2")


def test_changed_facts_and_missing_cells_are_told_and_fail() -> None:
    for change, code, says, *words in (
            (lambda cell: cell["counters"].update(sah_cost=1 + cell["counters"]["sah_cost"]), 1, "REGRESSION torus:3000: "),
            (lambda cell: cell["scene"].update(name="other"), 1, "not in B"),
            (lambda cell: cell["scene"].update(name="other"), 0, "not in B", "--allow-missing")):
        after = valid("a.json")
        change(after["cells"][0])
        compared(code, "a.json", written("b.json", after), *words, says=says)


def test_what_cannot_be_compared_is_refused_in_a_sentence() -> None:
    after = valid("a.json")
    after["run"]["device"]["name"] = "another"
    expect(2, "compare", "a.json", written("b.json", after), says="--other-devices")
    after["format"] = "2.0"
    expect(3, "compare", "a.json", written("b.json", after), says="format 2.0")
    expect(3, "compare", "a.json", "nowhere.json", says="nowhere.json")
    for threshold in ("-1%", "five", "5%%", "nan", ""):
        expect(2, "compare", "a.json", "a.json", "--threshold", threshold, says="a share")
    assert run("compare", "a.json").returncode == 2


sys.exit(main(globals()))
