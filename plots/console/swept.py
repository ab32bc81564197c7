"""Queries of swept boxes: a line each, and one for both of a step by the same pipeline."""
import math
from dataclasses import astuple, dataclass

import names
import results
from cells import Cell, choice
from console import spread
from tables import Table


@dataclass
class Sum:
    """A cell's numbers, or those of several together. What is not known (NaN) of one is not known of all."""

    primitives: float = 0
    pairs: float = 0
    broad_ns: float = 0
    whole_ns: float = 0
    truth: float = 0
    missed: float = 0

    def __add__(self, more: "Sum") -> "Sum":
        return Sum(*(one + other for one, other in zip(astuple(self), astuple(more))))


def text(run: results.Run, operation: str = "collide") -> str:
    table = Table("<scene", "step", "<pairs of", "<pipeline", "boxes", "pairs", "broad, ms", "ms", "Mpairs/s", "ground truth",
                  "missed", "inflation", "<verdict")
    # A scene that was not there has no steps; on the axis it is named all the same.
    steps: dict[tuple[object, ...], list[Cell]] = {}
    for cell in run.all_cells:
        if cell.operation == operation and (cell.swept or cell.accuracy.get("axis") == "swept"):
            steps.setdefault(step_of(cell), []).append(cell)
    for cells in steps.values():
        both = Sum()
        for cell in cells:
            numbers = numbers_of(cell)
            both += numbers
            scene = cell.scene_facts["name"] + (f" for {cell.stand_in_for}" if cell.stand_in_for else "")
            why = cell.reason or cell.check.get("detail", "")
            add_row(table, [scene, str(cell.frame), cell.swept.get("pairs", ""), method_of(cell)], numbers,
                    cell.verdict + (f": {why}" if why else ""))
        if len(cells) > 1:
            add_row(table, ["", "", "both", ""], both, "")
    return table.text() if steps else ""


def step_of(cell: Cell) -> tuple[object, ...]:
    """What the two queries of a step by one pipeline share."""
    collider = choice(cell.raw["collider"]) if cell.collider else ("", ())
    return (cell.scene_facts["name"], cell.frame, cell.experiment, choice(cell.raw["builder"]), collider[0],
            tuple(pair for pair in collider[1] if pair[0] != "pairs_of"))


def method_of(cell: Cell) -> str:
    over = "" if cell.builder == "none" else f" over {names.in_full(cell.raw['builder'])}"
    return f"{cell.collider or ''}{over}"


def numbers_of(cell: Cell) -> Sum:
    count = cell.counters.get
    broad, every = (cell.times_ns("broad"), cell.whole_times_ns()) if cell.has_times else ([math.nan], [math.nan])
    return Sum(cell.swept.get("primitives", 0), count("pairs_count", math.nan), spread.median(broad), spread.median(every),
               count("ground_truth_pairs", math.nan), count("ground_truth_missed", math.nan))


def add_row(table: Table, head: list[str], numbers: Sum, verdict: str) -> None:
    table.row([*head, whole(numbers.primitives), whole(numbers.pairs),
               fixed(numbers.broad_ns * 1e-6, 3), fixed(numbers.whole_ns * 1e-6, 3),
               fixed(spread.ratio(numbers.pairs, numbers.whole_ns) * 1e3, 1), whole(numbers.truth), whole(numbers.missed),
               fixed(spread.ratio(numbers.pairs, numbers.truth), 1), verdict])


def whole(value: float) -> str:
    return "" if math.isnan(value) else f"{int(value):,}"


def fixed(value: float, digits: int) -> str:
    return "" if math.isnan(value) else f"{value:.{digits}f}"
