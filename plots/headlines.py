"""A time as documents quote it: the median, the band within a process, and the spread between processes."""
from collections.abc import Sequence

from cells import Cell, quantiles


def times_ms(cell: Cell, by_host: bool) -> list[float]:
    return [ns * 1e-6 for ns in (cell.walls_ns() if by_host else cell.times_ns())]


def spread(frames: Sequence[Cell], by_host: bool) -> tuple[float, float, float, float]:
    """Returns the median milliseconds of all samples, the ends of the widest band of a process, and how far the medians of processes are
    apart, as a share of the median; of several frames their means."""
    each = []
    for cell in frames:
        of_processes = [quantiles(times_ms(process, by_host)) for process in cell.processes]
        widest, medians = max(of_processes, key=lambda one: one.p90 - one.p10), [one.median for one in of_processes]
        each.append((quantiles(times_ms(cell, by_host)).median, widest.p10, widest.p90, max(medians) - min(medians)))
    middle, low, high, apart = (sum(values) / len(each) for values in zip(*each))
    return middle, low, high, apart / middle


def told(frames: Sequence[Cell], by_host: bool = False) -> str:
    """Returns "0.116 (0.115–0.118; 0.4 %)"."""
    middle, low, high, apart = spread(frames, by_host)
    digits = 4 if middle < 0.0995 else 3 if middle < 9.95 else 1
    return f"{middle:.{digits}f} ({low:.{digits}f}–{high:.{digits}f}; {100 * apart:.1f} %)"
