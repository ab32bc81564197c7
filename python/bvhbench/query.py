"""The queries that a tree and a scene have in common."""
from collections.abc import Iterable

import numpy as np

from . import _core
from .arrays import pairs_of, words_of

Numbers = Iterable[int] | None
NONE = np.empty((0, 2), np.uint32)


def options(order: str, builder: str, collider: str, adjacent: bool) -> _core.Options:
    made = _core.Options()
    made.order, made.builder, made.collider, made.adjacent_pairs = order, builder, collider, bool(adjacent)
    return made


def query(answer: str, among: str, exclude=(), groups: Numbers = None, masks: Numbers = None, distance: float = 0.0) -> _core.Query:
    return _core.Query(answer, among, pairs_of(exclude, "pairs of objects"), words_of(groups, "groups"), words_of(masks, "masks"),
                       float(distance))


class Queries:
    """Which pairs a query tells, by the objects of their triangles, from 0:

    among     "all", "between" (of two objects) or "within" (of one)
    exclude   (k, 2) integers: objects that are not tested with each other; one twice: with itself
    groups, masks   a word an object: two objects a and b are tested if groups[a] & masks[b] and groups[b] & masks[a] have bits
    """

    def _ask(self, asked: _core.Query) -> np.ndarray:
        raise NotImplementedError

    def pairs(self, among: str = "all", exclude=(), groups: Numbers = None, masks: Numbers = None) -> np.ndarray:
        """Returns triangles whose boxes overlap or touch: a pair a row, in no order."""
        return self._ask(query("pairs", among, exclude, groups, masks))

    def contacts(self, among: str = "all", exclude=(), groups: Numbers = None, masks: Numbers = None) -> np.ndarray:
        """Returns triangles that intersect or touch, exactly for the coordinates as floats: a pair a row, in no order."""
        return self._ask(query("contacts", among, exclude, groups, masks))

    def within(self, distance: float, among: str = "all", exclude=(), groups: Numbers = None, masks: Numbers = None) -> np.ndarray:
        """Returns triangles that are at most `distance` apart, in the unit of the points, exactly for the coordinates as floats: a pair a
        row, in no order."""
        return self._ask(query("within", among, exclude, groups, masks, distance))

    def first(self, among: str = "all", exclude=(), groups: Numbers = None, masks: Numbers = None) -> tuple[int, ...] | None:
        """Returns two triangles that intersect, any of them, as one row of `contacts`; None if no two do. Ends at the first."""
        found = self._ask(query("first", among, exclude, groups, masks))
        return tuple(found[0].tolist()) if len(found) else None
