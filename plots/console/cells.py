"""The cells of a run, a line each."""
from collections.abc import Callable

import results
from cells import Cell
from console import spread
from tables import Table

MOST_LINES = 100  # with more cells than this, only those that need a look have a line


def all_of_them(_cell: Cell) -> bool:
    return True


def builds(cell: Cell) -> bool:
    return cell.operation != "collide"


def none(_cell: Cell) -> bool:
    return False


def wanted_of(run: results.Run) -> Callable[[Cell], bool]:
    """Which of the cells that agree have a line: frames have a table of their own."""
    others = sum(cell.operation != "collide" for cell in run.all_cells)
    return none if others > MOST_LINES else builds if others < len(run.all_cells) else all_of_them


def text(run: results.Run, wanted: Callable[[Cell], bool] | None = None) -> str:
    """A line for each cell that does not agree, and for those that are wanted; all are counted."""
    wanted = wanted or wanted_of(run)
    table = Table("<scene", "triangles", "<builder", *spread.TITLES, "n", "Mtris/s", "ns/tri", "GB/s", "% of copy", "<verdict")
    shown = [cell for cell in run.all_cells if cell.verdict != "agrees" or wanted(cell)]
    for cell in shown:
        table.row(line(cell, run.copy_rate_of(cell)))
    stand_ins = "* a stand-in: the scene itself is not there\n" if any(cell.stand_in_for for cell in shown) else ""
    agreeing = sum(cell.verdict == "agrees" for cell in run.all_cells)
    return f"{table.text() if shown else ''}{stand_ins}{len(run.all_cells):,} cells, {agreeing:,} agree\n"


def line(cell: Cell, copy_rate: float) -> list[str]:
    head = [cell.scene + (" *" if cell.stand_in_for else ""), f"{cell.triangles:,}" if cell.triangles else "", cell.pipeline]
    if not cell.has_times:
        return [*head, cell.verdict, *[""] * 9, cell.reason or cell.check.get("detail", "")]
    times, moved = cell.whole_times_ns(), spread.moved_bytes(cell)
    middle = spread.median(times)
    rate = cell.triangles * 1e3 / middle if middle > 0 else 0
    return [*head, *spread.of(times), str(len(cell.samples)), f"{rate:.1f}" if rate > 0 else "",
            f"{1e3 / rate:.2f}" if rate > 0 else "", spread.rate(moved, middle), spread.copy_share(moved, middle, copy_rate),
            cell.verdict]
