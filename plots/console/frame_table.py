"""Prints collision frames: one line each, or the mean over a scene's frames by pipeline, beside the paper's numbers."""
import numpy

from ..read import results
from ..read.cells import Cell, grouped
from ..read.ranking import is_by_wall
from ..words.tables import Table, duration, fixed, whole
from . import cell as one_cell, cells as all_cells, spread


def each(run: results.Run) -> str:
    """Returns a table for each scene and pipeline: one line for each frame, and the mean over those after the first."""
    groups = grouped(run.all_cells, lambda cell: (cell.scene, cell.pipeline))
    tables = "".join(f"{pipeline} on {scene}\n{of_pipeline(cells)}" for (scene, pipeline), cells in groups.items())
    return tables + all_cells.outside(run.all_cells)


def of_pipeline(cells: list[Cell]) -> str:
    has_wall = any(cell.wall_ns for cell in cells)
    touching = ["touching"] * any("touching_count" in cell.counters for cell in cells)
    keys = [f"{count}_count" for count in ("pairs", "contacts", *touching)]
    table = Table("frame", *spread.TITLES, *["wall"] * has_wall, "n", "pairs", "contacts", *touching, "<verdict")
    for cell in cells:
        wall = [duration(cell.wall_ns)] * has_wall
        times = [*spread.of(cell.times_ns()), *wall, str(len(cell.samples))] if cell.has_times else [""] * (6 + has_wall)
        counts = [whole(cell.counters.get(key)) for key in keys]
        counts[1] = one_cell.first_contact([cell], counts[1])
        table.row(str(cell.frame), *times, *counts, one_cell.verdict(cell))
    if len(cells) > 1 and all(cell.has_times for cell in cells):
        later = cells[1:]
        counts = [whole(mean(later, key, 1, 0.5)) for key in keys]
        counts[1] = one_cell.first_contact(later, counts[1])
        table.row("mean of later", duration(sum(cell.median_ns() for cell in later) / len(later)), *[""] * (5 + has_wall), *counts)
    return table.text()


def text(run: results.Run, printed: str = "") -> str:
    """Returns one line for the frames of a scene by a pipeline, followed by the rows of the paper's table `printed`. Empty if
    there are no frames. Of several frames the first is in the column "first", and all other columns have means over those after it.
    The column "wall" is the host's clock, in ms. The columns "up" and "back", in ms, are of copies to and from the device, which "ms" does not have."""
    groups = list(grouped((cell for cell in run.all_cells if cell.operation == "collide" and not cell.swept),
                          lambda cell: (cell.scene, *cell.key("builder", "collider", "experiment", "caches"))).values())
    has_wall = any(cell.wall_ns for cells in groups for cell in cells)
    by_wall = is_by_wall(cell for cells in groups for cell in cells)
    table = Table("<scene", "<pipeline", "frames", "first", "ms", "±", "broad", *["wall"] * has_wall, "up", "back", "MB", "pairs", "contacts", "peak BVTT", "<verdict")
    rows = results.printed(printed)["rows"] if printed else []
    names = [cells[0].scene for cells in groups]
    for cells, name, next_name in zip(groups, names, [*names, None][1:], strict=True):
        first = cells[0]
        stand_in = f" for {first.stand_in_for}" if first.stand_in_for else ""
        later = cells[1:] or cells
        counts = [whole(mean(later, key, 1, 0.5)) for key in ("pairs_count", "contacts_count", "bvtt_peak_count")]
        counts[1] = one_cell.first_contact(cells, counts[1])
        of_frames = times_of(later)
        copies = [fixed(mean(later, key, 1e-6), 3) for key in ("upload_ns", "read_back_ns")]
        of_first = times_of(cells[:1])[0] if len(cells) > 1 else ""
        table.row(name + stand_in, first.pipeline, str(len(cells)), of_first, *of_frames, *[wall_of(later)] * has_wall, *copies,
                  fixed(mean(later, "memory_bytes", 1e-6), 1), *counts, verdict(cells), among=name,
                  value=float((wall_of(later) if by_wall else of_frames[0]) or "nan"))
        for row in rows if name != next_name else ():
            if row["scene"] == (first.stand_in_for or first.scene_facts["name"]):
                table.row("", f"paper: {row['method']}", str(row["frames"]), "", fixed(row["frame_ms"], 3),
                          fixed(row.get("frame_stdev_ms", 0) or None, 3), "", *[""] * has_wall, "", "", fixed(row["memory_megabytes"], 1), "", "", "",
                          "printed")
    return table.text() + all_cells.outside([cell for cells in groups for cell in cells]) if groups else ""


def mean(cells: list[Cell], counter: str, scale: float, more: float = 0) -> float | None:
    """Returns the mean of a counter, or None if a frame lacks it."""
    if any(counter not in cell.counters for cell in cells):
        return None
    return sum(cell.counters[counter] for cell in cells) / len(cells) * scale + more


def times_of(cells: list[Cell]) -> list[str]:
    """Returns mean and standard deviation over frames of their medians, and the mean of the stage broad, in ms; blank unless
    every frame agrees, or has its errors counted."""
    if any(not cell.checked or not cell.samples for cell in cells):
        return ["", "", ""]
    medians = [cell.median_ns() * 1e-6 for cell in cells]
    broad = sum(cell.median_ns("broad") for cell in cells) * 1e-6 / len(cells)
    return [fixed(ms, 3) for ms in (numpy.mean(medians), numpy.std(medians), broad)]


def wall_of(cells: list[Cell]) -> str:
    """Returns the mean over frames of their medians on the host's clock, in ms; blank as times_of."""
    if any(not cell.checked or not cell.wall_ns for cell in cells):
        return ""
    return fixed(numpy.mean([cell.wall_ns * 1e-6 for cell in cells]), 3)


def verdict(cells: list[Cell]) -> str:
    """Returns "agrees" if all agree, the errors of all frames if they were counted, otherwise the first other verdict and its
    reason."""
    bad = next((cell for cell in cells if not cell.checked), None)
    if bad is not None:
        return bad.verdict + (f": {bad.reason}" if bad.reason else "")
    if all(cell.verdict == "agrees" for cell in cells):
        return "agrees"
    missed, false = (sum(cell.counters.get(f"{key}_count", 0) + cell.counters.get(f"{key}_pairs_count", 0) for cell in cells)
                     for key in ("missed", "false"))
    return f"counted: {missed:,.0f} missed, {false:,.0f} false"
