#!/usr/bin/env python3
"""Tests that the program with the changes of docs/adding-a-builder.md has the builder, and that the page's claims hold.

Usage: worked_example_test.py <bvhbench with the builder> <result schema> <folder of worked_example.py>"""
import pathlib
import shutil
import sys

from program import SOURCE, copied_kernels, expect, main, valid
from worked_example import files_of

NAME = "oibvh-levels"
FILES = files_of(SOURCE, "docs/adding-a-builder.md")
FOLDER = pathlib.Path(sys.argv[3]).resolve()


def bvhbench(*words: str, says: str = "", code: int = 0) -> str:
    """Runs the program with the source's kernels and the page's kernel."""
    if not pathlib.Path("kernels").exists():
        shutil.copytree(FOLDER, copied_kernels("kernels"), dirs_exist_ok=True)
    return expect(code, *words, "--kernels", "kernels", says=says)


def cells(*words: str) -> list[dict]:
    bvhbench(*words, "out.json", "--force")
    found = valid("out.json")["cells"]
    assert found and all(cell["check"]["verdict"] == "agrees" for cell in found), found
    return found


def test_it_was_built_with_what_the_page_says() -> None:
    for path, text in FILES.items():
        assert (FOLDER / path).read_text() == text, f"the program was built with another {path}"
        if path.endswith(".py"):
            compile(text, path, "exec")


def test_it_meets_its_contract() -> None:
    bvhbench("list", "builders", says=f"\n{NAME} ")
    bvhbench("check", "--builder", NAME, says="no violation")


def test_it_launches_a_kernel_a_level() -> None:
    for leaves in ("mesh", "sorted"):
        cell, = cells("build", "--builder", NAME, "--scene", "torus:3000", "--samples", "2", "--leaves", leaves, "--json")
        hierarchy, = (stage for stage in cell["samples"][0]["stages"] if stage["stage"] == "hierarchy")
        assert hierarchy["launches"] == 12, hierarchy  # 2,048 < 3,000 <= 4,096


def test_it_builds_several_trees_for_colliders() -> None:
    cells("collide", "--builder", NAME, "--collider", "leaf", "--scene", "n-body:6100:2", "--frames", "0:",
          "--pairs-of", "between", "--samples", "2", "--json")


def test_it_is_in_experiments_and_smoke() -> None:
    found = cells("run", str(FOLDER / "harness/experiments/smoke.json"), "--filter", f"/{NAME}$", "--out")
    assert {cell["builder"]["name"] for cell in found} == {NAME}


def test_who_forgets_a_box_is_found_out() -> None:
    kernel = pathlib.Path("kernels/oibvh/by_levels.cl")
    right, wrong = "merged(box, load_box(own, left + 1u))", "load_box(own, left + 1u)"
    assert right in kernel.read_text()
    kernel.write_text(kernel.read_text().replace(right, wrong))
    assert "differs" in bvhbench("build", "--builder", NAME, "--scene", "torus:3000", "--samples", "1", code=1)


sys.exit(main(globals()))
