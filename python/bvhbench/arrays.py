"""Arrays as the library takes them: contiguous, of 32 bits, with indices that there are."""
import warnings
from collections.abc import Iterable

import numpy as np

from ._core import BadInput

MOST = 2**32 - 1
NOTICED = 1e-6  # a share of the diagonal
NOTHING = {columns: np.empty((0, columns) if columns else 0, np.uint32) for columns in (0, 2, 3)}


def points_of(given) -> np.ndarray:
    """Returns points as (n, 3) floats of 32 bits, without a copy if they are. Warns if rounding moves one by more than a millionth of
    the diagonal of all."""
    points = np.asarray(given)
    if points.dtype.kind not in "fiu":
        raise TypeError(f"points are real numbers, not {points.dtype}")
    rounded = np.ascontiguousarray(shaped(points, 3, "points"), np.float32)
    if points.dtype.itemsize > 4 and rounded.size:
        off = np.abs(rounded - points).max()
        size = np.linalg.norm(np.ptp(points, axis=0).astype(float))
        if np.isfinite(size) and off > NOTICED * size:
            warnings.warn(f"points are rounded to floats, which moves coordinates by up to {off:.1g} of {size:.3g}; subtract a point near "
                          "them first", stacklevel=3)
    return rounded


def faces_of(given) -> np.ndarray:
    """Returns faces as (m, 3) indices of 32 bits. Whether there are such points is checked on the device."""
    return indices(given, 3, "faces")


def pairs_of(given, what: str) -> np.ndarray:
    return indices(given, 2, what)


def words_of(given: Iterable[int] | None, what: str) -> np.ndarray:
    """Returns (k,) words of 32 bits; none if nothing is given."""
    return indices(() if given is None else given, 0, what)


def indices(given, columns: int, what: str) -> np.ndarray:
    """Returns integers from 0 to MOST as words of 32 bits: an array of that many columns, or of one dimension if `columns` is 0."""
    if isinstance(given, tuple) and not given:  # as in most calls, which then take some microseconds less
        return NOTHING[columns]
    array = np.asarray(given)
    if array.size == 0:
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{what} are integers, not {array.dtype}")
    array = shaped(array, columns, what)
    if array.dtype != np.uint32 and array.size and (array.min() < 0 or array.max() > MOST):
        raise BadInput(f"{what} are from 0 to {MOST}, not {array.min() if array.min() < 0 else array.max()}")
    return np.ascontiguousarray(array, np.uint32)


def shaped(array: np.ndarray, columns: int, what: str) -> np.ndarray:
    """Returns the array if it has that many columns, or one dimension if `columns` is 0. An empty array takes that shape."""
    if array.size == 0:
        return array.reshape((0, columns) if columns else 0)
    if array.ndim != (2 if columns else 1) or columns and array.shape[1] != columns:
        raise BadInput(f"{what} have the shape {'(n, ' + str(columns) + ')' if columns else '(n,)'}, not {array.shape}")
    return array
