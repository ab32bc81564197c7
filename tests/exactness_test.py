#!/usr/bin/env python3
"""Hold kernels and build files to what keeps arithmetic the same everywhere: nothing lets a compiler fuse, reorder or
approximate it. That it does not, tests/device/contraction_test.cpp shows by numbers.

Usage: exactness_test.py <source root> <compile_commands.json>
"""
import json
import pathlib
import re
import sys

ROOMS = ("geometry", "device", "builders", "oibvh", "baselines", "collide", "library")
PRAGMA = "#pragma OPENCL FP_CONTRACT OFF"
HOME = "geometry/dialect.h"
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
CHECKED_BEHIND = re.compile(r"^// check:.*-include (\S+)", re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*")
FLOATING = re.compile(r"\b(?:float|double)(?:2|3|4|8|16)?\b")
# Built-in functions of OpenCL C whose results are left to the device, or that fuse.
INEXACT = re.compile(r"\b(?:fma|mad|native_\w+|half_(?:cos|divide|exp2?|exp10|log2?|log10|powr|recip|r?sqrt|sin|tan))\s*\(")
LOOSE_OPTIONS = re.compile(r"-cl-(?:fast-relaxed-math|mad-enable|unsafe-math\S*|finite-math-only|no-signed-zeros|"
                           r"denorms-are-zero|single-precision-constant)|-ffast-math|-Ofast|-funsafe-math\S*|"
                           r"-fassociative-math|-freciprocal-math|-ffinite-math-only|-ffp-contract=(?:fast|on)")


def reached(root: pathlib.Path, path: str, seen: set[str]) -> set[str]:
    if path not in seen:
        seen.add(path)
        text = (root / path).read_text()
        for other in INCLUDE.findall(text) + CHECKED_BEHIND.findall(text):
            reached(root, other, seen)
    return seen


def violations(root: pathlib.Path, commands: list[dict[str, str]]):
    files = [path.relative_to(root).as_posix() for room in ROOMS for path in sorted((root / room).rglob("*"))
             if path.suffix in {".h", ".cpp", ".cl", ".clh"}]
    kernels = [path for path in files if path.endswith(".cl")]
    if len(kernels) < 10:
        yield f"{len(kernels)} kernel files found: this test looks in the wrong place"
    if (root / HOME).read_text().count(PRAGMA) != 1:
        yield f"{HOME}: no '{PRAGMA}'"
    for path in kernels:
        texts = reached(root, path, set())
        if HOME not in texts and any(FLOATING.search(COMMENT.sub("", (root / other).read_text())) for other in texts):
            yield f"{path}: does not include {HOME}, where contraction is switched off"
    for path in files:
        text = (root / path).read_text()
        if "FP_CONTRACT" in text and path != HOME:
            yield f"{path}: FP_CONTRACT is set in {HOME} alone"
        if path.endswith((".cl", ".clh", ".h")):
            for call in INEXACT.findall(text):
                yield f"{path}: {call}...) differs from device to device"
    build_files = [root / "CMakeLists.txt", root / "CMakePresets.json", *(root / "cmake").rglob("*.cmake"),
                   *(root / folder for folder in files if folder.endswith(".cpp"))]
    for path in build_files:
        for option in LOOSE_OPTIONS.findall(path.read_text()):
            yield f"{path.relative_to(root)}: {option}"
    own = [command for command in commands if pathlib.Path(command["file"]).is_relative_to(root)
           and pathlib.Path(command["file"]).relative_to(root).parts[0] in (*ROOMS, "scenes", "harness")]
    if not own:
        yield "no compile command of a room found"
    for command in own:
        if "-ffp-contract=off" not in command["command"] or LOOSE_OPTIONS.search(command["command"]):
            yield f"{command['file']}: compiled without -ffp-contract=off, or with an option that rounds otherwise"


def main() -> int:
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(violations(root, json.loads(pathlib.Path(sys.argv[2]).read_text())))
    print("\n".join(found) or "nothing may fuse, reorder or approximate")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
