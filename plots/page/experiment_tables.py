"""Tables of a page for cells of one experiment: rules that skip work, and builders (tables.py says what a table is)."""
import math
from collections.abc import Iterable
from typing import Any

from ..read import builder_rows, results, savings
from ..read.cells import Cell
from . import cell_data

MS = {"unit": "ms"}
SKIPS = [("scene", "text"), ("rule", "text"), ("pipeline", "text"), ("skipped", "text"), ("with", "time", MS), ("without", "time", MS),
         ("without over with", "number"), *((f"avoided {amount}", "count") for amount in savings.AMOUNTS), ("answers", "text")]
BUILDERS = [("scene", "text"), ("builder", "text"), ("on", "text"), ("million triangles a second", "number"),
            ("of the hierarchy", "number"), ("peak MB", "number"), ("reserved MB", "number"), ("tree MB", "number"),
            ("surface area cost", "number"), ("end-point overlap", "number"), ("query", "time", MS), ("frame", "time", MS),
            ("collider", "text")]


def skips(cells: Iterable[Cell]) -> list[dict[str, Any]]:
    """Returns one row for each scene, pipeline and rule that was switched off; nothing without such cells."""
    found = savings.of_scenes(cells)
    note = ("Frames of a scene together: times are means of medians, amounts are added up. Avoided: without the rule minus "
            "with it. Forced: the device does without the rule, and it was used all the same.")
    return [cell_data.table("Rules that skip work", SKIPS, ("scene", "rule", "pipeline", "skipped"),
                            [skip_row(one) for one in found], note, [cell_data.library_of(one.first) for one in found])] if found else []


def skip_row(one: savings.Saving) -> list[Any]:
    own, other = one.ns()
    skipped = "nothing" if not one.skips_something else "something, forced" if one.is_forced else "something"
    times = [own * 1e-6, other * 1e-6, savings.times(one)] if one.skips_something else [None] * 3  # their difference is noise
    return [cell_data.scene_name(one.first), one.rule, one.pipeline, skipped, *times,
            *(one.avoided(amount) for amount in savings.AMOUNTS), "the same" if one.is_same else "NOT the same"]


def builders(run: results.Run) -> list[dict[str, Any]]:
    """Returns one row for each builder and scene; nothing without cells of the experiment."""
    rows = [row for there in builder_rows.of_run(run).values() for row in there]
    note = ("Peak: the most memory of the device that the cell held at once. Query and frame: medians with the collider whose "
            "frame is the soonest. docs/builders.md says what each column is.")
    return [cell_data.table("Each builder, with its best collider", BUILDERS, ("scene", "builder", "on", "collider"),
                            [builder_row(row) for row in rows], note, [cell_data.library_of(row.build) for row in rows])] if rows else []


def builder_row(row: builder_rows.Row) -> list[Any]:
    megabytes = (1e-6 * value for value in (row.counter("device_peak_bytes"), row.reserved, row.counter("tree_bytes")))
    values = [row.rate(), row.rate("hierarchy"), *megabytes, row.counter("sah_cost"), row.counter("epo"), 1e-6 * row.query_ns,
              1e-6 * row.frame_ns]
    return [cell_data.scene_name(row.build), row.label, "host" if row.build.on_host else "device",
            *(None if math.isnan(value) else value for value in values), row.collider or None]
