"""The stage hierarchy beside that of plain threads of the host, of trees that are equal."""
import names
import results
from cells import Cell
from console import spread
from tables import Table, duration

YARDSTICK = "oibvh-host"


def may_be_shown(cell: Cell) -> bool:
    return cell.operation == "build" and cell.verdict == "agrees" and bool(cell.samples)


def text(run: results.Run) -> str:
    yardsticks: dict[tuple[object, ...], Cell] = {}
    for cell in run.all_cells:
        if cell.builder == YARDSTICK and may_be_shown(cell):
            yardsticks.setdefault(key_of(cell), cell)
    table = Table("<scene", "triangles", "<builder", "hierarchy", YARDSTICK, "times")
    most = 0.0
    for cell in run.all_cells:
        beside = yardsticks.get(key_of(cell)) if may_be_shown(cell) and cell.builder != YARDSTICK else None
        if beside is None:
            continue
        own, other = (spread.median(one.times_ns("hierarchy")) for one in (cell, beside))
        times = spread.ratio(own, other)
        most = max(most, times)
        table.row([cell.scene_facts["name"], f"{cell.triangles:,}", names.in_full(cell.raw["builder"]), duration(own),
                   duration(other), f"{times:.2f}"])
    return (f"{table.text()}medians of the stage hierarchy, of trees that are equal: at most {most:.2f} times as long as by "
            "threads of the host\n") if most else ""


def key_of(cell: Cell) -> tuple[object, ...]:
    """What two cells must share for their trees to be the same work."""
    return (cell.experiment, cell.scene_facts["name"], dict(cell.options).get("leaves", "mesh"), cell.check.get("tree_hash"))
