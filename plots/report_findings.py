"""What a result file answers: of each experiment its question, a sentence, and the best builder or pipeline of each scene.

`ranked` and `sentence` decide what is best: the lowest mean over frames of median times, or another objective where the experiment
asks about something else. What gave a wrong answer, or lacks a frame, has no place."""
import pathlib
from collections import Counter
from collections.abc import Callable
from typing import Any, NamedTuple

import json_files
import report_cells
from cells import Cell, grouped
from report_cells import WITHOUT_TIMES, state_of
from tables import counted, duration

EXPERIMENTS = pathlib.Path(__file__).resolve().parent.parent / "harness" / "experiments"


class Objective(NamedTuple):
    """What is to be low, and words for it: "A {is_best} on S", "the next {has} 1.2 times {times}"."""

    values: Callable[[Cell], tuple[float, float, float]]  # low, middle and high of a cell
    text: Callable[[float], str]
    is_best: str
    has: str
    times: str


def of_counter(name: str) -> Callable[[Cell], tuple[float, float, float]]:
    return lambda cell: (cell.counters[name],) * 3


TIME = Objective(lambda cell: tuple(report_cells.times_of(cell)[report_cells.WHOLE]), lambda ns: duration(ns).replace("us", "µs"),
                 "is soonest", "takes", "as long")
COST = Objective(of_counter("sah_cost"), "{:.4g}".format, "has the lowest surface area cost", "costs", "as much")
ERROR = Objective(of_counter("relative_error"), "{:.2g}".format, "errs least", "errs by", "as much")
# Experiments and axes of accuracy that do not ask who is soonest; None: they ask only whether answers are right.
OBJECTIVES = {"agreement": None, "equality": None, "smoke": None, "table4": COST, "fig13": COST, "sums": ERROR}


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


# Questions of the axes of accuracy.
AXES = {"narrow": "Which test of two triangles is right, and what does it cost?",
        "sums": "How far off is each way to add areas up, and what does it cost?",
        "codes": "What does each order of the leaves cost, and what does a query of its tree?",
        "input": "How many pairs are false far from the origin, and does a shift of the vertices help?",
        "boxes": "What do smaller boxes save a query, and how many false pairs do they add?",
        "swept": "Which boxes of a triangle's way miss nothing, and what do they cost?"}


def question(experiment: str, axis: str | None) -> str:
    """Returns the question of one of the program's experiments or of an axis of accuracy; empty for others."""
    if axis:
        return AXES.get(axis, "")
    path = EXPERIMENTS / f"{experiment}.json"
    return json_files.parsed(path).get("question", "") if "/" not in experiment and path.exists() else ""


def is_right(cell: Cell) -> bool:
    """True if a cell has times and missed nothing; a narrow phase must not find too much either."""
    wrong = ("missed_count", "false_count") if cell.accuracy.get("axis") == "narrow" else ("missed_count",)
    return bool(cell.samples) and state_of(cell) not in WITHOUT_TIMES and not any(cell.counters.get(key) for key in wrong)


def entry(who: str, placed: list[tuple[int, Cell]], objective: Objective) -> Entry | None:
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
    rankings = []
    for (scene, asked), group in grouped(placed, lambda one: (report_cells.scene_name(one[1]), report_cells.asked(one[1]))).items():
        entries = [entry(who, own, objective) for who, own in grouped(group, lambda one: report_cells.who(one[1])).items()]
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


def verdicts(cells: list[Cell]) -> str:
    """Says how many answers were right, and what was wrong or missing; of libraries apart. Of a narrow phase: which methods are
    right on how many scenes."""
    if cells[0].accuracy.get("axis") == "narrow":
        return rightness(cells)
    found = Counter((report_cells.library_of(cell), state_of(cell)) for cell in cells)
    agreeing = sum(count for (_, state), count in found.items() if state == "agrees")
    told = []
    if agreeing and not cells[0].accuracy:  # of methods, that they err is no fault
        told.append(f"{'all ' if agreeing == len(cells) > 1 else ''}{counted(agreeing, 'answer')} {'is' if agreeing == 1 else 'are'} right")
    said = {"differs": "gave a wrong answer", "failed": "failed", "skipped": "skipped"}
    told += [f"{counted(count, 'cell')}{f' of {library}' if library else ''} {said[state]}"
             for (library, state), count in found.items() if state in said]
    text = "; ".join(told)
    return text[:1].upper() + text[1:] + "." if told else ""


