"""Where the middle and the edges of samples lie, as columns of a table."""
import math
from collections.abc import Sequence

import numpy

import tables
from cells import Cell

TITLES = ("median", "p10", "q1", "q3", "p90")
FRACTIONS = (0.5, 0.1, 0.25, 0.75, 0.9)


def of(values: Sequence[float]) -> list[str]:
    """The columns TITLES of some nanoseconds; all are 0 if there are none."""
    return [tables.duration(float(value)) for value in numpy.quantile(values if len(values) else [0], FRACTIONS)]


def quartile_range(values: Sequence[float]) -> float:
    """The range between the quartiles as a share of the median."""
    low, middle, high = numpy.quantile(values, (0.25, 0.5, 0.75))
    return float((high - low) / middle) if middle > 0 else 0.0


def ratio(part: float, of: float) -> float:
    """A ratio to 0 is infinite, and 0 to 0 is not a number."""
    return part / of if of else math.nan if part == 0 or math.isnan(part) else math.inf


def rates(moved: float, ns: float, copy_rate: float) -> list[str]:
    """GB/s, bytes a nanosecond, and the share of the device's copy rate; blank if something is not known."""
    if not (moved > 0 and ns > 0):
        return ["", ""]
    return [f"{moved / ns:.1f}", f"{100 * (moved / (ns * 1e-9)) / copy_rate:.1f} %" if copy_rate > 0 else ""]


def of_stages(cell: Cell, key: str) -> int:
    """The sum over stages of what each says of itself; host stages say nothing."""
    return sum(stage.get(key, 0) for stage in cell.all_samples[0]["stages"]) if cell.all_samples else 0


def why(cell: Cell) -> str:
    """The verdict, and the first line of what is wrong or why there are no numbers."""
    reason = (cell.reason or cell.check.get("detail", "")).split("\n")[0]
    return cell.verdict + (f": {reason}" if reason else "")
