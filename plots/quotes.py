#!/usr/bin/env python3
"""Compares the numbers that documents quote with the result files that they come from.

    plots/quotes.py            # prints each number that differs from its file; the exit code is 1 if one does
    plots/quotes.py --fill     # writes the files' numbers into the documents

The numbers of NAME.md are listed in results/quotes/NAME.py, whose function `quotes` names sentences of the document and gives the
values of the numbers in them (Document.says). results/quotes/loose.json has how many numbers each document has besides: they are of
tests, other programs or runs that were not kept. --fill lowers these counts; who raises one by hand has to say why.
"""
import argparse
import json
import lzma
import pathlib
import re
import runpy
import sys
import types
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import names
import output
from cells import Cell
from ranking import OF_QUERY

ROOT = pathlib.Path(__file__).resolve().parent.parent
LOOSE_COUNTS = ROOT / "results" / "quotes" / "loose.json"
NUMBER = r"-?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e-?\d+)?"
NUMBER_PLACE, TEXT_PLACE = rf"(?<![\d.,])(?:\*\*)?({NUMBER})(?:\*\*)?", r"([^|\n]*?)"
# A number that a measurement may give: it has decimals or thousands. Code and addresses of links are no text.
LOOSE = re.compile(r"(?<![\w.,:-])(?:\d+\.\d+|\d{1,3}(?:,\d{3})+(?:\.\d+)?)(?![\w.:-]*\w)")
ONE_SET = ", objects: one"  # of a scene whose objects were one set
RESULT = re.compile(r"results/[\w-]+/[\w-]+\.json\.xz")
NO_TEXT = re.compile(r"^```.*?^```|^    .*?$|`[^`]*`|\]\([^)]*\)", re.MULTILINE | re.DOTALL)


class File:
    """A result file of results/, by its name without endings: "h200/table1"."""

    def __init__(self, name: str) -> None:
        self.document: dict[str, Any] = json.loads(lzma.decompress((ROOT / "results" / f"{name}.json.xz").read_bytes()))
        self.cells = [Cell(raw) for raw in self.document.get("cells", [])]
        self.name = name

    def frames(self, scene: str, asked: str) -> list[Cell]:
        """Returns the measured cells of a scene by what was asked for (asked_of). Raises LookupError if there are none."""
        found = [cell for cell in self.cells if cell.scene == scene and cell.status == "measured" and asked_of(cell) == asked]
        if not found:
            there = "; ".join(sorted({asked_of(cell) for cell in self.cells if cell.scene == scene}))
            raise LookupError(f"{self.name} has no cell '{asked}' of {scene}; there are: {there or 'none of this scene'}")
        return found

    def cell(self, scene: str, asked: str) -> Cell:
        """Returns the first of `frames`."""
        return self.frames(scene, asked)[0]


def asked_of(cell: Cell) -> str:
    """Returns the name of what was asked for, equal on every device: "bvtt (jump 2) over oibvh-multi", "oibvh-multi, kd"."""
    if cell.operation != "collide":
        return cell.asked
    caches = f", {names.CACHES[cell.caches]}" if cell.caches in names.CACHES else ""
    return names.pipeline(cell.collider or "", dict(cell.collider_options), cell.builder, dict(cell.options)) + caches


def us(cell: Cell, *stages: str) -> float:
    """Returns the sum of the median microseconds of the stages, or the median of the whole without stages."""
    return sum(cell.median_ns(stage) for stage in stages or ("",)) * 1e-3


def query_us(cell: Cell) -> float:
    """Returns the sum of the median microseconds of the stages after the tree."""
    return us(cell, *(stage for stage in cell.samples[0] if stage in OF_QUERY))


def tree_us(cell: Cell, *without: str) -> float:
    """Returns the same of the stages that make the tree."""
    return us(cell, *(stage for stage in cell.samples[0] if stage not in (*OF_QUERY, *without)))


def later_ms(frames: Sequence[Cell]) -> float:
    """Returns the mean over the frames after the first of their median milliseconds."""
    return sum(us(cell) for cell in frames[1:]) / (len(frames) - 1) * 1e-3


