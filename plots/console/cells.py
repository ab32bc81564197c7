"""Prints the cells of a run, one line each."""
import math

import numpy

from ..read import families, results
from ..read.cells import Cell, grouped
from ..read.ranking import middle_of
from ..words import tables
from ..words.tables import Table, fixed, whole
from . import spread

WIDE = "°"
MOST_LINES = 100  # with more cells, only those that do not agree have a line, and builds have a summary


def text(run: results.Run, only_wrong: bool = False) -> str:
    """Returns a line for each cell that does not agree; unless `only_wrong`, for all others too, but for frames, which have a table of their own,
    or if they are many their summary; and the number of all cells."""
    others = sum(cell.operation != "collide" for cell in run.all_cells)
    has_lines, has_summary = (not only_wrong and few == (others <= MOST_LINES) for few in (True, False))
    has_wall, has_cost = (any(map(has, run.all_cells)) for has in (lambda cell: cell.wall_ns, cost_of))
    table = Table("<scene", "triangles", "<builder", *["SAH"] * has_cost, *spread.TITLES, *["wall"] * has_wall, "n", "Mtris/s", "ns/tri", "GB/s",
                  "% of copy", "<verdict")
    middle = middle_of(run.all_cells)
    shown = [cell for cell in run.all_cells
             if cell.verdict != "agrees" or (has_lines and (others == len(run.all_cells) or cell.operation != "collide"))]
    for cell in shown:
        table.row(*line(cell, run.copy_rate_of(cell), has_wall, has_cost), among=cell.scene, value=middle(cell) if cell.has_times else math.nan)
    wide = f"{WIDE} of wide nodes, which one visit tests whole: not comparable\n" if WIDE in "".join(map(cost_of, run.all_cells)) else ""
    stand_ins = "* a stand-in: the scene itself is not there\n" if any(cell.stand_in_for for cell in shown) else ""
    agreeing = sum(cell.verdict == "agrees" for cell in run.all_cells)
    return (f"{table.text() if shown else ''}{summary(run.all_cells) if has_summary else ''}{wide}{stand_ins}{outside(shown)}"
            f"{len(run.all_cells):,} cells, {agreeing:,} agree\n")


def outside(cells: list[Cell]) -> str:
    """Returns a line for each builder or collider from outside: whose it is."""
    whose = {cell.outside["name"]: cell.provenance for cell in cells if cell.outside}
    return "".join(f"{name}, from outside: {provenance}\n" for name, provenance in whose.items())


def cost_of(cell: Cell) -> str:
    """Returns the surface area cost of a build's tree, marked if its nodes are wide; blank without one."""
    cost = fixed(cell.counters.get("sah_cost"))
    return cost + WIDE * (cost != "" and families.of_builder(cell.builder) == "wide trees")


def summary(cells: list[Cell]) -> str:
    """Returns a line for each builder, with its order: how many times the least of a scene its SAH and time are, geometric means over scenes."""
    builds = [cell for cell in cells if cell.operation == "build" and cell.has_times and cell.counters.get("sah_cost")]
    ratios = {id(cell): numpy.log((cell.counters["sah_cost"], cell.median_ns())) for cell in builds}
    for those in grouped(builds, lambda cell: cell.scene).values():
        least = numpy.min([ratios[id(cell)] for cell in those], axis=0)
        ratios |= {id(cell): ratios[id(cell)] - least for cell in those}
    table = Table("<builder", "scenes", "SAH", "time")
    for name, those in grouped(builds, lambda cell: cell.pipeline).items():
        wide = WIDE * cost_of(those[0]).endswith(WIDE)
        cost, time = numpy.exp(numpy.mean([ratios[id(cell)] for cell in those], axis=0))
        table.row(name, str(len(those)), fixed(cost) + wide, fixed(time))
    return f"{table.text()}SAH, time: times the least of the scene, geometric means over scenes\n" if builds else ""


def line(cell: Cell, copy_rate: float, has_wall: bool, has_cost: bool) -> list[str]:
    head = [cell.scene + (" *" if cell.stand_in_for else ""), whole(cell.triangles or None), cell.pipeline, *[cost_of(cell)] * has_cost]
    if not cell.has_times:
        return [*head, cell.verdict, *[""] * (9 + has_wall), cell.reason or cell.check.get("detail", "")]
    middle = cell.median_ns()
    rate = cell.triangles * 1e3 / middle if middle > 0 else 0
    rates = [f"{rate:.1f}", f"{1e3 / rate:.2f}"] if rate > 0 else ["", ""]
    wall = [tables.duration(cell.wall_ns) if cell.wall_ns else ""] * has_wall
    return [*head, *spread.of(cell.times_ns()), *wall, str(len(cell.samples)), *rates,
            *spread.rates(spread.of_stages(cell, "moved_bytes"), middle, copy_rate), cell.verdict]
