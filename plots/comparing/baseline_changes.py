"""Compares a run of the experiment `smoke` with its baseline."""
import math
from dataclasses import dataclass, field

from ..read.cells import grouped, median
from ..words.tables import exact
from .baseline import Kept

FROM_WORST = ("failed", "differs", "skipped", "not checked", "counted", "agrees")  # from the worst verdict to the best
HAS_FACTS = FROM_WORST.index("skipped") + 1
LEAST_EXCESS_NS = 50_000  # smaller excess times are ignored: they are a few launches


@dataclass
class Changes:
    """Regressions, and remarks that do not fail, one sentence each, and the names of cells that the baseline lacks. `timed` of the
    `compared` cells have a ratio of times."""

    regressions: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    new: list[str] = field(default_factory=list)
    compared: int = 0
    timed: int = 0


def compare(before: list[Kept], now: list[Kept], tolerance: float, some: bool) -> Changes:
    """Compares verdicts, counters and hashes exactly, and times as ratios to the median ratio of their scene. With `some`, cells
    missing in `now` are not regressions."""
    changes = Changes()
    old = {cell["cell"]: cell for cell in reversed(before)}
    for cell in now:
        if cell["cell"] in old:
            changes.compared += 1
            compare_facts(old[cell["cell"]], cell, changes)
        else:
            changes.new.append(cell["cell"])
    there = {cell["cell"] for cell in now}
    gone = [cell["cell"] for cell in before if not some and cell["cell"] not in there]
    changes.regressions += [f"{name}: is in the baseline only" for name in gone]
    compare_times([(old[cell["cell"]], cell) for cell in now if cell["cell"] in old], tolerance, changes)
    return changes


def rank(verdict: str) -> int:
    return FROM_WORST.index(verdict) if verdict in FROM_WORST else len(FROM_WORST)


def compare_facts(before: Kept, now: Kept, changes: Changes) -> None:
    was, is_ = before["verdict"], now["verdict"]
    if was != is_:
        (changes.regressions if rank(is_) < rank(was) else changes.remarks).append(f"{now['cell']}: {is_}, was {was}")
    if min(rank(was), rank(is_)) >= HAS_FACTS:
        told = [*told_counters(before["counters"], now["counters"]), *told_hashes(before["hashes"], now["hashes"])]
        changes.regressions += [f"{now['cell']}: {what}" for what in told]


def told_counters(before: dict[str, float], now: dict[str, float]) -> list[str]:
    told = []
    for counter, value in sorted(before.items()):
        if counter not in now:
            told.append(f"no {counter}, was {exact(value)}")
        elif now[counter] != value:
            told.append(f"{counter} {exact(now[counter])}, was {exact(value)}")
    return told + [f"{counter} is new: {exact(value)}" for counter, value in sorted(now.items()) if counter not in before]


def told_hashes(before: dict[str, str], now: dict[str, str]) -> list[str]:
    return [f"other {what} than before: hash {now.get(what, 'none')}, was {hash_}"
            for what, hash_ in sorted(before.items()) if now.get(what) != hash_]


def compare_times(pairs: list[tuple[Kept, Kept]], tolerance: float, changes: Changes) -> None:
    timed_pairs = [pair for pair in pairs if pair[0].get("fastest_ns", 0) > 0 and "fastest_ns" in pair[1]]
    changes.timed = len(timed_pairs)
    for _, those in sorted(grouped(timed_pairs, lambda pair: pair[1]["scene"]).items()):
        timed = [(cell["cell"], old["fastest_ns"], cell["fastest_ns"]) for old, cell in those]
        common = median([now / old for _, old, now in timed])
        for name, old, now in timed:
            expected = old * common
            if now > tolerance * expected and now > expected + LEAST_EXCESS_NS:
                times = exact(math.floor(10 * now / expected + 0.5) / 10)
                changes.regressions.append(f"{name}: takes {times} times as long beside the others of its scene as it did")


def report(changes: Changes, tolerance: float) -> str:
    lines = [f"new: {name}: not in the baseline; `bvhbench smoke --update` adds it\n" for name in changes.new]
    lines += [f"changed: {remark}\n" for remark in changes.remarks] + [f"REGRESSION {told}\n" for told in changes.regressions]
    count = len(changes.regressions)
    return "".join(lines) + (f"{changes.compared} cells compared with the baseline, {changes.timed} times within {tolerance:g} "
                             f"times the ratio there: {f'{count} regressions' if count else 'as before'}\n")
