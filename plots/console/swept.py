"""Prints queries of swept boxes: one line each, and one for both queries of a step by the same pipeline."""
import math

import names
import results
from cells import Cell, grouped
from console import spread
from tables import Table, fixed, whole

COUNTERS = ("pairs_count", "ground_truth_pairs", "ground_truth_missed")


def text(run: results.Run, operation: str = "collide") -> str:
    table = Table("<scene", "step", "<pairs of", "<pipeline", "boxes", "pairs", "broad, ms", "ms", "Mpairs/s", "ground truth",
                  "missed", "inflation", "<verdict")
    # A group holds both queries of a step by one pipeline. A missing scene has no steps, but is listed along the axis.
    steps = grouped((cell for cell in run.all_cells
                     if cell.operation == operation and (cell.swept or cell.accuracy.get("axis") == "swept")),
                    lambda cell: cell.key("scene", "frame", "experiment", "builder", "collider", without="pairs_of"))
    for cells in steps.values():
        numbers = [numbers_of(cell) for cell in cells]
        for cell, own in zip(cells, numbers):
            scene = cell.scene_facts["name"] + (f" for {cell.stand_in_for}" if cell.stand_in_for else "")
            why = cell.reason or cell.check.get("detail", "")
            table.row(scene, str(cell.frame), cell.swept.get("pairs", ""), method_of(cell), *columns(*own),
                      cell.verdict + (f": {why}" if why else ""))
        if len(cells) > 1:
            table.row("", "", "both", "", *columns(*map(sum, zip(*numbers))))
    return table.text() if steps else ""


def method_of(cell: Cell) -> str:
    over = "" if cell.builder == "none" else f" over {names.in_full(cell.raw['builder'])}"
    return f"{cell.collider or ''}{over}"


def numbers_of(cell: Cell) -> list[float]:
    """Returns the arguments of `columns`. Unknown values are NaN, so that their sums are unknown too."""
    times = [cell.median_ns("broad"), cell.median_ns()] if cell.has_times else [math.nan, math.nan]
    return [cell.swept.get("primitives", 0), *times, *(cell.counters.get(key, math.nan) for key in COUNTERS)]


def columns(primitives: float, broad_ns: float, whole_ns: float, pairs: float, truth: float, missed: float) -> list[str]:
    return [whole(primitives), whole(pairs), fixed(broad_ns * 1e-6, 3), fixed(whole_ns * 1e-6, 3),
            fixed(spread.ratio(pairs, whole_ns) * 1e3, 1), whole(truth), whole(missed), fixed(spread.ratio(pairs, truth), 1)]
