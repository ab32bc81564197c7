"""Writes cells as the JSON of Google Benchmark's --benchmark_out. Each sample is a repetition of one iteration. Times are
nanoseconds. A cell of several stages has an entry for its whole time, then one for each stage, NAME/STAGE."""
import json
from collections.abc import Iterator

import numpy

from ..files.json_files import Json
from ..read.cells import Cell, times_ns
from ..read.results import Run
from .cell_names import Owned, names_of


def text(runs: list[Run]) -> str:
    """Returns the JSON, with an entry a line."""
    entries = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in benchmarks(runs))
    return f'{{"context": {json.dumps(context(runs), indent=1, ensure_ascii=False)},\n"benchmarks": [\n{entries}\n]}}\n'


def context(runs: list[Run]) -> Json:
    """Returns what the format says about the machine. Facts that are not known, or not equal in all files, are left out."""
    each = [context_of(run) for run in runs]
    shared = {key: value for key, value in each[0].items() if all(other.get(key) == value for other in each)}
    return {"date": min(one["date"] for one in each), **shared, "json_schema_version": 1}


def context_of(run: Run) -> Json:
    program, host, device, state = (run.facts.get(part, {}) for part in ("program", "host", "device", "conditions"))
    known = {"date": run.facts["started_at"], "host_name": host["name"], "executable": run.facts["command"][0],
             "num_cpus": host["threads"], "caches": [],
             "library_build_type": "debug" if program["build_type"] == "Debug" else "release",
             "program": f"bvhbench {program['version']}", "commit": program["commit"] + ("-dirty" if program["dirty"] else ""),
             "device": device["name"], "driver": device["driver"]}
    if "governor" in state:
        known["cpu_scaling_enabled"] = state["governor"] != "performance"
    if "load" in state:
        known["load_avg"] = [state["load"]]
    return known


def benchmarks(runs: list[Run]) -> Iterator[Json]:
    """Yields the entries of all cells. Cells of one builder or pipeline are a family."""
    cells: list[Owned] = [(run, cell) for run in runs for cell in run.all_cells]
    families: dict[tuple[str, str], int] = {}
    instances: dict[int, int] = {}
    for (_, cell), name in zip(cells, names_of(cells), strict=True):
        family = families.setdefault((cell.experiment, cell.asked), len(families))
        for series_name, entries in series_of(cell, name):
            place = instances[family] = instances.get(family, -1) + 1
            for number, entry in enumerate(entries):
                yield {"name": series_name, "family_index": family, "per_family_instance_index": place, "run_name": series_name,
                       "run_type": "iteration", "repetitions": len(entries), "repetition_index": number, "threads": 1, **entry}


def series_of(cell: Cell, name: str) -> Iterator[tuple[str, list[Json]]]:
    """Yields the whole times of a cell, and those of each stage if it has several; or one entry that says why it has none."""
    if not cell.has_times:
        yield name, [{**without_times(cell), "iterations": 0, **time(0), "label": cell.verdict}]
        return
    more = {"label": cell.verdict}
    yield name, [{"iterations": 1, **time(ns), **more, **cell.counters} for ns in cell.times_ns()]
    stages = list(dict.fromkeys(stage for sample in cell.samples for stage in sample))
    for stage in stages if len(stages) > 1 else ():
        yield f"{name}/{stage}", [{"iterations": 1, **time(ns), **more} for ns in times_ns(cell.samples, stage)]


def time(ns: numpy.float64 | int) -> Json:
    """Returns the times of an entry. The processor's own time is not measured, and readers require it: it repeats the other."""
    return {"real_time": float(ns), "cpu_time": float(ns), "time_unit": "ns"}


def without_times(cell: Cell) -> Json:
    why = cell.reason or cell.check.get("detail") or "it has no samples"
    if cell.verdict in ("failed", "differs"):
        return {"error_occurred": True, "error_message": f"{cell.verdict}: {why}"}
    return {"skipped": True, "skip_message": why}
