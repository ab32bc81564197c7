"""Differences between two runs of the same program: the speed of the device, and its variation during each run."""
import functools
import math
from dataclasses import dataclass

import numpy

from cells import Cell, Sample, by_stage, counted, median, times_ns

LIKENESS = 0.05  # of logarithms of speeds
PARTS = 8
OF_MOST = 4.5  # largest range of the parts' medians that chance gives, in standard errors
BESIDE = 2  # neighbouring samples on each side
NORMAL = 1.4826  # standard deviation of a normal distribution over its median distance from the median
OF_MEDIAN = 1.2533  # standard error of the median over that of the mean


@dataclass(frozen=True)
class Series:
    """A cell's samples in the order taken. Times are one value for each sample, or for each sample that has the stage."""

    samples: list[dict]  # as in the file

    def times_ns(self, stage: str = "") -> numpy.ndarray:
        """Returns whole times, or those of a stage."""
        return times_ns(self.stages, stage)

    @functools.cached_property
    def stages(self) -> list[Sample]:
        return [by_stage(sample) for sample in self.samples]

    def __len__(self) -> int:
        return len(self.samples)


Pair = tuple[Series, Series]  # a cell's samples in two files
CellPair = tuple[Cell, Cell]


def all_pairs(cells: list[CellPair]) -> list[Pair]:
    return [(Series(first.all_samples), Series(second.all_samples)) for first, second in cells]


def counted_pairs(cells: list[CellPair]) -> list[Pair]:
    return [(Series(counted(first.all_samples)), Series(counted(second.all_samples))) for first, second in cells]


def at_like_speed(cells: list[CellPair]) -> list[Pair]:
    """Selects samples taken at the same speed of the device in both files: those whose calibration time is within 5 % of the
    value that the most samples of both files are near. A machine has several speed states, and each run meets them by chance.
    Files without calibration get the samples that statistics use. A series may be empty."""
    pairs = all_pairs(cells)
    if any(sample.get("calibration_ns", 0) <= 0 for pair in pairs for series in pair for sample in series.samples):
        return counted_pairs(cells)
    speeds = [[numpy.log([sample["calibration_ns"] for sample in series.samples]) for series in pair] for pair in pairs]
    speed = shared_speed(*(numpy.sort(numpy.concatenate(of_file)) for of_file in zip(*speeds)))
    return [tuple(Series([sample for sample, own in zip(series.samples, each) if abs(own - speed) <= LIKENESS])
                  for series, each in zip(pair, of_pair)) for pair, of_pair in zip(pairs, speeds)]


def shared_speed(first: numpy.ndarray, second: numpy.ndarray) -> float:
    """Returns the logarithm of calibration time that has the most samples of both files near it. Both arrays are ascending."""
    candidates = numpy.concatenate((first, second))
    near = [numpy.searchsorted(speeds, candidates + LIKENESS, "right") - numpy.searchsorted(speeds, candidates - LIKENESS, "left")
            for speeds in (first, second)]
    shared = numpy.minimum(*near)
    return float(candidates[numpy.argmax(shared)]) if shared.max() > 0 else 0.0


def wavering(cells: list[Series]) -> float:
    """Returns the logarithm of the ratio of a run's slowest to its fastest eighth, minus the largest range that chance gives; 0
    for too few samples. Eighths are cut by sample order. The speed of an eighth is the median over cells of the cell's median
    time in it, relative to the cell's median over the whole run."""
    orders = [[sample["order"] for sample in series.samples] for series in cells]
    begin = min((order[0] for order in orders if order), default=0)
    end = max((order[-1] for order in orders if order), default=0) + 1
    slower: list[list[float]] = [[] for _ in range(PARTS)]  # of each part, one value for each cell
    errors = []  # standard error of a part's median, one value for each cell
    for series, order in zip(cells, orders):
        times = numpy.maximum(series.times_ns(), 1)
        parts = (numpy.array(order, dtype=int) - begin) * PARTS // (end - begin)
        in_parts = [times[parts == part] for part in range(PARTS)]
        errors.append(median_error(in_parts))
        for part, own in zip(slower, in_parts):
            if len(own) >= 3:
                part.append(math.log(median(own) / median(times)))
    of_parts = [median(part) for part in slower if part]
    if not of_parts:
        return 0.0
    chance = OF_MOST * median(errors) / math.sqrt(len(errors))
    return max(0.0, max(of_parts) - min(of_parts) - chance)


def median_error(in_parts: list[numpy.ndarray]) -> float:
    """Returns the standard error of the logarithm of a part's median, from the samples' distances to their parts' medians."""
    distances = numpy.concatenate([numpy.abs(numpy.log(part / median(part))) for part in in_parts if len(part)] or [[]])
    if not len(distances):
        return 0.0
    return OF_MEDIAN * NORMAL * median(distances) / math.sqrt(len(distances) / PARTS)


def common_trend(cells: list[Pair]) -> numpy.ndarray:
    """Returns the trend that two runs with alternating samples share, from all cells of the scene in both files and from
    neighbouring samples."""
    return by_place([series for pair in cells for series in pair], BESIDE)


def by_place(cells: list[Series], beside: int) -> numpy.ndarray:
    """Returns for the n-th samples the median, over all cells and `beside` samples on each side, of the logarithm of the time
    relative to the cell's median."""
    rows = [times for series in cells if median(times := series.times_ns()) > 0]
    slower = numpy.full((len(rows), max(map(len, rows), default=0)), math.nan)
    for row, times in zip(slower, rows):
        row[:len(times)] = numpy.log(numpy.maximum(times, 1) / median(times))
    near_by = (slower[:, max(0, place - beside):place + beside + 1] for place in range(slower.shape[1]))
    return numpy.array([median(each[~numpy.isnan(each)]) for each in near_by])
