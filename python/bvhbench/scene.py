"""Objects that are placed one by one."""
import numpy as np

from . import _core
from .arrays import faces_of, points_of
from .query import Queries, options


class Scene(Queries):
    """Objects over triangles, each with a tree of its own, and queries among them. What a pose or new points cost does not depend on the
    other objects. Arrays are copied. The options are those of Tree.

    Queries give rows of four: an object, its triangle, another object, its triangle, each from 0.
    """

    def __init__(self, device: str | int = "", *, adjacent: bool = True, order: str = "hilbert30", builder: str = "", collider: str = ""):
        self._scene = _core.Scene(str(device), options(order, builder, collider, adjacent))
        self._first = np.zeros(1, np.int64)  # triangle of each object, and one past the last

    def add(self, points, faces) -> int:
        """Adds an object over (n, 3) points and (m, 3) faces of them, and returns its number. The next query builds all trees anew."""
        points = points_of(points)
        faces = faces_of(faces)
        number = self._scene.add(points, faces)
        self._first = np.append(self._first, self._first[-1] + len(faces))
        return number

    def place(self, number: int, pose) -> None:
        """Puts an object where the affine (4, 4) matrix `pose`, whose last row is 0, 0, 0, 1, takes the points that it was given last.
        Nothing but the pose is copied; the next query refits this object's tree."""
        pose = np.asarray(pose)
        if pose.shape != (4, 4) or pose.dtype.kind not in "fiu" or pose[3].tolist() != [0, 0, 0, 1]:
            raise _core.BadInput("a pose is a (4, 4) matrix of real numbers whose last row is 0, 0, 0, 1")
        self._scene.place(number, np.ascontiguousarray(pose[:3], np.float32))

    def move(self, number: int, points) -> None:
        """Gives an object other points, as many as before; its pose stays. The next query rebuilds this object's tree."""
        self._scene.move(number, points_of(points))

    def __len__(self) -> int:
        """Returns the number of objects."""
        return len(self._first) - 1

    @property
    def memory(self) -> int:
        """Bytes of device memory that the scene holds."""
        return self._scene.memory()

    def _ask(self, asked: _core.Query) -> np.ndarray:
        if not len(self):
            return np.empty((0, 4), np.uint32)
        found = self._scene.ask(asked)
        owners = np.searchsorted(self._first, found, "right") - 1
        return np.stack((owners, found - self._first[owners]), axis=2).reshape(-1, 4).astype(np.uint32)
