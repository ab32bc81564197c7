"""Prints claims of the paper with the paper's figure, ours, and a verdict that follows from ours."""
import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from ..read import results
from ..read.cells import Cell, later
from ..words import names
from ..words.tables import Table

BVTT, FROM_ROOT = "bvtt (jump 2) over oibvh-multi", "bvtt (without start-level, jump 1) over oibvh-multi"
FRESH, REFIT = "front (always rebuild) over apetrei-fused", "bvtt (jump 2, always refit) over oibvh-multi"
ONE_TREE = "bvtt (jump 2, one tree of the scene) over oibvh-multi"
RADIX = [f"{name} over apetrei-fused" for name in ("front", "front-leaf", "front (one tree of the scene)",
                                                   "front-leaf (one tree of the scene)")]
OURS = ("oibvh-single", "oibvh-multi")
MORTON = "{}, morton30-axis"
ALL = 30  # claims in docs/paper.md


def asked_of(cell: Cell) -> str:
    """Returns the name of what was asked for, equal on every device: "bvtt (jump 2) over oibvh-multi", "oibvh-multi, kd"."""
    if cell.operation != "collide":
        return cell.asked
    caches = f", {names.CACHES[cell.caches]}" if cell.caches in names.CACHES else ""
    return names.pipeline(cell.collider or "", dict(cell.collider_options), cell.builder, dict(cell.options)) + caches


def hierarchy(cells: list[Cell]) -> float:
    return cells[0].median_ns("hierarchy")


def frame(cells: list[Cell]) -> float:
    """Returns the mean over the frames after the first of their medians."""
    frames = later(cells)
    return sum(cell.median_ns() for cell in frames) / len(frames)


def most(counter: str) -> Callable[[list[Cell]], float]:
    return lambda cells: max(cell.counters.get(counter, math.nan) for cell in cells)


class Claim(NamedTuple):
    """A claim that holds where rivals have more than ours, by scene: the least of the rivals against the least of ours."""

    text: str
    printed: str  # the paper's figure
    experiment: str
    says: str  # with the least and the most of the ratios in braces
    measured: Callable[[list[Cell]], float]  # of the frames of one scene by one method
    rivals: Iterable[str]  # as asked_of
    ours: Iterable[str]
    confirmed_from: float = 1  # if all ratios are at least this; in part, if one is above the next
    in_part_from: float = 1
    grows: bool = False  # a ratio is divided by that of the same mesh whose triangle has not moved


# Index arithmetic may cost a tenth, and what is faster by less than a twentieth is no faster: times spread as much.
CLAIMS = (
    Claim("Construction is faster than Apetrei's (Sec. 6.1)", "4.17 to 6.53 times", "table1", "{} to {} times", hierarchy, ["apetrei"], OURS),
    Claim("Nodes without links are smaller (Sec. 3)", "none", "table1", "`apetrei` takes {} to {} times the bytes", most("tree_bytes"),
          ["apetrei"], OURS),
    Claim("The layout saves memory of the padded tree (Table 1)", "up to 48.1 %", "table1", "the padded tree takes {} to {} times the bytes",
          most("tree_bytes"), ["perfect"], OURS),
    Claim("Its index arithmetic costs nothing that matters (Sec. 6.1)", "none", "table1", "the padded tree takes {} to {} times as long",
          hierarchy, ["perfect"], OURS[1:], 0.9, 0.9),
    Claim("It is faster at every size (Fig. 8)", "3.2 to 6.2 times", "fig8", "{} to {} times", hierarchy, ["apetrei"], OURS),
    Claim("The pipeline is up to 30 % faster than front tracking (Table 2)", "1 to 1.29 times", "table2", "{} to {} times", frame, RADIX, [BVTT]),
    Claim("It is 4 times as fast as fronts over new trees (Sec. 6.2)", "4 times", "table2", "{} to {} times", frame, [FRESH], [BVTT], 4),
    Claim("Rebuilding is faster than refitting (Abstract)", "none", "table2", "refits take {} to {} times as long", frame, [REFIT], [BVTT]),
    Claim("From the root it is faster than front tracking (Sec. 5)", "none", "table2", "fronts take {} to {} times as long", frame, RADIX,
          [FROM_ROOT], 1.05, 1.05),
    Claim("It takes less memory than front tracking (Table 2)", "5 to 58.4 %", "table2", "fronts take {} to {} times the bytes",
          most("memory_bytes"), RADIX, [BVTT]),
    Claim("A tree for each object is better than one for the scene (Sec. 1)", "none", "table2", "one tree takes {} to {} times as long", frame,
          [ONE_TREE], [BVTT]),
    Claim("It is faster than spatial hashing (Table 3)", "36 to 98 times", "table3", "a hierarchical grid takes {} to {} times as long", frame,
          ["hierarchical grid"], [BVTT]),
    Claim("It takes less memory than spatial hashing (Table 3)", "1.5 to 16 %", "table3", "a hierarchical grid takes {} to {} times the bytes",
          most("memory_bytes"), ["hierarchical grid"], [BVTT]),
    Claim("The radix tree has the better quality (Table 4)", "1.67 to 2.66 times the cost", "table4", "{} to {} times", most("sah_cost"),
          [MORTON.format("oibvh-multi")], [MORTON.format("apetrei-fused")]),
    Claim("The cost grows faster as one triangle moves away (Fig. 13)", "a curve", "fig13", "it grows {} to {} times as much as the radix tree's",
          most("sah_cost"), [MORTON.format("oibvh-multi")], [MORTON.format("apetrei-fused")], grows=True),
)


def ratios(claim: Claim, run: results.Run) -> list[float]:
    """Returns for each scene how many times ours the rivals have. Scenes without both are left out."""
    found: dict[str, float] = {}
    unmoved: dict[str, float] = {}
    for scene in dict.fromkeys(cell.scene for cell in run.all_cells):
        there = [cell for cell in run.all_cells if cell.scene == scene and cell.status == "measured" and cell.verdict != "differs"]
        theirs, own = ([claim.measured(cells) for one in asked if (cells := [cell for cell in there if asked_of(cell) == one])]
                       for asked in (claim.rivals, claim.ours))
        if not theirs or not own or math.isnan(ratio := min(theirs) / min(own)):
            continue
        moved = there[0].outlier if claim.grows else None
        if moved and moved["diameters"] == 0:
            unmoved[moved["of"]] = ratio
        else:
            found[scene] = ratio / unmoved.get(moved["of"], math.nan) if moved else ratio
    return list(found.values())


def verdict(values: list[float], confirmed_from: float = 1, in_part_from: float = 1) -> str:
    """Returns the verdict on a claim whose ratios should be above 1."""
    if not values:
        return "not judged: nothing was measured"
    if min(values) >= confirmed_from and min(values) > in_part_from:
        return "confirmed"
    return "confirmed in part" if max(values) > in_part_from else "not confirmed"


def text(runs: dict[str, results.Run]) -> str:
    """Returns the claims that the runs, by their experiments, tell of."""
    table = Table("<claim of the paper", "<the paper", "<ours", "<verdict")
    there = [claim for claim in CLAIMS if claim.experiment in runs]
    for claim in there:
        values = ratios(claim, runs[claim.experiment])
        ours = claim.says.format(f"{min(values):.2f}", f"{max(values):.2f}") if values else ""
        table.row(claim.text, claim.printed, ours, verdict(values, claim.confirmed_from, claim.in_part_from))
    return f"{table.text()}{len(there)} of {ALL} claims; docs/paper.md has all of them, as measured on an H200\n"
