"""Prints run time against error, one table for each axis of accuracy."""
from collections.abc import Callable

from ..read import results
from ..read.cells import Cell, elapsed_ns, grouped, median, whole_ns
from ..words.tables import Table, duration, fixed, whole
from . import spread, swept_table

YARDSTICK = "guigue-f64"
FRAME_COUNTS = ("pairs_count", "right_contacts_count", "missed_count", "false_count")
SIZES = ("depth of missed: median/99 %/most", "gap of false")
NARROW = ("filter-f64+exact", "filter-f64", "filter-f32", YARDSTICK, "guigue-f32", "moller-f32", "sat-f32")


def text(run: results.Run) -> str:
    """Returns the tables; empty if the file has no cells of an axis."""
    by_axis = grouped((cell for cell in run.all_cells if cell.operation == "accuracy"), lambda cell: cell.accuracy["axis"])
    return "".join(table(by_axis[axis]) for axis, table in AXES.items() if axis in by_axis) + swept_table.text(run, "accuracy")


def counts(cell: Cell, *keys: str) -> list[str]:
    return [whole(cell.counters.get(key)) for key in keys]


def must(cell: Cell, *keys: str) -> list[str]:
    """Returns required counters as text. Raises KeyError if one is missing."""
    return [whole(cell.counters[key]) for key in keys]


def lines(cells: list[Cell], titles: tuple[str, ...], row: Callable[[Cell], list[str]],
          has_numbers: Callable[[Cell], bool] = lambda cell: cell.has_times) -> str:
    """Returns one line for each cell: scene, method, the entries of `row`, and the verdict; or why there are no numbers."""
    table = Table(*titles, "<verdict")
    for cell in cells:
        numbers = [*row(cell), cell.verdict] if has_numbers(cell) else [*[""] * (len(titles) - 2), spread.why(cell)]
        table.row(cell.scene_facts["name"], cell.accuracy["method"], *numbers)
    return table.text()


def sums(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<sum", "nodes", "surface area cost", "relative error", "ns/node"), lambda cell: [
        *must(cell, "nodes_count"), f"{cell.counters['sah_cost']:.6f}",
        f"{error:.1e}" if (error := cell.counters["relative_error"]) else "0",
        f"{spread.ratio(cell.median_ns(), cell.counters['nodes_count']):.2f}"])


def codes(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<codes", "duplicates", "longest run", "surface area cost", "box tests", "codes and sort",
                         "build", "query", "missed", "false"), lambda cell: [
        *counts(cell, "duplicates_count", "longest_run_count"), fixed(cell.counters.get("sah_cost")),
        *counts(cell, "box_tests_count"), duration(cell.median_ns("codes") + cell.median_ns("sort")),
        duration(build_ns(cell)), duration(cell.median_ns("broad")), *counts(cell, "missed_count", "false_count")])


def build_ns(cell: Cell) -> float:
    """Returns the median time of all stages but the query."""
    return median([whole_ns(sample) - elapsed_ns(sample["broad"]) for sample in cell.samples if "broad" in sample])


def inputs(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<vertices", "pairs of doubles", "missed", "false", "times as many", "frame"), lambda cell: [
        *must(cell, "right_pairs_count", "missed_count", "false_count"), inflation(cell), duration(cell.median_ns())])


def place(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<narrow phase", "pairs", "missed", "false", "left open", "ns/pair", "frame"), lambda cell: [
        *must(cell, "pairs_count", "missed_count", "false_count"),
        f"{100 * spread.ratio(cell.counters['narrow_exact_count'], cell.counters['pairs_count']):.1f} %",
        f"{spread.ratio(cell.median_ns('narrow'), cell.counters['pairs_count']):.1f}", duration(cell.median_ns())])


def boxes(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<boxes", "bytes a box", "gather", "hierarchy", "query", "narrow", "frame", "box tests",
                         "missed", "false", "times as many"), lambda cell: [
        *(count or "0" for count in counts(cell, "node_bytes")),
        *(duration(cell.median_ns(name)) for name in ("gather", "hierarchy", "broad", "narrow", "")),
        *(count or "0" for count in counts(cell, "box_tests_count", "missed_count", "false_count")), inflation(cell)])


def inflation(cell: Cell) -> str:
    """Returns the number of pairs found for each right pair."""
    right = cell.counters.get("right_pairs_count", 0)
    return f"{cell.counters['pairs_count'] / right:.3f}" if right > 0 else ""


def sizes(cells: list[Cell], of: str) -> str:
    """Returns the median, the 99th percentile and the largest of errors' sizes, each the largest of the cells'; empty without errors."""
    found = [[cell.counters[f"{of}_{key}"] for key in ("median", "99_percent", "most")] for cell in cells if f"{of}_most" in cell.counters]
    return "/".join(f"{max(values):.0e}" if max(values) else "0" for values in zip(*found, strict=True))


