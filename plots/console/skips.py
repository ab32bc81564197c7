"""What each rule that leaves work out saves: frames with the rule beside the same frames without it."""
import results
from cells import Cell, choice
from console import spread
from tables import Table, duration

TITLES = ("<scene", "frame", "<rule", "triangles left out", "launches", "rebuilds", "updates", "sorts", "tasks", "box tests",
          "with", "without", "times", "<pairs")
FEW = 1000  # a group takes nodes in the order in which they turn up: of so many box tests one may come and go


def text(run: results.Run) -> str:
    by_rules: dict[tuple[object, ...], Cell] = {}
    for cell in run.all_cells:
        if cell.operation == "collide":
            by_rules.setdefault(key_of(cell, rules_of(cell)), cell)
    table = Table(*TITLES)
    for cell in run.all_cells:
        for rule in rules_of(cell):
            beside = by_rules.get(key_of(cell, [other for other in rules_of(cell) if other != rule]))
            if beside is not None and all(one.verdict == "agrees" and one.samples for one in (cell, beside)):
                table.row(row_of(beside, cell, rule))
    return "skips:\n" + table.text() if table.rows else ""


def rules_of(cell: Cell) -> list[str]:
    """Those that are switched off."""
    return [rule for rule in dict(cell.collider_options).get("no_skip", "").split(", ") if rule]


def key_of(cell: Cell, rules: list[str]) -> tuple[object, ...]:
    """What a cell is but for the rules that it does without, and those."""
    collider, options = choice(cell.raw["collider"])
    others = tuple(pair for pair in options if pair[0] != "no_skip")
    of_scene = (cell.scene_facts["name"], cell.frame, cell.experiment)
    return (*of_scene, choice(cell.raw["builder"]), collider, others, frozenset(rules))


def row_of(with_rule: Cell, without: Cell, rule: str) -> list[str]:
    def less(key: str) -> int:
        return int(without.counters.get(key, 0) - with_rule.counters.get(key, 0))

    triangles = int(entered(without) - entered(with_rule))
    launches = launches_of(without) - launches_of(with_rule)
    saved = [triangles, launches, less("rebuilt_objects_count"), -less("kept_objects_count"), less("sorts_count"),
             less("tasks_count")]
    tests = less("box_tests_count")
    row = [with_rule.scene_facts["name"], str(with_rule.frame), rule, f"{triangles:,}", str(launches),
           *(f"{value:,}" for value in (*saved[2:], tests))]
    if not any(saved) and FEW * abs(tests) < with_rule.counters.get("box_tests_count", 0):
        row += ["", "", "nothing to skip"]  # its times would be noise
    else:
        on, off = (spread.median(cell.whole_times_ns()) for cell in (with_rule, without))
        row += [duration(on), duration(off), f"{spread.ratio(off, on):.2f}"]
    same = all(with_rule.check.get(key) == without.check.get(key) for key in ("pairs_hash", "contacts_hash"))
    return [*row, "the same" if same else "NOT the same"]


def entered(cell: Cell) -> float:
    """Triangles that the frame's work began with."""
    return cell.counters.get("entered_count", cell.triangles)


def launches_of(cell: Cell) -> int:
    return sum(stage.get("launches", 0) for stage in cell.all_samples[0]["stages"])
