"""What tests of the program share: run it and hold it to its exit codes, its output and the result schema.

A test script is called with the program and the result schema, and ends with `sys.exit(main(globals()))`.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM, SCHEMA = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def run(*words: str, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **environment})


def expect(code: int, *words: str, says: str = "", **environment: str) -> str:
    """The program's standard output; an error is one line on stderr that contains `says`."""
    done = run(*words, **environment)
    assert done.returncode == code, (words, done)
    assert says in (done.stderr if code else done.stdout), (words, done)
    if code in (2, 3, 4):
        assert done.stderr.startswith("bvhbench: ") and done.stderr.count("\n") == 1, done.stderr
    return done.stdout


def valid(path: str) -> dict:
    text = pathlib.Path(path).read_text()
    assert "NaN" not in text
    result = json.loads(text)
    if jsonschema:
        jsonschema.validate(result, json.loads(SCHEMA.read_text()))
    return result


def copied_kernels(folder: str) -> str:
    """A folder of all kernels' text, for --kernels, to be changed there."""
    source = SCHEMA.parents[2]
    for path in source.rglob("*"):
        if path.suffix in (".cl", ".clh", ".h") and "build" not in path.relative_to(source).parts[:1]:
            to = pathlib.Path(folder, path.relative_to(source))
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, to)
    return folder


def planted_kernels(folder: str, pattern: str, replacement: str) -> str:
    """The same, those of karras changed."""
    planted = pathlib.Path(copied_kernels(folder), "baselines/radix/karras.cl")
    text, kernels = re.subn(pattern, replacement, planted.read_text())
    assert kernels > 0
    planted.write_text(text)
    return folder


def main(names: dict) -> int:
    """Run every test of a script in a folder that is removed in the end."""
    tests = [value for name, value in names.items() if name.startswith("test_")]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for test in tests:
            test()
            print("passed:", test.__name__.removeprefix("test_").replace("_", " "))
        os.chdir("/")
    if not jsonschema:
        print("not held to the schema: there is no jsonschema for this Python")
    return 0
