#!/usr/bin/env python3
"""Tests what bash completes: the words come from the program."""
import pathlib
import shutil
import subprocess
import sys

from program import PROGRAM, SOURCE, main

SCRIPT = """source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _bvhbench; printf '%s\\n' "${COMPREPLY[@]}" """


def completed(*words: str, program: pathlib.Path = PROGRAM) -> set[str]:
    done = subprocess.run(["bash", "-c", SCRIPT, "bash", SOURCE / "completions/bvhbench.bash", program, *words],
                          capture_output=True, text=True, timeout=600, check=True)
    assert not done.stderr, done.stderr
    return set(done.stdout.split())


def test_commands_options_and_names_are_completed():
    assert {"build", "collide", "sweep", "report"} <= completed("")
    assert completed("coll") == {"collide"}
    assert {"--builder", "--device"} <= completed("build", "--")
    assert completed("build", "--build") == {"--builder"}
    assert completed("sweep", "--dry") == {"--dry-run"}
    assert completed("build", "--builder", "oibvh-s") == {"oibvh-single", "oibvh-single-printed"}
    assert {"morton30", "hilbert30", "kd"} <= completed("--device", "cpu", "collide", "--order", "")
    assert {"builders", "devices", "experiments"} <= completed("list", "")
    assert "peers" in completed("run", "pee")


def test_an_unbuilt_checkout_completes_commands_and_builds_nothing():
    root = pathlib.Path("checkout")
    (root / "docs").mkdir(parents=True)
    for path in ("bvhbench", "packages.txt", "docs/help.txt"):
        shutil.copy(SOURCE / path, root / path)
    assert completed("coll", program=root / "bvhbench") == {"collide"}
    completed("build", "--", program=root / "bvhbench")
    assert not (root / "build").exists()


sys.exit(main(globals()))
