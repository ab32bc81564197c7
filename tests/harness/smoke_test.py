#!/usr/bin/env python3
"""`smoke` gates: a wrong tree, a worse tree and a slower kernel are planted in kernels, and each is found.

Usage: smoke_test.py <bvhbench> <result schema>

Kernels are read from a copy of the sources' (--kernels) in which a line is another. What is right is held to the baseline in
the repository by CI itself; here a baseline is made first, with the kernels as they are.
"""
import json
import os
import pathlib
import sys

from program import SCHEMA, copied_kernels, expect, main, run, valid

ROOT = SCHEMA.parent.parent.parent
SOME = ("--filter", "torus:2048/(karras|apetrei|apetrei-fused|lbvh-levels|oibvh-wide4|fcl-aabb)$")


def kernels(name: str, *changes: tuple[str, str, str]) -> str:
    """A folder of all kernel text, with `old` in a file replaced by `new`."""
    copied_kernels(name)
    for file, old, new in changes:
        path = pathlib.Path(name, file)
        text = path.read_text()
        assert text.count(old) == 1, (file, old)
        path.write_text(text.replace(old, new))
    return name


def smoke(code: int, *words: str, says: str = "") -> str:
    done = run("smoke", "--baseline", "base.json", *words)
    assert done.returncode == code and says in done.stdout, (words, done)
    return done.stdout


def regressions(said: str) -> list[str]:
    return [line for line in said.splitlines() if line.startswith("REGRESSION ")]


def test_a_baseline_is_made_and_held() -> None:
    expect(3, "smoke", "--baseline", "base.json", says="there is no baseline 'base.json' to hold this run to")
    smoke(0, "--update", "--out", "smoke.json", says="written: base.json")
    result, base = valid("smoke.json"), json.loads(pathlib.Path("base.json").read_text())
    assert len(base["cells"]) == len(result["cells"]) == len({cell["cell"] for cell in base["cells"]})
    assert {cell["verdict"] for cell in base["cells"]} <= {"agrees", "skipped"}, base
    timed = [cell for cell in base["cells"] if "fastest_ns" in cell]
    assert len(timed) > 54 and not any("reference" in cell["cell"] for cell in timed), len(timed)
    smoke(0, *SOME, says="6 cells held to the baseline, 5 times")


def test_what_is_kept_is_the_same_in_the_repositorys_baseline() -> None:
    base = json.loads(pathlib.Path("base.json").read_text())
    kept = ROOT / "results" / "baseline" / f"smoke-{base['device_kind']}.json"
    here, there = ({cell["cell"]: {key: cell[key] for key in ("verdict", "counters", "hashes")} for cell in cells["cells"]}
                   for cells in (base, json.loads(kept.read_text())))
    assert here.keys() == there.keys(), here.keys() ^ there.keys()
    for cell, facts in here.items():
        assert facts == there[cell], (cell, facts, there[cell])


def test_a_wrong_tree_is_found() -> None:
    folder = kernels("wrong", ("baselines/radix/apetrei_fused.cl", "box = merged(box, child_box(", "box = (child_box("))
    text = pathlib.Path(folder, "baselines/radix/apetrei_fused.cl").read_text()
    assert "box = (child_box(leaf_boxes, ids, nodes, sibling));" in text
    said = smoke(1, *SOME, "--kernels", folder, says="REGRESSION torus:2048: apetrei-fused: differs, was agrees")
    assert all("apetrei-fused" in line for line in regressions(said)), said


def test_a_worse_tree_that_is_right_is_found() -> None:
    coarse = "(code_of(cell) >> dropped & ~0xfffffu)"
    folder = kernels("worse", ("builders/stages/codes_chunks.cl",
                               "codes[lane] = above | code_of(cell) >> dropped;", f"codes[lane] = above | {coarse};"))
    said = smoke(1, "--filter", "torus:2048/oibvh-wide4$", "--kernels", folder, says="torus:2048: oibvh-wide4: sah_cost ")
    assert "differs" not in said, said


def test_a_slower_kernel_is_found() -> None:
    start = "    uint first = leaf, last = leaf;\n"
    spin = "    for (volatile uint spin = 0u; spin < 20000u; ++spin)\n        ;\n"
    folder = kernels("slow", ("baselines/radix/apetrei_fused.cl", start, spin + start))
    said = smoke(1, *SOME, "--kernels", folder, says="torus:2048: apetrei-fused: takes ")
    found = regressions(said)
    assert len(found) == 1 and "times as long beside the others" in found[0], said
    smoke(0, *SOME, "--kernels", folder, "--tolerance", "1e9")


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
    cell = next(cell for cell in base["cells"] if cell["cell"] == "torus:2048: karras")
    for key, name, value in (("counters", "depth_max", 3), ("counters", "nodes_count", 1), ("counters", "gone_count", 1),
                             ("hashes", "tree", "0" * 16)):
        kept = cell[key].get(name)
        cell[key][name] = value
        pathlib.Path("doctored.json").write_text(json.dumps(base))
        done = run("smoke", *SOME, "--baseline", "doctored.json")
        assert done.returncode == 1 and len(regressions(done.stdout)) == 1 and "karras" in done.stdout, done
        cell[key].pop(name) if kept is None else cell[key].update({name: kept})
    base["cells"].remove(cell)
    pathlib.Path("doctored.json").write_text(json.dumps(base))
    done = run("smoke", *SOME, "--baseline", "doctored.json")
    assert done.returncode == 1 and "torus:2048: karras: is not in the baseline" in done.stdout, done


def test_what_is_no_baseline_is_refused_in_a_sentence() -> None:
    pathlib.Path("no.json").write_text("{}")
    expect(3, "smoke", "--baseline", "no.json", says="no.json is no baseline of smoke")
    pathlib.Path("no.json").write_text('{"format": "smoke-2", "device_kind": "cpu", "cells": []}')
    expect(3, "smoke", "--baseline", "no.json", says='has format "smoke-2"')
    pathlib.Path("no.json").write_text('{"format": "smoke-1", "device_kind": "gpu", "cells": []}')
    expect(2, "smoke", "--baseline", "no.json", says="of a device of kind gpu")
    expect(2, "smoke", "--baseline", "base.json", "--filter", "nothing-like-this", says="no cell of smoke matches")


sys.exit(main(globals()))
