import math

from plots.evidence.quotes import ROOT, Document
from plots.read import builder_rows, results


def quotes(doc: Document) -> None:
    there = builder_rows.of_run(results.everything(ROOT / "results" / "h200" / "builders.json.xz"))
    for scene, rows in there.items():
        if scene == "happy_buddha_1087716":  # as the torus
            continue
        doc.table(scene, "< builder | build | peak, MB | tree, MB | SAH | query, ms | frame, ms", (
            [f"`{row.build.builder}`{'*' if row.build.on_host else ''}", row.rate(),
             1e-6 * (row.reserved if math.isnan(peak := row.counter("device_peak_bytes")) else peak),
             row.counter("tree_bytes") * 1e-6, row.counter("sah_cost"),
             *([row.query_ns * 1e-6, f"{row.frame_ns * 1e-6:.3f} `{row.collider}`"] if row.best else [None, None])] for row in rows))
