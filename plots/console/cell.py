"""Prints one cell in full: its stages as a table, its counters and its verdict."""
import itertools

from ..read import results
from ..read.cells import Cell, median
from ..words import names
from ..words.tables import Table, duration, size
from . import spread

HASHES = (("tree_hash", "tree"), ("pairs_hash", "pairs"), ("contacts_hash", "contacts"))
# Why sampling ended; the fields are the interquartile range and its target.
STOPPED = {"steady": "; quartiles {} apart, within {}", "noisy": "; quartiles {} apart and staying so, above {}",
           "most": "; no more are allowed, quartiles {} apart, above {}",
           "budget": "; the time is over, quartiles {} apart, above {}"}


def text(cell: Cell, run: results.Run) -> str:
    head = f"{cell.pipeline} on {cell.scene}"
    head += f", {cell.triangles:,} triangles" if cell.triangles else ""
    head += f", standing in for {cell.stand_in_for}" if cell.stand_in_for else ""
    parts = [f"{head}\n"]
    if cell.outside:
        parts.append(f"from outside: {cell.provenance}\n")
    if cell.has_times:
        parts += [stages(cell, run.copy_rate_of(cell)), f"{samples(cell)}\n"]
        if wall := cell.wall_ns:
            parts.append(f"{duration(wall)} on the host's clock, median\n")
    if first := cell.raw.get("first"):
        parts.append(f"first run {duration(first['run_ns'])} on the host's clock, kernels compiled in "
                     f"{duration(first['compile_ns'])}\n")
    if cell.counters:
        parts.append("counters: " + ", ".join(f"{key} {number(value)}" for key, value in sorted(cell.counters.items())) + "\n")
    if "first_contact" in cell.raw:
        parts.append(f"{first_contact([cell])}{', triangles {} and {}'.format(*pair) if (pair := cell.raw['first_contact']) else ''}\n")
    parts += [f"no {counter}: {why}\n" for counter, why in sorted(cell.left_out.items())]
    if cell.leaves_by_depth:
        parts.append(f"levels of leaves: {depths(cell.leaves_by_depth)}\n")
    return "".join([*parts, f"verdict: {verdict(cell)}\n"])


def first_contact(cells: list[Cell], otherwise: str = "") -> str:
    """Returns what queries up to the first contact say, of several frames in how many there is one; `otherwise` if there are no such."""
    answers = [bool(cell.raw["first_contact"]) for cell in cells if "first_contact" in cell.raw]
    there = "yes" if any(answers) else "no"
    return "first contact: " + (f"yes in {sum(answers)} of {len(answers)} frames" if len(answers) > 1 else there) if answers else otherwise


def number(value: float) -> str:
    return f"{int(value):,}" if value == int(value) else f"{value:.3f}"


def stages(cell: Cell, copy_rate: float) -> str:
    """Returns one line for each stage, and one for all together."""
    table = Table("<stage", *spread.TITLES, "launches", "bytes", "GB/s", "% of copy", "queued", "submitted")
    first = {entry["stage"]: entry for entry in cell.all_samples[0]["stages"]}
    first |= {"": {key: spread.of_stages(cell, key) for key in ("launches", "moved_bytes")}} if len(first) > 1 else {}
    for stage, entry in first.items():
        launches, moved = entry.get("launches", 0), entry.get("moved_bytes", 0)
        table.row(stage or "all", *spread.of(cell.times_ns(stage)), str(launches or "host"), size(moved) if moved else "",
                  *spread.rates(moved, cell.median_ns(stage), copy_rate), waited(cell, stage, "queued_ns"),
                  waited(cell, stage, "submitted_ns"))
    return table.text()


def waited(cell: Cell, stage: str, state: str) -> str:
    """Returns the median time that a stage's launches, or all launches, spent in that state."""
    middle = median([sum(entry.get(state, 0) for name, entry in sample.items() if stage in ("", name))
                     for sample in cell.samples])
    return duration(middle) if middle > 0 else ""


def samples(cell: Cell) -> str:
    sampling, count = cell.raw.get("sampling", {}), len(cell.all_samples)
    several = f" of {len(cell.processes)} processes" if len(cell.processes) > 1 else ""
    line = f"{count} samples{several}{f', {names.CACHES[cell.caches]}' if cell.caches in names.CACHES else ''}"
    if drifted := sum(sample.get("drifted", False) for sample in cell.all_samples):
        line += f", {drifted} of them beside drift of the device{' and left out here' if len(cell.samples) < count else ''}"
    noise = f"{100 * spread.quartile_range(cell.times_ns()):.1f} %"
    words = STOPPED.get(sampling.get("stopped", ""), "; quartiles {} apart")
    return line + words.format(noise, f"{100 * sampling.get('until', 0):.1f} %")


def verdict(cell: Cell) -> str:
    against = cell.check.get("against") if cell.verdict == "agrees" else ""
    line = cell.verdict + (f" with {against}" if against else "")
    line += "".join(f", {word} {cell.check[key]}" for key, word in HASHES if key in cell.check)
    return line + "".join(f": {words}" for words in (cell.check.get("detail"), cell.reason) if words)


def depths(leaves_by_depth: list[int]) -> str:
    """Returns the levels of the leaves: "14–38, half by 19"; "17" if all are on one level."""
    first = next((depth for depth, leaves in enumerate(leaves_by_depth) if leaves > 0), None)
    if first is None:
        return ""
    if first + 1 == len(leaves_by_depth):
        return str(first)
    half = next(depth for depth, met in enumerate(itertools.accumulate(leaves_by_depth)) if 2 * met >= sum(leaves_by_depth))
    return f"{first}–{len(leaves_by_depth) - 1}, half by {half}"
