"""The memory that this process may still use. An input that would need more is refused before it is read."""
import pathlib
import re
import resource

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


def number_in(path: pathlib.Path) -> int | None:
    try:
        return int(path.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return None


def left_in_groups() -> int:
    """Returns the bytes left in the control groups (version 1 or 2) of this process."""
    least = UNLIMITED
    try:
        lines = pathlib.Path("/proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except OSError:
        return least
    for line in lines:
        _, controllers, name = line.split(":", 2)
        if controllers not in ("", "memory"):
            continue
        root = pathlib.Path("/sys/fs/cgroup", controllers)
        most, used = ("memory.limit_in_bytes", "memory.usage_in_bytes") if controllers else ("memory.max", "memory.current")
        group = root / name.lstrip("/")
        for folder in (group, *group.parents):
            allowed, taken = number_in(folder / most), number_in(folder / used)
            if allowed is not None and taken is not None:
                least = min(least, allowed - taken)
            if folder == root:
                break
    return least


def own(key: str) -> int:
    """Returns a value of /proc/self/status (this process) or /proc/meminfo (the machine), in bytes."""
    for path in ("/proc/self/status", "/proc/meminfo"):
        found = re.search(rf"^{key}:\s+(\d+) kB", pathlib.Path(path).read_text(encoding="utf-8"), re.MULTILINE)
        if found:
            return int(found[1]) << 10
    return 0


def left() -> int:
    spaces = [own("MemAvailable"), left_in_groups()]
    address_space = resource.getrlimit(resource.RLIMIT_AS)[0]
    if address_space != resource.RLIM_INFINITY:
        spaces.append(address_space - own("VmSize"))
    if limit:
        spaces.append(limit - own("VmRSS"))
    return max(0, min(spaces))


def refusal(path: str | pathlib.Path, size: int) -> str:
    """Returns why a text of `size` bytes cannot be read, or an empty text if it can."""
    wanted, there = A_TEXT_BYTE * size, left()
    return f"out of host memory: reading '{path}' takes about {wanted} bytes, and the host gives {there}" if wanted > there else ""
