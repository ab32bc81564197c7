"""Prints the cells of a run, one line each."""
import math
from collections.abc import Callable

from ..read import results
from ..read.cells import Cell
from ..read.ranking import middle_of
from ..words import tables
from ..words.tables import Table, whole
from . import spread

MOST_LINES = 100  # with more cells, only those that do not agree have a line


def wanted_of(run: results.Run) -> Callable[[Cell], bool]:
    """Returns a filter for the cells that agree: true if they have a line. Frames have a separate table."""
    others = sum(cell.operation != "collide" for cell in run.all_cells)
    return lambda cell: others <= MOST_LINES and (others == len(run.all_cells) or cell.operation != "collide")


def text(run: results.Run, wanted: Callable[[Cell], bool] | None = None) -> str:
    """Returns a line for each cell that does not agree or for which `wanted` is true, and the number of all cells."""
    wanted = wanted or wanted_of(run)
    has_wall = any(cell.wall_ns for cell in run.all_cells)
    table = Table("<scene", "triangles", "<builder", *spread.TITLES, *["wall"] * has_wall, "n", "Mtris/s", "ns/tri", "GB/s", "% of copy", "<verdict")
    middle = middle_of(run.all_cells)
    shown = [cell for cell in run.all_cells if cell.verdict != "agrees" or wanted(cell)]
    for cell in shown:
        table.row(*line(cell, run.copy_rate_of(cell), has_wall), among=cell.scene, value=middle(cell) if cell.has_times else math.nan)
    stand_ins = "* a stand-in: the scene itself is not there\n" if any(cell.stand_in_for for cell in shown) else ""
    agreeing = sum(cell.verdict == "agrees" for cell in run.all_cells)
    return f"{table.text() if shown else ''}{stand_ins}{outside(shown)}{len(run.all_cells):,} cells, {agreeing:,} agree\n"


def outside(cells: list[Cell]) -> str:
    """Returns a line for each builder or collider from outside: whose it is."""
    whose = {cell.outside["name"]: cell.provenance for cell in cells if cell.outside}
    return "".join(f"{name}, from outside: {provenance}\n" for name, provenance in whose.items())


def line(cell: Cell, copy_rate: float, has_wall: bool) -> list[str]:
    head = [cell.scene + (" *" if cell.stand_in_for else ""), whole(cell.triangles or None), cell.pipeline]
    if not cell.has_times:
        return [*head, cell.verdict, *[""] * (9 + has_wall), cell.reason or cell.check.get("detail", "")]
    middle = cell.median_ns()
    rate = cell.triangles * 1e3 / middle if middle > 0 else 0
    rates = [f"{rate:.1f}", f"{1e3 / rate:.2f}"] if rate > 0 else ["", ""]
    wall = [tables.duration(cell.wall_ns) if cell.wall_ns else ""] * has_wall
    return [*head, *spread.of(cell.times_ns()), *wall, str(len(cell.samples)), *rates,
            *spread.rates(spread.of_stages(cell, "moved_bytes"), middle, copy_rate), cell.verdict]
