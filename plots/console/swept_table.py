"""Prints queries of swept boxes: one line each, and one for both queries of a step by the same pipeline. Where a narrow phase
follows, the ground truth is what touches, and inflation the number of contacts for each."""
import math

from ..read import results
from ..read.cells import Cell, grouped
from ..words import names
from ..words.tables import Table, fixed, whole
from . import spread

COUNTERS = ("pairs_count", "contacts_count", "false_count", "ground_truth_pairs", "ground_truth_missed")
NARROW = ("narrow, ms", "contacts", "false")  # columns of files that have a narrow phase


def text(run: results.Run, operation: str = "collide") -> str:
    all_cells = [cell for cell in run.all_cells
                 if cell.operation == operation and (cell.swept or cell.accuracy.get("axis") in ("swept", "impacts"))]
    with_narrow = any(has_narrow(cell) for cell in all_cells)
    table = Table("<scene", "step", "<pairs of", "<pipeline", "boxes", "pairs", "broad, ms", *(NARROW if with_narrow else ()), "ms",
                  "Mpairs/s", "ground truth", "missed", "inflation", "<verdict")
    # A group holds both queries of a step by one pipeline. A missing scene has no steps, but is listed along the axis.
    steps = grouped(all_cells, lambda cell: cell.key("scene", "frame", "experiment", "builder", "collider", without="pairs_of"))
    for cells in steps.values():
        numbers = [numbers_of(cell) for cell in cells]
        for cell, own in zip(cells, numbers, strict=True):
            scene = cell.scene_facts["name"] + (f" for {cell.stand_in_for}" if cell.stand_in_for else "")
            table.row(scene, str(cell.frame), cell.swept.get("pairs", ""), method_of(cell), *columns(with_narrow, *own),
                      spread.why(cell))
        if len(cells) > 1:
            table.row("", "", "both", "", *columns(with_narrow, *map(sum, zip(*numbers, strict=True))))
    return table.text() if steps else ""


def has_narrow(cell: Cell) -> bool:
    return bool(cell.raw.get("collider", {}).get("options", {}).get("narrow", "none") != "none")


def method_of(cell: Cell) -> str:
    over = "" if cell.builder == "none" else f" over {names.in_full(cell.raw['builder'])}"
    narrow = f", {cell.raw['collider']['options']['narrow']}" if has_narrow(cell) else ""
    return f"{cell.collider or ''}{over}{narrow}"


def numbers_of(cell: Cell) -> list[float]:
    """Returns the arguments of `columns`. Unknown values are NaN, so that their sums are unknown too."""
    times = [cell.median_ns(stage) for stage in ("broad", "narrow", "")] if cell.has_times else [math.nan] * 3
    known = dict(cell.counters) if has_narrow(cell) else {**cell.counters, "contacts_count": math.nan, "false_count": math.nan}
    return [cell.swept.get("primitives", 0), *times, *(known.get(key, math.nan) for key in COUNTERS)]


def columns(with_narrow: bool, primitives: float, broad_ns: float, narrow_ns: float, whole_ns: float, pairs: float,
            contacts: float, false: float, truth: float, missed: float) -> list[str]:
    narrow = [fixed(narrow_ns * 1e-6, 3), whole(contacts), whole(false)] if with_narrow else []
    found = pairs if math.isnan(contacts) else contacts
    return [whole(primitives), whole(pairs), fixed(broad_ns * 1e-6, 3), *narrow, fixed(whole_ns * 1e-6, 3),
            fixed(spread.ratio(pairs, whole_ns) * 1e3, 1), whole(truth), whole(missed), fixed(spread.ratio(found, truth), 1)]
