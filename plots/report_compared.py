"""What a page says of cells that may be compared, a scene's that were asked the same: which are on a front, and a bar for each
builder or pipeline."""
from collections.abc import Sequence
from typing import Any

import pareto
from report_cells import WHOLE

QUESTION = ("experiment", "axis", "scene", "asked")
Data = dict[str, Any]  # of a cell, as report_cells makes it
MEDIAN = 1  # its place among quantiles


def grouped(cells: list[Data], keys: Sequence[str]) -> list[list[Data]]:
    groups: dict[tuple[Any, ...], list[Data]] = {}
    for cell in cells:
        groups.setdefault(tuple(cell[key] for key in keys), []).append(cell)
    return list(groups.values())


def mark_fronts(cells: list[Data]) -> None:
    """Each timed cell gets by which measures nothing else is as fast as and as good as it."""
    for group in grouped([cell for cell in cells if cell["times"]], QUESTION):
        for cell in group:
            cell["front"] = []
        for measure in dict.fromkeys(measure for cell in group for measure in cell["measures"]):
            points = [(cell["times"][WHOLE][MEDIAN], cell["measures"][measure], cell)
                      for cell in group if measure in cell["measures"]]
            for _, _, cell in pareto.front(points):
                cell["front"].append(measure)


def bars_of(cells: list[Data]) -> list[Data]:
    """Where the time of each goes: medians by stage, of several frames their means; or why it has none."""
    places = {id(cell): place for place, cell in enumerate(cells)}
    return [{key: group[0][key] for key in (*QUESTION, "who")} | {"cell": places[id(group[0])] if len(group) == 1 else None}
            | bar_of(group) for group in grouped(cells, (*QUESTION, "who"))]


def bar_of(group: list[Data]) -> Data:
    bad = next((cell for cell in group if not cell["times"]), None)
    if bad:
        where = f" on frame {bad['frame']}" if len(group) > 1 else ""
        return {"said": f"{bad['state'].replace('_', ' ')}{where}{': ' if bad['why'] else ''}{bad['why']}"}
    stages = {stage: mean_median(group, stage) for stage in dict.fromkeys(stage for cell in group for stage in cell["times"])}
    whole = stages.pop(WHOLE)
    between = round(whole - sum(stages.values()), 1)
    if group[0]["operation"] == "collide" and between > 0:
        stages["between"] = between
    return {"whole": whole, "stages": stages}


def mean_median(group: list[Data], stage: str) -> float:
    """Of cells that lack the stage it is 0."""
    return round(sum(cell["times"].get(stage, (0, 0, 0))[MEDIAN] for cell in group) / len(group), 1)
