"""Prints surface area costs of Oi-BVHs and radix trees beside the paper's: Table 4 and Fig. 13."""
from dataclasses import dataclass

from ..read import results
from ..read.cells import Cell, grouped
from ..read.results import USUAL_COSTS
from ..words.tables import Table, exact, fixed, whole

RADIX = ("apetrei", "karras", "lbvh", "radix")


@dataclass
class Pair:
    """Both kinds of tree over a scene in one order; None for a missing tree."""

    either: Cell
    radix: Cell | None = None
    oi: Cell | None = None

    @property
    def ratio(self) -> float:
        return sah_cost(self.oi) / sah_cost(self.radix) if sah_cost(self.radix) else 0.0

    @property
    def why(self) -> str:
        """Returns why there is no ratio; empty if there is one."""
        if self.ratio:
            return ""
        if self.radix is None or self.oi is None:
            return "no radix tree" if self.radix is None else "no Oi-BVH"
        cell = self.oi if sah_cost(self.radix) else self.radix
        return cell.verdict + (f": {cell.reason}" if cell.reason else "")


def sah_cost(cell: Cell | None) -> float:
    """Returns the cost, or 0 if the tree is missing or wrong."""
    if cell is None or cell.status != "measured" or cell.verdict == "differs":
        return 0.0
    return cell.counters.get("sah_cost", 0.0)


def pairs_of(run: results.Run) -> list[Pair]:
    """Returns the pairs in the order of the cells. An order without its own radix tree is paired with the scene's first one."""
    pairs, radix = [], {}
    for (scene, _), cells in grouped(run.all_cells, lambda cell: (cell.scene_facts["name"], order_of(cell))).items():
        kinds = grouped(cells, lambda cell: cell.builder.startswith(RADIX))
        # If several builders build the same tree, the first one with a cost is used.
        own, oi = (next(filter(sah_cost, kinds.get(is_radix, [])), kinds.get(is_radix, [None])[-1]) for is_radix in (True, False))
        if own:
            radix.setdefault(scene, own)
        pairs.append(Pair(oi or own, own or radix.get(scene), oi))
    return pairs


def order_of(cell: Cell) -> str:
    return dict(cell.options).get("order", "morton30")


def number(value: float) -> str:
    return fixed(value if value > 0 else None)


def table4(run: results.Run) -> str:
    is_usual = run.costs == USUAL_COSTS
    printed = results.printed("table4")
    costs = {(row["scene"], row["builder"]): row["sah_cost"] for row in printed["rows"]} if is_usual else {}
    editions = printed["other_editions"] if is_usual else {}
    table = Table("<mesh", "triangles", "<order", "radix", "paper", "Oi-BVH", "paper", "times", "paper", "<")
    notes = {"+": "another edition of the paper's model, with another triangle count",
             "*": "a generated stand-in with the mesh's triangle count: the mesh itself is not there"}
    seen = set()
    for pair in pairs_of(run):
        cell = pair.either
        mesh = cell.stand_in_for or cell.scene_facts["name"]
        model = editions.get(mesh, mesh)
        mark = "*" if cell.stand_in_for else "+" if model != mesh else ""
        seen |= {mark} | ({"+"} if model != mesh else set())
        radix, oi = costs.get((model, "apetrei"), 0), costs.get((model, "oibvh-multi"), 0)
        table.row(f"{mesh} {mark}".rstrip(), whole(cell.triangles or None), order_of(cell), number(sah_cost(pair.radix)),
                  number(radix), number(sah_cost(pair.oi)), number(oi), number(pair.ratio),
                  number(oi / radix if radix else 0), pair.why)
    said = "surface area cost, an inner node {}, a triangle {}".format(*map(exact, run.costs))
    others = "" if is_usual else "; the paper's are for others"
    return (f"{table.text()}{said}{others}\n"
            + "".join(f"{mark} {note}\n" for mark, note in notes.items() if mark in seen))


def fig13(run: results.Run) -> str:
    table = Table("<mesh", "<order", "triangle", "diameters", "radix", "Oi-BVH", "times", "<")
    first = last = 0.0
    for pair in pairs_of(run):
        cell, outlier = pair.either, pair.either.outlier
        if not outlier:  # the scene could not be made, so it has no facts
            table.row(cell.scene_facts["name"], order_of(cell), "", "", "", "", "", pair.why)
            continue
        table.row(outlier["of"], order_of(cell), str(outlier["triangle"]), f"{outlier['diameters']:.1f}",
                  number(sah_cost(pair.radix)), number(sah_cost(pair.oi)), number(pair.ratio), pair.why)
        if outlier["diameters"] == 0 and not first:
            first = pair.ratio
        if first and not last and outlier["diameters"] >= 10:
            last = pair.ratio
    if not (first and last):
        return table.text()
    return (f"{table.text()}the Oi-BVH's cost relative to the radix tree's {'grows' if last > first else 'does not grow'}, from "
            f"{first:.2f} to {last:.2f} times; the paper has it grow \"much faster\"\n")
