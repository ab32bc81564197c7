"""Run time against error, a table for each axis of accuracy."""
from collections.abc import Callable

import results
from cells import Cell, elapsed_ns, whole_ns
from console import spread, swept
from tables import Table, duration

YARDSTICK = "guigue-f64"
NARROW = ("filter-f64+exact", YARDSTICK, "guigue-f32", "moller-f32")


def text(run: results.Run) -> str:
    """Empty if the file has no cells of an axis."""
    on_axes = [cell for cell in run.all_cells if cell.operation == "accuracy"]
    by_axis = {axis: [cell for cell in on_axes if cell.accuracy["axis"] == axis] for axis in AXES}
    return "".join(table(by_axis[axis]) for axis, table in AXES.items() if by_axis[axis]) + swept.text(run, "accuracy")


def count(cell: Cell, key: str) -> str:
    return f"{int(cell.counters[key]):,}" if key in cell.counters else ""


def must(cell: Cell, *keys: str) -> list[str]:
    """Counters without which the line says nothing. Raises KeyError for one that is missing."""
    return [f"{int(cell.counters[key]):,}" for key in keys]


def stage(cell: Cell, name: str) -> float:
    return spread.median(cell.times_ns(name))


def whole(cell: Cell) -> float:
    return spread.median(cell.whole_times_ns())


def lines(cells: list[Cell], titles: tuple[str, ...], row: Callable[[Cell], list[str]]) -> str:
    """A line a cell: scene, method, what `row` says, and the verdict; or why there are no numbers."""
    table = Table(*titles, "<verdict")
    for cell in cells:
        head = [cell.scene_facts["name"], cell.accuracy["method"]]
        if cell.has_times:
            table.row([*head, *row(cell), cell.verdict])
        else:
            table.row([*head, *[""] * (len(titles) - 2), spread.why(cell)])
    return table.text()


def sums(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<sum", "nodes", "surface area cost", "relative error", "ns/node"), lambda cell: [
        *must(cell, "nodes_count"), f"{cell.counters['sah_cost']:.6f}",
        f"{error:.1e}" if (error := cell.counters["relative_error"]) else "0",
        f"{spread.ratio(whole(cell), cell.counters['nodes_count']):.2f}"])


def codes(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<codes", "duplicates", "longest run", "surface area cost", "box tests", "codes and sort",
                         "build", "query", "missed", "false"), lambda cell: [
        count(cell, "duplicates_count"), count(cell, "longest_run_count"),
        f"{cell.counters['sah_cost']:.2f}" if "sah_cost" in cell.counters else "", count(cell, "box_tests_count"),
        duration(stage(cell, "codes") + stage(cell, "sort")),
        duration(build(cell)), duration(stage(cell, "broad")),
        count(cell, "missed_count"), count(cell, "false_count")])


def build(cell: Cell) -> float:
    """All stages but the query."""
    return spread.median([whole_ns(sample) - elapsed_ns(sample["broad"]) for sample in cell.samples if "broad" in sample])


def inputs(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<vertices", "pairs of doubles", "missed", "false", "times as many", "frame"), lambda cell: [
        *must(cell, "right_pairs_count", "missed_count", "false_count"),
        inflation(cell), duration(whole(cell))])


def boxes(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<boxes", "bytes a box", "gather", "hierarchy", "query", "narrow", "frame", "box tests",
                         "missed", "false", "times as many"), lambda cell: [
        count(cell, "node_bytes") or "0", *(duration(stage(cell, name)) for name in ("gather", "hierarchy", "broad", "narrow")),
        duration(whole(cell)), *(count(cell, key) or "0" for key in ("box_tests_count", "missed_count", "false_count")),
        inflation(cell)])


def inflation(cell: Cell) -> str:
    """Pairs found for each right one."""
    right = cell.counters.get("right_pairs_count", 0)
    return f"{cell.counters['pairs_count'] / right:.3f}" if right > 0 else ""


def narrow(cells: list[Cell]) -> str:
    yardsticks: dict[str, float] = {}
    for cell in cells:
        if cell.accuracy["method"] == YARDSTICK and cell.has_times:
            yardsticks.setdefault(cell.scene_facts["name"], ns_a_pair(cell))
    table = Table("<pairs of triangles", "<narrow phase", "pairs", "meet", "missed", "false", "exactly", "ns/pair",
                  f"of {YARDSTICK}", "<verdict")
    for cell in cells:
        head = [cell.scene_facts["name"], cell.accuracy["method"]]
        if cell.status != "measured":
            table.row([*head, *[""] * 7, spread.why(cell)])
            continue
        pairs, beside = cell.counters["pairs_count"], yardsticks.get(cell.scene_facts["name"])
        own = ns_a_pair(cell) if cell.has_times else None
        table.row([*head, *must(cell, "pairs_count", "meeting_count", "missed_count", "false_count"),
                   f"{100 * cell.counters['narrow_exact_count'] / pairs:.1f} %" if pairs else "",
                   f"{own:.2f}" if own is not None else "",
                   f"{spread.ratio(own, beside):.2f}" if own is not None and beside is not None else "", cell.verdict])
    return table.text() + "".join(totals(cells))


def ns_a_pair(cell: Cell) -> float:
    return spread.ratio(whole(cell), cell.counters["pairs_count"])


def totals(cells: list[Cell]) -> list[str]:
    """What each method got wrong over all classes, and the seeds."""
    measured = [cell for cell in cells if cell.status == "measured"]
    said = []
    methods = {cell.accuracy["method"] for cell in measured}
    for method in sorted(methods, key=lambda name: (NARROW.index(name) if name in NARROW else len(NARROW), name)):
        own = [cell.counters for cell in measured if cell.accuracy["method"] == method]
        missed, false, pairs = (int(sum(one[key] for one in own)) for key in ("missed_count", "false_count", "pairs_count"))
        wrong = sum(one["missed_count"] + one["false_count"] > 0 for one in own)
        said.append(f"{method}: {missed:,} missed and {false:,} false of {pairs:,} pairs, "
                    f"wrong in {wrong} of {len(own)} classes\n")
    return said + [f"seed {seed}\n" for seed in sorted({cell.accuracy.get("seed", 0) for cell in measured})]


AXES: dict[str, Callable[[list[Cell]], str]] = {"narrow": narrow, "sums": sums, "codes": codes, "input": inputs, "boxes": boxes}
