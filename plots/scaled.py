"""Files of `bvhbench scale`: what they hold, and their table."""
import lzma
import os
import pathlib
from typing import Any

import tables

FORMAT = "cluster-runs-1"


def is_scaled(path: str | os.PathLike[str]) -> bool:
    """True if the file is one of `bvhbench scale`. Reads the beginning alone, where such a file has its format."""
    file = pathlib.Path(path)
    if not file.is_file():  # what is no regular file, a pipe for one, can be read only once
        return False
    try:
        with lzma.open(file) if file.suffix == ".xz" else file.open("rb") as beginning:
            return f'"{FORMAT}.'.encode() in beginning.read(100)
    except (OSError, EOFError, lzma.LZMAError):
        return False


def measured(document: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns the results of measured cells, with their number of ranks, ascending."""
    runs = [run["result"] | {"count": run["ranks"]} for run in document["runs"] if run["status"] == "measured"]
    return sorted(runs, key=lambda run: run["count"])


def text(document: dict[str, Any]) -> str:
    """Returns a row for each cell, as `bvhbench show` prints it."""
    table = tables.Table("<scene", "ranks", "<partition", "boxes", "frame", "times one rank", "halo", "largest part", "<verdict")
    first = next((run for run in measured(document) if "frame_ns" in run), None)
    for run in measured(document):
        grows = run["scene"]["triangles"] / first["scene"]["triangles"] if first else 1  # weak: the scene of P ranks is larger
        table.row(run["scene"]["name"], str(run["count"]), run["partition"], str(run.get("boxes_count", 64)),
                  tables.duration(run["frame_ns"]) if first else "", f"{grows * first['frame_ns'] / run['frame_ns']:.2f}" if first else "",
                  f"{100 * run['halo_share']:.1f} %", f"{run['imbalance']:.3f}", run.get("check", {}).get("verdict", "counted"))
    failed = "".join(f"{run['scene']} on {run['ranks']} ranks: {run['reason']}\n" for run in document["runs"] if run["status"] != "measured")
    return f"scale {document['experiment']}\n{table.text()}{failed}"
