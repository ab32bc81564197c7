"""Tables and numbers for the console."""
import math
from collections.abc import Sequence

LEFT, RIGHT = "<", ">"


class Table:
    """Columns as wide as their widest entry. A title that begins with "<" aligns its column to the left."""

    def __init__(self, *titles: str) -> None:
        self.titles = [title.removeprefix(LEFT) for title in titles]
        self.aligns = [LEFT if title.startswith(LEFT) else RIGHT for title in titles]
        self.rows: list[list[str]] = []

    def row(self, *entries: str) -> None:
        """One entry a column; missing ones at the end are blank."""
        self.rows.append([*entries, *[""] * (len(self.titles) - len(entries))])

    def text(self) -> str:
        """A line of titles if any column has one, then the rows, each ended by a newline."""
        lines = [self.titles, *self.rows] if any(self.titles) else self.rows
        widths = [max(map(len, column)) for column in zip(self.titles, *self.rows)]
        return "".join("  ".join(f"{entry:{align}{width}}" for entry, align, width in zip(line, self.aligns, widths)).rstrip(" ") + "\n"
                       for line in lines)


def with_unit(value: float, units: Sequence[str]) -> str:
    """Three digits that count, in the largest of the units that leaves at least 1."""
    unit = 0
    while unit + 1 < len(units) and value >= 999.5:
        value /= 1000
        unit += 1
    digits = 0 if unit == 0 or value >= 99.95 else 1 if value >= 9.995 else 2
    return f"{value:.{digits}f} {units[unit]}"


def duration(ns: float) -> str:
    """Nanoseconds in the unit that suits: "950 ns", "71.2 us", "1.30 ms"."""
    return with_unit(ns, ("ns", "us", "ms", "s"))


def size(count: float) -> str:
    """Bytes in the unit that suits: "512 B", "6.91 MB"."""
    return with_unit(count, ("B", "kB", "MB", "GB", "TB"))


def counted(count: int, what: str) -> str:
    """"1 cell", "1,200 cells"."""
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def whole(value: float | None) -> str:
    """"1,200"; blank of what is not known, which is None or NaN."""
    return "" if value is None or math.isnan(value) else f"{int(value):,}"


def fixed(value: float | None, digits: int = 2) -> str:
    """So many digits after the point; blank of what is not known."""
    return "" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def exact(value: float) -> str:
    """With as many digits as tell a number from all others."""
    return repr(float(value) + 0.0).removesuffix(".0")  # of -0.0 it is 0
