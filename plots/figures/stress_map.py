"""What `bvhbench stress` found, as a map: a row a scene, a column a system or a kind of them.

A cell is white where nothing was wrong, and says how many pairs were missed and how many are false where some were, or
that the system failed: crashed, hung, or gave no answer. Builders stand together, and so do a collider's trees and
forms; of several the worst is shown. Libraries as their manuals show them are to the right of the line.
"""
from enum import IntEnum
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
from matplotlib.patches import Patch

from ..draw import cell_map, figure
from ..read import results


class State(IntEnum):
    HOLDS = 0
    REFUSED = 1
    WRONG = 2
    FAILED = 3


COLOURS = {State.HOLDS: "#DDEFF7", State.REFUSED: "#BBBBBB", State.WRONG: "#E69F00", State.FAILED: "#D55E00"}
WORDS = {State.HOLDS: "0 wrong", State.REFUSED: "refused, with a reason", State.WRONG: "not 0: missed (−), false (+)",
         State.FAILED: "failed: crashed, hung or no answer"}


class Entry(NamedTuple):
    """What a cell of the map shows. Of two entries for one place the larger is shown."""

    state: State
    missed: int = 0
    false: int = 0

    @property
    def text(self) -> str:
        if self.state == State.HOLDS:
            return "0"
        if self.state != State.WRONG:
            return "–" if self.state == State.REFUSED else "failed"
        parts = [f"{sign}{short(count)}" for sign, count in (("−", self.missed), ("+", self.false)) if count]
        return "\n".join(parts) or "wrong"


def short(count: int) -> str:
    """Returns 1234 as 1.2k, because columns are narrow."""
    for unit, letter in ((10**6, "M"), (10**3, "k")):
        if count >= unit:
            return f"{count / unit:.{0 if count >= 10 * unit else 1}f}{letter}"
    return str(count)


def entry_of(cell: dict[str, Any]) -> Entry:
    worst = Entry(State.HOLDS)
    for invariant, finding in cell["findings"].items():
        if finding["verdict"] == "refused":
            worst = max(worst, Entry(State.REFUSED))
        elif finding["verdict"] == "broken":
            state = State.FAILED if invariant == "ends" else State.WRONG
            worst = max(worst, Entry(state, finding["missed"], finding["wrong"] - finding["missed"]))
    return worst


def column_of(cell: dict[str, Any]) -> str:
    """Returns the column of a cell: our builders, a library's builders, or a collider, whatever its trees."""
    if cell["kind"] == "builder":
        return f"{cell['library']} builders" if "library" in cell else "builders"
    if cell["kind"] == "collider":
        return cell["system"].split(" over ")[0].split(",")[0]
    return cell["system"] if cell["kind"] == "library" else "host"


def columns_of(cells: list[dict[str, Any]]) -> list[str]:
    """Returns our columns, then libraries that our code wraps, then libraries on their own."""
    def rank(cell: dict[str, Any]) -> int:
        return 2 if cell["kind"] == "library" else 1 if "library" in cell else 0

    return list(dict.fromkeys(column_of(cell) for cell in sorted(cells, key=rank)))


def draw(run: results.Run) -> plt.Figure:
    cells = [cell for cell in run.stress if cell["family"] != "group-sizes"]
    if not cells:
        raise results.Refused(f"{run.path}: nothing that stress found")
    rows = list(dict.fromkeys(f"{cell['family']}: {cell['scene']}" for cell in cells))
    columns = columns_of(cells)
    entries: dict[tuple[str, str], Entry] = {}
    for cell in cells:
        place = (f"{cell['family']}: {cell['scene']}", column_of(cell))
        entries[place] = max(entries.get(place, Entry(State.HOLDS)), entry_of(cell))

    drawn = {place: (COLOURS[entry.state], entry.text) for place, entry in entries.items()}
    drawing, [[axes]] = figure.grid(1, 1, 1.9 + cell_map.inches(drawn, rows))
    cell_map.draw(axes, drawn, rows, columns)
    plain = [column_of(cell) for cell in cells if cell["kind"] == "library"]
    if plain:
        axes.axvline(min(columns.index(column) for column in plain), color="black", linewidth=0.8)
    height = figure.legend_above(drawing, [Patch(color=COLOURS[state], label=WORDS[state]) for state in State], 4)
    versions = ", ".join(f"{name} {run.facts['libraries'][name]}"
                         for name in sorted({cell["library"] for cell in cells if "library" in cell}))
    ours = sum("library" not in cell for cell in run.stress)
    remark = f"{ours:,} cells of ours, of several the worst is shown." + (f" Libraries: {versions}." if versions else "")
    figure.footer(drawing, run, "stress", (remark,), height)
    return drawing
