"""A time as documents quote it: the median, how wide the band within a process is, and how far apart processes are."""
from collections.abc import Sequence

from ..read.cells import Cell, quantiles


def times_ms(cell: Cell, by_host: bool) -> list[float]:
    return [ns * 1e-6 for ns in (cell.walls_ns() if by_host else cell.times_ns())]


def spread(frames: Sequence[Cell], by_host: bool) -> tuple[float, float, float]:
    """Returns the median milliseconds of all samples and two shares of it: of the band from the 10th to the 90th percentile, in the
    process where that is widest, and of the distance between the medians of processes. Of several frames all are means."""
    each = []
    for cell in frames:
        of_processes = [quantiles(times_ms(process, by_host)) for process in cell.processes]
        medians = [one.median for one in of_processes]
        each.append((quantiles(times_ms(cell, by_host)).median, max(one.p90 - one.p10 for one in of_processes), max(medians) - min(medians)))
    middle, within, between = (sum(values) / len(each) for values in zip(*each, strict=True))
    return middle, within / middle, between / middle


def told(frames: Sequence[Cell], by_host: bool = False) -> str:
    """Returns "0.116 (2.1 %, 0.4 %)"."""
    middle, within, between = spread(frames, by_host)
    digits = 4 if middle < 0.0995 else 3 if middle < 9.95 else 1
    return f"{middle:.{digits}f} ({100 * within:.1f} %, {100 * between:.1f} %)"
