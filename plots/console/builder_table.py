"""Prints the experiment builders: a row for each builder and scene, with its build, memory, tree and best query."""
import math

from ..read import builder_rows, results
from ..words.tables import Table, fixed, size

MILLI = 1e-6
TITLES = ("<scene", "<builder", "<on", "Mtris/s", "hierarchy", "peak", "reserved", "tree", "SAH", "EPO", "query ms", "frame ms",
          "<collider")


def text(run: results.Run) -> str:
    """Returns the table; empty if the file has no cell of the experiment. A scene's soonest build is bold on a terminal."""
    table = Table(*TITLES)
    for scene, rows in builder_rows.of_run(run).items():
        for row in rows:
            table.row(scene, row.label, "host" if row.build.on_host else "device", number(row.rate()), number(row.rate("hierarchy")),
                      *map(memory, (row.counter("device_peak_bytes"), row.reserved, row.counter("tree_bytes"))),
                      fixed(row.counter("sah_cost")), number(row.counter("epo"), 2), number(MILLI * row.query_ns, 3),
                      number(MILLI * row.frame_ns, 3), row.collider or "-", among=scene, value=-row.rate())
    return f"builders:\n{table.text()}" if table.rows else ""


def number(value: float, digits: int = 1) -> str:
    return "-" if math.isnan(value) else fixed(value, digits)


def memory(count: float) -> str:
    return "-" if math.isnan(count) else size(count)
