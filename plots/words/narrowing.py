"""Makes a table fit a width: moves columns with one value above it, wraps names, and leaves the least important columns out."""
import textwrap

LEAST = ("submitted", "queued", "p10", "p90", "q1", "q3", "p10–p90", "bytes", "moved", "GB/s", "ns/tri", "launches", "updates",
         "sorts", "tasks", "rebuilds", "n", "padding %", "duplicates", "longest run", "inflation", "peak BVTT", "±", "Mtris/s", "MB",
         "% of copy")  # columns that are left out, in this order
WRAPPED, NARROWEST = 34, 14  # widths that names are wrapped to, before and after columns are left out
GAP = 2


class Fitted:
    """Columns of a table, each a list of its entries, with titles and alignments."""

    def __init__(self, titles: list[str], aligns: list[str], rows: list[list[str]], width: int) -> None:
        self.titles, self.aligns, self.width = titles, aligns, width
        self.columns = [list(column) for column in zip(*rows, strict=True)] if rows else [[] for _ in titles]
        self.shown = list(range(len(titles)))
        self.limits = [max(map(len, (title, *column))) for title, column in zip(titles, self.columns, strict=True)]
        self.above = self.take_constant(len(rows))
        self.wrap(WRAPPED)
        places = {self.titles[place]: place for place in self.shown}
        self.left_out = self.leave_out([places[title] for title in LEAST if title in places])
        self.wrap(NARROWEST)
        self.left_out += self.leave_out([place for place in reversed(self.shown[1:]) if self.aligns[place] == ">"])
        self.wrap(0)

    def take_constant(self, count: int) -> list[str]:
        """Removes columns with one value in all rows, and blank ones, and returns "title: value" of the former. At least one
        column stays."""
        if count < 2:
            return []
        constant = [place for place in self.shown if self.titles[place] and len(set(self.columns[place])) == 1]
        constant = constant[:len(self.shown) - 1]
        self.shown = [place for place in self.shown if place not in constant]
        return [f"{self.titles[place]}: {self.columns[place][0]}" for place in constant if self.columns[place][0]]

    def excess(self) -> int:
        return sum(self.limits[place] + GAP for place in self.shown) - GAP - self.width

    def wrap(self, least: int) -> None:
        """Narrows columns of text, the widest first, down to `least` or to their longest word, until the table fits."""
        for place in sorted((place for place in self.shown if self.aligns[place] == "<"), key=lambda place: -self.limits[place]):
            if (excess := self.excess()) > 0:
                word = max((len(word) for entry in (self.titles[place], *self.columns[place]) for word in entry.split()), default=0)
                self.limits[place] = min(self.limits[place], max(least, min(word, WRAPPED), self.limits[place] - excess))

    def leave_out(self, order: list[int]) -> list[str]:
        """Removes columns, in the given order, until the table fits. Returns their titles."""
        gone = []
        for place in order:
            if self.excess() <= 0:
                break
            self.shown.remove(place)
            gone.append(self.titles[place])
        return gone

    def cells_of(self, row: list[str]) -> list[list[str]]:
        """Returns the lines of each shown entry of a row, or of the titles."""
        return [textwrap.wrap(row[place], self.limits[place]) or [""] for place in self.shown]