def sah(file: File, scene: str, asked: str) -> float:
    """Returns the surface area cost of a tree."""
    return file.cell(scene, asked).counters["sah_cost"]


def frame_ms(document: dict[str, Any]) -> float:
    """Returns the median time of a frame of `bvhbench cluster` in milliseconds."""
    return document["frame_ns"] * 1e-6


def best(values: Sequence[float], form: str = "{:.3f}") -> list[str]:
    """Returns the texts of values, the smallest one bold."""
    return [f"**{form.format(value)}**" if value == min(values) else form.format(value) for value in values]


class Quote(NamedTuple):
    """A number or text of a document between two offsets, and its value in the file."""

    start: int
    end: int
    value: float | str


class Document:
    """A document, or the part of it between two offsets, whose numbers are compared."""

    def __init__(self, path: pathlib.Path, root: pathlib.Path = ROOT) -> None:
        self.path, self.name, self.text = path, str(path.relative_to(root)), path.read_text(encoding="utf-8")
        self.start, self.end = 0, len(self.text)
        self.quotes: list[Quote] = []
        self.covered: list[tuple[int, int]] = []
        self.faults: list[str] = []

    def line(self, offset: int) -> str:
        return f"{self.name}:{self.text.count(chr(10), 0, offset) + 1}"

    def under(self, beginning: str, until: str = "", lines: int = 0) -> None:
        """What follows is said from the line that begins with `beginning` up to the line that begins with `until`, or for a number of
        lines, or else up to the next heading of the same or a higher level."""
        first = re.compile(rf"^{re.escape(beginning)}", re.MULTILINE).search(self.text)
        if first is None:
            raise LookupError(f"{self.name} has no line '{beginning}'")
        level = len(beginning) - len(beginning.lstrip("#")) or 6
        end = rf"^{re.escape(until)}" if until else rf"(?:.*\n){{{lines}}}" if lines else rf"^#{{1,{level}}} "
        last = re.compile(end, re.MULTILINE).search(self.text, first.start() if lines else first.end())
        self.start, self.end = first.start(), last.end() if last and lines else last.start() if last else len(self.text)

    def says(self, sentence: str, *values: float | str | None) -> None:
        """The document has this sentence once, with a number of this value for each {}, rounded to the digits that it has there, or
        with this text. None stands for a number that has no file. Blanks and ends of lines are equal, and a number may be bold."""
        pieces = [r"\s+".join(map(re.escape, re.split(r"\s+", piece))) for piece in sentence.split("{}")]
        if len(pieces) != len(values) + 1:
            raise LookupError(f"'{sentence}' has {len(pieces) - 1} places for {len(values)} values")
        places = [TEXT_PLACE if isinstance(value, str) else NUMBER_PLACE for value in values]
        whole = r"(?!\d|[.,]\d)" if sentence.endswith("{}") else ""  # a number at the end of the sentence is taken whole
        pattern = "".join(piece + place for piece, place in zip(pieces, [*places, whole]))
        found = list(re.compile(pattern).finditer(self.text, self.start, self.end))
        if len(found) != 1:
            self.faults.append(f"{self.line(self.start)}: {'no' if not found else len(found)} text '{sentence}' from here on")
            return
        spans = [(*found[0].span(place), value) for place, value in enumerate(values, 1)]
        self.quotes += [Quote(*span) for span in spans if span[2] is not None]
        # What lies between numbers without a file is covered, the numbers are not.
        edges = [found[0].start(), *(edge for start, end, value in spans if value is None for edge in (start, end)), found[0].end()]
        self.covered += list(zip(edges[::2], edges[1::2]))

    def row(self, label: str, *values: float | str | None) -> None:
        """A row of a table begins with the label and has these values."""
        self.says(f"| {label} |{' {} |' * len(values)}", *values)

    def differing(self) -> list[Quote]:
        return [quote for quote in self.quotes if not agrees(self.text[quote.start:quote.end], quote.value)]

    def findings(self) -> list[str]:
        wrong = []
        for quote in self.differing():
            value = quote.value if isinstance(quote.value, str) else f"{quote.value:.6g}"
            wrong.append(f"{self.line(quote.start)}: {self.text[quote.start:quote.end] or 'nothing'}, the file has {value}")
        return [*self.faults, *wrong]

    def filled(self) -> str:
        """Returns the text with the files' numbers."""
        text = self.text
        once = {quote.start: quote for quote in self.differing()}  # sentences may share a number
        for _, quote in sorted(once.items(), reverse=True):
            text = text[:quote.start] + filled(text[quote.start:quote.end], quote.value) + text[quote.end:]
        return text

    def loose(self) -> list[str]:
        """Returns each number with decimals or thousands that no sentence covers, with its line."""
        hidden = [*self.covered, *(found.span() for found in NO_TEXT.finditer(self.text))]
        return [f"{self.line(found.start())}: {found.group()}" for found in LOOSE.finditer(self.text)
                if not any(start <= found.start() < end for start, end in hidden)]


