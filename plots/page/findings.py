"""What a result file answers: of each experiment its question, a sentence, and the best builder or pipeline of each scene."""
import math
import pathlib
from collections import Counter
from typing import Any, NamedTuple

from ..files import json_files
from ..read import savings
from ..read.cells import Cell, grouped, median
from ..read.ranking import Row, method, ranked
from ..read.ranking_text import number
from ..words.tables import counted, duration
from . import cell_data
from .cell_data import WITHOUT_TIMES, library_of, state_of, who

EXPERIMENTS = pathlib.Path(__file__).resolve().parents[2] / "harness" / "experiments"
# Experiments and axes of accuracy that do not ask who is soonest; None: they rank nothing.
OBJECTIVES = {"agreement": None, "equality": None, "smoke": None, "skips": None, "effects": None, "table4": "cost", "fig13": "cost",
              "sums": "error"}
# Words of an objective: "A {is soonest} on S: 1.00 ms; the next {takes} 1.20 times {as long}".
WORDS = {"frame": ("is soonest", "takes", "as long"), "cost": ("has the lowest surface area cost", "costs", "as much"),
         "error": ("errs least", "errs by", "as much")}
# Questions of the axes of accuracy.
AXES = {"narrow": "Which test of two triangles is right, and what does it cost?",
        "sums": "How far off is each way to add areas up, and what does it cost?",
        "codes": "What does each order of the leaves cost, and what does a query of its tree?",
        "input": "How many pairs are false far from the origin, and does a shift of the vertices help?",
        "place": "What does exact arithmetic cost, by the distance from the origin and the triangles' size?",
        "boxes": "What do smaller boxes save a query, and how many false pairs do they add?",
        "swept": "Which boxes of a triangle's way miss nothing, and what do they cost?",
        "frames": "What does a frame cost, and how many contacts are wrong, by what is rounded?"}
BY_WALL = " Times are by the wall clock where a method from outside is compared."
NO_FALSE = ("narrow", "frames")  # axes whose methods must not find too much either


def question(experiment: str, axis: str | None) -> str:
    """Returns the question of one of the program's experiments or of an axis of accuracy; empty for others."""
    if axis:
        return AXES.get(axis, "")
    path = next((path for path in EXPERIMENTS.glob("*.json") if path.stem == experiment), None)
    return json_files.parsed(path).get("question", "") if path else ""


def verdicts(cells: list[Cell]) -> str:
    """Says how many answers were right, and what was wrong or missing; of libraries apart. Of a narrow phase: which methods are
    right on how many scenes."""
    if cells[0].accuracy.get("axis") == "narrow":
        return rightness(cells)
    found = Counter((library_of(cell), state_of(cell)) for cell in cells)
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
    counts = {name: (sum(map(is_right, own)), len(own)) for name, own in grouped(cells, who).items()}
    told = [f"{name} on {'all ' if right == most > 1 else f'{right} of '}{counted(most, 'scene')}"
            for name, (right, most) in sorted(counts.items(), key=lambda one: -one[1][0])]
    return f"Right: {', '.join(told)}."


class Case(NamedTuple):
    """Builders or pipelines that were asked for the same, the best first. Each has right answers in every frame."""

    scene: str
    asked: str
    rows: list[Row]
    by_wall: bool


def is_right(cell: Cell) -> bool:
    """True if a cell has times and missed nothing; on the axes of NO_FALSE, also if it found nothing false."""
    wrong = ("missed_count", "false_count") if cell.accuracy.get("axis") in NO_FALSE else ("missed_count",)
    return bool(cell.samples) and state_of(cell) not in WITHOUT_TIMES and not any(cell.counters.get(key) for key in wrong)


def cases_of(cells: list[Cell], objective: str) -> list[Case]:
    """Ranks the cells of one experiment or axis: once for each scene and request."""
    groups = grouped(cells, lambda cell: (cell_data.scene_name(cell), cell_data.asked(cell)))
    cases = []
    for key, own in groups.items():
        frames = {cell.frame for cell in own}
        right = grouped(filter(is_right, own), method).values()
        found = ranked([cell for there in right if {cell.frame for cell in there} == frames for cell in there], objective)
        if found.rows:
            cases.append(Case(*key, found.rows, found.by_wall and objective == "frame"))
    return cases


def amount(row: Row, objective: str) -> str:
    return duration(row.ns).replace("us", "µs") if objective == "frame" else f"{row.amount(objective):.4g}"


def is_librarys(row: Row) -> bool:
    return library_of(row.first) is not None


def span(texts: list[str]) -> str:
    """Returns the first and the last text, or one if they are equal: "1.05 to 2.1"."""
    return " to ".join(dict.fromkeys((texts[0], texts[-1])))


