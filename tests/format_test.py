#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every source and kernel is as clang-format 14 leaves it.

Usage: format_test.py <source root> <clang-format>
"""
import pathlib
import subprocess
import sys

ROOMS = ("baselines", "builders", "collide", "device", "examples", "geometry", "harness", "library", "oibvh", "scenes", "tests")
SUFFIXES = {".h", ".cpp", ".cl", ".clh"}


def main() -> int:
    root, formatter = pathlib.Path(sys.argv[1]), sys.argv[2]
    files = [path for room in ROOMS for path in sorted((root / room).rglob("*")) if path.suffix in SUFFIXES]
    assert len(files) > 500, f"only {len(files)} files below {root}"
    return subprocess.run([formatter, "--dry-run", "--Werror", *files], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
