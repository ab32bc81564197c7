#!/usr/bin/env python3
"""Tests that a new cell option changes at most three files, and that result files can be read with it.

Usage: new_option_test.py <source root> <folder with the changed files>"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

MOST_FILES = 3
TOLD = """
from plots.read import cells
raw = {"experiment": "e", "scene": {"name": "s"}, "builder": {"name": "b", "options": {}}, "status": "measured"}
other = raw | {"builder": {"name": "b", "options": {"bins": 8}}}
usual = raw | {"builder": {"name": "b", "options": {"bins": 32}}}
assert cells.identity(raw) == cells.identity(usual) != cells.identity(other)
assert cells.Cell(other).label == "s: b, 8 bins" and cells.Cell(usual).label == "s: b", cells.Cell(other).label
"""


def main() -> int:
    root, example = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    changed = [path.relative_to(example) for path in example.rglob("*") if path.is_file()]
    assert len(changed) <= MOST_FILES, changed
    with tempfile.TemporaryDirectory() as folder:
        plots = pathlib.Path(folder, "plots")
        shutil.copytree(root / "plots", plots, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(example / "plots" / "words" / "names.py", plots / "words")
        subprocess.run([sys.executable, "-c", TOLD], cwd=folder, check=True)
    print(f"an option more: {len(changed)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
