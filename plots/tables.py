"""Formats tables and numbers for the console."""
import math
from collections.abc import Sequence

LEFT, RIGHT = "<", ">"


class Table:
    """A table whose columns are as wide as their widest entry. A title that starts with "<" aligns its column to the left."""

    def __init__(self, *titles: str) -> None:
        self.titles = [title.removeprefix(LEFT) for title in titles]
        self.aligns = [LEFT if title.startswith(LEFT) else RIGHT for title in titles]
        self.rows: list[list[str]] = []

    def row(self, *entries: str) -> None:
        """Adds a row with one entry for each column; missing entries at the end are blank."""
        self.rows.append([*entries, *[""] * (len(self.titles) - len(entries))])

    def text(self) -> str:
        """Returns the titles, if any column has one, then the rows, each ended by a newline."""
        lines = [self.titles, *self.rows] if any(self.titles) else self.rows
        widths = [max(map(len, column)) for column in zip(self.titles, *self.rows)]
        return "".join("  ".join(f"{entry:{align}{width}}" for entry, align, width in zip(line, self.aligns, widths)).rstrip(" ") + "\n"
                       for line in lines)


def with_unit(value: float, units: Sequence[str]) -> str:
    """Returns three significant digits, in the largest of the units in which the value is at least 1."""
    unit = 0
    while unit + 1 < len(units) and value >= 999.5:
        value /= 1000
        unit += 1
    digits = 0 if unit == 0 or value >= 99.95 else 1 if value >= 9.995 else 2
    return f"{value:.{digits}f} {units[unit]}"


def duration(ns: float) -> str:
    """Returns nanoseconds in a suitable unit: "950 ns", "71.2 us", "1.30 ms"."""
    return with_unit(ns, ("ns", "us", "ms", "s"))


def size(count: float) -> str:
    """Returns bytes in a suitable unit: "512 B", "6.91 MB"."""
    return with_unit(count, ("B", "kB", "MB", "GB", "TB"))


IN_CACHE = "in cache"


def of_copy_rate(share: float) -> float | str:
    """Returns a share of the copy rate, or IN_CACHE if it is above 1: then some of the bytes came from a cache."""
    return share if share <= 1 else IN_CACHE


def percent(share: float | str) -> str:
    """Returns "69.4 %"; words stay."""
    return share if isinstance(share, str) else f"{100 * share:.1f} %"


def counted(count: int, what: str) -> str:
    """Returns "1 cell", "1,200 cells"."""
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def whole(value: float | None) -> str:
    """Returns "1,200", or blank for an unknown value (None or NaN)."""
    return "" if value is None or math.isnan(value) else f"{int(value):,}"


def fixed(value: float | None, digits: int = 2) -> str:
    """Returns `digits` digits after the point, or blank for an unknown value."""
    return "" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def exact(value: float) -> str:
    """Returns as many digits as distinguish the number from all others."""
    return repr(float(value) + 0.0).removesuffix(".0")  # + 0.0 turns -0.0 into 0
