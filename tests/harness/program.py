# SPDX-License-Identifier: MIT
"""Shared by tests of the program: runs it, and tests its exit codes, its output and the result schema.

A test script is called with the program and the result schema, and ends with `sys.exit(main(globals()))`.
"""
import contextlib
import json
import math
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM, SCHEMA = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
SOURCE = SCHEMA.parents[2]
ROOMS_OF_KERNELS = ("baselines", "builders", "cluster", "collide", "device", "geometry", "library", "oibvh")
ALL_CASES = os.environ.get("BVHBENCH_TESTS") == "all"  # .ci/nightly; tests/all_cases.h
PATIENCE_S = 600  # after which a test takes a process for hung; nothing else depends on it
KEPT = "bvhbench: stopped; finished cells are kept\n"
_validator = jsonschema and jsonschema.Draft202012Validator(json.loads(SCHEMA.read_text()))


def run(*words: str, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=PATIENCE_S, env={**os.environ, **environment})


def expect(code: int, *words: str, says: str = "", **environment: str) -> str:
    """Runs the program and returns its standard output. Tests the exit code; an error must be one line on stderr with `says`."""
    done = run(*words, **environment)
    assert done.returncode == code, (words, done)
    assert says in (done.stderr if code else done.stdout), (words, done)
    if code in (2, 3, 4):
        sentences = [line for line in done.stderr.splitlines() if not line.startswith("scene '")]  # notices about a file
        assert len(sentences) == 1 and sentences[0].startswith("bvhbench: "), done.stderr
    return done.stdout


def best(code: int, *words: str, **environment: str) -> str:
    # Again if a busy machine left too few samples for a winner.
    done = run("best", *words, **environment)
    if "\nno winner: " in done.stdout and "--force" not in words:
        return best(code, *words, "--force", **environment)
    assert done.returncode == code, (words, done)
    return done.stdout


def valid(path: str | pathlib.Path) -> dict:
    text = pathlib.Path(path).read_text()
    assert "NaN" not in text
    result = json.loads(text)
    if _validator:
        _validator.validate(result)
    return result


def only(path: str) -> dict:
    """Returns the only cell of a result file."""
    cell, = valid(path)["cells"]
    return cell


def cells_after(*words: str, code: int = 0, says: str = "", **environment: str) -> list[dict]:
    """Runs a command that measures as `expect` does, and returns the cells of its result file, r.json."""
    expect(code, *words, "--out" if words[0] == "run" else "--json", "r.json", "--force", says=says, **environment)
    return valid("r.json")["cells"]


def experiment(path: str, **keys) -> str:
    """Writes an experiment and returns its path. The defaults are one sample and no warm-up."""
    pathlib.Path(path).write_text(json.dumps({"experiment": "test", "question": "?", "samples": 1, "warm_up": 0, **keys}))
    return path


def copied_kernels(folder: str, *faults: str) -> str:
    """Copies all kernels into a folder for --kernels. A fault is a file, a pattern and what replaces each match of it in the file."""
    for room in ROOMS_OF_KERNELS:
        shutil.copytree(SOURCE / room, pathlib.Path(folder, room), ignore=shutil.ignore_patterns("*.cpp", "*.txt"), dirs_exist_ok=True)
    for file, pattern, replacement in zip(*(faults[k::3] for k in range(3)), strict=True):
        planted = pathlib.Path(folder, file)
        text, count = re.subn(pattern, replacement, planted.read_text())
        assert count > 0, (file, pattern)
        planted.write_text(text)
    return folder


def planted_karras(folder: str, pattern: str, replacement: str) -> str:
    return copied_kernels(folder, "baselines/radix/karras.cl", pattern, replacement)


@contextlib.contextmanager
def at_work(*words: str, **environment: str) -> Iterator[subprocess.Popen]:
    """Yields the running program in its own process group, and kills it at the end if it has not ended."""
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                          env={**os.environ, **environment}) as process:
        try:
            yield process
        finally:
            process.kill()


def on_a_terminal(*words: str) -> str:
    """Runs the program on a terminal of 80 columns without colours, tests that it succeeds, and returns what it shows."""
    own, child = pty.openpty()
    with subprocess.Popen([PROGRAM, *words], stdout=child, stderr=child,
                          env={**os.environ, "COLUMNS": "80", "NO_COLOR": "1"}) as process, os.fdopen(own, "rb", buffering=0) as shown:
        os.close(child)
        text = b""
        with contextlib.suppress(OSError):  # when the terminal's other end is closed
            while part := shown.read(4096):
                text += part
    assert process.returncode == 0, text
    return text.decode()


def ended(process: subprocess.Popen, sent: signal.Signals) -> tuple[str, str]:
    """Sends a signal to a running process and returns its output and errors."""
    assert process.poll() is None, process.communicate()
    process.send_signal(sent)
    return process.communicate(timeout=PATIENCE_S)


@contextlib.contextmanager
def small_disk(kib: int) -> Iterator[pathlib.Path | None]:
    """Yields a folder with room for `kib` KiB, or None if this user may not mount one."""
    disk = pathlib.Path(f"disk-{kib}").resolve()
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kib}k", "tmpfs", disk], capture_output=True).returncode:
        print("  no small disk: this user may not mount one")
        yield None
        return
    try:
        yield disk
    finally:
        subprocess.run(["umount", disk], check=True)


def wait_until(happens: Callable[[], object]) -> None:
    until = time.monotonic() + PATIENCE_S
    while not happens():
        assert time.monotonic() < until
        time.sleep(0.02)


def limit_for(*words: str, **environment: str) -> int:
    """Returns a --time-limit in seconds for a command with something that hangs: at least 2, and four times what it takes with nothing
    that hangs, so that a busy machine is no hang."""
    began = time.monotonic()
    run(*words, **environment)
    return max(2, math.ceil(4 * (time.monotonic() - began)))


def children(parent: int) -> list[int]:
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if int((entry / "stat").read_text().rpartition(")")[2].split()[1]) == parent:
                found.append(int(entry.name))
    return found


def ours() -> list[str]:
    """Returns the command lines of other processes that were started in this folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            if entry.name.isdigit() and int(entry.name) != os.getpid() and os.readlink(entry / "cwd") == os.getcwd():
                found.append((entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip())
    return [line for line in found if line]


def main(names: dict, begin: Callable[[], None] | None = None, at_a_time: int = 1) -> int:
    """Runs every test of a script, at night also those called night_test_, or those with TESTS in their names, in a temporary folder.
    With `begin`, each test has its own folder, prepared by `begin`. Tests that wait much and use no file of each other run `at_a_time`."""
    wanted = os.environ.get("TESTS", "")
    begins = ("test_", "night_test_") if ALL_CASES or wanted else "test_"
    tests = {name.split("test_", 1)[1]: value for name, value in names.items() if name.startswith(begins) and wanted in name}

    def passes(name: str, test: Callable[[], None]) -> None:
        started = time.monotonic()
        test()
        print(f"passed: {name.replace('_', ' ')} ({time.monotonic() - started:.1f} s)", flush=True)

    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(at_a_time) as several:
        os.chdir(folder)
        if at_a_time > 1:
            list(several.map(passes, *zip(*tests.items())))
        for name, test in tests.items() if at_a_time == 1 else ():
            if begin:
                os.mkdir(f"{folder}/{name}")
                os.chdir(f"{folder}/{name}")
                begin()
            passes(name, test)
        os.chdir("/")
    if not jsonschema:
        print("not checked against the schema: there is no jsonschema for this Python")
    return 0
