"""Tables of a page: columns and rows as data, which plots/page/web/table.js shows, sorts and filters.

A column's kind is text, state, count (all digits), number (four digits), share or time. A row has one value for each column;
times are in the column's unit. A missing value is null, never 0."""
import statistics
from collections.abc import Callable
from typing import Any

from ..read.cells import grouped, median
from .cell_data import BETWEEN, MEDIAN, STAR, WHOLE, WITHOUT_TIMES, later, mean_median, table as table_of
from .plot_looks import stage_looks

STAGES = [stage for stage in stage_looks() if stage != BETWEEN]
UNITS = (("ns", 1.0), ("µs", 1e3), ("ms", 1e6), ("s", 1e9))
Cells = list[tuple[int, dict[str, Any]]]  # places in the file and the cells' data
Value = Callable[[dict[str, Any]], Any]


def unit_of(cells: Cells) -> tuple[str, float]:
    """Returns the largest unit in which the median of the cells' times is at least 1."""
    middle = median([data["times"][WHOLE][MEDIAN] for _, data in cells if WHOLE in data["times"]])
    return next((unit for unit in reversed(UNITS) if middle >= unit[1]), UNITS[0])


class Table:
    """A table of cells. Columns without values are left out; those added with `varies` also if all rows are equal."""

    def __init__(self, title: str, cells: Cells, note: str = ""):
        self.title, self.cells, self.note = title, cells, note
        self.columns: list[tuple[dict[str, Any], list[Any]]] = []

    def add(self, label: str, kind: str, value: Value, *, varies: bool = False, facet: bool = False, **more: Any) -> None:
        values = [value(data) for _, data in self.cells]
        there = {found for found in values if found not in (None, "")}
        if there and not (varies and len(there) == 1 and "" not in values):
            self.columns.append(({"label": label, "kind": kind, "facet": facet, **more}, values))

    def times(self, unit: tuple[str, float]) -> None:
        columns = [(f"whole, {name}", WHOLE, place) for name, place in (("median", MEDIAN), ("p10", 0), ("p90", 2))]
        for label, stage, place in [*columns, *((stage, stage, MEDIAN) for stage in STAGES)]:
            self.add(label, "time", lambda data, stage=stage, place=place: data["times"][stage][place] / unit[1]
                     if stage in data["times"] else None, unit=unit[0], stage=stage)

    def counters(self, wanted: list[str]) -> None:
        for name in wanted:
            kind = "count" if name.endswith(("_count", "_bytes", "_max")) else "number"
            self.add(name.removesuffix("_count").replace("_", " "), kind, lambda data, name=name: data["counters"].get(name))

    def data(self) -> dict[str, Any]:
        rows = [list(row) for row in zip(*(values for _, values in self.columns), strict=True)]
        made = table_of(self.title, (), (), rows, noted(self.note, self.cells), [data["library"] for _, data in self.cells])
        return made | {"columns": [column for column, _ in self.columns], "cells": [place for place, _ in self.cells]}


def noted(note: str, cells: Cells) -> str:
    """Returns the note, with the explanation of the star if a scene is a stand-in."""
    return f"{note} {STAR}.".lstrip() if any(data["is_stand_in"] for _, data in cells) else note


def begin(title: str, cells: Cells, called: str, note: str = "") -> Table:
    """Creates a table with the columns that all tables of cells start with: scene, name, verdict and, if they vary, others."""
    table = Table(title, cells, note)
    for label, kind, key, varies in (("scene", "text", "scene", False), ("frame", "count", "frame", True),
                                     (called, "text", "who", False), ("verdict", "state", "state", False),
                                     ("experiment", "text", "experiment", True), ("axis", "text", "axis", True),
                                     ("asked for", "text", "asked", True), ("triangles", "count", "triangles", False)):
        table.add(label, kind, lambda data, key=key: data[key], varies=varies, facet=kind != "count")
    return table


def times_table(title: str, cells: Cells, called: str, counters: list[str], note: str) -> dict[str, Any]:
    table = begin(title, cells, called, note)
    table.add("samples", "count", lambda data: data["n"] or None)
    table.times(unit_of(cells))
    table.add("rate", "number", lambda data: data["triangles"] * 1e3 / data["times"][WHOLE][1]
              if data["operation"] == "build" and data["times"].get(WHOLE, [0, 0])[1] > 0 and data["triangles"] else None,
              unit="Mtris/s")
    table.add("of copy rate", "share", lambda data: data.get("copy_share"))
    for error in dict.fromkeys(name for _, data in cells for name in data.get("errors", {})):
        table.add(error, "number", lambda data, error=error: data.get("errors", {}).get(error))
    table.counters(counters)
    return table.data()


