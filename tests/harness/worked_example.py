#!/usr/bin/env python3
"""Write the files of the worked example in docs/adding-a-builder.md, new and changed, into a folder.

Usage: worked_example.py <source root> <folder>

A block of the page that is no diff is the file whose name is the last in backticks before it; a diff changes that file.
"""
import pathlib
import re
import sys

PAGE = "docs/adding-a-builder.md"
BLOCK = re.compile(r"^```(c|cpp|diff)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"`(\w+/[\w./]+\.\w+)`")


def changed(text: str, diff: str, path: str) -> str:
    lines = diff.splitlines()
    before = "\n".join(line[1:] for line in lines if not line.startswith("+"))
    after = "\n".join(line[1:] for line in lines if not line.startswith("-"))
    assert text.count(before) == 1, f"{PAGE}: {path} has {text.count(before)} times:\n{before}"
    return text.replace(before, after)


def files_of(root: pathlib.Path) -> dict[str, str]:
    page, files = (root / PAGE).read_text(), {}
    for block in BLOCK.finditer(page):
        path = FILE.findall(page[:block.start()])[-1]
        if block[1] == "diff":
            files[path] = changed(files.get(path) or (root / path).read_text(), block[2], path)
        else:
            assert not (root / path).exists(), f"{PAGE}: {path} is there already"
            files[path] = block[2]
    return files


def make(root: pathlib.Path, folder: pathlib.Path) -> None:
    for path, text in files_of(root).items():
        to = folder / path
        to.parent.mkdir(parents=True, exist_ok=True)
        if not to.exists() or to.read_text() != text:
            to.write_text(text)


if __name__ == "__main__":
    make(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
