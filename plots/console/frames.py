"""Frames of collision: each in a line, or the mean over those of a scene by a pipeline, beside what the paper prints."""
import numpy

import results
from cells import Cell, choice
from console import cell as one_cell
from console import spread
from tables import Table


def each(run: results.Run) -> str:
    table = Table("<scene", "frame", "<what", *spread.TITLES, "n", "pairs", "contacts", "<verdict")
    for cell in run.all_cells:
        times = [*spread.of(cell.whole_times_ns()), str(len(cell.samples))] if cell.has_times else [""] * 6
        counts = [f"{int(cell.counters[key]):,}" if key in cell.counters else "" for key in ("pairs_count", "contacts_count")]
        table.row([cell.scene, str(cell.frame), cell.pipeline, *times, *counts, one_cell.verdict(cell)])
    return table.text()


def text(run: results.Run, printed: str = "") -> str:
    """A line for the frames of a scene by a pipeline; `printed` is the paper's table that has rows to stand below them. Empty if
    there are no frames."""
    groups: dict[tuple[object, ...], list[Cell]] = {}
    for cell in run.all_cells:
        if cell.operation == "collide" and not cell.swept:
            key = (cell.scene_facts["name"], choice(cell.raw["builder"]), choice(cell.raw["collider"]), cell.experiment)
            groups.setdefault(key, []).append(cell)
    if not groups:
        return ""
    table = Table("<scene", "<pipeline", "frames", "ms", "±", "broad", "MB", "pairs", "contacts", "peak BVTT", "<verdict")
    rows = results.printed(printed)["rows"] if printed else []
    all_groups = list(groups.values())
    for place, cells in enumerate(all_groups):
        first = cells[0]
        stand_in = f" for {first.stand_in_for}" if first.stand_in_for else ""
        table.row([first.scene_facts["name"] + stand_in, first.pipeline, str(len(cells)), *times_of(cells),
                   mean(cells, "memory_bytes", 1e-6),
                   *(mean(cells, key) for key in ("pairs_count", "contacts_count", "bvtt_peak_count")), verdict(cells)])
        is_last = place + 1 == len(all_groups) or all_groups[place + 1][0].scene_facts["name"] != first.scene_facts["name"]
        for row in rows if is_last else ():
            if row["scene"] == (first.stand_in_for or first.scene_facts["name"]):
                deviation = row.get("frame_stdev_ms", 0)
                table.row(["", f"paper: {row['method']}", str(row["frames"]), f"{row['frame_ms']:.3f}",
                           f"{deviation:.3f}" if deviation else "", "", f"{row['memory_megabytes']:.1f}", "", "", "", "printed"])
    return table.text()


def table2(run: results.Run) -> str:
    return text(run, "table2")


def table3(run: results.Run) -> str:
    return text(run, "table3")


def mean(cells: list[Cell], counter: str, scale: float = 0) -> str:
    """Of a counter; blank if a frame does not have it."""
    if any(counter not in cell.counters for cell in cells):
        return ""
    value = sum(cell.counters[counter] for cell in cells) / len(cells)
    return f"{value * scale:.1f}" if scale else f"{int(value + 0.5):,}"


def times_of(cells: list[Cell]) -> list[str]:
    """Mean and deviation over frames of their medians, and the mean of the stage broad, in ms; blank unless every frame was
    right."""
    if any(cell.verdict != "agrees" or not cell.samples for cell in cells):
        return ["", "", ""]
    medians = [spread.median(cell.whole_times_ns()) * 1e-6 for cell in cells]
    broad = sum(spread.median(cell.times_ns("broad")) for cell in cells) * 1e-6 / len(cells)
    return [f"{numpy.mean(medians):.3f}", f"{numpy.std(medians):.3f}", f"{broad:.3f}"]


def verdict(cells: list[Cell]) -> str:
    """One word for all, or the first that is not "agrees"."""
    for cell in cells:
        if cell.verdict != "agrees":
            return cell.verdict + (f": {cell.reason}" if cell.reason else "")
    return "agrees"
