#!/usr/bin/env python3
"""Runs docs/plugins.md: compiles its plug-in and runs its commands; compiles the header as C and as C++.

Usage: examples_test.py <bvhbench> <result schema> <C compiler> <C++ compiler>"""
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "harness"))
from ci_steps_test import steps  # noqa: E402
from program import PATIENCE_S, PROGRAM, SOURCE, main, valid  # noqa: E402

CC, CXX = sys.argv[3:5]
PAGE = (SOURCE / "docs/plugins.md").read_text()
INCLUDE = SOURCE / "plugins/include"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def printed(commands: str) -> str:
    """Runs a block of the page in a shell, where bvhbench is the program."""
    pathlib.Path("bin").mkdir(exist_ok=True)
    link = pathlib.Path("bin/bvhbench")
    link.unlink(missing_ok=True)
    link.symlink_to(PROGRAM)
    commands = re.sub(r"^cc ", f"{CC} ", commands.replace("BVHBENCH", str(SOURCE)), flags=re.MULTILINE)
    commands = commands.replace("examples/plugins/", f"{SOURCE}/examples/plugins/")
    done = subprocess.run(["sh", "-ec", commands], capture_output=True, text=True, timeout=PATIENCE_S,
                          env={**os.environ, "PATH": f"{os.getcwd()}/bin:{os.environ['PATH']}"})
    assert done.returncode == 0 and not done.stderr, done
    return done.stdout


def test_the_pages_plugin_in_c_has_a_verified_row():
    source, = blocks("c")
    assert sum(bool(line.strip()) for line in source.splitlines()) < 50
    pathlib.Path("mine.c").write_text(source)
    text = printed(blocks("sh")[0])
    assert "\nmine " in text and "mine, from outside: Mine 0.1 (MIT) by libmine.so, on host" in text, text
    cells = {cell["collider"]["name"]: cell for cell in valid("mine.json")["cells"]}
    assert list(cells) == ["mine", "brute", "grid"]
    assert all(cell["check"]["verdict"] == "agrees" and cell["samples"] for cell in cells.values()), cells


def test_the_workflow_of_a_plugins_repository_judges_it():
    os.makedirs("repository/bvhbench")
    os.symlink(PROGRAM, "repository/bvhbench/bvhbench")
    os.symlink(SOURCE / "plugins", "repository/bvhbench/plugins")
    source, = blocks("c")
    for right, wrong in (("", ""), ("state)->count, *two", "state)->count - 1, *two")):
        pathlib.Path("repository/mine.c").write_text(source.replace(right, wrong))
        done = subprocess.run(["bash", "-ec", "\n".join(steps(0)).replace("cc ", f"{CC} ", 1)], cwd="repository", capture_output=True,
                              text=True, timeout=PATIENCE_S)
        assert done.returncode == bool(right), done
        assert ("1 missing: " in done.stdout) == bool(right), done


def test_the_program_in_numpy_has_a_verified_row():
    for scene in ("torus:2000", "cloth-ball:400:2 --swept"):
        text = printed(blocks("sh")[1].rstrip().replace("torus:2000", scene) + " --json numpy.json --force")
        assert "numpy-sweep, from outside: NumPy " in text, text
        for cell in valid("numpy.json")["cells"]:
            assert cell["check"]["verdict"] == "agrees" and cell["samples"], cell


def test_the_header_is_c99_and_cpp():
    for name, compiler, words in (("c", CC, ("-std=c99",)), ("cpp", CXX, ("-std=c++11",))):
        source = pathlib.Path(f"header.{name}")
        source.write_text("#include <bvhbench/plugin.h>\n#include <bvhbench/plugin.h>\nint used(bvhbench_tree *t) { return t->nodes > 0; }\n")
        subprocess.run([compiler, *words, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", source, "-I", INCLUDE, "-o", "header.o"], check=True)


sys.exit(main(globals()))
