"""Result files as rows, one for each stage of each sample: what bvhbench.read and `export --format csv` give."""
import os
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from . import results
from .cells import Cell, elapsed_ns

if TYPE_CHECKING:
    import pandas

Path = str | os.PathLike[str]
CELL = ("file", "experiment", "scene", "triangles", "frame", "stand_in_for", "builder", "collider", "operation", "axis", "method",
        "seed", "features", "swept", "to_frame", "caches")
SAMPLE = ("status", "verdict", "sample", "drifted", "stage", "ns", "launches", "moved_bytes", "start_ns")


def read(paths: Path | Iterable[Path], counters: bool = False) -> "pandas.DataFrame":
    """As bvhbench.read. Raises json_files.Refused if a file is not a result file."""
    import pandas

    files = [paths] if isinstance(paths, (str, os.PathLike)) else paths
    found = [row for path in files for row in rows(results.everything(path), counters)]
    return pandas.DataFrame(found, columns=columns_of(found))


def columns_of(found: Iterable[dict[str, Any]]) -> list[str]:
    """Returns the columns of a table of these rows, always in the same order."""
    names = dict.fromkeys(name for row in found for name in row)
    options = sorted(name for name in names if name.startswith(("option_", "collider_")))
    return list(dict.fromkeys((*CELL, *options, *SAMPLE, *names)))


def rows(run: results.Run, counters: bool) -> Iterator[dict[str, Any]]:
    """Yields the rows of one file: column name to value. Columns without a value are left out."""
    for cell in run.all_cells:
        about = {"file": os.fspath(run.path), **facts(cell), **(cell.counters if counters else {})}
        if not cell.all_samples:
            yield about
        for sample in cell.all_samples:
            for stage in sample["stages"]:
                said = {key: stage[key] for key in SAMPLE if key in stage}
                process = {"process": sample["process"]} if "process" in sample else {}
                yield {**about, **process, "sample": sample["order"], "drifted": sample.get("drifted", False), **said,
                       "ns": elapsed_ns(stage)}


def facts(cell: Cell) -> dict[str, Any]:
    """Returns the columns that describe a cell and its outcome. Facts that a cell does not have are left out."""
    known = {"experiment": cell.experiment, "scene": cell.scene, "triangles": cell.scene_facts.get("triangles"),
             "frame": cell.frame, "stand_in_for": cell.stand_in_for, "builder": cell.builder, "collider": cell.collider,
             "operation": cell.operation, **{key: cell.accuracy.get(key) for key in ("axis", "method", "seed")},
             "features": cell.raw.get("features", {}).get("pairs"), "swept": cell.swept.get("pairs"), "to_frame": cell.swept.get("to_frame"),
             "caches": cell.raw.get("sampling", {}).get("caches"), "status": cell.status,
             "verdict": cell.verdict if cell.status == "measured" else None}
    for part, prefix in (("builder", "option"), ("collider", "collider")):
        known |= {f"{prefix}_{name}": value for name, value in cell.raw.get(part, {}).get("options", {}).items()}
    return {key: value for key, value in known.items() if value is not None}
