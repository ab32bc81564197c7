"""Compares what documents quote with the result files that it comes from.

    python3 -m plots.evidence.quotes            # prints what differs from its file; the exit code is 1 if something does
    python3 -m plots.evidence.quotes --fill     # writes the files' tables and numbers into the documents

The list of NAME.md is results/quotes/NAME.py. Its function `quotes` makes the tables that stand between the marks

    <!-- generated: NAME -->
    <!-- end -->

of the document (Document.table, or Document.block for other lines), and names the few sentences that quote a number, with its value
(Document.says).
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

from ..console.claims import asked_of
from ..files import output
from ..read import rank_files
from ..read.cells import Cell
from ..read.ranking import OF_QUERY
from ..words import tables

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUMBER = r"-?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e-?\d+)?"
NUMBER_PLACE, TEXT_PLACE = rf"(?<![\d.,])(?:\*\*)?({NUMBER})(?:\*\*)?", r"([^|\n]*?)"
CLAIMS = "claims.py"  # of several documents, and no list of one
ONE_SET = ", objects: one"  # of a scene whose objects were one set
RESULT = re.compile(r"results/[\w-]+/[\w-]+\.json\.xz|<!-- generated: ")
Value = float | str | None


class File:
    """A result file of results/, by its name without endings: "h200/table1"."""

    def __init__(self, name: str) -> None:
        self.document: dict[str, Any] = json.loads(lzma.decompress((ROOT / "results" / f"{name}.json.xz").read_bytes()))
        self.cells = [Cell(raw) for raw in self.document["cells"]]
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

    def results(self) -> list[dict[str, Any]]:
        """Returns the cells of several ranks, in the order of the file."""
        return rank_files.cells_of(self.document, self.name)


def us(cell: Cell, *stages: str) -> float:
    """Returns the sum of the median microseconds of the stages, or the median of the whole without stages."""
    return sum(cell.median_ns(stage) for stage in stages or ("",)) * 1e-3


def query_us(cell: Cell) -> float:
    """Returns the sum of the median microseconds of the stages after the tree."""
    return us(cell, *(stage for stage in cell.samples[0] if stage in OF_QUERY))


def tree_us(cell: Cell) -> float:
    """Returns the same of the stages that make the tree."""
    return us(cell, *(stage for stage in cell.samples[0] if stage not in OF_QUERY))


def later_ms(frames: Sequence[Cell]) -> float:
    """Returns the mean over the frames after the first of their median milliseconds."""
    return sum(us(cell) for cell in frames[1:]) / (len(frames) - 1) * 1e-3


def sah(file: File, scene: str, asked: str) -> float:
    """Returns the surface area cost of a tree."""
    return file.cell(scene, asked).counters["sah_cost"]


def frame_ms(cell: dict[str, Any]) -> float:
    """Returns the median time of a frame of several ranks in milliseconds."""
    return cell["frame_ns"] * 1e-6


def ends(values: Iterable[float]) -> tuple[float, float]:
    return min(those := list(values)), max(those)


def ratios(values: Iterable[float], others: Iterable[float]) -> tuple[float, float]:
    """Returns the least and the largest ratio of each value to the other in its place."""
    return ends(one / other for one, other in zip(values, others, strict=True))


def shown(value: Value) -> str:
    """Returns the entry of a table: three digits of a number, all digits of a whole one."""
    if value is None or isinstance(value, str):
        return value or ""
    return f"{value:,}" if isinstance(value, int) else "0" if value == 0 else tables.three_digits(value)


def best(values: Sequence[float]) -> list[str]:
    """Returns the entries of values, the least one bold."""
    return [f"**{shown(value)}**" if value == min(values) else shown(value) for value in values]


def markdown(titles: str, rows: Iterable[Sequence[Value]]) -> str:
    """Returns a table that can be read as plain text. `titles` has "|" between columns; "<" aligns one to the left."""
    heads = [title.strip() for title in titles.split("|")]
    texts = [[head.removeprefix("<").strip() for head in heads], *([shown(value) for value in row] for row in rows)]
    widths = [max(3, *map(len, column)) for column in zip(*texts, strict=True)]
    aligns = ["<" if head.startswith("<") else ">" for head in heads]
    lines = [[f"{text:{align}{width}}" for text, align, width in zip(row, aligns, widths, strict=True)] for row in texts]
    lines[1:1] = [["-" * (width - (align == ">")) + ":" * (align == ">") for align, width in zip(aligns, widths, strict=True)]]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


class Quote(NamedTuple):
    """A number, text or table of a document between two offsets, and its value in the file."""

    start: int
    end: int
    value: float | str


class Document:
    """A document whose tables and numbers are compared."""

    def __init__(self, path: pathlib.Path, root: pathlib.Path = ROOT) -> None:
        self.path, self.name, self.text = path, str(path.relative_to(root)), path.read_text(encoding="utf-8")
        self.quotes: list[Quote] = []
        self.faults: list[str] = []
        self.marks = re.findall(r"<!-- generated: (.*?) -->", self.text)
        self.made: list[str] = []

    def line(self, offset: int) -> str:
        return f"{self.name}:{self.text.count(chr(10), 0, offset) + 1}"

    def table(self, name: str, titles: str, rows: Iterable[Sequence[Value]]) -> None:
        self.block(name, markdown(titles, rows))

    def block(self, name: str, text: str) -> None:
        """The document has these lines between the marks of their name."""
        self.made.append(name)
        begin = f"<!-- generated: {re.escape(name)} -->"
        if found := re.search(rf"^{begin}\n((?:(?!<!--).)*)^<!-- end -->$", self.text, re.MULTILINE | re.DOTALL):
            self.quotes.append(Quote(*found.span(1), text))
        else:
            self.faults.append(f"{self.name}: the block '{name}' has no marks, or no end")

    def says(self, sentence: str, *values: float | str) -> None:
        """The document has this sentence once, with a number of this value for each {}, rounded to the digits that it has there, or
        with this text. Blanks and ends of lines are equal, and a number may be bold."""
        pieces = [r"\s+".join(map(re.escape, re.split(r"\s+", piece))) for piece in sentence.split("{}")]
        if len(pieces) != len(values) + 1:
            raise LookupError(f"'{sentence}' has {len(pieces) - 1} places for {len(values)} values")
        places = [TEXT_PLACE if isinstance(value, str) else NUMBER_PLACE for value in values]
        whole = r"(?!\d|[.,]\d)" if sentence.endswith("{}") else ""  # a number at the end of the sentence is taken whole
        pattern = "".join(piece + place for piece, place in zip(pieces, [*places, whole], strict=True))
        found = list(re.finditer(pattern, self.text))
        if len(found) == 1:
            self.quotes += [Quote(*found[0].span(place), value) for place, value in enumerate(values, 1)]
        else:
            self.faults.append(f"{self.name}: {'no' if not found else len(found)} text '{sentence}'")

    def row(self, label: str, *values: float | str) -> None:
        """A row of a table begins with the label and has these values."""
        self.says(f"| {label} |{' {} |' * len(values)}", *values)

    def differing(self) -> list[Quote]:
        return [quote for quote in self.quotes if not agrees(self.text[quote.start:quote.end], quote.value)]

    def findings(self) -> list[str]:
        wrong = [f"{self.name}: the marks and the list of tables differ: {there or 'none'}, {made or 'none'}"
                 for there, made in [(sorted(self.marks), sorted(self.made))] if there != made]
        for quote in self.differing():
            value = quote.value if isinstance(quote.value, str) else f"{quote.value:.6g}"
            both = [*self.text[quote.start:quote.end].splitlines(), ""], [*value.splitlines(), ""]
            there, made = next(pair for pair in zip(*both) if pair[0] != pair[1])  # the first line that differs, of a table
            wrong.append(f"{self.line(quote.start)}: {there or 'nothing'}, the file has {made or 'nothing'}")
        return [*self.faults, *wrong]

    def filled(self) -> str:
        """Returns the text with the files' tables and numbers."""
        text = self.text
        once = {quote.start: quote for quote in self.differing()}  # sentences may share a number
        for _, quote in sorted(once.items(), reverse=True):
            text = text[:quote.start] + filled(text[quote.start:quote.end], quote.value) + text[quote.end:]
        return text


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
    return [read(path) for path in sorted((ROOT / "results" / "quotes").rglob("*.py")) if path.name != CLAIMS]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fill", action="store_true", help="write the files' tables and numbers into the documents")
    arguments = parser.parse_args()
    those = documents()
    if arguments.fill:
        for one in those:
            if one.differing():
                output.write(one.path, one.filled().encode())
        those = documents()
    findings = [finding for one in those for finding in one.findings()]
    print("\n".join(findings) or f"{sum(len(one.quotes) for one in those)} tables and numbers are those of their files")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
