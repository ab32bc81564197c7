"""Data of each cell for the report page, including wrong, skipped and failed cells, and the raw samples. Cells of a scene that
answer the same question are comparable: the data say which are on a Pareto front, and have a bar for each builder or pipeline.

Times are nanoseconds: 10th percentile, median, 90th percentile. A cell with a wrong answer, or without one, has no times."""
import re
from collections.abc import Iterable
from typing import Any

from ..figures import accuracy, accuracy_narrow
from ..read import pareto
from ..read.cells import Cell, by_stage, grouped, quantiles, whole_ns
from ..words import names, tables

WITHOUT_TIMES = ("differs", "skipped", "failed")
WHOLE = "whole"
BETWEEN = names.BETWEEN
MEDIAN = 1  # index of the median among quantiles
QUESTION = ("experiment", "axis", "scene", "asked")
# Counters that tell how good a tree is, and their names on the page.
GOODNESS = {"sah_cost": "surface area cost", "epo": "end-point overlap", "sibling_overlap": "overlap of siblings",
            "box_tests_count": "box tests of a query", "tree_bytes": "bytes of the tree"}
LIBRARIES = {"embree": "Embree", "fcl": "FCL"}  # by the first word of a builder or collider
STAR = "* a stand-in: the scene itself is not there"
FINDS_CONTACTS = ("fcl", "fcl-refit")  # colliders that find exact contacts in their broad phase
Data = dict[str, Any]  # of a cell, as returned by cell_data


def state_of(cell: Cell) -> str:
    """Returns the verdict of a measured cell, otherwise its status."""
    return cell.check["verdict"] if cell.status == "measured" else cell.status


def who(cell: Cell) -> str:
    """Returns the builder or pipeline with the options that are not the defaults, or the method along an axis of accuracy."""
    if cell.accuracy:
        return cell.accuracy["method"]
    if cell.collider:
        return cell.called
    name = names.variant(cell.builder, dict(cell.options))
    return f"refit of {name}" if cell.operation == "refit" else name


def asked(cell: Cell) -> str:
    """Returns what a query was asked for, and where samples found their data. Cells that were asked for different things
    must not be compared."""
    caches = [names.CACHES[cell.caches]] if cell.caches in names.CACHES else []
    features = [cell.features["pairs"]] if cell.features else []
    if not cell.collider or cell.accuracy:
        return ", ".join(features + caches)
    options = dict(cell.collider_options)
    words = [f"pairs {options['pairs_of']} objects" if options.get("pairs_of", "all") != "all" else "all pairs", *features]
    if options.get("adjacent") == "drop":
        words.append("adjacent dropped")
    narrow = "exact" if cell.collider in FINDS_CONTACTS else options.get("narrow", "none")
    if options.get("first") == "True":
        words.append("first contact")
    elif options.get("within", "none") != "none":
        words.append(f"within {options['within']}")
    elif narrow != "none":
        words.append(f"contacts ({narrow})")
    if options.get("separation", "none") != "none":
        words.append(f"{options['separation']} apart")
    return ", ".join(words + caches)


def scene_name(cell: Cell) -> str:
    """Returns the scene's name; for a stand-in, with a star (STAR explains it) and the scene that it replaces, if that has
    another name."""
    if not (other := cell.stand_in_for):
        return cell.scene
    return f"{cell.scene} *" + (f" (for {other})" if other != cell.scene_facts["name"] else "")


def library_of(cell: Cell) -> str | None:
    """Returns the library that built the tree or queried it, if it was not ours."""
    first = (name.split("-")[0] for name in (cell.builder, cell.collider) if name)
    return next((LIBRARIES[word] for word in first if word in LIBRARIES), None)


def table(title: str, columns: Iterable[tuple[Any, ...]], facets: tuple[str, ...], rows: list[list[Any]], note: str = "",
          libraries: Iterable[str | None] = ()) -> dict[str, Any]:
    """Returns a table with these columns (label, kind, and perhaps more of it) and rows. Rows can be chosen by facets. `libraries` are
    those that rows are of."""
    return {"title": title, "cells": None, "rows": rows, "note": note,
            "libraries": [row for row, library in enumerate(libraries) if library],
            "columns": [{"label": label, "kind": kind, "facet": label in facets} | (more[0] if more else {}) for label, kind, *more in columns]}


def times_of(cell: Cell) -> dict[str, list[float]]:
    """Returns the quantiles of each stage and of the whole sample, from first start to last end."""
    if not cell.samples:
        return {}
    stages = {WHOLE: ""} | {stage: stage for sample in cell.samples for stage in sample}
    return {name: [round(1e9 * value, 1) for value in quantiles(cell.times_s(stage))] for name, stage in stages.items()}


def copy_share(cell: Cell, times: dict[str, list[float]], copy_rate: float) -> float | str | None:
    """Returns the rate of the bytes that all stages must move as a share of the copy rate (tables.of_copy_rate); None if a
    stage ran on the host."""
    moved = [cell.moved_bytes(stage) for stage in times if stage != WHOLE]
    if not copy_rate or not moved or None in moved or times[WHOLE][MEDIAN] <= 0:
        return None
    return tables.of_copy_rate(round(sum(moved) / (1e-9 * times[WHOLE][MEDIAN]) / copy_rate, 5))