def rightness(cells: list[Cell]) -> str:
    counts = {who: (sum(map(is_right, own)), len(own)) for who, own in grouped(cells, report_cells.who).items()}
    told = [f"{who} on {'all ' if right == most > 1 else f'{right} of '}{counted(most, 'scene')}"
            for who, (right, most) in sorted(counts.items(), key=lambda one: -one[1][0])]
    return f"Right: {', '.join(told)}. Of those that are right:"


def findings_of(cells: list[Cell]) -> list[dict[str, Any]]:
    """Returns of each experiment, and of each axis of accuracy, its question, its answer and the rows of best_table."""
    found = []
    named = grouped(enumerate(cells), lambda one: (one[1].experiment, one[1].accuracy.get("axis")))
    for (experiment, axis), placed in named.items():
        objective = OBJECTIVES.get(axis or experiment, TIME)
        rankings = ranked(placed, objective) if objective else []
        said = (verdicts([cell for _, cell in placed]), sentence(rankings, objective) if objective else "")
        found.append({"experiment": experiment + (f", {axis}" if axis else ""), "question": question(experiment, axis),
                      "answer": " ".join(filter(None, said if axis == "narrow" else reversed(said))),
                      "rows": [row(ranking, objective) for ranking in rankings]})
    return found


def row(ranking: Ranking, objective: Objective) -> list[Any]:
    first, *others = ranking.entries
    spreads = ("overlap" if ranking.overlaps else "apart") if others and objective is TIME else None
    return [ranking.scene, ranking.asked, first.who, first.value / 1e3 if objective is TIME else None,
            None if objective is TIME else first.value, others[0].who if others else None, ranking.ratio, spreads, first.place]


COLUMNS = (("file", "text"), ("experiment", "text"), ("scene", "text"), ("asked for", "text"), ("best", "text"), ("time", "time"),
           ("cost or error", "number"), ("next", "text"), ("ratio", "number"), ("p10 to p90", "text"))


def best_table(files: list[tuple[str, list[dict[str, Any]]]]) -> dict[str, Any] | None:
    """Returns a table of the best of each scene in all files, each a title and its findings; None without a row."""
    rows, links, names = [], [], []
    for number, (title, findings) in enumerate(files):
        for finding in findings:
            for *values, place in finding["rows"]:
                rows.append([title, finding["experiment"], *values])
                names.append(f"#file-{number}")
                links.append(None if place is None else f"#cell={number}.{place}.{report_cells.WHOLE}")
    if not rows:
        return None
    is_needed = {1: any(row[1] not in row[0] for row in rows)}  # most files are named after their experiment
    kept = [k for k, _ in enumerate(COLUMNS) if is_needed.get(k, True) and any(row[k] not in (None, "") for row in rows)]
    more = {"file": {"links": names}, "time": {"links": links, "unit": "µs"}}
    starred = any(row[2] and " *" in row[2] for row in rows)
    note = ("Time: the lowest, a mean over frames of medians. Ratio: the next over it. Last: whether their 10th to 90th percentiles overlap. "
            "What was wrong, or lacks a frame, has no place.")
    return {"title": "The best of each scene", "cells": None, "note": note + (f" {report_cells.STAR}." if starred else ""),
            "rows": [[row[k] for k in kept] for row in rows],
            "columns": [{"label": label, "kind": kind, "facet": label in ("file", "experiment", "best", "next"), **more.get(label, {})}
                        for k, (label, kind) in enumerate(COLUMNS) if k in kept]}
