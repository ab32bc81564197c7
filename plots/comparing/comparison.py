"""Compares two result files cell by cell: what became faster, slower, larger or wrong."""
import math
from dataclasses import dataclass, field
from typing import Any

from ..read.cells import Cell, by_stage, grouped, median, times_ns
from . import times
from .facts import fact_changes, run_remarks
from .refusals import Rules
from .sides import Sides, sides_of

CellPair = tuple[Cell, Cell]


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
    sides: Sides
    cells: list[ComparedCell]  # in the first file's order
    only_first: list[Cell]
    only_second: list[Cell]
    remarks: list[str]  # other differences of the two runs
    withheld: int = 0  # cells that would be FASTER or SLOWER, if there were no warnings

    @property
    def regressions(self) -> int:
        if self.rules.builders:
            return sum(bool(cell.regressions) for cell in self.cells)
        return (sum(cell.verdict == times.SLOWER or bool(cell.regressions) for cell in self.cells)
                + (0 if self.rules.allow_missing else len(self.only_first)))


def compare(first: dict[str, Any], second: dict[str, Any], rules: Rules) -> Comparison:
    """Compares two documents that require_comparable accepts."""
    both, only_first, only_second = matched_cells(*([Cell(raw) for raw in document["cells"]] for document in (first, second)))
    cells = [ComparedCell(*pair, *fact_changes(*pair, rules)) for pair in both]
    comparison = Comparison(rules, sides_of(first, second), cells, only_first, only_second, run_remarks(first["run"], second["run"]))
    for group in grouped((cell for cell in cells if cell.has_times), lambda cell: group_of(cell.first)).values():
        compare_scene(group, comparison)
    if comparison.sides.warnings:
        comparison.withheld = sum(cell.verdict in (times.FASTER, times.SLOWER) for cell in cells)
        for cell in cells:
            cell.time = times.without_verdict(cell.time)
    return comparison


def compare_scene(cells: list[ComparedCell], comparison: Comparison) -> None:
    """Compares the times of cells whose pairs of processes vary alike."""
    rules = comparison.rules
    whole = [(times_of(cell.first), times_of(cell.second)) for cell in cells]
    in_pairs = not comparison.sides.why and len({len(of_side) for pair in whole for of_side in pair}) == 1
    spread = times.spread_of([times.differences(*pair) for pair in whole]) if in_pairs else None
    common = 1.0
    if rules.other_devices:
        common = math.exp(median([times.log_medians(second).mean() - times.log_medians(first).mean() for first, second in whole]))
        if len(cells) == 1:
            return  # it has no other to be compared with

    # The error allowed for one cell, after Bonferroni, so that comparisons of hundreds of cells of equal programs rarely fail.
    error = rules.error / max(1, sum(cell.has_times for cell in comparison.cells))

    def change(first: times.Times, second: times.Times) -> times.TimeChange:
        return times.time_change(first, second, rules.threshold, error, spread, common)

    for cell, pair in zip(cells, whole, strict=True):
        cell.time = change(*pair)
        stages = [entry["stage"] for entry in cell.first.all_samples[0]["stages"]]
        if len(stages) > 1:
            of_stages = ((stage, times_of(cell.first, stage), times_of(cell.second, stage)) for stage in stages)
            cell.stages = {stage: change(one, other) for stage, one, other in of_stages
                           if all(map(len, one)) and all(map(len, other))}


def times_of(cell: Cell, stage: str = "") -> times.Times:
    """Returns the whole times, or those of a stage, of each process; those during drift too, which affects both sides alike."""
    return [times_ns(map(by_stage, process.all_samples), stage) for process in cell.processes]


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
    return (cell.experiment, cell.scene_facts["name"], str(cell.frame), cell.operation, cell.features.get("pairs", ""),
            cell.accuracy.get("axis", ""), cell.caches, "leaves" if cell.starts_from_leaves else "")
