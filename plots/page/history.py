"""The history of an experiment on a machine: each cell over the commits of result files, and what changed at which commit.

A cell is compared as `compare` does, with the commit at which it last changed, so that a slow drift is found too."""
import datetime
import itertools
import pathlib
from collections import Counter
from typing import Any

from ..comparing import comparison, facts, refusals, sides, times
from ..files.json_files import Json, Refused
from ..files.output import WrongUsage, say
from ..read import results
from ..read.cells import Cell, grouped
from ..words.tables import counted, duration
from . import cell_data, findings, plot_looks, report

NOTE = ("A change is what `bvhbench compare` calls one, against the commit at which the cell last changed: of times, a factor beyond "
        f"{times.MOST_DRIFT}, since processes of two commits did not run beside each other.")
COLUMNS = [("commit", "text"), ("date", "text"), ("cell", "text"), ("change", "state"), ("what", "text")]
FROM_WORST = ("worse", "slower", "faster", "changed", "new", "gone")  # kinds of changes of a cell
OF_RUN = ("circumstance", "warning")  # kinds of what is said of a run
RUN = ("", 0)  # the key of it
Cells = dict[tuple[str, int], Cell]  # by their identity, and how many cells before them in their file have the same
Changes = dict[tuple[str, int], list[tuple[str, str]]]  # of each cell at a commit: kind and sentence


def commit_of(document: Json) -> str:
    return document["run"]["program"]["commit"]


def dated(path: pathlib.Path) -> tuple[datetime.datetime, pathlib.Path, Json]:
    """Reads a result file and returns it with its date. Raises Refused or WrongUsage for one that has no place in a history."""
    document = results.document_of(path)
    started, program = document["run"]["started_at"], document["run"]["program"]
    if results.is_dirty(program):
        raise WrongUsage(f"{path} was made by a program {results.changes_text(program)}: it has no place among commits")
    if len({source.get("commit") for source in document.get("merged_from", [])}) > 1:
        raise WrongUsage(f"{path} is merged from several commits, and a history has each at its own place")
    if not document["cells"] or any("cluster" in cell for cell in document["cells"]):
        raise WrongUsage(f"{path} is of {'several ranks' if document['cells'] else 'no cells'}, and a history is of cells of one device")
    try:
        return datetime.datetime.fromisoformat(started).astimezone(datetime.UTC), path, document
    except (TypeError, ValueError) as error:
        raise Refused(f"{path} has no date: it says that it started at {started!r}") from error


def histories_of(files: list[pathlib.Path]) -> dict[tuple[Any, ...], list[Json]]:
    """Returns the cells of each experiment, axis and machine: a document for each commit, by date. Raises WrongUsage if two files have one."""
    found: dict[tuple[Any, ...], dict[str, refusals.Named]] = {}
    for _, path, document in sorted(map(dated, files), key=lambda one: one[0]):
        for key, cells in grouped(document["cells"], lambda raw: (raw["experiment"], raw.get("accuracy", {}).get("axis"))).items():
            there = found.setdefault((*key, refusals.machine(document["run"])), {})
            if other := there.get(commit_of(document)):
                raise WrongUsage(f"{other[0]} and {path} both have {key[0]} of commit {commit_of(document)[:10]}: leave one of them out, "
                                 "or make one file of processes by `bvhbench merge --processes`")
            there[commit_of(document)] = path, document | {"cells": cells}
            refusals.require_comparable(next(iter(there.values())), there[commit_of(document)], refusals.Rules())
    return {key: [document for _, document in there.values()] for key, there in found.items()}


def cells_of(document: Json) -> Cells:
    same = grouped(map(Cell, document["cells"]), lambda cell: cell.identity)
    return {(identity, place): cell for identity, own in same.items() for place, cell in enumerate(own)}


def changes_of(documents: list[Json], cells: list[Cells]) -> list[Changes]:
    """Returns what changed at each commit."""
    found: list[Changes] = [{RUN: warnings_of(documents[0])}]
    last = {key: (documents[0], cell) for key, cell in cells[0].items()}
    for (before, document), here in zip(itertools.pairwise(documents), cells[1:], strict=True):
        now = {key: changes(last[key], (document, cell)) if key in last else [("new", "not measured at the commit before")]
               for key, cell in here.items()}
        gone = {key: [("gone", "not measured any more")] for key in last if key not in here}
        last = {key: (document, cell) if now[key] or warnings_of(last[key][0]) else last[key] for key, cell in here.items()}
        remarks = [("circumstance", remark) for remark in facts.run_remarks(before["run"], document["run"])]
        found.append({RUN: remarks + warnings_of(document), **now, **gone})
    return found


