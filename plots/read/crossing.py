"""From which size on one construction stays ahead of another: Figure 8."""
import itertools
import math


def crossing(single: dict[int, float], multi: dict[int, float]) -> float | None:
    """Returns the number of triangles from which `multi` is faster at all larger measured sizes, interpolated between sizes. Both have times by
    number of triangles.

    Returns None if `multi` is not faster at the largest size, or is faster at every size, so that there is no crossing."""
    ahead = [(math.log2(size), math.log(time / multi[size])) for size, time in sorted(single.items()) if size in multi]
    for (x0, lead0), (x1, lead1) in reversed(list(itertools.pairwise(ahead))):
        if lead1 <= 0:
            return None
        if lead0 <= 0:
            return 2 ** (x0 + (x1 - x0) * -lead0 / (lead1 - lead0))
    return None
