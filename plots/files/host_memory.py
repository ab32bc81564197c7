"""The memory that this process may still use. An input that would need more is refused before it is read."""
import os
import pathlib
import re

A_TEXT_BYTE = 12  # approximate bytes of host memory for each byte of JSON
UNITS = ("", "K", "M", "G", "T")
UNLIMITED = 1 << 62

limit = 0  # bytes that this process may use in all (--memory-limit); 0: no limit


def bytes_of(text: str) -> int:
    """Parses "512M" or "2G". Raises ValueError for anything but a number of bytes of at least 1."""
    found = re.fullmatch(r"(\d+)([KMGT]?)B?", text, re.IGNORECASE)
    value = int(found[1]) << 10 * UNITS.index(found[2].upper()) if found else 0
    if not 0 < value < 1 << 64:
        raise ValueError(f"must be a number of bytes from 1 on, as 512M or 2G, not '{text}'")
    return value


def left() -> int:
    """Returns the least of what the program found free when it started this process and what --memory-limit leaves."""
    spaces = [int(os.environ.get("BVHBENCH_HOST_BYTES", UNLIMITED))]
    if limit:
        resident = re.search(r"^VmRSS:\s+(\d+) kB", pathlib.Path("/proc/self/status").read_text(encoding="utf-8"), re.MULTILINE)
        spaces.append(limit - (int(resident[1]) << 10))
    return max(0, min(spaces))


def refusal(path: str | pathlib.Path, size: int) -> str:
    """Returns why a text of `size` bytes cannot be read, or an empty text if it can."""
    wanted, there = A_TEXT_BYTE * size, left()
    return f"out of host memory: reading '{path}' takes about {wanted} bytes, and the host gives {there}" if wanted > there else ""
