#!/usr/bin/env python3
"""Tests `tune`, and files of tuned values.

Usage: tune_test.py <bvhbench> <result schema>"""
import json
import pathlib
import sys

from program import expect, main, run, valid


def tuned_file(folder: str, **values: int) -> pathlib.Path:
    """Writes a tuning file for the present device into a folder."""
    device = expect(0, "list", "devices").splitlines()[0].split("  ")[0].split("/", 1)[1]
    slug = "-".join(filter(None, "".join(c if c.isascii() and c.isalnum() else " " for c in device.lower()).split(" ")))
    path = pathlib.Path(folder, f"{slug}.json")
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps({"format": "tuning 1", "device": device, "values": {
        name.replace("__", "."): {"value": value} for name, value in values.items()}}))
    return path


def test_tune_searches_checks_and_writes_what_is_then_used():
    tune = ("tune", "--scene", "torus:2000", "--quick", "--samples", "3", "--out", "tuned/t.json")
    pathlib.Path("tuned").mkdir()
    for target, parameter in (("sort", "sort.chunk_digit_bits"), ("oibvh-multi", "chunks.per_core"), ("leaf", "walk.task_leaves")):
        out = expect(0, *tune, target, says=f"tuned: {target} over torus:2000")
        assert f"\n{parameter} " in out and " current\n" in out, out
        file = json.loads(pathlib.Path("tuned/t.json").read_text())
        assert set(file) == {"format", "device", "driver", "values"}, file
        kept = {line.split()[0] for line in out.splitlines() if line.endswith("better, kept")}
        assert {name for name in file["values"] if file["values"][name]["target"] == target} <= kept, (file, out)
    expect(2, *tune, "sotr", says="nothing that could be tuned is called 'sotr'; did you mean 'sort'?")
    expect(2, *tune, "median-split", says="there is nothing to tune")
    expect(2, "tune", "sort", says="--scene is required")
    expect(2, *tune, "sort", "--samples", "2", says="--samples")


def test_tuned_values_are_used_named_and_turned_off():
    path = tuned_file("mine", sort__chunk_digit_bits=7, chunks__per_core=2)
    build = ("build", "--builder", "oibvh-multi", "--scene", "soup:3000", "--samples", "1", "--json", "t.json", "--force")

    def launches(*words: str, **environment: str) -> tuple[int, dict]:
        expect(0, *build, *words, says="verdict: agrees", **environment)
        result = valid("t.json")
        stages = result["cells"][0]["samples"][0]["stages"]
        return next(s["launches"] for s in stages if s["stage"] == "sort"), result["run"]["tuning"]

    values = {"chunks.per_core": 2, "sort.chunk_digit_bits": 7}
    assert launches("--tuning", "mine") == (12, {"from": str(path), "values": values})
    assert launches(BVHBENCH_TUNING="mine") == (12, {"from": str(path), "values": values})
    none = (9, {"from": "none", "values": {}})
    assert launches("--tuning", "", BVHBENCH_TUNING="mine") == none
    assert launches(BVHBENCH_TUNING="") == none
    shown = expect(0, "list", "tuning", "--tuning", "mine")
    row = next(line for line in shown.splitlines() if line.startswith("sort.chunk_digit_bits "))
    assert row.split()[1:3] == ["7", str(path)], row
    rest = [line.split()[2] for line in shown.splitlines() if line.split()[0] not in values]
    assert set(rest) == {"default"} and len(rest) > 20, rest
    expect(0, *build, "--tuning", "mine", says="tuned by mine/")


def test_tuning_files_that_cannot_be_end_with_a_sentence():
    build = ("build", "--builder", "oibvh-multi", "--scene", "soup:30", "--samples", "1", "--tuning")
    expect(3, *build, "nowhere", says="tuning: there is no folder 'nowhere'")
    path = tuned_file("bad", sort__group_size=48)
    expect(3, *build, "bad", says=f"{path}: sort.group_size must be a power of two, not 48")
    expect(3, "tune", "sort", "--scene", "soup:30", "--out", str(path), says="must be a power of two")
    tuned_file("bad", sort__speed=1)
    done = run(*build, "bad")
    assert done.returncode == 0 and "no parameter is called 'sort.speed', and its value is not used" in done.stderr, done
    path.write_text("{")
    expect(3, *build, "bad", says=f"{path}: ")
    path.write_text(json.dumps({"format": "tuning 1", "device": "another", "values": {"chunks.per_core": {"value": 2}}}))
    expect(3, *build, "bad", says="its values are of 'another', and the device is '")


if __name__ == "__main__":
    sys.exit(main(globals()))
