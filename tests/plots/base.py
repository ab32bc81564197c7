"""Shared by tests of plots, which `python3 -m unittest NAME_test` runs in their folder: the source root, generated result files and runs,
and ways to run scripts."""
import copy
import functools
import importlib
import json
import os
import pathlib
import runpy
import subprocess
import sys
import tempfile
import traceback
import unittest
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOLDEN = ROOT / "tests" / "golden"
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # a memory file system, where fsync costs no time
ALL_CASES = os.environ.get("BVHBENCH_TESTS") == "all"  # .ci/nightly
sys.path[:0] = [str(ROOT), str(ROOT / "plots")]
Raw = dict[str, Any]


def golden(name: str) -> Raw:
    return json.loads((GOLDEN / f"{name}.json").read_text(encoding="utf-8"))


def stage(name: str, span_ns: int, moved_bytes: int = 0, **more: int) -> Raw:
    return {"stage": name, "busy_ns": span_ns - 10, "span_ns": span_ns, "launches": 2, "moved_bytes": moved_bytes, **more}


def cell(builder: str = "oibvh-multi", ns: int = 100000, **more: Any) -> Raw:
    """Returns a cell: the hierarchy of a tree over 144,046 triangles, in three samples."""
    return {"experiment": "table1", "scene": {"name": "bunny", "triangles": 144046}, "builder": {"name": builder}, "status": "measured",
            "samples": [{"order": 7 + place, "stages": [stage("hierarchy", ns + off, 50000000)]}
                        for place, off in enumerate((10000, 0, -10000))],
            "counters": {"nodes_count": 288100, "tree_bytes": 6914400, "scratch_bytes": 0},
            "check": {"verdict": "agrees", "against": "oibvh-reference", "tree_hash": "00000000000000ff"}, **copy.deepcopy(more)}


def document(*all_cells: Raw, **facts: Any) -> Raw:
    """Returns a result file with a copy rate of 1e12 bytes per second."""
    table1 = golden("table1")
    return {"format": table1["format"], "run": {**table1["run"], "copy_rate_bytes_per_s": 1e12, **facts},
            "cells": copy.deepcopy(list(all_cells))}


def run_of(*all_cells: Raw, **facts: Any) -> Any:
    from plots.read import results

    return results.Run(pathlib.Path("made.json"), document(*all_cells, **facts))


@functools.cache
def load_scripts() -> None:
    """Loads what scripts import, once for all their forks, and puts a small library in the place of plotly.js, which takes long to pack."""
    for name in ("figures.catalog", "page.report", "commands.compare", "commands.export", "commands.merge", "commands.plot", "commands.show"):
        importlib.import_module(f"plots.{name}")
    html = importlib.import_module("plots.page.html")
    html.plotly_file = lambda: html.PARTS / "theme.js"


def code_of_script() -> int:
    """Runs the script in sys.argv as the main program, and returns the exit code that the interpreter would give."""
    code = 1
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush(), sys.stderr.flush()
    return code


class InFolder(unittest.TestCase):
    """A test with a temporary folder and the golden file of Table 1."""

    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(dir=MEMORY)))
        self.document = golden("table1")

    def written(self, document: Raw, name: str = "table1.json") -> pathlib.Path:
        path = self.folder / name
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    def run_script(self, name: str, *arguments: object) -> subprocess.CompletedProcess:
        """Runs a file or folder of plots, named before its first words, as from a shell, but in a fork of this process, which has loaded it."""
        load_scripts()
        script, *words = name.split()
        command = [str(ROOT / "plots" / script), *words, *map(str, arguments)]
        with tempfile.TemporaryFile("w+", errors="surrogateescape") as out, tempfile.TemporaryFile("w+", errors="surrogateescape") as errors:
            sys.stdout.flush(), sys.stderr.flush()
            if (child := os.fork()) == 0:
                os.dup2(out.fileno(), 1)
                os.dup2(errors.fileno(), 2)
                sys.stdout, sys.stderr, sys.argv = open(1, "w", closefd=False), open(2, "w", closefd=False), command
                os._exit(code_of_script())
            status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            out.seek(0), errors.seek(0)
            return subprocess.CompletedProcess(command, status, out.read(), errors.read())

    def made(self, name: str, *arguments: object, code: int = 0) -> subprocess.CompletedProcess:
        """Runs a script. Tests its exit code, and that it prints no errors if the code is 0."""
        done = self.run_script(name, *arguments)
        self.assertEqual((done.returncode, done.stderr if code == 0 else ""), (code, ""), done)
        return done
