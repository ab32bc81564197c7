"""The Pareto front of times against costs or errors."""
from collections.abc import Sequence
from typing import TypeVar

Point = TypeVar("Point", bound=Sequence)  # time, cost or error, and anything else


def front(points: Sequence[Point]) -> list[Point]:
    """Returns the Pareto front, sorted by time. Of equal points the first is kept."""
    kept: list[Point] = []
    for point in sorted(points, key=lambda point: (point[0], point[1])):
        if not kept or point[1] < kept[-1][1]:
            kept.append(point)
    return kept
