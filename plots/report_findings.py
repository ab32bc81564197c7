"""What a result file answers: of each experiment its question, a sentence, and the best builder or pipeline of each scene."""
import pathlib
from collections import Counter
from typing import Any

import json_files
import report_cells
from cells import Cell, grouped
from report_cells import state_of
from report_ranking import COST, ERROR, TIME, Objective, Ranking, is_right, ranked, sentence
from tables import counted

EXPERIMENTS = pathlib.Path(__file__).resolve().parent.parent / "harness" / "experiments"
# Experiments and axes of accuracy that do not ask who is soonest; None: they ask only whether answers are right.
OBJECTIVES = {"agreement": None, "equality": None, "smoke": None, "table4": COST, "fig13": COST, "sums": ERROR}
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


def verdicts(cells: list[Cell]) -> str:
    """Says how many answers were right, and what was wrong or missing; of libraries apart. Of a narrow phase: which methods are
    right on how many scenes."""
    if cells[0].accuracy.get("axis") == "narrow":
        return rightness(cells)
    found = Counter((report_cells.library_of(cell), state_of(cell)) for cell in cells)
    agreeing = sum(count for (_, state), count in found.items() if state == "agrees")
    told = []
    if agreeing and not cells[0].accuracy:  # of methods, that they err is no fault
        every = "all " if agreeing == len(cells) > 1 else ""
        told.append(f"{every}{counted(agreeing, 'answer')} {'is' if agreeing == 1 else 'are'} right")
    said = {"differs": "gave a wrong answer", "failed": "failed", "skipped": "skipped"}
    told += [f"{counted(count, 'cell')}{f' of {library}' if library else ''} {said[state]}"
             for (library, state), count in found.items() if state in said]
    text = "; ".join(told)
    return text[:1].upper() + text[1:] + "." if told else ""


def rightness(cells: list[Cell]) -> str:
    counts = {who: (sum(map(is_right, own)), len(own)) for who, own in grouped(cells, report_cells.who).items()}
    told = [f"{who} on {'all ' if right == most > 1 else f'{right} of '}{counted(most, 'scene')}"
            for who, (right, most) in sorted(counts.items(), key=lambda one: -one[1][0])]
    return f"Right: {', '.join(told)}."


def findings_of(cells: list[Cell]) -> list[dict[str, Any]]:
    """Returns of each experiment, and of each axis of accuracy, its question, its answer and the rows of best_table."""
    found = []
    named = grouped(enumerate(cells), lambda one: (one[1].experiment, one[1].accuracy.get("axis")))
    for (experiment, axis), placed in named.items():
        objective = OBJECTIVES.get(axis or experiment, TIME)
        rankings = ranked(placed, objective) if objective else []
        said = [sentence(rankings, objective) if objective else "", verdicts([cell for _, cell in placed])]
        if axis == "narrow" and said[0]:
            said = [said[1], "Of those that are right:", said[0]]
        found.append({"experiment": experiment + (f", {axis}" if axis else ""), "question": question(experiment, axis),
                      "answer": " ".join(filter(None, said)),
                      "rows": [row(ranking, objective) for ranking in rankings]})
    return found


def row(ranking: Ranking, objective: Objective) -> list[Any]:
    first, *others = ranking.entries
    spreads = ("overlap" if ranking.overlaps else "apart") if others and objective is TIME else None
    return [ranking.scene, ranking.asked, first.who, first.value / 1e3 if objective is TIME else None,
            None if objective is TIME else first.value, others[0].who if others else None, ranking.ratio, spreads, first.place]


COLUMNS = (("file", "text"), ("experiment", "text"), ("scene", "text"), ("asked for", "text"), ("best", "text"),
           ("time", "time"), ("cost or error", "number"), ("next", "text"), ("ratio", "number"), ("p10 to p90", "text"))
FACETS = ("file", "experiment", "best", "next")


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
    note = ("Time: the lowest, a mean over frames of medians. Ratio: the next over it. Last: whether their 10th to 90th "
            "percentiles overlap. What was wrong, or lacks a frame, has no place.")
    return {"title": "The best of each scene", "cells": None, "note": note + (f" {report_cells.STAR}." if starred else ""),
            "rows": [[row[k] for k in kept] for row in rows],
            "columns": [{"label": label, "kind": kind, "facet": label in FACETS, **more.get(label, {})}
                        for k, (label, kind) in enumerate(COLUMNS) if k in kept]}