def sentence(cases: list[Case], objective: str | None) -> str:
    """Says which is best, on how many scenes, and how far the next and the best library are behind; empty without a time."""
    compared = [case for case in cases if len(case.rows) > 1]
    if not compared:
        rows = sorted((row for case in cases for row in case.rows), key=lambda row: (row.amount(objective), row.ns))
        names = {who(row.first) for row in rows}
        return f"Only {names.pop()} was measured: {span([amount(row, objective) for row in rows])}." if len(names) == 1 else ""
    is_best, has, times = WORDS[objective]
    (winner, count), *others = Counter(who(case.rows[0].first) for case in compared).most_common()
    what = "scenes" if len({case.scene for case in compared}) == len(compared) else "cases"
    where, rival = f"{count} of {len(compared)} {what}" if others else f"{'both' if count == 2 else f'all {count}'} {what}", ""
    if len(compared) == 1:
        where, rival = f"{compared[0].scene}: {amount(compared[0].rows[0], objective)}", f", {who(compared[0].rows[1].first)},"
    said = [f"{winner} {is_best} on {where}", *(f"{name} on {wins}" for name, wins in others[:3])]
    said += [f"others on {sum(wins for _, wins in others[3:])}"] if others[3:] else []

    def behind(name: str, rows: list[Row]) -> str:
        ratios = [number(ratio) for ratio in sorted(row.ratio for row in rows) if math.isfinite(ratio)]
        return f"; {name} {has} {span(ratios)} times {times}" if ratios else ""

    tied = sum(case.rows[1].tied for case in compared) if objective == "frame" else 0
    noise = f",{f' on {tied}' if len(compared) > 1 else ''} within noise" if tied else ""
    libraries = [next(filter(is_librarys, case.rows)) for case in compared if not is_librarys(case.rows[0])
                 and any(map(is_librarys, case.rows))]
    after = behind(f"the next{rival}", [case.rows[1] for case in compared]) + noise + behind("the best library", libraries)
    return f"{', '.join(said)}{after}.{BY_WALL if any(case.by_wall for case in compared) else ''}"


def findings_of(cells: list[Cell]) -> list[dict[str, Any]]:
    """Returns of each experiment, and of each axis of accuracy, its question, its answer and the rows of best_table."""
    found = []
    named = grouped(enumerate(cells), lambda one: (one[1].experiment, one[1].accuracy.get("axis")))
    for (experiment, axis), placed in named.items():
        objective, own = OBJECTIVES.get(axis or experiment, "frame"), [cell for _, cell in placed]
        cases = cases_of(own, objective) if objective else []
        said = [sentence(cases, objective) or savings.sentence(own), verdicts(own)]
        if axis == "narrow" and said[0]:
            said = [said[1], "Of those that are right:", said[0]]
        found.append({"experiment": experiment + (f", {axis}" if axis else ""), "question": question(experiment, axis),
                      "answer": " ".join(filter(None, said)),
                      "rows": [best_row(case, objective, {id(cell): place for place, cell in placed}) for case in cases]})
    return found


def best_row(case: Case, objective: str, places: dict[int, int]) -> list[Any]:
    """Returns a row of best_table. `places` are those of the cells in the file, by their id."""
    best, *others = case.rows
    after = [None] * 3
    if others:
        is_apart = ("no" if others[0].tied else "yes") if objective == "frame" else None
        after = [who(others[0].first), others[0].ratio if math.isfinite(others[0].ratio) else None, is_apart]
    time, held = (best.ns / 1e3, None) if objective == "frame" else (None, best.amount(objective))
    place = places[id(best.first)] if len(best.cells) == 1 else None
    return [case.scene, case.asked, who(best.first), time, held, *after, place]


COLUMNS = (("file", "text"), ("experiment", "text"), ("scene", "text"), ("asked for", "text"), ("best", "text"),
           ("time", "time"), ("cost or error", "number"), ("next", "text"), ("ratio", "number"), ("beyond noise", "text"))
FACETS, TIME = ("file", "experiment", "best", "next"), 5  # TIME: the place in COLUMNS


def best_table(files: list[tuple[str, list[dict[str, Any]]]]) -> dict[str, Any] | None:
    """Returns a table of the best of each scene in all files, each a title and its findings; None without a row."""
    rows, links, names = [], [], []
    for number, (title, findings) in enumerate(files):
        for finding in findings:
            for *values, place in finding["rows"]:
                rows.append([title, finding["experiment"], *values])
                names.append(f"#file-{number}")
                links.append(None if place is None else f"#cell={number}.{place}.{cell_data.WHOLE}")
    if not rows:
        return None
    is_needed = {1: any(row[1] not in row[0] for row in rows)}  # most files are named after their experiment
    kept = [k for k, _ in enumerate(COLUMNS) if is_needed.get(k, True) and any(row[k] not in (None, "") for row in rows)]
    is_ms = median([row[TIME] for row in rows if row[TIME]] or [0]) >= 1000
    rows = [[value and value / 1000 if is_ms and k == TIME else value for k, value in enumerate(row)] for row in rows]
    more = {"file": ({"links": names},), "time": ({"links": links, "unit": "ms" if is_ms else "µs"},)}
    starred = any(row[2] and " *" in row[2] for row in rows)
    note = ("Time: the lowest, of several frames the mean of medians after the first; by the wall clock beside a method from outside. Beyond "
            "noise: intervals of the medians do not overlap. What was wrong, lacks a frame, or starts from one that is not there, has no place.")
    columns = [(*COLUMNS[k], *more.get(COLUMNS[k][0], ())) for k in kept]
    return cell_data.table("The best of each scene", columns, FACETS, [[row[k] for k in kept] for row in rows],
                           note + (f" {cell_data.STAR}." if starred else ""))
