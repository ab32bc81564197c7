"""How long cells that are not done will take, from those that are."""
import math

import numpy

START_TRIANGLES = 100_000  # what a process costs before it measures anything, in triangles: a guess where nothing is known yet

Done = list[tuple[float, float]]  # triangles, 0 where they are not known, and seconds


class TimeLeft:
    """A time to start and one for each triangle: of the same builder or pipeline if it is done in several sizes, else of all."""

    def __init__(self) -> None:
        self.all: Done = []
        self.of_kind: dict[str, Done] = {}

    def add(self, kind: str, triangles: int, seconds: float) -> None:
        self.all.append((triangles, seconds))
        self.of_kind.setdefault(kind, []).append((triangles, seconds))

    def seconds_of(self, kind: str, triangles: int) -> float:
        """At least one cell must have been added."""
        own = self.of_kind.get(kind, [])
        return estimate(own if own and (has_sizes(own) or not has_sizes(self.all)) else self.all, triangles)


def has_sizes(done: Done) -> bool:
    return len({triangles for triangles, _ in done}) > 1


def estimate(done: Done, triangles: int) -> float:
    """A line by least squares, neither of whose numbers is negative."""
    sizes, seconds = (numpy.array(column, dtype=float) for column in zip(*done))
    if triangles <= 0:
        return float(seconds.mean())
    if not has_sizes(done):
        return float(seconds.mean() * (START_TRIANGLES + triangles) / (START_TRIANGLES + sizes.mean()))
    slope = max(0.0, float(numpy.polyfit(sizes, seconds, 1)[0]))
    start = float(seconds.mean() - slope * sizes.mean())
    return start + slope * triangles if start >= 0 else float(seconds.sum() / sizes.sum() * triangles)


def rough(seconds: float) -> str:
    """"12 s", "3 min", "5 h 20 min", "2 d 3 h"."""
    whole = math.ceil(max(seconds, 1))
    if whole < 90:
        return f"{whole} s"
    minutes = -(-whole // 60)
    if minutes < 90:
        return f"{minutes} min"
    hours = minutes // 60
    large, unit, small, small_unit = (hours, "h", minutes % 60, "min") if hours < 48 else (hours // 24, "d", hours % 24, "h")
    return f"{large} {unit}" + (f" {small} {small_unit}" if small else "")
