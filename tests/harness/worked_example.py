#!/usr/bin/env python3
"""Writes the new and changed files of an example in a document into a folder.

Usage: worked_example.py <source root> <document> <folder>

A block of the page that is not a diff is a file, whose name is the last one in backticks before it. A diff changes that file."""
import pathlib
import re
import sys

BLOCK = re.compile(r"^```(c|cpp|diff)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"`(\w+/[\w./]+\.\w+)`")


def changed(text: str, diff: str, path: str) -> str:
    """Applies a diff to a text, in which the replaced lines must occur exactly once."""
    lines = diff.splitlines()
    before = "\n".join(line[1:] for line in lines if not line.startswith("+"))
    after = "\n".join(line[1:] for line in lines if not line.startswith("-"))
    assert text.count(before) == 1, f"{path} has {text.count(before)} times:\n{before}"
    return text.replace(before, after)


def files_of(root: pathlib.Path, document: str) -> dict[str, str]:
    page, files = (root / document).read_text(), {}
    for block in BLOCK.finditer(page):
        path = FILE.findall(page[:block.start()])[-1]
        if block[1] == "diff":
            files[path] = changed(files.get(path) or (root / path).read_text(), block[2], path)
        else:
            assert not (root / path).exists(), f"{document}: {path} is there already"
            files[path] = block[2]
    return files


def make(root: pathlib.Path, document: str, folder: pathlib.Path) -> None:
    for path, text in files_of(root, document).items():
        to = folder / path
        to.parent.mkdir(parents=True, exist_ok=True)
        if not to.exists() or to.read_text() != text:
            to.write_text(text)


if __name__ == "__main__":
    make(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]))
