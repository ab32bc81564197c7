"""Prints what each rule that skips work saves: frames with the rule beside the same frames without it."""
from collections.abc import Iterable

import results
from cells import Cell
from console import spread
from tables import Table, duration

TITLES = ("<scene", "frame", "<rule", "triangles left out", "launches", "rebuilds", "updates", "sorts", "tasks", "box tests",
          "with", "without", "times", "<pairs")
FEW = 1000  # a group's box tests vary from run to run: smaller relative differences, 1 in FEW, are ignored


def text(run: results.Run) -> str:
    cells = [cell for cell in run.all_cells if cell.operation == "collide"]
    by_rules = {key_of(cell, rules_of(cell)): cell for cell in reversed(cells)}
    table = Table(*TITLES)
    for cell in cells:
        for rule in rules_of(cell):
            beside = by_rules.get(key_of(cell, set(rules_of(cell)) - {rule}))
            if beside is not None and all(one.verdict == "agrees" and one.samples for one in (cell, beside)):
                table.row(*row_of(beside, cell, rule))
    return "skips:\n" + table.text() if table.rows else ""


def rules_of(cell: Cell) -> list[str]:
    return [rule for rule in dict(cell.collider_options).get("no_skip", "").split(", ") if rule]


def key_of(cell: Cell, rules: Iterable[str]) -> tuple[object, ...]:
    """Returns the identity of a cell without the option no_skip, and the set of rules that are off."""
    return (*cell.key("scene", "frame", "experiment", "builder", "collider", without="no_skip"), frozenset(rules))


def row_of(with_rule: Cell, without: Cell, rule: str) -> list[str]:
    def less(key: str, sign: int = 1) -> int:
        return sign * int(without.counters.get(key, 0) - with_rule.counters.get(key, 0))

    triangles = int(entered(without) - entered(with_rule))
    launches = spread.of_stages(without, "launches") - spread.of_stages(with_rule, "launches")
    counts = [less("rebuilt_objects_count"), less("kept_objects_count", -1), less("sorts_count"), less("tasks_count")]
    tests = less("box_tests_count")
    row = [with_rule.scene_facts["name"], str(with_rule.frame), rule, f"{triangles:,}", str(launches),
           *(f"{value:,}" for value in (*counts, tests))]
    if not any((triangles, launches, *counts)) and FEW * abs(tests) < with_rule.counters.get("box_tests_count", 0):
        row += ["", "", "nothing to skip"]  # its times would be noise
    else:
        on, off = with_rule.median_ns(), without.median_ns()
        row += [duration(on), duration(off), f"{spread.ratio(off, on):.2f}"]
    same = all(with_rule.check.get(key) == without.check.get(key) for key in ("pairs_hash", "contacts_hash"))
    return [*row, "the same" if same else "NOT the same"]


def entered(cell: Cell) -> float:
    """Returns the number of triangles that the frame's work started with."""
    return cell.counters.get("entered_count", cell.triangles)
