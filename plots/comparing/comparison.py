"""Compares two result files cell by cell: what became faster, slower, larger or wrong."""
import functools
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

from cells import Cell, grouped
from comparing import scenes, times
from comparing.drift import CellPair
from comparing.facts import fact_changes, run_remarks
from comparing.launches import allowance_ns
from comparing.refusals import Rules
from comparing.scenes import SceneChange


@dataclass
class ComparedCell:
    first: Cell
    second: Cell
    regressions: list[str]  # changes of the verdict, the answer and counters that fail
    changes: list[str]  # changes of these that do not fail
    time: times.TimeChange = times.TimeChange()  # of all stages together, which decides the verdict
    stages: dict[str, times.TimeChange] = field(default_factory=dict)

    @property
    def has_times(self) -> bool:
        return self.first.has_times and self.second.has_times

    @property
    def verdict(self) -> str:
        """Returns the verdict on times. Cells without samples are SAME, because only their facts are compared."""
        return self.time.verdict if self.first.all_samples or self.second.all_samples else times.SAME



@dataclass
class Comparison:
    rules: Rules
    cells: list[ComparedCell]  # in the first file's order
    only_first: list[Cell]
    only_second: list[Cell]
    remarks: list[str]  # other differences of the two runs
    by_turns: bool  # true if the runs took samples in turns, so that drift affects both alike
    allowance: float = 0  # nanoseconds that a launch may differ by between the runs
    scenes: list[SceneChange] = field(default_factory=list)  # of scenes with enough cells for a common change

    @functools.cached_property
    def error_of_each(self) -> float:
        """Returns the error allowed for one cell or one scene's common change, after Bonferroni, so that comparisons of hundreds
        of cells of equal programs rarely fail."""
        timed = [group_of(cell.first) for cell in self.cells if cell.has_times]
        return self.rules.error / max(1, len(timed) + sum(count >= scenes.FEWEST_CELLS for count in Counter(timed).values()))

    @property
    def regressions(self) -> int:
        if self.rules.builders:
            return sum(bool(cell.regressions) for cell in self.cells)
        return (sum(cell.verdict == times.SLOWER or bool(cell.regressions) for cell in self.cells)
                + sum(scene.verdict == times.SLOWER for scene in self.scenes)
                + (0 if self.rules.allow_missing else len(self.only_first)))


def compare(first: dict[str, Any], second: dict[str, Any], rules: Rules) -> Comparison:
    """Compares two documents that require_comparable accepts."""
    both, only_first, only_second = matched_cells(*([Cell(raw) for raw in document["cells"]] for document in (first, second)))
    cells = [ComparedCell(*pair, *fact_changes(*pair, rules)) for pair in both]
    runs = first["run"], second["run"]
    by_turns = all(one["id"] in other.get("turns_with", []) for one, other in (runs, runs[::-1]))
    comparison = Comparison(rules, cells, only_first, only_second, run_remarks(*runs), by_turns,
                            0 if rules.builders and runs[0]["id"] == runs[1]["id"] else allowance_ns(runs))
    groups = grouped((cell for cell in cells if cell.has_times), lambda cell: group_of(cell.first))
    for _, group in sorted(groups.items()):
        compare_scene(group, comparison)
    comparison.scenes = scenes.judged(comparison.scenes, rules.threshold)
    return comparison


def compare_scene(cells: list[ComparedCell], comparison: Comparison) -> None:
    rules, error = comparison.rules, comparison.error_of_each
    pairs = [(cell.first, cell.second) for cell in cells]
    if rules.builders:
        against = scenes.each_alone(pairs, comparison.allowance)
    elif comparison.by_turns:
        against = scenes.by_turns(pairs)
    elif rules.other_devices:
        against = scenes.of_other_devices(pairs)
    else:
        against, scene = scenes.beside_the_others(pairs, comparison.allowance, error)
        comparison.scenes += [scene] if scene else []
    for cell, series in zip(cells, against.pairs if against else []):
        cell.time = scenes.change_of(series, "", against, rules.threshold, error)
        stages = [entry["stage"] for entry in cell.first.all_samples[0]["stages"]]
        if len(stages) > 1:
            cell.stages = {stage: scenes.change_of(series, stage, against, rules.threshold, error)
                           for stage in stages if len(series[1].times_ns(stage))}


def matched_cells(first: list[Cell], second: list[Cell]) -> tuple[list[CellPair], list[Cell], list[Cell]]:
    """Pairs cells of equal identity in order, and returns the pairs and the cells that only one file has."""
    there = grouped(second, lambda cell: cell.identity)
    both, only_first = [], []
    for cell in first:
        candidates = there.get(cell.identity, [])
        # A cell without samples does not show whether it would have started from sorted leaves.
        place = next((place for place, other in enumerate(candidates) if not cell.all_samples or not other.all_samples
                      or cell.starts_from_leaves == other.starts_from_leaves), None)
        if place is None:
            only_first.append(cell)
        else:
            both.append((cell, candidates.pop(place)))
    left = {id(cell) for candidates in there.values() for cell in candidates}
    return both, only_first, [cell for cell in second if id(cell) in left]


def group_of(cell: Cell) -> tuple[str, ...]:
    """Returns a key that is equal for cells whose times are comparable: other builders or colliders on one scene and frame."""
    return (cell.experiment, cell.scene_facts["name"], str(cell.frame), cell.operation, cell.swept.get("pairs", ""),
            cell.accuracy.get("axis", ""), cell.caches, "leaves" if cell.starts_from_leaves else "")
