"""A tree over one array of triangles."""
import numpy as np

from . import _core
from .arrays import faces_of, points_of, words_of
from .query import NONE, Numbers, Queries, options


class Tree(Queries):
    """An Oi-BVH over triangles, or one for each object, and queries for pairs of triangles.

    points    (n, 3) real numbers, in one unit. Doubles are rounded to floats.
    faces     (m, 3) integers: the points of each triangle, from 0. No faces: no pairs.
    device    "gpu", "cpu", an index among bvhbench.devices(), or words of a name; the first GPU if empty, or else the processor
    objects   (m,) integers: the object of each triangle, each of 0 to the largest at least once; one object if None
    adjacent  whether triangles that share a point (by index) are pairs, and contacts if they meet beyond it
    order, builder, collider   as Options of the C++ library has them; the best on the device if empty

    On a processor arrays of float32 and uint32 that are contiguous are not copied: the tree reads them up to the next `build`, `refit` or
    `update`, so they must not be written until then. Queries wait, and there builds do, all without the GIL. Threads may share a device,
    and a tree, whose calls take turns.

    Raises BadInput (a ValueError) for values and shapes, TypeError for other types, Unavailable for too little memory.
    """

    def __init__(self, points, faces, device: str | int = "", *, objects=None, adjacent: bool = True, order: str = "hilbert30",
                 builder: str = "", collider: str = ""):
        self._tree = _core.Tree(str(device), options(order, builder, collider, adjacent))
        self.build(points, faces, objects)

    def build(self, points, faces, objects=None) -> None:
        """Builds the tree over other triangles, on the same device and with the same options."""
        self._points = 0  # there is no tree until the build succeeds
        points = points_of(points)
        faces = faces_of(faces)
        owners = None if objects is None else words_of(objects, "objects")
        if owners is not None and len(owners) != len(faces):
            raise _core.BadInput(f"there are {len(owners)} objects of triangles, and {len(faces)} triangles")
        self._order = None  # of the triangles in the tree, if objects are not in order
        sizes = ()
        if owners is not None and len(owners):
            sizes = np.bincount(owners)
            if np.any(owners[1:] < owners[:-1]):
                self._order = np.argsort(owners, kind="stable").astype(np.uint32)
                faces = np.ascontiguousarray(faces[self._order])
        self._owners, self._empty = owners, not len(faces)
        if not self._empty:
            self._tree.build(points, faces, words_of(sizes, "sizes"))
        self._points = len(points)

    def refit(self, points) -> None:
        """Recomputes the boxes from as many points. Faster than `update`; queries get slower the further triangles move apart."""
        points = self._as_many(points)
        if not self._empty:
            self._tree.refit(points)

    def update(self, points, objects: Numbers = None) -> None:
        """Rebuilds the trees of `objects`, which moved, and keeps the others; of all objects if None."""
        points = self._as_many(points)
        moved = np.full(self.object_count, objects is None, np.uint32)
        numbers = words_of(objects, "objects")
        if numbers.size and numbers.max() >= len(moved):
            raise _core.BadInput(f"there is no object {numbers.max()}, and there are {len(moved)}")
        moved[numbers] = 1
        if not self._empty:
            self._tree.update(points, moved)

    def pairs_with(self, other: "Tree") -> np.ndarray:
        """Returns (k, 2) triangles whose boxes overlap, the first of this tree and the second of `other`, in no order. Both trees are of
        one device and one object each."""
        if self._empty or other._empty:
            return NONE
        return self._tree.pairs_with(other._tree)

    def objects_of(self, pairs) -> np.ndarray:
        """Returns the object of each triangle, in the shape of `pairs`."""
        triangles = np.asarray(pairs)
        return np.zeros(triangles.shape, np.uint32) if self._owners is None else self._owners[triangles]

    @property
    def object_count(self) -> int:
        return 1 if self._owners is None or self._empty else int(self._owners.max()) + 1

    @property
    def builder(self) -> str:
        return self._tree.builder()

    @property
    def collider(self) -> str:
        return self._tree.collider()

    @property
    def memory(self) -> int:
        """Bytes of device memory that the tree holds, without arrays that are not copied."""
        return self._tree.memory()

    def _as_many(self, points) -> np.ndarray:
        points = points_of(points)
        if len(points) != self._points:
            raise _core.BadInput(f"the tree is over {self._points} points, and {len(points)} are given")
        return points

    def _ask(self, asked: _core.Query) -> np.ndarray:
        if self._empty:
            return NONE
        found = self._tree.ask(asked)
        return found if self._order is None else np.sort(self._order[found], axis=1)
