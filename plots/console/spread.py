"""Formats the median and percentiles of samples as columns of a table."""
import math
from collections.abc import Sequence

import numpy

from ..read.cells import Cell
from ..words import tables

TITLES = ("median", "p10", "q1", "q3", "p90")
FRACTIONS = (0.5, 0.1, 0.25, 0.75, 0.9)


def of(values: Sequence[float]) -> list[str]:
    """Returns the columns TITLES for times in nanoseconds; all are 0 if there are none."""
    return [tables.duration(float(value)) for value in numpy.quantile(values if len(values) else [0], FRACTIONS)]


def quartile_range(values: Sequence[float]) -> float:
    """Returns the interquartile range as a share of the median."""
    low, middle, high = numpy.quantile(values, (0.25, 0.5, 0.75))
    return float((high - low) / middle) if middle > 0 else 0.0


def ratio(part: float, of: float) -> float:
    """Returns part / of: infinite if only `of` is 0, not a number if both are."""
    return part / of if of else math.nan if part == 0 or math.isnan(part) else math.inf


def rates(moved: float, ns: float, copy_rate: float) -> list[str]:
    """Returns GB/s and the share of the device's copy rate (tables.of_copy_rate); blank for unknown values."""
    if not (moved > 0 and ns > 0):
        return ["", ""]
    share = moved / (ns * 1e-9) / copy_rate if copy_rate > 0 else None
    return [f"{moved / ns:.1f}", "" if share is None else tables.percent(tables.of_copy_rate(share))]


def of_stages(cell: Cell, key: str) -> int:
    """Returns the sum of a value over stages; host stages without it count as 0."""
    return sum(stage.get(key, 0) for stage in cell.all_samples[0]["stages"]) if cell.all_samples else 0


def why(cell: Cell) -> str:
    """Returns the verdict and the first line of the reason."""
    reason = (cell.reason or cell.check.get("detail", "")).split("\n")[0]
    return cell.verdict + (f": {reason}" if reason else "")
