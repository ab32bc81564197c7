#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the text of sources and documents against the project's rules. Each finding is a line.

Usage: sources_test.py rooms <source root> <rooms.json>
       sources_test.py exactness <source root> <compile_commands.json>
       sources_test.py docs <source root>
       sources_test.py format <source root> <clang-format>
       sources_test.py budget <source root>
       sources_test.py floors <source root>

rooms: every #include follows the rules written by cmake/Rooms.cmake.
exactness: nothing permits a compiler to fuse, reorder or approximate arithmetic, in kernels or on the host.
tests/device/contraction_test.cpp tests the results themselves.
docs: everything that documents name exists: paths in backticks, unless their line says "not yet" or they hold a <placeholder>;
links to other documents; GoogleTest names in backticks, as in `Suite.Test`. In sources, keys such as [Chitalu2020] have an
entry in docs/references.md.
format: every source and kernel is formatted by clang-format.
budget: no room has more lines of code than its line in CONTRIBUTING.md allows, by more than 3 %.
floors: a module of plots imports its own floor and lower ones (FLOORS in plots/__init__.py), and no floor has too many modules.
"""
import ast
import json
import pathlib
import re
import runpy
import subprocess
import sys
from collections.abc import Iterator

CHECK, ROOT, MORE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), "".join(sys.argv[3:4])
LIBRARY = ("geometry", "device", "builders", "oibvh", "baselines", "collide", "cluster", "library", "library_cluster")
ALL = (*LIBRARY, "python", "process", "scenes", "plugins", "harness", "benchmarks", "examples", "tests")
SOURCES = (".h", ".cpp", ".cl", ".clh")
CODE = (*SOURCES, ".c", ".cu", ".py", ".js", ".css", ".sh")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)

PRAGMA = "#pragma OPENCL FP_CONTRACT OFF"
HOME = "geometry/dialect.h"
CHECKED_BEHIND = re.compile(r"^// check:.*-include (\S+)", re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*")
FLOATING = re.compile(r"\b(?:float|double)(?:2|3|4|8|16)?\b")
# Built-in functions of OpenCL C whose results depend on the device, or that fuse operations.
INEXACT = re.compile(r"\b(?:fma|mad|native_\w+|half_(?:cos|divide|exp2?|exp10|log2?|log10|powr|recip|r?sqrt|sin|tan))\s*\(")
LOOSE_OPTIONS = re.compile(r"-cl-(?:fast-relaxed-math|mad-enable|unsafe-math\S*|finite-math-only|no-signed-zeros|"
                           r"denorms-are-zero|single-precision-constant)|-ffast-math|-Ofast|-funsafe-math\S*|"
                           r"-fassociative-math|-freciprocal-math|-ffinite-math-only|-ffp-contract=(?:fast|on)")

QUOTED = re.compile(r"`([^`\n]+)`")
PATH = re.compile(rf"^(?:{'|'.join((*ALL, 'cmake', 'docs', 'plots', 'results'))})/[\w./-]*$")
TEST_NAME = re.compile(r"^[A-Z]\w+\.[A-Z]\w+$")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
CITED = re.compile(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d)[\],]")
MOST_MODULES = 25  # of a floor of plots
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P)\((\w+),\s*(\w+)\)", re.MULTILINE)


def files(*folders: str, kinds: tuple[str, ...] = SOURCES) -> list[pathlib.Path]:
    return [path for folder in folders for path in sorted((ROOT / folder).rglob("*")) if path.suffix in kinds]


def floor(path: pathlib.PurePath) -> str:
    """Returns the folder of the room that a file is in; "." for the room itself."""
    return path.parts[1] if len(path.parts) > 2 else "."


def goes_up(floors: list[str], of: str, to: str) -> str:
    """Returns what is wrong with an include from one folder of a room to another; empty if nothing is."""
    if not floors or of == to:
        return ""
    for name in (of, to):
        if name not in floors:
            return f"the room has no floor {name}"
    return "" if floors.index(to) < floors.index(of) else f"{of} is below {to}"


def rooms() -> Iterator[str]:
    rules = json.loads(pathlib.Path(MORE).read_text())
    owners = {}
    for room, rule in rules.items():
        for prefix in rule["owns"]:
            owners.setdefault(prefix, []).append(room)
    for room, rule in rules.items():
        for path in files(room):
            of = path.relative_to(ROOT)
            for mark, target in INCLUDE.findall(path.read_text()):
                head = target.split("/")[0]
                if mark == "<":
                    allowed = next((owners[p] for p in owners if target.startswith(p)), [room])
                    if room not in allowed:
                        yield f"{of}: {target}: only {' and '.join(allowed)} includes this library"
                elif not (ROOT / target).is_file():
                    yield f"{of}: {target}: write the path from the source root"
                elif head not in (room, *rule["needs"]):
                    yield f"{of}: {target}: {room} does not need {head}"
                elif head == room and (above := goes_up(rule["floors"], floor(of), floor(pathlib.PurePath(target)))):
                    yield f"{of}: {target}: {above}"


def reached(path: str, seen: set[str]) -> set[str]:
    """Returns a kernel file and all files that it includes."""
    if path not in seen:
        seen.add(path)
        text = (ROOT / path).read_text()
        for other in [target for mark, target in INCLUDE.findall(text) if mark == '"'] + CHECKED_BEHIND.findall(text):
            reached(other, seen)
    return seen


def exactness() -> Iterator[str]:
    texts = {path.relative_to(ROOT).as_posix(): path.read_text() for path in files(*LIBRARY)}
    kernels = [path for path in texts if path.endswith(".cl")]
    if len(kernels) < 10:
        yield f"{len(kernels)} kernel files found: this test looks in the wrong place"
    if texts[HOME].count(PRAGMA) != 1:
        yield f"{HOME}: no '{PRAGMA}'"
    for path in kernels:
        includes = reached(path, set())
        if HOME not in includes and any(FLOATING.search(COMMENT.sub("", (ROOT / other).read_text())) for other in includes):
            yield f"{path}: does not include {HOME}, where contraction is switched off"
    for path, text in texts.items():
        if "FP_CONTRACT" in text and path != HOME:
            yield f"{path}: FP_CONTRACT is set in {HOME} alone"
        for call in INEXACT.findall(text) if not path.endswith(".cpp") else ():
            yield f"{path}: {call}...) differs from device to device"
    for path in (ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json", *files("cmake", kinds=(".cmake",)),
                 *files(*LIBRARY, kinds=(".cpp",))):
        for option in LOOSE_OPTIONS.findall(path.read_text()):
            yield f"{path.relative_to(ROOT)}: {option}"
    rooms = (*LIBRARY, "scenes", "harness", "benchmarks")
    # Sources compiled as one are named by a file in the build folder, in a folder of the room's name.
    places = [base / room for base in (ROOT, pathlib.Path(MORE).resolve().parent) for room in rooms]
    own = [command for command in json.loads(pathlib.Path(MORE).read_text())
           if any(pathlib.Path(command["file"]).is_relative_to(place) for place in places)]
    if not own:
        yield "no compile command of a room found"
    for command in own:
        if "-ffp-contract=off" not in command["command"] or LOOSE_OPTIONS.search(command["command"]):
            yield f"{command['file']}: compiled without -ffp-contract=off, or with an option that rounds otherwise"


def faults_of_document(path: pathlib.Path, tests: set[str]) -> Iterator[str]:
    is_code = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        is_code ^= line.startswith("```")
        where = f"{path.relative_to(ROOT)}:{number}"
        for word in QUOTED.findall(line):
            if PATH.match(word) and "not yet" not in line and not (ROOT / word).exists():
                yield f"{where}: {word} is not there"
            if TEST_NAME.match(word) and word not in tests and not (ROOT / word).exists():
                yield f"{where}: no test is called {word}"
        for target in [] if is_code else LINK.findall(line):
            if not (path.parent / target).exists():
                yield f"{where}: the link to {target} leads nowhere"


def docs() -> Iterator[str]:
    tests = {".".join(names) for path in files("tests", kinds=(".cpp",)) for names in TEST.findall(path.read_text())}
    for path in sorted([*ROOT.glob("*.md"), *files("docs", kinds=(".md",))]):
        yield from faults_of_document(path, tests)
    known = set(re.findall(r"^- \*\*\[(\w+)\]\*\*", (ROOT / "docs" / "references.md").read_text(), re.MULTILINE))
    for path in files(*ALL, "cmake", "docs", "plots", "results", kinds=(*SOURCES, ".py", ".md")):
        for key in CITED.findall(path.read_text()):
            if key not in known:
                yield f"{path.relative_to(ROOT)}: [{key}] is not in docs/references.md"


def format() -> Iterator[str]:
    paths = files(*ALL)
    if len(paths) < 500:
        yield f"only {len(paths)} files below {ROOT}"
    yield from subprocess.run([MORE, "--dry-run", "--Werror", *paths], stderr=subprocess.PIPE, text=True, check=False).stderr.splitlines()


def code_lines(path: pathlib.Path) -> int:
    """Returns the number of lines that are neither blank nor comment nor, in Python, a docstring."""
    text = path.read_text(encoding="utf-8")
    if path.suffix in (".py", ".sh"):
        text = re.sub(r'^\s*"""(?:.|\n)*?"""\n', "", text, flags=re.MULTILINE)
        text = re.sub(r"^\s*#.*\n", "", text, flags=re.MULTILINE)
    else:
        text = re.sub(r"/\*(?:.|\n)*?\*/|^\s*//.*", "", text, flags=re.MULTILINE)
    return sum(bool(line.strip()) for line in text.splitlines())


def budget() -> Iterator[str]:
    table = re.findall(r"^\| `(\w+)` \| ([\d,]+) \|$", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), re.MULTILINE)
    allowed = {room: int(lines.replace(",", "")) for room, lines in table}
    for room in (*ALL, "plots"):
        found = sum(map(code_lines, files(room, kinds=CODE)))
        if room not in allowed:
            yield f"{room}: {found:,} lines of code, and CONTRIBUTING.md has no line of it"
        elif found > 1.03 * allowed[room]:
            yield f"{room}: {found:,} lines of code, and CONTRIBUTING.md allows {allowed[room]:,}"


def imported_floors(path: pathlib.Path) -> Iterator[str]:
    """Yields the floor of plots that each relative import of a module leads to; "." for the package itself."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level > 1:
            yield node.module.split(".")[0] if node.module else "."
        elif isinstance(node, (ast.Import, ast.ImportFrom)) and not getattr(node, "level", 0):
            dotted = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module]
            yield from (name.split(".")[1] for name in dotted if name.startswith("plots."))


def floors() -> Iterator[str]:
    order = list(runpy.run_path(str(ROOT / "plots" / "__init__.py"))["FLOORS"])
    for path in files("plots", kinds=(".py",)):
        of = path.relative_to(ROOT)
        if len(of.parts) > 2:
            yield from sorted({f"{of}: {above}" for to in imported_floors(path) if (above := goes_up(order, floor(of), to))})
    for name in order:
        if (count := len(list((ROOT / "plots" / name).glob("*.py")))) > MOST_MODULES:
            yield f"plots/{name}: {count} modules, more than {MOST_MODULES}"


if __name__ == "__main__":
    findings = list({"rooms": rooms, "exactness": exactness, "docs": docs, "format": format, "budget": budget, "floors": floors}[CHECK]())
    print("\n".join(findings) or f"{CHECK}: nothing found")
    sys.exit(bool(findings))
