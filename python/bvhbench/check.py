"""Whether pairs are right, whoever found them."""
import numpy as np

from . import _core
from .arrays import faces_of, pairs_of, points_of

SHOWN = 3


class WrongPairs(AssertionError):
    """Pairs that are not those of the host's sweep. `missing` and `extra` are (k, 2) arrays, `repeated` a number of rows."""

    def __init__(self, missing: np.ndarray, extra: np.ndarray, repeated: int, right: int):
        self.missing, self.extra, self.repeated = missing, extra, repeated
        parts = [f"{len(rows)} {word}: {', '.join(str(tuple(row)) for row in rows[:SHOWN].tolist())}{' …' * (len(rows) > SHOWN)}"
                 for rows, word in ((missing, "missing"), (extra, "too many")) if len(rows)]
        parts += [f"{repeated} repeated"] * (repeated > 0)
        super().__init__(f"of {right} pairs {'; '.join(parts)}")


def verify(pairs, points, faces, *, answer: str = "pairs", distance: float = 0.0, adjacent: bool = True) -> None:
    """Compares pairs in any order, either triangle first, with those that a sweep and exact tests find on the host, without any tree of
    ours: of all triangles of one array. `answer` and `distance` say what they answer: "pairs", "contacts" or "within". Raises
    WrongPairs, with the first wrong ones, and the errors of Tree. May take long: it tests all pairs that overlap along one axis."""
    if answer not in ("pairs", "contacts", "within"):
        raise _core.BadInput(f"an answer is 'pairs', 'contacts' or 'within', not {answer!r}")
    if not 0 <= distance < np.inf:
        raise _core.BadInput(f"a distance is not negative and finite, not {distance}")
    points = points_of(points)
    if not np.isfinite(points).all():
        raise _core.BadInput("a point is not finite")
    faces = faces_of(faces)
    if faces.size and faces.max() >= len(points):
        raise _core.BadInput(f"a face names point {faces.max()}, and there are {len(points)}")
    given = np.sort(pairs_of(pairs, "pairs"), axis=1)
    right = _core.right_pairs(answer, points, faces, adjacent, distance)
    keys, wanted = (rows.astype(np.uint64) @ np.array([1 << 32, 1], np.uint64) for rows in (given, right))
    missing = right[~np.isin(wanted, keys)]
    extra = given[~np.isin(keys, wanted)]
    repeated = len(keys) - len(np.unique(keys))
    if len(missing) or len(extra) or repeated:
        raise WrongPairs(missing, extra, repeated, len(right))
