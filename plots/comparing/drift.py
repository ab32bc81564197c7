"""What two runs of one program differ in though nothing was changed: how fast the device was, and how that wavered."""
import functools
import math
from dataclasses import dataclass

import numpy

from cells import Cell, Sample, by_stage, counted, median, times_ns

LIKENESS = 0.05  # of logarithms of speeds
PARTS = 8
OF_MOST = 4.5  # standard errors from the least of so many parts to the most, by chance
BESIDE = 2  # samples before and after
NORMAL = 1.4826  # standard deviations of a normal distribution per median distance from the median
OF_MEDIAN = 1.2533  # standard errors of the median per that of the mean


@dataclass(frozen=True)
class Series:
    """A cell's samples in the order taken: a value a sample, and of a stage one for each sample that has it."""

    samples: list[dict]  # as in the file

    def times_ns(self, stage: str = "") -> numpy.ndarray:
        """Whole times, or those of a stage."""
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
    """The samples beside which the calibration took about as long in both files, within 5 % of the time at which the most of both
    did. A machine has states, and which of them a run meets is chance. Where the files have no calibration, the samples that
    statistics are made of. Each series may be empty."""
    pairs = all_pairs(cells)
    if any(sample.get("calibration_ns", 0) <= 0 for pair in pairs for series in pair for sample in series.samples):
        return counted_pairs(cells)
    speeds = [[numpy.log([sample["calibration_ns"] for sample in series.samples]) for series in pair] for pair in pairs]
    speed = shared_speed(*(numpy.sort(numpy.concatenate(of_file)) for of_file in zip(*speeds)))
    return [tuple(Series([sample for sample, own in zip(series.samples, each) if abs(own - speed) <= LIKENESS])
                  for series, each in zip(pair, of_pair)) for pair, of_pair in zip(pairs, speeds)]


def shared_speed(first: numpy.ndarray, second: numpy.ndarray) -> float:
    """Of both, each ascending, the one that both have the most samples near of."""
    candidates = numpy.concatenate((first, second))
    near = [numpy.searchsorted(speeds, candidates + LIKENESS, "right") - numpy.searchsorted(speeds, candidates - LIKENESS, "left")
            for speeds in (first, second)]
    shared = numpy.minimum(*near)
    return float(candidates[numpy.argmax(shared)]) if shared.max() > 0 else 0.0


def wavering(cells: list[Series]) -> float:
    """The logarithm of the ratio of a run's slowest eighth to its fastest, minus what chance alone gives; 0 for too few samples.
    Samples are cut into eighths by their order; the speed of one is the median over its cells of their time in it, relative to
    their median over the whole run."""
    orders = [[sample["order"] for sample in series.samples] for series in cells]
    begin = min((order[0] for order in orders if order), default=0)
    end = max((order[-1] for order in orders if order), default=0) + 1
    slower: list[list[float]] = [[] for _ in range(PARTS)]  # of each part, a value a cell
    errors = []  # of a part's median, a value a cell
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
    """The standard error of the logarithm of a part's median, from how samples lie about the medians of their parts."""
    distances = numpy.concatenate([numpy.abs(numpy.log(part / median(part))) for part in in_parts if len(part)] or [[]])
    if not len(distances):
        return 0.0
    return OF_MEDIAN * NORMAL * median(distances) / math.sqrt(len(distances) / PARTS)


def common_trend(cells: list[Pair]) -> numpy.ndarray:
    """What two runs that took turns had in common: of the cells of a scene, by how much the n-th samples in both files and those
    beside them are slower than their cells' medians, the median of all of these, as the logarithm of a ratio."""
    rows = [times for pair in cells for series in pair if median(times := series.times_ns()) > 0]
    slower = numpy.full((len(rows), max(map(len, rows), default=0)), math.nan)
    for row, times in zip(slower, rows):
        row[:len(times)] = numpy.log(numpy.maximum(times, 1) / median(times))
    near_by = (slower[:, max(0, place - BESIDE):place + BESIDE + 1] for place in range(slower.shape[1]))
    return numpy.array([median(each[~numpy.isnan(each)]) for each in near_by])
