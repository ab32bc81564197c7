"""The Pareto front of times against costs or errors."""
from collections.abc import Sequence
from typing import TypeVar

Point = TypeVar("Point", bound=Sequence)  # a time, a cost or error, and whatever else


def front(points: Sequence[Point]) -> list[Point]:
    """Those that no other is as fast as and as good as, one of them more so; by time. Of equal ones the first."""
    kept: list[Point] = []
    for point in sorted(points, key=lambda point: (point[0], point[1])):
        if not kept or point[1] < kept[-1][1]:
            kept.append(point)
    return kept
