"""Units of a sweep: what one process measures, a cell or all cells of a scene. Distributes units to shards and estimates the
remaining time."""
import json
import math
import re
from dataclasses import dataclass

import numpy

from cells import grouped
from output import WrongUsage
from sweeping.planned import Json, Planned, Sweep, hash_of

START_TRIANGLES = 100_000  # estimated cost of starting a process, in triangles
Done = list[tuple[float, float]]  # (triangles, or 0 if unknown; seconds)


@dataclass(frozen=True)
class Unit:
    cells: list[Planned]
    experiment: Json
    what: str  # hash of what is measured
    label: str  # "soup:70, karras"

    @property
    def triangles(self) -> int:
        return self.cells[0].triangles

    @property
    def kind(self) -> str:
        """Returns what its time depends on apart from the scene."""
        return self.label.removeprefix(self.cells[0].cell.scene)


@dataclass(frozen=True)
class Shard:
    """Part `number` of `of`."""

    number: int = 1
    of: int = 1

    @property
    def is_all(self) -> bool:
        return self.of == 1


def shard_called(text: str) -> Shard:
    found = re.fullmatch(r"(\d+)/(\d+)", text)
    if not found or not 1 <= int(found[1]) <= int(found[2]):
        raise WrongUsage(f"--shard is i/n with i from 1 to n, not '{text}'")
    return Shard(int(found[1]), int(found[2]))


def units_of(sweep: Sweep, together: bool, settings: str) -> list[Unit]:
    """Returns the units of the possible cells. `settings` holds everything else that affects what is measured."""
    groups = grouped((one for one in sweep.cells if not one.why_not),
                     lambda one: json.dumps(one.scene, sort_keys=True) if together else id(one))
    return [unit_of(sweep, cells, settings) for cells in groups.values()]


def unit_of(sweep: Sweep, cells: list[Planned], settings: str) -> Unit:
    experiment = sweep.experiment(cells)
    what = f"{len(cells)} cells" if len(cells) > 1 else cells[0].cell.pipeline
    return Unit(cells, experiment, hash_of(json.dumps(experiment), settings), f"{cells[0].cell.scene}, {what}")


def shards_of(units: list[Unit], count: int) -> list[int]:
    """Returns the shard of each unit, from 1: the heaviest unit first, each to the shard with the smallest load."""
    weights = [unit.triangles * len(unit.cells) + START_TRIANGLES for unit in units]
    load, chosen = [0] * count, [0] * len(units)
    for place in sorted(range(len(units)), key=lambda one: -weights[one]):
        least = load.index(min(load))
        load[least] += weights[place]
        chosen[place] = least + 1
    return chosen


class TimeLeft:
    """Estimates times from finished units: those of the same builder or pipeline if they have several sizes, otherwise all."""

    def __init__(self) -> None:
        self.all: Done = []
        self.of_kind: dict[str, Done] = {}

    def add(self, kind: str, triangles: int, seconds: float) -> None:
        self.all.append((triangles, seconds))
        self.of_kind.setdefault(kind, []).append((triangles, seconds))

    def seconds_of(self, kind: str, triangles: int) -> float:
        """Returns the expected seconds of a unit. At least one unit must have been added."""
        own = self.of_kind.get(kind, [])
        return estimate(own if own and (has_sizes(own) or not has_sizes(self.all)) else self.all, triangles)


def has_sizes(done: Done) -> bool:
    return len({triangles for triangles, _ in done}) > 1


def estimate(done: Done, triangles: int) -> float:
    """Fits a line by least squares, with neither a negative start nor a negative slope, and returns its value."""
    sizes, seconds = (numpy.array(column, dtype=float) for column in zip(*done, strict=True))
    if triangles <= 0:
        return float(seconds.mean())
    if not has_sizes(done):
        return float(seconds.mean() * (START_TRIANGLES + triangles) / (START_TRIANGLES + sizes.mean()))
    slope = max(0.0, float(numpy.polyfit(sizes, seconds, 1)[0]))
    start = float(seconds.mean() - slope * sizes.mean())
    return start + slope * triangles if start >= 0 else float(seconds.sum() / sizes.sum() * triangles)


def rough(seconds: float) -> str:
    """Returns "12 s", "3 min", "5 h 20 min", "2 d 3 h"."""
    whole = math.ceil(max(seconds, 1))
    if whole < 90:
        return f"{whole} s"
    minutes = -(-whole // 60)
    if minutes < 90:
        return f"{minutes} min"
    hours = minutes // 60
    large, unit, small, small_unit = (hours, "h", minutes % 60, "min") if hours < 48 else (hours // 24, "d", hours % 24, "h")
    return f"{large} {unit}" + (f" {small} {small_unit}" if small else "")
