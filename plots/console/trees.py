"""Prints builds: tree quality, refits beside rebuilds, kernels beside host threads, and stages beside the device's limit. Each
page is empty if the file has no cells for it."""
from ..read import results
from ..read.cells import Cell
from ..words import names
from ..words.tables import Table, duration, fixed, size
from . import spread
from .cell import depths

YARDSTICK = "oibvh-host"


def may_be_shown(cell: Cell) -> bool:
    return cell.verdict == "agrees" and bool(cell.samples)


def head(cell: Cell) -> list[str]:
    return [cell.scene_facts["name"], f"{cell.triangles:,}", names.in_full(cell.raw["builder"])]


def quality(run: results.Run) -> str:
    """Returns surface area cost, overlaps and levels of leaves; empty unless the run computed end-point overlap."""
    table = Table("<scene", "<builder", "SAH", "EPO", "sibling overlap", "<levels of leaves")
    shown = [cell for cell in run.all_cells if cell.leaves_by_depth]
    for cell in shown:
        scene, _, builder = head(cell)
        table.row(scene, builder, *(fixed(cell.counters.get(key)) for key in ("sah_cost", "epo", "sibling_overlap")),
                  depths(cell.leaves_by_depth))
    return table.text() if any("epo" in cell.counters for cell in shown) else ""


def refits(run: results.Run) -> str:
    """Returns each refit beside the rebuild by the same builder on the same scene."""
    table = Table("<scene", "triangles", "<builder", "rebuild", "refit", "times", "hierarchy", "refit stage", "times",
                  "SAH rebuilt", "refitted")
    rebuilds = {cell.key("builder", "scene", "experiment", "caches"): cell
                for cell in reversed(run.all_cells) if cell.operation == "build" and may_be_shown(cell)}
    slower = 0
    for cell in run.all_cells:
        beside = rebuilds.get(cell.key("builder", "scene", "experiment", "caches"))
        if cell.operation != "refit" or not may_be_shown(cell) or beside is None:
            continue
        times = (beside.median_ns(), cell.median_ns()), (beside.median_ns("hierarchy"), cell.median_ns("refit"))
        slower += times[0][0] > times[0][1]
        columns = [[duration(one), duration(other), fixed(one / other if one > 0 and other > 0 else None)]
                   for one, other in times]
        table.row(*head(cell), *columns[0], *columns[1], *(fixed(one.counters.get("sah_cost")) for one in (beside, cell)))
    return (f"{table.text()}medians; rebuild and refit: from moved triangles to a tree over them, all stages; "
            f"times: rebuild over refit\nrebuilding takes longer than refitting in {slower} of {len(table.rows)} cases\n") if table.rows else ""


def yardstick(run: results.Run) -> str:
    """Returns the times of the stage hierarchy beside those of plain host threads, for equal trees."""
    def key_of(cell: Cell) -> tuple[object, ...]:
        return (*cell.key("experiment", "scene"), dict(cell.options).get("leaves", "mesh"), cell.check.get("tree_hash"))

    shown = [cell for cell in run.all_cells if cell.operation == "build" and may_be_shown(cell)]
    yardsticks = {key_of(cell): cell for cell in reversed(shown) if cell.builder == YARDSTICK}
    table = Table("<scene", "triangles", "<builder", "hierarchy", YARDSTICK, "times")
    most = 0.0
    for cell in shown:
        beside = yardsticks.get(key_of(cell))
        if cell.builder == YARDSTICK or beside is None:
            continue
        own, other = cell.median_ns("hierarchy"), beside.median_ns("hierarchy")
        times = spread.ratio(own, other)
        most = max(most, times)
        table.row(*head(cell), duration(own), duration(other), f"{times:.2f}")
    return (f"{table.text()}medians of the stage hierarchy, of trees that are equal: at most {most:.2f} times as long as by "
            "threads of the host\n") if most else ""


def roofline(run: results.Run) -> str:
    """Returns each stage's time over the least time that the device allows: bytes at the copy rate plus launches."""
    if not any(cell.experiment == "roofline" for cell in run.all_cells):
        return ""
    table = Table("<scene", "<of", "<stage", "launches", "bytes", "a triangle", "floor", "reached", "ratio")
    for cell in run.all_cells if run.copy_rate else ():
        for entry in cell.all_samples[0]["stages"] if cell.has_times else ():
            launches, moved = entry.get("launches", 0), entry.get("moved_bytes", 0)
            is_query = cell.operation != "collide" or cell.builder == "none" or entry["stage"] in names.OF_QUERIES
            if not (launches and moved and is_query):
                continue
            floor = 1e9 * moved / run.copy_rate_of(cell) + launches * run.facts.get("launch_cost_ns", 0)
            reached = cell.median_ns(entry["stage"])
            table.row(cell.scene_facts["name"], cell.pipeline, entry["stage"], str(launches), size(moved),
                      f"{moved / max(1, cell.triangles):.1f}", duration(floor), duration(reached), f"{reached / floor:.2f}")
    return "floor: bytes at the copy rate, and launches at the launch cost\n" + table.text()
