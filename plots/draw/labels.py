"""Places short labels beside points of a scatter plot so that none covers another label or a point."""
import itertools
import math
from typing import NamedTuple

import matplotlib.pyplot as plt

from . import style

HEIGHT = style.SMALL  # points, 1/72 inch
WIDTH = 0.66 * HEIGHT  # of a character, including the space around it
GAP = 1  # left and right of a label, so that two labels do not read as one number
POINT = 3.2  # half the width of a marker
RADII = (6, 8.5, 11.5, 15, 19, 24, 30, 37, 45, 55)
DIRECTIONS = 24
LEADER_FROM = 9  # a label farther from its point is joined to it by a line

# Penalties: COVERED for each square point that is covered, SEEMS_ANOTHERS if another point is nearer, 1 for each crossing line.
COVERED = 10
SEEMS_ANOTHERS = 0.3

Place = tuple[float, float]
Line = tuple[Place, Place]


class Label(NamedTuple):
    """A label beside a point, in the axes' data coordinates."""

    x: float
    y: float
    text: str
    colour: str


class Box(NamedTuple):
    left: float
    foot: float
    right: float
    top: float

    @property
    def area(self) -> float:
        return (self.right - self.left) * (self.top - self.foot)


def box_at(x: float, y: float, text: str) -> Box:
    half = WIDTH * len(text) / 2 + GAP
    return Box(x - half, y - HEIGHT / 2, x + half, y + HEIGHT / 2)


def shared(one: Box, other: Box) -> float:
    wide = min(one.right, other.right) - max(one.left, other.left)
    high = min(one.top, other.top) - max(one.foot, other.foot)
    return wide * high if wide > 0 and high > 0 else 0.0


def meets(box: Box, start: Place, end: Place) -> bool:
    """True if the line from `start` to `end` crosses the box. Clips the line to the box along each axis."""
    first, last = 0.0, 1.0
    for axis, (low, high) in enumerate(((box.left, box.right), (box.foot, box.top))):
        step = end[axis] - start[axis]
        if step == 0:
            if not low < start[axis] < high:
                return False
            continue
        near, far = sorted(((low - start[axis]) / step, (high - start[axis]) / step))
        first, last = max(first, near), min(last, far)
    return first < last


def places_around(x: float, y: float) -> list[tuple[float, Place]]:
    """Returns places around a point with their distances: nearest first, and the upper right first at equal distance."""
    angles = [math.pi / 4 + 2 * math.pi * step / DIRECTIONS for step in range(DIRECTIONS)]
    return [(radius, (x + radius * math.cos(angle), y + radius * math.sin(angle)))
            for radius in RADII for angle in angles]


def offsets(points: list[Place], texts: list[str], frame: Box, lines: list[Line]) -> list[Place]:
    """Returns each label's offset from its point, in typographical points: the nearest place with the least penalty."""
    taken = [Box(x - POINT, y - POINT, x + POINT, y + POINT) for x, y in points]
    placed: list[Box] = []
    lines = list(lines)
    found = []
    for (x, y), text in zip(points, texts, strict=True):
        least = math.inf
        for radius, place in places_around(x, y):
            box = box_at(*place, text)
            fault = COVERED * (sum(shared(box, other) for other in taken) + box.area - shared(box, frame))
            fault += sum(meets(box, *line) for line in lines) + sum(meets(other, (x, y), place) for other in placed)
            if radius <= LEADER_FROM and any(math.dist(place, point) < radius - 0.1 for point in points):
                fault += SEEMS_ANOTHERS
            if fault < least - 1e-9:
                least, best = fault, (radius, place, box)
            if least < 1e-9:
                break
        radius, place, box = best
        placed.append(box)
        taken.append(box)
        if radius > LEADER_FROM:
            lines.append(((x, y), place))
        found.append((place[0] - x, place[1] - y))
    return found


def draw(axes: plt.Axes, labels: list[Label], path: list[Place] = ()) -> None:
    """Draws labels beside their points and off the path, in data coordinates. The layout must be final: places depend on it."""
    to_points = 72 / axes.figure.dpi

    def placed(places: list[Place]) -> list[Place]:
        return [tuple(to_points * axes.transData.transform(place)) for place in places]

    points, path = placed([(label.x, label.y) for label in labels]), placed(path)
    frame = Box(*(to_points * axes.get_window_extent().extents))
    found = offsets(points, [label.text for label in labels], frame, list(itertools.pairwise(path)))
    for label, (dx, dy) in zip(labels, found, strict=True):
        line = {"arrowstyle": "-", "color": label.colour, "linewidth": 0.4, "shrinkA": 0, "shrinkB": POINT}
        axes.annotate(label.text, (label.x, label.y), (dx, dy), textcoords="offset points", ha="center",
                      va="center_baseline", fontsize=HEIGHT, color=label.colour, zorder=5, annotation_clip=False,
                      arrowprops=line if math.hypot(dx, dy) > LEADER_FROM else None).set_in_layout(False)
