"""Sizes of a sweep: 1000,30k or 1000:1M:x10 or 1000:5000:+1000."""
import math
from typing import NoReturn

from ..files.output import WrongUsage

MOST = 2**31
MOST_SIZES = 10000
UNITS = {"k": 1e3, "M": 1e6}


def refuse(text: str, why: str) -> NoReturn:
    raise WrongUsage(f"'{text}' are no sizes: {why}; write 1000,30000 or 1000:1000000:x10 or 1000:5000:+1000")


def number(text: str, digits: str, kind: type) -> float:
    unit = UNITS.get(digits[-1:], 1)
    try:
        spelled = digits[:-1] if unit > 1 else digits
        value = round(float(spelled) * unit, 6) if digits.strip() == digits and "_" not in digits else math.nan
    except ValueError:
        value = math.nan
    if not 0 < value <= MOST or kind(value) != value:
        refuse(text, f"'{digits}' is no number from 1 to {MOST}")
    return kind(value)


def of_range(text: str, words: str) -> set[int]:
    parts = words.split(":")
    if len(parts) != 3 or len(parts[2]) < 2 or parts[2][0] not in "x+":
        refuse(text, f"a range is FROM:TO:xFACTOR or FROM:TO:+STEP, not '{words}'")
    first, last = (number(text, part, int) for part in parts[:2])
    if first > last:
        refuse(text, f"{parts[0]} is more than {parts[1]}")
    multiplies, by = parts[2][0] == "x", number(text, parts[2][1:], float)
    if by <= 1 if multiplies else by < 1:
        refuse(text, f"'{parts[2]}' leads nowhere")
    sizes, size = set(), float(first)
    while math.floor(size + 0.5) <= last:
        sizes.add(math.floor(size + 0.5))
        size = size * by if multiplies else size + by
        if len(sizes) > MOST_SIZES:
            refuse(text, f"they are more than {MOST_SIZES}")
    return sizes


def called(text: str) -> list[int]:
    """Returns the sizes in ascending order, each once. Raises WrongUsage."""
    sizes: set[int] = set()
    for item in text.split(","):
        sizes |= of_range(text, item) if ":" in item else {int(number(text, item, int))}
    return sorted(sizes)
