#!/usr/bin/env python3
"""Tests that every header compiles alone.

Usage: headers_test.py <source root> <compile_commands.json>

A header that is the first include of a compiled source, or of such a header, has been compiled alone by the build. That holds
for 3 in 4 headers, though after the standard library's headers if those are precompiled (cmake/Precompiled.cmake; not in the
presets dev and sanitize). The other headers are compiled here without any header before them, with the options of their
room's sources, and without generating code.
"""
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOMS = ("geometry", "device", "builders", "oibvh", "baselines", "collide", "cluster", "library", "library_cluster", "process", "scenes",
         "harness", "benchmarks")
FIRST_INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)', re.MULTILINE)
WITH_VALUE = ("-o", "-MF", "-MT", "-MQ", "-include")


def arguments(command: dict[str, str]) -> list[str]:
    """Returns the compiler and its options, without input and output files."""
    words = shlex.split(command["command"])
    while pathlib.Path(words[0]).name == "ccache":
        words = words[1:]
    kept, skipped = [], False
    for word in words:
        if not skipped and word not in (*WITH_VALUE, "-c", "-MD", "-MMD", "-Winvalid-pch", command["file"]):
            kept.append(word)
        skipped = word in WITH_VALUE
    return kept


def compiled_alone(root: pathlib.Path, sources: list[str]) -> set[str]:
    found, waiting = set(), list(sources)
    while waiting:
        first = FIRST_INCLUDE.search((root / waiting.pop()).read_text())
        if first and first[1] not in found and (root / first[1]).is_file():
            found.add(first[1])
            waiting.append(first[1])
    return found


def failure(root: pathlib.Path, header: str, command: dict[str, str], folder: pathlib.Path) -> str:
    """Returns the compiler's errors for a file that includes only this header, twice, so that its guard is tested too."""
    alone = folder / (header.replace("/", "_") + ".cpp")
    alone.write_text(2 * f'#include "{header}"\n')
    result = subprocess.run([*arguments(command), "-fsyntax-only", str(alone)], cwd=command["directory"],
                            capture_output=True, text=True, check=False)
    return result.stderr if result.returncode != 0 else ""


def main() -> int:
    root = pathlib.Path(sys.argv[1]).resolve()
    commands = {}
    for command in json.loads(pathlib.Path(sys.argv[2]).read_text()):
        path = pathlib.Path(command["file"])
        if path.is_relative_to(root):
            commands[path.relative_to(root).as_posix()] = command
    headers = [path.relative_to(root).as_posix() for room in ROOMS for path in sorted((root / room).rglob("*.h"))]
    alone = compiled_alone(root, [path for path in commands if path.startswith(ROOMS)])
    rest = [header for header in headers if header not in alone]
    # Headers of a room are compiled with the options of its sources, or of harness sources if the room has none.
    of_room = {room: next((command for path, command in commands.items() if path.startswith(room + "/")), None)
               for room in ROOMS}
    if of_room["harness"] is None or len(headers) < 100:
        print(f"{len(headers)} headers found, and {len(commands)} compile commands: this test looks in the wrong place")
        return 1
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder = pathlib.Path(name)
        said = list(pool.map(lambda header: failure(root, header, of_room[header.split("/")[0]] or of_room["harness"],
                                                    folder), rest))
    for header, text in zip(rest, said):
        if text:
            print(f"{header} does not compile alone:\n{text}")
    print(f"{len(headers) - len(rest)} headers are the first of a source, {len(rest)} compiled here")
    return int(any(said))


if __name__ == "__main__":
    sys.exit(main())
