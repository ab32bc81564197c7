"""What a process measures: a cell, or all cells of a scene. Units are dealt to shards."""
import json
import re
from dataclasses import dataclass

from cells import grouped
from output import WrongUsage
from sweeping.planned import Json, Planned, Sweep, hash_of
from sweeping.time_left import START_TRIANGLES


@dataclass(frozen=True)
class Unit:
    cells: list[Planned]
    experiment: Json
    what: str  # the hash of what is measured
    label: str  # "soup:70, karras"

    @property
    def triangles(self) -> int:
        return self.cells[0].triangles

    @property
    def kind(self) -> str:
        """What sets its time apart, but for its scene."""
        return self.label.removeprefix(self.cells[0].cell.scene)


@dataclass(frozen=True)
class Shard:
    """The number-th of so many parts."""

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
    """Of the cells that can be. `settings` is what decides what is measured besides."""
    groups = grouped((one for one in sweep.cells if not one.why_not),
                     lambda one: json.dumps(one.scene, sort_keys=True) if together else id(one))
    return [unit_of(sweep, cells, settings) for cells in groups.values()]


def unit_of(sweep: Sweep, cells: list[Planned], settings: str) -> Unit:
    experiment = sweep.experiment(cells)
    what = f"{len(cells)} cells" if len(cells) > 1 else cells[0].cell.pipeline
    return Unit(cells, experiment, hash_of(json.dumps(experiment), settings), f"{cells[0].cell.scene}, {what}")


def shards_of(units: list[Unit], count: int) -> list[int]:
    """The shard of each unit: the heaviest first, each to the shard that has least."""
    weights = [unit.triangles * len(unit.cells) + START_TRIANGLES for unit in units]
    load, chosen = [0] * count, [0] * len(units)
    for place in sorted(range(len(units)), key=lambda one: -weights[one]):
        least = load.index(min(load))
        load[least] += weights[place]
        chosen[place] = least + 1
    return chosen