def warnings_of(document: Json) -> list[tuple[str, str]]:
    """Returns what the runs warn of. No change of a time is told at such a commit, nor against one."""
    return [("warning", text) for own in sides.conditions_of(document) for text in own]


def changes(*one: tuple[Json, Cell]) -> list[tuple[str, str]]:
    """Returns what changed between a cell of an earlier document and that of a later one."""
    said = []
    for each in comparison.compare(*(document | {"cells": [cell.raw]} for document, cell in one), refusals.Rules()).cells:
        said += [("worse", text) for text in each.regressions] + [("changed", text) for text in each.changes]
        if each.verdict in (times.FASTER, times.SLOWER):
            said.append((each.verdict.lower(), f"{duration(each.time.second)}, was {duration(each.time.first)}".replace("us", "µs")))
    return said


def lines_of(cells: list[Cells], told: list[Changes]) -> list[cell_data.Data]:
    """Returns the data of each cell at each commit from its first to the one after its last; without times where it was not measured."""
    found = []
    for line, (key, newest) in enumerate({key: cell for own in cells for key, cell in own.items()}.items()):
        places = [place for place, own in enumerate(cells) if key in own]
        scene = cell_data.scene_name(newest) + (f", frame {newest.frame}" if newest.frame else "")
        for place in range(places[0], min(places[-1] + 2, len(cells))):
            absent = {} if key in cells[place] else {"state": "absent", "times": {}}
            found.append(cell_data.cell_data(cells[place].get(key, newest), 0) | absent | {
                "line": line, "who": cell_data.who(newest), "scene": scene, "frame": place, "told": [text for _, text in told[place].get(key, [])]})
    return found


def rows_of(runs: list[Json], cells: list[Cells], told: list[Changes]) -> list[list[Any]]:
    """Returns a row for each cell and kind of change, the newest commit and the worst kind first."""
    labels = {key: cell.label for own in cells for key, cell in own.items()} | {RUN: "all"}
    return [[run["commit"], run["date"], labels[key], kind, "; ".join(texts)]
            for run, now in reversed([*zip(runs, told, strict=True)]) for kind in FROM_WORST + OF_RUN
            for key, changes in now.items() if (texts := [text for other, text in changes if other == kind])]


def part_of(experiment: str, axis: str | None, documents: list[Json], where: str) -> report.Part:
    """Returns the section of one history."""
    cells = [cells_of(document) for document in documents]
    told = changes_of(documents, cells)
    runs = [{"commit": commit_of(document)[:10], "date": document["run"]["started_at"]} for document in documents]
    lines, rows = lines_of(cells, told), rows_of(runs, cells, told)
    counts = Counter(kind for *_, kind, _ in rows)
    said = f"{counted(len(runs), 'commit')} from {runs[0]['date'][:10]} to {runs[-1]['date'][:10]}: "
    said += ", ".join(f"{counts[kind]} {kind}" for kind in FROM_WORST if counts[kind]) or "nothing changed"
    said += "; the latest at {}, {}: {}, {}.".format(rows[0][0], *rows[0][2:]) if rows else "."
    warned = counts["warning"] and f"No change of a time is told at {counted(counts['warning'], 'commit')} whose runs warn, nor against them."
    data = {"cells": lines, "bars": [], "looks": plot_looks.looks_of(lines), "star": cell_data.STAR, "runs": runs,
            "states": report.tallied(Counter((cell_data.library_of(cell), cell_data.state_of(cell)) for cell in cells[-1].values())),
            "tables": [cell_data.table("What changed", COLUMNS, ("commit", "change"), rows)] if rows else []}
    name = experiment + (f", {axis}" if axis else "")
    answer = {"experiment": name, "question": findings.question(experiment, axis), "answer": said, "rows": []}
    return report.Part(name + where, documents[-1], data, [answer], [warned] if warned else [])


def make(files: list[pathlib.Path]) -> tuple[str, bool]:
    """Returns the page and whether an answer at the newest commit was wrong. Raises Refused, or WrongUsage for files without a place."""
    histories = histories_of(files)
    is_one = len({machine for *_, machine in histories}) == 1
    if not is_one:
        say("bvhbench: the files are of several machines, and each has a history of its own")
    parts = [part_of(experiment, axis, documents, "" if is_one else f" on {refusals.device_text(documents[0]['run'])}")
             for (experiment, axis, _), documents in histories.items()]
    return report.page_of("history", NOTE, parts, [], []), any(part.is_wrong for part in parts)
