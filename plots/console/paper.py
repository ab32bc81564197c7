"""Prints times of the hierarchy beside those of the paper: Table 1 and Fig. 8."""
import math

from ..read import results
from ..read.cells import Cell, quantiles
from ..read.crossing import crossing
from ..words.tables import Table, size, whole
from . import spread

STAGE = "hierarchy"


def table1(run: results.Run) -> str:
    printed = results.printed("table1")
    rows = {(row["scene"], row["builder"]): row for row in printed["rows"]}
    table = Table("<mesh", "triangles", "<builder", "nodes", "padding %", "paper", "ms", "p10–p90", "Mtris/s", "moved",
                  "% of copy", "paper ms")
    for cell in run.all_cells:
        mesh = cell.stand_in_for or cell.scene
        row, nodes = rows.get((mesh, cell.builder)), int(cell.counters.get("nodes_count", 0))
        if cell.status == "skipped" and not row:  # the paper does not have the mesh, and neither has this machine
            continue
        table.row(mesh + (" *" if cell.stand_in_for else ""), f"{cell.triangles:,}", cell.builder, whole(nodes or None),
                  padding_text(padding_percent(cell)) if nodes else "", row["padding_percent"] if row else "",
                  *time_columns(cell, run.copy_rate_of(cell)), f"{row['hierarchy_ms']:.3f}" if row else "")
    stand_in = "* a generated stand-in with the mesh's triangle count: the mesh itself is not there\n"
    return (f"{table.text()}ms: the stage hierarchy from sorted leaves, median; paper ms: {printed['device']}\n"
            f"{stand_in if any(cell.stand_in_for for cell in run.all_cells) else ''}")


def fig8(run: results.Run) -> str:
    table = Table("triangles", "<builder", "ms", "p10–p90", "Mtris/s", "moved", "% of copy", "Gnodes/s")
    for cell in run.all_cells:
        ns = hierarchy_ns(cell)
        table.row(f"{cell.triangles:,}", cell.builder, *time_columns(cell, run.copy_rate_of(cell)),
                  f"{cell.counters.get('nodes_count', 0) / ns:.2f}" if ns else "")
    there = {cell.builder for cell in run.all_cells}
    return table.text() + "".join(crossing_text(run.all_cells, single) for single in ("oibvh-single-printed", "oibvh-single")
                                  if single in there)


def crossing_text(cells: list[Cell], single: str) -> str:
    """Returns a sentence on where oibvh-multi overtakes the builder `single`."""
    of_both = ({cell.triangles: ns for cell in cells if cell.builder == name and (ns := hierarchy_ns(cell))} for name in (single, "oibvh-multi"))
    if size := crossing(*of_both):
        return f"oibvh-multi is faster than {single} from about {size:,.0f} triangles on; in the paper, from about 131,072\n"
    return f"{single} and oibvh-multi do not cross here; in the paper they do at about 131,072 triangles\n"


def hierarchy_ns(cell: Cell) -> float:
    """Returns the median of the stage, or 0 for a cell whose time must not be shown."""
    return cell.median_ns(STAGE) if cell.verdict == "agrees" else 0.0


def time_columns(cell: Cell, copy_rate: float) -> list[str]:
    """Returns time, rate and memory traffic of the stage, or the verdict if there is no time."""
    if not (median := hierarchy_ns(cell)):
        return [cell.verdict, "", "", "", ""]
    low, _, high = quantiles(cell.times_ns(STAGE) * 1e-6)
    moved = cell.moved_bytes(STAGE) or 0
    return [f"{median * 1e-6:.4f}", f"{low:.4f}–{high:.4f}", f"{cell.triangles * 1e3 / median:.0f}", size(moved),
            spread.rates(moved, median, copy_rate)[1]]


def perfect_padding(triangles: int, nodes: float) -> float:
    """Returns the share of virtual nodes in a perfect tree, in percent: those that an implicit tree leaves out on each level
    (paper, Section 4.1)."""
    virtual = (1 << max(triangles - 1, 0).bit_length()) - triangles
    real = nodes - sum(virtual >> level for level in range(virtual.bit_length()))
    return 100 * (nodes - real) / nodes


def padding_percent(cell: Cell) -> float:
    """Returns the padding in percent: of the perfect tree's nodes, or beyond the 2n - 1 nodes that every tree has."""
    nodes = cell.counters["nodes_count"]
    if cell.builder == "perfect":
        return perfect_padding(cell.triangles, nodes)
    least = 2 * cell.triangles - 1
    return 100 * (nodes - least) / least


def padding_text(percent: float) -> str:
    """Returns the percentage as Table 1 prints it: two digits after the point, or two significant digits, truncated."""
    if percent == 0:
        return "0"
    if percent >= 0.1:
        return f"{percent:.2f}"
    exponent = math.floor(math.log10(percent))
    return f"{math.floor(percent / 10 ** (exponent - 1) + 1e-9) / 10:.1f}e{exponent}"
