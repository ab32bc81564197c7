import math

import builder_rows
import results
import tables
from quotes import ROOT, Document


def quotes(doc: Document) -> None:
    doc.under("## NVIDIA H200")
    run = results.everything(ROOT / "results" / "h200" / "builders.json.xz")
    there = builder_rows.of_run(run)
    for scene, rows in there.items():
        for row in rows:
            on_host = row.build.on_host
            of_device = row.counter("device_peak_bytes")
            peak = f"{tables.size(row.reserved)} *" if math.isnan(of_device) else tables.size(of_device)
            query = (f"{row.query_ns * 1e-6:.3f}", f"{row.frame_ns * 1e-6:.3f}", f"`{row.collider}`") if row.best else ("-",) * 3
            doc.row(f"{scene} | `{row.build.builder}`{' (host)' if on_host else ''}", row.rate(), row.rate("hierarchy"), peak,
                    tables.size(row.counter("tree_bytes")), row.counter("sah_cost"), *query)
    rows = {(row.build.scene, row.build.builder): row for those in there.values() for row in those}
    doc.says("bunny ({} and {} ms)", *(rows["bunny", builder].query_ns * 1e-6 for builder in ("hploc", "apetrei-fused")))
    slower = [rows[scene, "apetrei-fused"].rate("hierarchy") / rows[scene, "hploc"].rate("hierarchy")
              for scene in dict.fromkeys(scene for scene, _ in rows)]
    doc.says("takes {} to {} times that of\n  `apetrei-fused`", min(slower), max(slower))
    device = [row.build.median_ns() * 1e-6 for row in rows.values() if not row.build.on_host]
    host = [row.build.median_ns() * 1e-6 for row in rows.values() if row.build.on_host and row.build.builder != "oibvh-host"]
    doc.says("Builders on the host take {} to {} ms", min(host), max(host))
    doc.says("where those on the device take {} to {}.", min(device), max(device))
