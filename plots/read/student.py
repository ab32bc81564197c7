"""Student's t distribution (Abramowitz and Stegun, 26.7.3 and 26.7.4)."""
import functools
import math

MOST = 1e12  # larger than any quantile that is asked for


def beyond(t: float, freedom: int) -> float:
    """Returns the probability of a value further from 0 than `t`, at that many degrees of freedom."""
    sine, cosine = t / math.hypot(t, math.sqrt(freedom)), math.sqrt(freedom) / math.hypot(t, math.sqrt(freedom))
    is_odd = freedom % 2
    term = total = 0.0 if freedom == 1 else cosine if is_odd else 1.0
    for power in range(3 if is_odd else 2, freedom - 1, 2):
        term *= cosine * cosine * (power - 1) / power
        total += term
    within = sine * total
    return 1 - (2 / math.pi * (math.atan2(t, math.sqrt(freedom)) + within) if is_odd else within)


@functools.cache
def quantile(error: float, freedom: int) -> float:
    """Returns the distance from 0 that is exceeded with the probability `error`."""
    low, high = 0.0, MOST
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if beyond(middle, freedom) > error else (low, middle)
    return high
