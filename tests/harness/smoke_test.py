#!/usr/bin/env python3
"""Tests that `smoke` finds a wrong tree, a worse tree and a slower kernel, planted in kernels. CI itself runs `smoke` against the
repository's baseline. These tests write a baseline with unchanged kernels first."""
import json
import os
import pathlib
import sys

from program import SOURCE, copied_kernels, expect, main, run, valid

SOME = ("--filter", "torus:2048/(karras|apetrei|apetrei-fused|lbvh-levels|oibvh-wide4|fcl-aabb)$")
FUSED = "baselines/radix/apetrei_fused.cl"


def smoke(code: int, *words: str, says: str = "", baseline: str = "base.json") -> str:
    done = run("smoke", "--baseline", baseline, *words)
    assert done.returncode == code and says in done.stdout, (words, done)
    return done.stdout


def regressions(said: str) -> list[str]:
    return [line for line in said.splitlines() if line.startswith("REGRESSION ")]


def test_a_baseline_is_made_and_held() -> None:
    expect(3, "smoke", "--baseline", "base.json", says="there is no baseline 'base.json' to compare this run with")
    smoke(0, "--update", "--out", "smoke.json", says="written: base.json")
    result, base = valid("smoke.json"), json.loads(pathlib.Path("base.json").read_text())
    assert len(base["cells"]) == len(result["cells"]) == len({cell["cell"] for cell in base["cells"]})
    assert {cell["verdict"] for cell in base["cells"]} <= {"agrees", "skipped"}, base
    timed = [cell for cell in base["cells"] if "fastest_ns" in cell]
    assert len(timed) > 54 and not any("reference" in cell["cell"] for cell in timed), len(timed)
    smoke(0, *SOME, says="6 cells compared with the baseline, 5 times")
    kept = SOURCE / "results" / "baseline" / f"smoke-{base['device_kind']}.json"
    here, there = ({cell["cell"]: {key: cell[key] for key in ("verdict", "counters", "hashes")} for cell in cells["cells"]}
                   for cells in (base, json.loads(kept.read_text())))
    assert here.keys() == there.keys(), here.keys() ^ there.keys()
    for cell, facts in here.items():
        assert facts == there[cell], (cell, facts, there[cell])


def test_a_wrong_tree_is_found() -> None:
    folder = copied_kernels("wrong", FUSED, r"at.box = merged\(at.box, (?=child_box\(leaf_boxes, ids, nodes, sibling\)\);)", "at.box = (")
    said = smoke(1, *SOME, "--kernels", folder, says="REGRESSION torus:2048: apetrei-fused: differs, was agrees")
    assert all("apetrei-fused" in line for line in regressions(said)), said


def test_a_worse_tree_that_is_right_is_found() -> None:
    folder = copied_kernels("worse", "builders/stages/codes_chunks.cl", r"codes\[lane\] = above \| (code_of\(cell\) >> dropped);",
                            r"codes[lane] = above | (\1 & ~0xfffffu);")
    said = smoke(1, "--filter", "torus:2048/oibvh-wide4$", "--kernels", folder, says="torus:2048: oibvh-wide4: sah_cost ")
    assert "differs" not in said, said


def test_a_slower_kernel_is_found() -> None:
    spin = r"    for (volatile uint spin = 0u; spin < 20000u; ++spin)\n        ;\n\1"
    folder = copied_kernels("slow", FUSED, r"(        const Reached at = \{leaf, leaf, )", spin)
    found = regressions(smoke(1, *SOME, "--kernels", folder, says="torus:2048: apetrei-fused: takes "))
    assert len(found) == 1 and "times as long beside the others" in found[0], found


def test_a_test_hook_is_found_too_and_makes_no_baseline() -> None:
    os.environ["BVHBENCH_SLOW"] = "karras:100"
    try:
        assert "NO RESULT" in smoke(1, *SOME, says="torus:2048: karras: takes ")
        expect(2, "smoke", "--update", "--baseline", "none.json", "--filter", "x", says="--filter is not for it")
        expect(2, "smoke", "--update", "--baseline", "none.json", says="BVHBENCH_SLOW is set")
        assert not pathlib.Path("none.json").exists()
    finally:
        del os.environ["BVHBENCH_SLOW"]


def test_changed_facts_and_cells_of_one_side_are_found() -> None:
    base = json.loads(pathlib.Path("base.json").read_text())
    cells = {cell["cell"]: cell for cell in base["cells"]}
    cells["torus:2048: karras"]["counters"]["depth_max"] = 3
    cells["torus:2048: apetrei"]["hashes"]["tree"] = "0" * 16
    base["cells"].remove(cells["torus:2048: lbvh-levels"])
    pathlib.Path("doctored.json").write_text(json.dumps(base))
    found = regressions(smoke(1, *SOME, baseline="doctored.json", says="new: torus:2048: lbvh-levels: not in the baseline"))
    assert len(found) == 2 and "karras: depth_max" in "".join(found) and "apetrei: other tree" in "".join(found), found


def test_what_is_no_baseline_is_refused_in_a_sentence() -> None:
    for code, text, says in ((3, "{}", "no.json is no baseline of smoke"),
                             (2, '{"format": "smoke-1", "device_kind": "gpu", "cells": []}', "of a device of kind gpu")):
        pathlib.Path("no.json").write_text(text)
        expect(code, "smoke", "--baseline", "no.json", says=says)
    expect(2, "smoke", "--baseline", "base.json", "--filter", "nothing-like-this", says="no cell of smoke matches")


sys.exit(main(globals()))
