"""The experiment builders as a table of a page (tables.py says what a table is)."""
import math
from typing import Any

from ..read import builder_rows, results
from ..read.builder_rows import Row
from . import cell_data

COLUMNS = [("scene", "text"), ("builder", "text"), ("on", "text"), ("million triangles a second", "number"), ("of the hierarchy", "number"),
           ("peak MB", "number"), ("reserved MB", "number"), ("tree MB", "number"), ("surface area cost", "number"),
           ("end-point overlap", "number"), ("query", "time"), ("frame", "time"), ("collider", "text")]


def tables_of(run: results.Run) -> list[dict[str, Any]]:
    """Returns one row for each builder and scene; nothing without cells of the experiment."""
    rows = [row for there in builder_rows.of_run(run).values() for row in there]
    if not rows:
        return []
    return [cell_data.table(
        "Each builder, with its best collider", COLUMNS, ("scene", "builder", "on", "collider"),
        [values_of(row) for row in rows], [row.build for row in rows],
        "Peak: the most memory of the device that the cell held at once. Query and frame: medians with the collider whose "
        "frame is the soonest. docs/builders.md says what each column is.")]


def values_of(row: Row) -> list[Any]:
    values = [row.rate(), row.rate("hierarchy"), *(1e-6 * value for value in (row.counter("device_peak_bytes"), row.reserved,
              row.counter("tree_bytes"))), row.counter("sah_cost"), row.counter("epo"), 1e-6 * row.query_ns, 1e-6 * row.frame_ns]
    return [cell_data.scene_name(row.build), row.label, "host" if row.build.on_host else "device",
            *(None if math.isnan(value) else value for value in values), row.collider or None]
