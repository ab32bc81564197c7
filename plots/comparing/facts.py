"""Compares everything about two cells and two runs that is not a time."""
from typing import Any

from ..console.cell import depths
from ..read.cells import Cell
from ..read.counters import differs, is_better_smaller, is_promised
from ..words.tables import exact
from .refusals import Rules

WORST_FIRST = ("failed", "skipped", "differs", "not checked", "counted", "agrees")  # verdicts
OF_ANSWERS = {"pairs_hash": "pairs", "contacts_hash": "contacts"}
# Counters that say how wrong an answer is. Where they are, they tell what is worse; the answer's hash and number only differ.
ERRORS_OF = {"pairs": "missed_pairs_count", "contacts": "missed_count"}
NO_HASH = "0" * 16
# Names of circumstances in remarks, and their places in the facts of a run.
CIRCUMSTANCES = {"device": ("device", "name"), "driver": ("device", "driver"), "host": ("host", "name"),
                 "operating system": ("host", "os"), "compiler": ("program", "compiler"), "build": ("program", "build_type"),
                 "architecture": ("program", "arch"), "kernels": ("program", "kernels")}

Found = tuple[list[str], list[str]]  # messages: regressions, and other changes


def fact_changes(first: Cell, second: Cell, rules: Rules) -> Found:
    """Compares verdicts, hashes of answers and exact counters of two cells of one identity. For other devices, only verdicts, and
    for two builders, only verdicts and answers."""
    found: Found = [], []
    compare_verdicts(first, second, found)
    if first.provenance != second.provenance:
        found[1].append(f"from outside: {second.provenance or 'no more'}, was {first.provenance or 'ours'}")
    if first.status != "measured" or second.status != "measured":
        return found
    scenes = [cell.scene_facts.get("content_hash", NO_HASH) for cell in (first, second)]
    if scenes[0] != scenes[1]:
        found[0].append(f"another scene of the same name: content {scenes[1]}, was {scenes[0]}")
    elif rules.builders:
        compare_hashes(first, second, found, ())
    elif not rules.other_devices:
        compare_hashes(first, second, found)
        compare_counters(first, second, rules.allow_missing, found)
    return found


def compare_verdicts(first: Cell, second: Cell, found: Found) -> None:
    before, after = WORST_FIRST.index(first.verdict), WORST_FIRST.index(second.verdict)
    if before != after:
        why = second.reason or second.check.get("detail", "")
        found[after > before].append(f"{second.verdict}{f' ({why})' if why else ''}, was {first.verdict}")


def compare_hashes(first: Cell, second: Cell, found: Found, of_trees: tuple[str, ...] = ("tree_hash",)) -> None:
    for key in (*OF_ANSWERS, *of_trees):
        before, after = (cell.check.get(key) for cell in (first, second))
        if before is None or after is None or before == after:
            continue
        if what := OF_ANSWERS.get(key):
            found[counts_errors(what, first, second)].append(f"other {what}: {after}, were {before}")
        else:
            found[1].append(f"another tree: {after}, was {before}")


def counts_errors(what: str, *cells: Cell) -> bool:
    return all(ERRORS_OF.get(what) in cell.counters for cell in cells)


def compare_counters(first: Cell, second: Cell, allow_missing: bool, found: Found) -> None:
    for counter, value in sorted(first.counters.items()):
        other = second.counters.get(counter)
        if other is None:
            why = second.left_out.get(counter)
            found[allow_missing].append(f"no {counter}{'' if why is None else f' ({why})'}, was {exact(value)}")
        elif differs(counter, float(value), float(other), first):
            is_better = is_better_smaller(counter) and other < value or counts_errors(counter.removesuffix("_count"), first, second)
            found[is_better or not is_promised(counter, first)].append(f"{counter} {exact(other)}, was {exact(value)}")
    before, after = first.leaves_by_depth, second.leaves_by_depth
    if before and after and before != after:
        found[1].append(f"leaves by depth {depths(after)}, were {depths(before)}")


def run_remarks(first: dict[str, Any], second: dict[str, Any]) -> list[str]:
    remarks = [f"{what}: {first[part][key]} and {second[part][key]}" for what, (part, key) in CIRCUMSTANCES.items()
               if first[part][key] != second[part][key]]
    tuned = [run.get("tuning", {}).get("values", {}) for run in (first, second)]
    if tuned[0] != tuned[1]:
        remarks.append("tuned values")
    for which, run in (("first", first), ("second", second)):
        if not run.get("finished_at"):
            remarks.append(f"the {which} run was stopped before its end")
        remarks += [f"the {which} run was under {hook}={value}" for hook, value in sorted(run.get("test_hooks", {}).items())]
    return remarks
