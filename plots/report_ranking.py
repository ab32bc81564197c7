"""Ranks builders or pipelines for a report: the lowest mean over frames of median times, or another objective where an
experiment asks about something else. `ranked` and `sentence` are all that the report asks for."""
from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

import report_cells
from cells import Cell, grouped
from report_cells import WITHOUT_TIMES, state_of
from tables import duration


class Objective(NamedTuple):
    """What is to be low, and words for it: "A {is_best} on S", "the next {has} 1.2 times {times}"."""

    values: Callable[[Cell], tuple[float, float, float]]  # low, middle and high of a cell
    text: Callable[[float], str]
    is_best: str
    has: str
    times: str


def of_counter(name: str) -> Callable[[Cell], tuple[float, float, float]]:
    return lambda cell: (cell.counters[name],) * 3


TIME = Objective(lambda cell: tuple(report_cells.times_of(cell)[report_cells.WHOLE]),
                 lambda ns: duration(ns).replace("us", "µs"), "is soonest", "takes", "as long")
COST = Objective(of_counter("sah_cost"), "{:.4g}".format, "has the lowest surface area cost", "costs", "as much")
ERROR = Objective(of_counter("relative_error"), "{:.2g}".format, "errs least", "errs by", "as much")


class Entry(NamedTuple):
    who: str
    low: float  # means over frames of the 10th percentile, the median and the 90th percentile, or equal values
    value: float
    high: float
    place: int | None  # of the cell in the file, if there is a single one
    library: str | None


class Ranking(NamedTuple):
    """Builders or pipelines that were asked for the same, the best first."""

    scene: str
    asked: str
    entries: list[Entry]

    @property
    def ratio(self) -> float | None:
        """Returns the second value over the first; None without a second, or with a first of 0."""
        return self.entries[1].value / self.entries[0].value if len(self.entries) > 1 and self.entries[0].value > 0 else None

    @property
    def overlaps(self) -> bool:
        """True if the second's 10th percentile is not above the first's 90th."""
        return len(self.entries) > 1 and self.entries[1].low <= self.entries[0].high


def is_right(cell: Cell) -> bool:
    """True if a cell has times and missed nothing; a narrow phase must not find too much either."""
    wrong = ("missed_count", "false_count") if cell.accuracy.get("axis") == "narrow" else ("missed_count",)
    return bool(cell.samples) and state_of(cell) not in WITHOUT_TIMES and not any(cell.counters.get(key) for key in wrong)


def entry(who: str, placed: list[tuple[int, Cell]], objective: Objective) -> Entry | None:
    """Returns the means over the cells; None if one is wrong, has no times or no such counter."""
    try:
        found = [objective.values(cell) for _, cell in placed if is_right(cell)]
    except KeyError:
        return None
    if len(found) < len(placed):
        return None
    return Entry(who, *(sum(values) / len(found) for values in zip(*found)), placed[0][0] if len(placed) == 1 else None,
                 report_cells.library_of(placed[0][1]))


def ranked(placed: list[tuple[int, Cell]], objective: Objective) -> list[Ranking]:
    """Ranks the cells, each with its place in the file, of one experiment or axis: once for each scene and request."""
    def question(one: tuple[int, Cell]) -> tuple[str, str]:
        return report_cells.scene_name(one[1]), report_cells.asked(one[1])

    rankings = []
    for (scene, asked), group in grouped(placed, question).items():
        frames = {cell.frame for _, cell in group}
        entries = [entry(who, own, objective) for who, own in grouped(group, lambda one: report_cells.who(one[1])).items()
                   if {cell.frame for _, cell in own} == frames]
        if known := sorted((one for one in entries if one), key=lambda one: one.value):
            rankings.append(Ranking(scene, asked, known))
    return rankings


def sentence(rankings: list[Ranking], objective: Objective) -> str:
    """Says which is best, on how many scenes, and how far the next is behind; empty if nothing can be compared."""
    compared = [ranking for ranking in rankings if len(ranking.entries) > 1]
    if not compared:
        return alone(rankings, objective)
    ratios = sorted(ranking.ratio for ranking in compared if ranking.ratio is not None)
    if len(compared) == 1:
        (scene, _, (first, second, *_)), = compared
        after = f", {times(ratios[0])} times {objective.times}" if ratios else ""
        after += ", within the spread of samples" if objective is TIME and compared[0].overlaps else ""
        return (f"{first.who} {objective.is_best} on {scene}: {objective.text(first.value)}. The next, {second.who}, "
                f"{objective.has} {objective.text(second.value)}{after}{behind(compared, objective)}.")
    (winner, count), *others = Counter(ranking.entries[0].who for ranking in compared).most_common()
    what = "scenes" if len({ranking.scene for ranking in compared}) == len(compared) else "cases"
    every = "both" if count == 2 else f"all {count}"
    where = f"{every} {what}" if not others else f"{count} of {len(compared)} {what}"
    told = "".join(f", {who} on {number}" for who, number in others[:3])
    rest = sum(number for _, number in others[3:])
    text = f"{winner} {objective.is_best} on {where}{told}{f', others on {rest}' if rest else ''}"
    after = f"; the next {objective.has} {span(ratios)} times {objective.times}" if ratios else ""
    close = sum(ranking.overlaps for ranking in compared) if objective is TIME else 0
    after += f", on {close} within the spread of samples" if close else ""
    return f"{text}{after}{behind(compared, objective)}."


def behind(rankings: list[Ranking], objective: Objective) -> str:
    """Says how far the best library is behind the best of ours, where ours is best."""
    pairs = [(ranking.entries[0], next((one for one in ranking.entries if one.library), None)) for ranking in rankings]
    ratios = [other.value / first.value for first, other in pairs if other and not first.library and first.value > 0]
    return f"; the best library {objective.has} {span(ratios)} times {objective.times}" if ratios else ""


def span(ratios: list[float]) -> str:
    """Returns "1.05 to 2.10", or one number if both ends are equal."""
    return " to ".join(dict.fromkeys(times(ratio) for ratio in (min(ratios), max(ratios))))


def alone(rankings: list[Ranking], objective: Objective) -> str:
    """Says what took how long if only one builder or pipeline was measured."""
    found = sorted((one for ranking in rankings for one in ranking.entries), key=lambda one: one.value)
    if len({one.who for one in found}) != 1:
        return ""
    between = " to ".join(dict.fromkeys(objective.text(one.value) for one in (found[0], found[-1])))
    return f"Only {found[0].who} was measured: {between}."


def times(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 9.995 else f"{ratio:,.3g}"