def narrow(cells: list[Cell]) -> str:
    yardsticks = {cell.scene_facts["name"]: ns_a_pair(cell) for cell in reversed(cells)
                  if cell.accuracy["method"] == YARDSTICK and cell.has_times}

    def row(cell: Cell) -> list[str]:
        pairs, beside = cell.counters["pairs_count"], yardsticks.get(cell.scene_facts["name"])
        own = ns_a_pair(cell) if cell.has_times else None
        return [*must(cell, "pairs_count", "meeting_count", "missed_count", "false_count"),
                sizes([cell], "missed_depth"), sizes([cell], "false_gap"),
                f"{100 * cell.counters['narrow_exact_count'] / pairs:.1f} %" if pairs and cell.accuracy["method"] in NARROW else "",
                f"{own:.2f}" if own is not None else "",
                f"{spread.ratio(own, beside):.2f}" if own is not None and beside is not None else ""]

    titles = ("<pairs of triangles", "<narrow phase", "pairs", "meet", "missed", "false", *SIZES, "exactly", "ns/pair", f"of {YARDSTICK}")
    return lines(cells, titles, row, lambda cell: cell.status == "measured") + "".join(totals(cells))


def ns_a_pair(cell: Cell) -> float:
    return spread.ratio(cell.median_ns(), cell.counters["pairs_count"])


def totals(cells: list[Cell]) -> list[str]:
    measured = [cell for cell in cells if cell.status == "measured"]
    said = []
    by_method = grouped(measured, lambda cell: cell.accuracy["method"])
    for method in sorted(by_method, key=lambda name: (NARROW.index(name) if name in NARROW else len(NARROW), name)):
        own = [cell.counters for cell in by_method[method]]
        missed, false, pairs = (int(sum(one[key] for one in own)) for key in ("missed_count", "false_count", "pairs_count"))
        wrong = sum(one["missed_count"] + one["false_count"] > 0 for one in own)
        said.append(f"{method}: {missed:,} missed and {false:,} false of {pairs:,} pairs, "
                    f"wrong in {wrong} of {len(own)} classes\n")
    return said + [f"seed {seed}\n" for seed in sorted({cell.accuracy.get("seed", 0) for cell in measured})]


def frames(cells: list[Cell]) -> str:
    """Returns one line for each setting of a scene: times are means over its frames, counts are of all of them, sizes those of the worst."""
    table = Table("<scene", "<setting", "frames", "frame", "pairs", "contacts", "missed", "false", *SIZES, "<verdict")
    for (scene, method), own in grouped(cells, lambda cell: (cell.scene_facts["name"], cell.accuracy["method"])).items():
        if without := [cell for cell in own if not cell.has_times]:
            table.row(scene, method, *[""] * (6 + len(SIZES)), spread.why(without[0]))
            continue
        table.row(scene, method, str(len(own)), duration(sum(cell.median_ns() for cell in own) / len(own)),
                  *(whole(sum(cell.counters[key] for cell in own)) for key in FRAME_COUNTS),
                  sizes(own, "missed_depth"), sizes(own, "false_gap"), own[0].verdict)
    return table.text()


def distance(cells: list[Cell]) -> str:
    return lines(cells, ("<scene", "<narrow phase", "within", "candidates", "pairs", "missed", "false", "median error", "most", "narrow", "frame"), lambda cell: [
        cell.raw["collider"]["options"]["within"], *must(cell, "pairs_count", "contacts_count"),
        *(count or "0" for count in counts(cell, "missed_count", "false_count")),
        *(f"{error:.0e}" if (error := cell.counters.get(f"distance_error_{key}")) is not None else "" for key in ("median", "most")),
        duration(cell.median_ns("narrow")), duration(cell.median_ns())])


def queries(cells: list[Cell]) -> str:
    """Returns one line for each set of queries and method, and one for each method over all sets of a kind."""
    titles = ("<queries", "<method", "number", "touch", "missed", "false", "late", "median gap", "99 %", "mean loss", "cut short", "ns/query")
    return lines(cells, titles, lambda cell: [
        *must(cell, "queries_count", "touching_count", "missed_count", "false_count", "late_count"),
        *(f"{cell.counters[key]:.1e}" for key in ("gap_median", "gap_99_percent", "shortened_mean")), whole(cell.counters.get("cut_short_count")),
        f"{spread.ratio(cell.median_ns(), cell.counters['queries_count'] * cell.counters['copies_count']):.0f}"]) + "".join(
            f"{method}, {kind}: {sums['missed_count']:,} missed, {sums['late_count']:,} late and {sums['false_count']:,} false of "
            f"{sums['queries_count']:,} queries\n" for (method, kind), sums in sums_of_queries(cells).items())


def sums_of_queries(cells: list[Cell]) -> dict[tuple[str, str], dict[str, int]]:
    measured = (cell for cell in cells if cell.status == "measured")
    by_kind = grouped(measured, lambda cell: (cell.accuracy["method"], cell.scene_facts["name"].split("/")[-1].split()[0]))
    return {name: {key: int(sum(cell.counters[key] for cell in own)) for key in ("missed_count", "late_count", "false_count", "queries_count")}
            for name, own in by_kind.items()}


AXES: dict[str, Callable[[list[Cell]], str]] = {"narrow": narrow, "sums": sums, "codes": codes, "input": inputs, "place": place, "boxes": boxes,
                                                "frames": frames, "queries": queries, "distance": distance}