def digits(text: str) -> int:
    """Returns the number of decimals, of a number with an exponent those of its mantissa."""
    return len(text.partition("e")[0].partition(".")[2])


def agrees(text: str, value: float | str) -> bool:
    """True if the value, rounded to the digits of the text, is the text; a half may be rounded up or down."""
    if isinstance(value, str):
        return text == value
    unit = 10.0 ** (int(text.partition("e")[2] or 0) - digits(text))
    return abs(float(text.replace(",", "")) - value) <= 0.5 * unit * (1 + 1e-9)


def filled(old: str, value: float | str) -> str:
    """Returns the value in the form of the text that it replaces."""
    if isinstance(value, str):
        return value
    if "e" in old:
        return re.sub(r"e([-+])0*", lambda sign: f"e{sign[1].strip('+')}", f"{value:.{digits(old)}e}")
    return f"{value:{',' if ',' in old or (value >= 10000 and '.' not in old) else ''}.{digits(old)}f}"


def lists() -> list[pathlib.Path]:
    return sorted((ROOT / "results" / "quotes").rglob("*.py"))


def listed(name: str) -> types.SimpleNamespace:
    """Returns the names of another document's list: "docs/collisions"."""
    return types.SimpleNamespace(**runpy.run_path(str(ROOT / "results" / "quotes" / f"{name}.py")))


def read(path: pathlib.Path) -> Document:
    """Returns the document of a list with what it quotes. What the list cannot find is a fault of the document."""
    document = Document(ROOT / path.relative_to(ROOT / "results" / "quotes").with_suffix(".md"))
    try:
        runpy.run_path(str(path))["quotes"](document)
    except (LookupError, OSError, ValueError) as error:
        document.faults.append(f"{path.relative_to(ROOT)}: {error}")
    return document


def documents() -> list[Document]:
    """Returns the documents that have a list."""
    return [read(path) for path in lists()]


def loose_counts(those: Iterable[Document]) -> dict[str, int]:
    counts = {one.name: len(one.loose()) for one in those}
    return {name: count for name, count in counts.items() if count}


def lower_counts(found: dict[str, int]) -> None:
    known = json.loads(LOOSE_COUNTS.read_text(encoding="utf-8"))
    lowered = {name: min(count, found[name]) for name, count in known.items() if found.get(name)}
    output.write(LOOSE_COUNTS, (json.dumps(lowered, indent=1) + "\n").encode())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fill", action="store_true", help="write the files' numbers into the documents")
    parser.add_argument("--loose", metavar="NAME", help="list the numbers of a document that no list has: docs/orders.md")
    arguments = parser.parse_args()
    those = documents()
    if arguments.loose:
        print("\n".join(line for one in those if one.path == ROOT / arguments.loose for line in one.loose()))
        return 0
    findings = [finding for one in those for finding in one.findings()]
    print("\n".join(findings) or f"{sum(len(one.quotes) for one in those)} numbers are those of their files")
    if arguments.fill:
        for one in those:
            if one.differing():
                output.write(one.path, one.filled().encode())
        lower_counts(loose_counts(documents()))
        findings = [fault for one in those for fault in one.faults]
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
