"""What rules that skip work avoided and saved, as a table of a page (tables.py says what a table is)."""
from collections.abc import Iterable
from typing import Any

from ..read import savings
from ..read.cells import Cell
from ..read.savings import Saving
from . import cell_data

COLUMNS = [("scene", "text"), ("rule", "text"), ("pipeline", "text"), ("skipped", "text"), ("with", "time"), ("without", "time"),
           ("without over with", "number"), *((f"avoided {amount}", "count") for amount in savings.AMOUNTS), ("answers", "text")]


def tables_of(cells: Iterable[Cell]) -> list[dict[str, Any]]:
    """Returns one row for each scene, pipeline and rule that was switched off; nothing without such cells."""
    found = savings.of_scenes(cells)
    if not found:
        return []
    return [cell_data.table(
        "Rules that skip work", COLUMNS, ("scene", "rule", "pipeline", "skipped"), [row_of(one) for one in found], [one.first for one in found],
        "Frames of a scene together: times are means of medians, amounts are added up. Avoided: without the rule minus "
        "with it. Forced: the device does without the rule, and it was used all the same.")]


def row_of(one: Saving) -> list[Any]:
    own, other = one.ns()
    skipped = "nothing" if not one.skips_something else "something, forced" if one.is_forced else "something"
    times = [own * 1e-6, other * 1e-6, savings.times(one)] if one.skips_something else [None] * 3  # their difference is noise
    return [cell_data.scene_name(one.first), one.rule, one.pipeline, skipped, *times,
            *(one.avoided(amount) for amount in savings.AMOUNTS), "the same" if one.is_same else "NOT the same"]
