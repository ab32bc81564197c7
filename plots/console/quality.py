"""How good trees are: surface area cost, end-point overlap, overlap of siblings, and where their leaves are."""
import names
import results
from console.cell import depths
from tables import Table

COUNTERS = ("sah_cost", "epo", "sibling_overlap")


def text(run: results.Run) -> str:
    """Empty unless end-point overlap was asked for."""
    table = Table("<scene", "<builder", "SAH", "EPO", "sibling overlap", "<levels of leaves")
    shown = [cell for cell in run.all_cells if cell.leaves_by_depth]
    for cell in shown:
        values = [f"{cell.counters[key]:.2f}" if key in cell.counters else "" for key in COUNTERS]
        table.row([cell.scene_facts["name"], names.in_full(cell.raw["builder"]), *values, depths(cell.leaves_by_depth)])
    return table.text() if any("epo" in cell.counters for cell in shown) else ""
