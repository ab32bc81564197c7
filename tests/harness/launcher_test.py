#!/usr/bin/env python3
"""Tests the launcher in read-only folders and in folders with unusual paths. Nothing is built here: the checkout is a copy of the
launcher with a program that prints its words."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from program import PATIENCE_S, PROGRAM, SOURCE, main

LAUNCHER = SOURCE / "bvhbench"
NOBODY = 65534


def checkout(name: str, built: bool = True) -> pathlib.Path:
    root = pathlib.Path(name).resolve()
    (root / "harness").mkdir(parents=True)
    (root / "cmake").mkdir()
    shutil.copy(SOURCE / "cmake/inputs.regex", root / "cmake")
    os.utime(root / "cmake/inputs.regex", (0, 0))
    shutil.copy(LAUNCHER, root)
    (root / "packages.txt").write_text("")
    (root / "harness" / "main.cpp").write_text("")
    if built:
        program = root / "build/release/harness/bvhbench"
        program.parent.mkdir(parents=True)
        program.write_text('#!/bin/sh\necho "ran: $*"\n')
        program.chmod(0o755)
        (root / "build/built").write_text("")
        (root / "build/lock").write_text("")
    return root


def call(root: pathlib.Path, *words: str) -> subprocess.CompletedProcess:
    """Runs the launcher as a user without write permission."""
    os.chmod(".", 0o755)
    other = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
    paths = [root, *root.rglob("*")]
    for path in paths:
        path.chmod(path.stat().st_mode & ~0o222)
    try:
        return subprocess.run([root / "bvhbench", *words], capture_output=True, text=True, timeout=PATIENCE_S, **other)
    finally:
        for path in paths:
            path.chmod(path.stat().st_mode | 0o200)


def refused(done: subprocess.CompletedProcess, sentence: str) -> None:
    assert done.returncode == 3 and not done.stdout and done.stderr.count("\n") == 1, done
    assert done.stderr.startswith("bvhbench: ") and sentence in done.stderr, done


def test_who_may_not_write_runs_what_is_built():
    root = checkout("built")
    done = call(root, "list", "a b")
    assert (done.returncode, done.stdout, done.stderr) == (0, "ran: list a b\n", ""), done
    source = root / "harness" / "main.cpp"
    os.utime(root / "build/built", (1, 1))
    refused(call(root, "list"), f"what is built in {root} is not up to date, and this user may not write there")
    os.utime(source, (0, 0))
    (root / "best.json").write_text("")  # newer, but no build reads it
    os.utime(root / "bvhbench", (2, 2))
    assert call(root, "list").returncode == 0
    refused(call(root, "test"), f"tests write into {root}/build, where this user may not")


def test_who_may_not_write_is_told_that_nothing_is_built():
    refused(call(checkout("unbuilt", built=False), "list"), "is not up to date, and this user may not write there")


def test_a_path_that_builds_do_not_take_is_refused_at_once_but_run_if_it_is_built():
    for k, bad in enumerate("'\"#;&[]*?|<^`\\"):
        root = checkout(f"{k} a{bad}b", built=False)
        done = subprocess.run([root / "bvhbench", "list"], capture_output=True, text=True, timeout=PATIENCE_S,
                              env={**os.environ, "BVHBENCH_PACKAGES": "skip"})
        refused(done, f"this cannot be built in a folder with {bad} in its path: {root}")
        assert not (root / "build").exists()
    done = call(checkout("it's ä (built) already"), "list")
    assert (done.returncode, done.stdout) == (0, "ran: list\n"), done


def test_help_and_version_are_answered_before_anything_is_built():
    root = checkout("nothing", built=False)
    (root / "docs").mkdir()
    for path in ("docs/help.txt", "docs/help-of-commands.txt", "CMakeLists.txt"):
        shutil.copy(SOURCE / path, root / path)
    listed = (SOURCE / "docs/help.txt").read_text().partition("\nKnow")[2].partition("\nExit codes")[0]
    commands = re.findall(r"^  ([a-z]+)  ", listed, re.MULTILINE)
    assert len(commands) > 15, commands
    for words in (["--help"], ["-h"], ["--version"], *([command, "--help"] for command in commands)):
        at_once, built = (subprocess.run([program, *words], capture_output=True, text=True, timeout=PATIENCE_S)
                          for program in (root / "bvhbench", PROGRAM))
        assert (at_once.returncode, at_once.stdout, at_once.stderr) == (0, built.stdout, ""), (words, at_once, built)
    assert not (root / "build").exists()


def test_help_builds_nothing_where_the_program_is_older():
    root = checkout("older")
    (root / "docs").mkdir()
    shutil.copy(SOURCE / "docs/help-of-commands.txt", root / "docs")
    os.utime(root / "build/built", (1, 1))
    done = subprocess.run([root / "bvhbench", "collide", "--help"], capture_output=True, text=True, timeout=PATIENCE_S)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ran: collide --help\n", ""), done


sys.exit(main(globals()))
