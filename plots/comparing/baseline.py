"""What a baseline keeps of a run of `smoke`: each cell's verdict, its fastest time, and all machine-independent numbers."""
import os

from ..files import documents
from ..read import counters, results
from ..files.documents import line_of
from ..files.json_files import Json, Refused, value_of
from ..files.output import WrongUsage
from ..read.cells import Cell, whole_ns

FORMAT = "smoke-1"
CELL = ("cell", "scene", "verdict", "counters", "hashes")  # keys of each cell

Kept = Json  # what is kept of a cell, as in the file; "fastest_ns" only if its time is comparable


def of_run(run: results.Run) -> list[Kept]:
    """Returns what is kept of each cell. Builders and colliders that wrap a library have its name as prefix."""
    libraries = tuple(name.lower() for name in run.facts["libraries"])
    return [kept_of(cell, libraries) for cell in run.all_cells]


def kept_of(cell: Cell, libraries: tuple[str, ...]) -> Kept:
    is_library = any(name.partition("-")[0] in libraries for name in (cell.builder, cell.collider or ""))
    kinds = ("contacts", "pairs") if is_library else ("contacts", "pairs", "tree")
    kept = {"cell": cell.label, "scene": f"{cell.scene_facts['name']} {cell.operation}", "verdict": cell.verdict,
            "counters": same_everywhere(cell, is_library),
            "hashes": {kind: cell.check[f"{kind}_hash"] for kind in kinds if f"{kind}_hash" in cell.check}}
    fastest = 0 if is_library else fastest_ns(cell)
    return {**kept, "fastest_ns": fastest} if fastest > 0 else kept


def same_everywhere(cell: Cell, is_library: bool) -> dict[str, float]:
    """Returns the exact counters, without bytes that depend on the number of compute units. For libraries, whose versions differ,
    returns only counts of pairs and contacts."""
    return {counter: value for counter, value in sorted(cell.counters.items())
            if counters.is_exact(counter, cell) and counter not in counters.SIZED_BY_DEVICE
            and (counter in counters.FOUND or not is_library)}


def fastest_ns(cell: Cell) -> int:
    """Returns the fastest time of the samples that statistics use, since other work on the machine slows many samples but speeds
    up none. 0 for host stages, which scale differently."""
    if not cell.has_times or any("wall_ns" in stage for stage in cell.samples[0].values()):
        return 0
    return min(whole_ns(sample) for sample in cell.samples)


def text_of(device_kind: str, kept: list[Kept]) -> str:
    """Returns the baseline's text with one cell in each line, so that changes are readable."""
    lines = ",".join(f"\n{line_of(cell)}" for cell in kept)
    return f'{{"format": "{FORMAT}", "device_kind": "{device_kind}", "cells": [{lines}\n]}}\n'


def parsed(text: bytes, origin: str) -> Json:
    """Parses and checks a baseline. Raises Refused, naming `origin`, if the text is not one."""
    try:
        baseline = value_of(text)
        documents.require(baseline, ("format",))
        if baseline["format"] != FORMAT:
            raise Refused(f'{origin} has format {line_of(baseline["format"])}; this program reads "{FORMAT}"')
        documents.require(baseline, ("device_kind", "cells"))
        documents.require_all(baseline, "cells", CELL)
    except (TypeError, ValueError) as error:
        raise Refused(f"{origin} is no baseline of smoke: {error}") from error
    return baseline


def is_baseline(text: bytes) -> bool:
    """True if the text is an earlier baseline, which a new one replaces."""
    try:
        parsed(text, "the baseline")
    except Refused:
        return False
    return True


def read(path: str, device_kind: str) -> list[Kept]:
    """Reads the baseline. Raises Refused if there is none, and WrongUsage if it is for another kind of device."""
    if not os.path.exists(path):
        raise Refused(f"there is no baseline '{path}' to compare this run with; smoke --update makes it")
    baseline = parsed(documents.file_text(path, "the baseline"), path)
    if baseline["device_kind"] != device_kind:
        raise WrongUsage(f"{path} is of a device of kind {baseline['device_kind']}, and this one is of kind {device_kind}")
    return baseline["cells"]
