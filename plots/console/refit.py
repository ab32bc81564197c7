"""Refits beside rebuilds of the same trees."""
import names
import results
from cells import Cell, choice
from console import spread
from tables import Table, duration

NOTE = ("medians; rebuild and refit: from moved triangles to a tree over them, all stages; times: rebuild over refit\n"
        "rebuilding takes longer than refitting in {} of {} cases\n")


def may_be_shown(cell: Cell) -> bool:
    return cell.verdict == "agrees" and bool(cell.samples)


def text(run: results.Run) -> str:
    table = Table("<scene", "triangles", "<builder", "rebuild", "refit", "times", "hierarchy", "refit stage", "times",
                  "SAH rebuilt", "refitted")
    pairs = slower = 0
    for cell in run.all_cells:
        beside = rebuild_of(cell, run) if cell.operation == "refit" and may_be_shown(cell) else None
        if beside is None:
            continue
        rebuild, refit = spread.median(beside.whole_times_ns()), spread.median(cell.whole_times_ns())
        hierarchy, stage = spread.median(beside.times_ns("hierarchy")), spread.median(cell.times_ns("refit"))
        pairs, slower = pairs + 1, slower + (rebuild > refit)
        table.row([cell.scene_facts["name"], f"{cell.triangles:,}", names.in_full(cell.raw["builder"]), duration(rebuild),
                   duration(refit), ratio(rebuild, refit), duration(hierarchy), duration(stage), ratio(hierarchy, stage),
                   cost(beside), cost(cell)])
    return table.text() + NOTE.format(slower, pairs) if pairs else ""


def rebuild_of(refit: Cell, run: results.Run) -> Cell | None:
    """The build by the same builder on the same scene."""
    def key_of(cell: Cell) -> tuple[object, ...]:
        return choice(cell.raw["builder"]), cell.scene_facts["name"], cell.experiment

    return next((cell for cell in run.all_cells
                 if cell.operation == "build" and key_of(cell) == key_of(refit) and may_be_shown(cell)), None)


def ratio(rebuild: float, refit: float) -> str:
    return f"{rebuild / refit:.2f}" if rebuild > 0 and refit > 0 else ""


def cost(cell: Cell) -> str:
    return f"{cell.counters['sah_cost']:.2f}" if "sah_cost" in cell.counters else ""