def errors_of(cell: Cell) -> dict[str, float]:
    """Returns the errors of a method, by name."""
    counters, errors = cell.counters, {}
    if {"missed_count", "false_count", "pairs_count"} <= counters.keys():
        if "right_pairs_count" in counters:
            errors["false pairs for each right one"] = accuracy.inflation(cell)
        elif "right_contacts_count" in counters:
            errors["wrong contacts"] = counters["missed_count"] + counters["false_count"]
        elif counters["pairs_count"]:
            errors["share of wrong answers"] = accuracy_narrow.wrong(cell)
    if "relative_error" in counters:
        errors["relative error"] = counters["relative_error"]
    return errors


def cell_data(cell: Cell, copy_rate: float) -> Data:
    """Returns a cell's data; `copy_rate` is that of the run that measured it, in bytes per second, or 0."""
    state = state_of(cell)
    kind = re.sub(rf":{re.escape(str(cell.triangles))}(?=:|$)", "", cell.scene)  # "torus" of "torus:1000"
    data = {
        "experiment": cell.experiment, "operation": cell.operation, "who": who(cell), "builder": cell.builder,
        "collider": cell.collider, "scene": scene_name(cell), "family": kind if kind != cell.scene else "", "is_stand_in": bool(cell.stand_in_for),
        "library": library_of(cell), "triangles": cell.scene_facts.get("triangles"),
        "frame": cell.frame, "asked": asked(cell), "state": state, "why": cell.reason or cell.check.get("detail", ""),
        "n": len(cell.all_samples), "ranks": cell.cluster, "counters": cell.counters, "axis": cell.accuracy.get("axis"), "times": {}}
    if state not in WITHOUT_TIMES:
        times, errors = times_of(cell), errors_of(cell)
        goodness = {text: cell.counters[key] for key, text in GOODNESS.items() if cell.operation != "collide" and key in cell.counters}
        data |= {"times": times, "on_host": cell.on_host, "copy_share": copy_share(cell, times, copy_rate) if times else None,
                 "errors": errors, "measures": errors | goodness}  # what time can be plotted against
    return data


def column(values: list[Any]) -> Any:
    """Returns the common value if all values are equal, otherwise the list."""
    return values[0] if values and all(value == values[0] for value in values) else values


def columns(rows: list[dict[str, Any]], left_out: str) -> dict[str, Any]:
    """Returns the rows' values by key, in the order of the rows. A value that a row lacks is None."""
    keys = dict.fromkeys(key for row in rows for key in row if key != left_out)
    return {key: column([row.get(key) for row in rows]) for key in keys}


def samples_data(cell: Cell) -> Data:
    """Returns the cell's samples by columns: a list in the order of the samples, or one value that all samples share."""
    samples = [by_stage(sample) for sample in cell.all_samples]
    return {"count": len(samples), "own": columns(cell.all_samples, "stages"),
            "whole": column([whole_ns(sample) for sample in samples]),
            "stages": {stage: columns([sample.get(stage, {}) for sample in samples], "stage")
                       for stage in dict.fromkeys(stage for sample in samples for stage in sample)},
            "facts": {key: value for key, value in cell.raw.items() if key != "samples"}}


def grouped_by(cells: list[Data], *keys: str) -> list[list[Data]]:
    return list(grouped(cells, lambda cell: tuple(cell[key] for key in keys)).values())


def mark_fronts(cells: list[Data]) -> None:
    """Adds to each timed cell the measures for which it is on the Pareto front."""
    for group in grouped_by([cell for cell in cells if cell["times"]], *QUESTION):
        for cell in group:
            cell["front"] = []
        for measure in dict.fromkeys(measure for cell in group for measure in cell["measures"]):
            points = [(cell["times"][WHOLE][MEDIAN], cell["measures"][measure], cell)
                      for cell in group if measure in cell["measures"]]
            for _, _, cell in pareto.front(points):
                cell["front"].append(measure)


def bars_of(cells: list[Data]) -> list[Data]:
    """Returns for each builder or pipeline the median time of each stage, averaged over later frames, or why there are no times."""
    places = {id(cell): place for place, cell in enumerate(cells)}
    return [{key: group[0][key] for key in (*QUESTION, "who")} | {"cell": places[id(group[0])] if len(group) == 1 else None}
            | bar_of(group) for group in grouped_by([cell for cell in cells if not cell["ranks"]], *QUESTION, "who")]


def bar_of(group: list[Data]) -> Data:
    bad = next((cell for cell in group if not cell["times"]), None)
    if bad:
        where = f" on frame {bad['frame']}" if len(group) > 1 else ""
        return {"said": f"{bad['state'].replace('_', ' ')}{where}{': ' if bad['why'] else ''}{bad['why']}"}
    group = later(group)
    stages = {stage: mean_median(group, stage) for stage in dict.fromkeys(stage for cell in group for stage in cell["times"])}
    whole = stages.pop(WHOLE)
    between = round(whole - sum(stages.values()), 1)
    if group[0]["operation"] == "collide" and between > 0:
        stages[BETWEEN] = between
    return {"whole": whole, "stages": stages}


def later(group: list[Data]) -> list[Data]:
    """Returns the cells of a pipeline without its first frame of several, as cells.later does."""
    first = min(cell["frame"] for cell in group)
    return [cell for cell in group if cell["operation"] == "collide" and cell["frame"] > first] or group


def mean_median(group: list[Data], stage: str) -> float:
    """Returns the mean of the stage's medians. A cell without the stage counts as 0."""
    return round(sum(cell["times"].get(stage, (0, 0, 0))[MEDIAN] for cell in group) / len(group), 1)
