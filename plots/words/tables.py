"""Formats tables and numbers for the console."""
import itertools
import math
import textwrap
from collections.abc import Collection, Sequence

from . import narrowing, terminal

LEFT, RIGHT = "<", ">"


class Table:
    """A table whose columns are as wide as their widest entry; on a terminal it fits the width (narrowing.py). A title that starts
    with "<" aligns its column to the left."""

    def __init__(self, *titles: str) -> None:
        self.titles = [title.removeprefix(LEFT) for title in titles]
        self.aligns = [LEFT if title.startswith(LEFT) else RIGHT for title in titles]
        self.rows: list[list[str]] = []
        self.values: dict[str, list[tuple[float, int]]] = {}

    def row(self, *entries: str, among: str = "", value: float = math.nan) -> None:
        """Adds a row with one entry for each column; missing entries at the end are blank. Of several rows with the same `among`
        the one with the least value is bold on a terminal."""
        if among and not math.isnan(value):
            self.values.setdefault(among, []).append((value, len(self.rows)))
        self.rows.append([*map(terminal.cleaned, entries), *[""] * (len(self.titles) - len(entries))])

    def text(self) -> str:
        """Returns the titles, if any column has one, then the rows, each ended by a newline."""
        if terminal.screen.width is not None and any(self.titles) and self.rows:
            return self.fitted(terminal.screen.width)
        widths = [max(map(len, column)) for column in zip(self.titles, *self.rows, strict=True)]
        titles = self.line(self.titles, widths, self.aligns) if any(self.titles) else ""
        best = self.best()
        return titles + "".join(self.line(row, widths, self.aligns, row_number in best) for row_number, row in enumerate(self.rows))

    def best(self) -> set[int]:
        return {min(those)[1] for those in self.values.values() if len(those) > 1}

    def fitted(self, width: int) -> str:
        made, best = narrowing.Fitted(self.titles, self.aligns, self.rows, width), self.best()
        aligns, widths = [self.aligns[place] for place in made.shown], [made.limits[place] for place in made.shown]
        lines = [f"{line}\n" for line in textwrap.wrap("; ".join(made.above), width)]
        for number, row in enumerate((self.titles, *self.rows), -1):
            for entries in itertools.zip_longest(*made.cells_of(row), fillvalue=""):
                lines.append(self.line(entries, widths, aligns, number in best))
        if made.left_out:
            said = f"{counted(len(made.left_out), 'column')} left out: {', '.join(made.left_out)}; --wide shows all"
            lines += [f"{line}\n" for line in textwrap.wrap(said, width, break_on_hyphens=False)]
        return "".join(lines)

    @staticmethod
    def line(entries: Sequence[str], widths: list[int], aligns: list[str], is_best: bool = False) -> str:
        """Returns one line. Verdicts, in columns of text after the first, have the colour of what they say."""
        padded = [f"{entry:{align}{width}}" for entry, align, width in zip(entries, aligns, widths, strict=True)]
        last = max((place for place, entry in enumerate(entries) if entry), default=-1)
        padded = [text.rstrip(" ") if place == last else text for place, text in enumerate(padded[:last + 1])]
        usual = terminal.BOLD if is_best else ""
        styles = [(terminal.of_verdict(text) if place > 0 and align == LEFT else "") or usual
                  for place, (text, align) in enumerate(zip(padded, aligns))]
        return "  ".join(map(terminal.dressed, padded, styles)) + "\n"


def with_unit(value: float, units: Sequence[str]) -> str:
    """Returns three significant digits, in the largest of the units in which the value is at least 1."""
    unit = 0
    while unit + 1 < len(units) and value >= 999.5:
        value /= 1000
        unit += 1
    digits = 0 if unit == 0 or value >= 99.95 else 1 if value >= 9.995 else 2
    return f"{value:.{digits}f} {units[unit]}"


def three_digits(value: float) -> str:
    """Returns at least three significant digits, without an exponent for usual values: "0.200", "18.0", "1,234"."""
    return f"{value:,.0f}" if value >= 99.95 else f"{value:#.3g}"


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


def span(values: Collection[float], digits: int, between: str = " to ") -> str:
    """Returns the least and the largest value as "0.98 to 1.02", or one number where both look the same; blank for unknown ones."""
    if any(map(math.isnan, values)):
        return ""
    ends = [f"{round(value, digits) + 0.0:.{digits}f}" for value in (min(values), max(values))]  # + 0.0 turns -0.0 into 0
    return between.join(dict.fromkeys(ends))


def exact(value: float) -> str:
    """Returns as many digits as distinguish the number from all others."""
    return repr(float(value) + 0.0).removesuffix(".0")  # + 0.0 turns -0.0 into 0
