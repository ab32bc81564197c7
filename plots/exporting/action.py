"""Writes medians as the list that github-action-benchmark reads for the tool customSmallerIsBetter."""
import json

from ..files.output import say
from ..read.cells import quantiles
from ..read.results import Run
from ..words.tables import counted, exact
from .cell_names import names_of


def text(runs: list[Run]) -> str:
    """Returns an entry for each cell that has times, in nanoseconds; its range is from the 10th to the 90th percentile. A note
    on standard error counts the other cells, because the format has no word for them."""
    cells = [(run, cell) for run in runs for cell in run.all_cells]
    entries = []
    for (_, cell), name in zip(cells, names_of(cells), strict=True):
        if cell.has_times:
            low, middle, high = quantiles(cell.times_ns())
            entries.append({"name": name, "unit": "ns", "value": middle, "range": f"{exact(low)} – {exact(high)}",
                            "extra": f"{cell.verdict}; {counted(len(cell.samples), 'sample')}"})
    if left := len(cells) - len(entries):
        say(f"bvhbench: left out, because they have no times: {counted(left, 'cell')} (skipped, failed or wrong)")
    return json.dumps(entries, indent=1, ensure_ascii=False) + "\n"