def summary_table(cells: Cells) -> dict[str, Any]:
    """Returns a table with one row for each scene and pipeline: means over the frames after the first of their medians."""
    groups = grouped(cells, lambda placed: tuple(placed[1][key] for key in ("experiment", "scene", "asked", "who")))
    unit, scale = unit_of(cells)
    slowest: list[int] = []
    columns = [("scene", "text"), ("pipeline", "text"), ("verdict", "state"), ("asked for", "text"), ("frames", "count"),
               ("mean of medians", "time", {"unit": unit}), ("slowest frame", "time", {"unit": unit, "cells": slowest, "stage": WHOLE}),
               ("pairs a frame", "number"), ("contacts a frame", "number")]
    rows = []
    for (_, scene, question, name), placed in groups.items():
        group = [data for _, data in placed]
        after = later(group)
        slowest.append(max(placed, key=lambda one: one[1]["times"].get(WHOLE, [0, 0])[1])[0])
        bad = next((data["state"] for state in WITHOUT_TIMES for data in group if data["state"] == state), None)
        medians = [data["times"][WHOLE][MEDIAN] / scale for data in group if WHOLE in data["times"]]
        # If frames are missing, a mean would be over other frames and could not be compared, so there is none.
        is_whole = bad is None and medians

        def mean(counter: str) -> float | None:
            values = [data["counters"][counter] for data in after if counter in data["counters"]]
            return statistics.fmean(values) if values and is_whole else None

        rows.append([scene, name, bad or group[0]["state"], question, len(group),
                     mean_median(after, WHOLE) / scale if is_whole else None, max(medians) if is_whole else None,
                     mean("pairs_count"), mean("contacts_count")])
    return table_of("Whole frames by scene", columns, ("scene", "pipeline", "verdict", "asked for"), rows,
                    noted("Means over the frames after the first of a scene; of a pipeline that lacks one there is none.", cells),
                    [placed[0][1]["library"] for placed in groups.values()])


TREE = ["sah_cost", "epo", "sibling_overlap", "depth_max", "nodes_count", "tree_bytes"]
RANKS = (("ranks", "count", "ranks_count", 1), ("boxes", "count", "boxes_count", 1), ("frame, ms", "number", "frame_ns", 1e-6),
         ("by the model, ms", "number", "model_ns", 1e-6), ("halo", "share", "halo_share", 1), ("largest part", "number", "imbalance", 1),
         ("pairs", "count", "pairs_count", 1))
FOUND = ["pairs_count", "contacts_count", "box_tests_count", "memory_bytes"]


def tables_of(cells: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Returns the tables in the order in which a reader needs them. A table with `folded` is opened on request."""
    placed = list(enumerate(cells))
    builds, frames, others = ([(place, data) for place, data in placed if data["operation"] in operations]
                              for operations in (("build", "refit"), ("collide",), ("accuracy",)))
    tables = []
    if missing := [(place, data) for place, data in placed if data["state"] in WITHOUT_TIMES]:
        table = begin("Without a time, and why", missing, "who")
        table.add("why", "text", lambda data: data["why"] or "no reason given")
        tables.append(table.data() | {"folded": all(data["state"] == "skipped" for _, data in missing)})
    if builds:
        tables.append(times_table("Builds", builds, "builder", TREE, "Whole: the sum of the stages. Stages: medians."))
    if frames:
        if len({data["frame"] for _, data in frames}) > 1:
            tables.append(summary_table(frames))
        tables.append(times_table("Frames", frames, "pipeline", FOUND, "Whole: from the first start to the last end. Stages: medians."))
    if others:
        tables.append(times_table("Accuracy", others, "method", ["pairs_count", "missed_count", "false_count", "sah_cost"],
                                  "Times beside errors."))
    if ranked := [(place, data) for place, data in placed if data["ranks"]]:
        table = begin("Several ranks", ranked, "pipeline", "Frame: of all ranks, the median of each frame's longest.")
        for label, kind, key, scale in RANKS:
            table.add(label, kind, lambda data, key=key, scale=scale: data["ranks"][key] * scale if key in data["ranks"] else None)
        tables.append(table.data())
    if counters := sorted({name for data in cells for name in data["counters"]}):
        table = begin("All counters", placed, "who")
        table.counters(counters)
        tables.append(table.data() | {"folded": True})
    return tables
