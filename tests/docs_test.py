#!/usr/bin/env python3
"""Hold the documents to the project: files, tests and references they name must be there.

Usage: docs_test.py <source root>

Checked in every .md file: paths in backticks, unless their line says "not yet" or they hold a <placeholder>;
links to other documents; GoogleTest names in backticks, as in `Suite.Test`. Checked in every source file:
keys such as [Chitalu2020] have an entry in docs/references.md.
"""
import pathlib
import re
import sys

ROOMS = ("baselines", "builders", "cmake", "collide", "device", "docs", "examples", "geometry", "harness", "library", "oibvh", "plots",
         "results", "scenes", "tests")
QUOTED = re.compile(r"`([^`\n]+)`")
PATH = re.compile(rf"^(?:{'|'.join(ROOMS)})/[\w./-]*$")
TEST_NAME = re.compile(r"^[A-Z]\w+\.[A-Z]\w+$")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
CITED = re.compile(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d)[\],]")
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P)\((\w+),\s*(\w+)\)", re.MULTILINE)


def faults_of_document(root: pathlib.Path, path: pathlib.Path, tests: set[str]):
    is_code = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        is_code ^= line.startswith("```")
        where = f"{path.relative_to(root)}:{number}"
        for word in QUOTED.findall(line):
            if PATH.match(word) and "not yet" not in line and not (root / word).exists():
                yield f"{where}: {word} is not there"
            if TEST_NAME.match(word) and word not in tests and not (root / word).exists():
                yield f"{where}: no test is called {word}"
        for target in [] if is_code else LINK.findall(line):
            if not (path.parent / target).exists():
                yield f"{where}: the link to {target} leads nowhere"


def faults(root: pathlib.Path):
    sources = [path for room in ROOMS for path in (root / room).rglob("*")
               if path.suffix in {".h", ".cpp", ".cl", ".clh", ".py", ".md"}]
    tests = {".".join(names) for path in sources if path.suffix == ".cpp" and "tests" in path.parts
             for names in TEST.findall(path.read_text())}
    for path in sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md")]):
        yield from faults_of_document(root, path, tests)
    known = set(re.findall(r"^- \*\*\[(\w+)\]\*\*", (root / "docs" / "references.md").read_text(), re.MULTILINE))
    for path in sorted(sources):
        for key in CITED.findall(path.read_text()):
            if key not in known:
                yield f"{path.relative_to(root)}: [{key}] is not in docs/references.md"


def main() -> int:
    found = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "the documents name what is there")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
