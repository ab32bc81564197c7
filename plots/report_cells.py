"""What a page says of each cell of a result file, wrong, skipped and failed ones too, and its raw samples beside it. Of cells
that may be compared, those of a scene that were asked the same, it says which are on a front, and has a bar for each builder
or pipeline.

Times are nanoseconds: 10th percentile, median, 90th percentile. A cell whose answer was wrong, or that has none, has no times.
"""
from typing import Any

import accuracy
import names
import pareto
from cells import Cell, by_stage, grouped, quantiles, whole_ns

WITHOUT_TIMES = ("differs", "skipped", "failed")
WHOLE = "whole"
MEDIAN = 1  # its place among quantiles
QUESTION = ("experiment", "axis", "scene", "asked")
# What tells how good a tree is, by counter, and what the page calls it.
GOODNESS = {"sah_cost": "surface area cost", "epo": "end-point overlap", "sibling_overlap": "overlap of siblings",
            "box_tests_count": "box tests of a query", "tree_bytes": "bytes of the tree"}
FINDS_CONTACTS = ("fcl", "fcl-refit")  # in their broad phase, and are held to the exact ones
Data = dict[str, Any]  # of a cell, as cell_data makes it


def state_of(cell: Cell) -> str:
    """The verdict of what was measured, else why it was not."""
    return cell.check["verdict"] if cell.status == "measured" else cell.status


def who(cell: Cell) -> str:
    """A builder or pipeline with the options that are not the usual ones; along an axis of accuracy, the method."""
    if cell.accuracy:
        return cell.accuracy["method"]
    if cell.collider:
        return cell.called
    name = names.variant(cell.builder, dict(cell.options))
    return f"{name}, refit" if cell.operation == "refit" else name


def asked(cell: Cell) -> str:
    """What a frame was asked for: cells that were asked something else are not to be compared."""
    if not cell.collider or cell.accuracy:
        return ""
    options = dict(cell.collider_options)
    words = [f"pairs {options['pairs_of']} objects" if options.get("pairs_of", "all") != "all" else "all pairs"]
    if cell.swept:
        words.append(cell.swept["pairs"])
    if options.get("adjacent") == "drop":
        words.append("adjacent dropped")
    narrow = "exact" if cell.collider in FINDS_CONTACTS else options.get("narrow", "none")
    if narrow != "none":
        words.append(f"contacts ({narrow})")
    return ", ".join(words)


def scene_name(cell: Cell) -> str:
    """A stand-in says for what it stands."""
    if not (other := cell.stand_in_for):
        return cell.scene
    name = cell.scene_facts["name"]
    return f"{name} ({'a stand-in' if other == name else f'for {other}'})"


def times_of(cell: Cell) -> dict[str, list[float]]:
    """By stage, and of the whole, from first start to last end."""
    if not cell.samples:
        return {}
    stages = {WHOLE: ""} | {stage: stage for sample in cell.samples for stage in sample}
    return {name: [round(1e9 * value, 1) for value in quantiles(cell.times_s(stage))] for name, stage in stages.items()}


def copy_share(cell: Cell, times: dict[str, list[float]], copy_rate: float | None) -> float | None:
    """The bytes that all stages must move, in the whole time, as a share of what a plain copy moves; of no host stages."""
    moved = [cell.moved_bytes(stage) for stage in times if stage != WHOLE]
    if not copy_rate or not moved or None in moved or times[WHOLE][MEDIAN] <= 0:
        return None
    return round(sum(moved) / (1e-9 * times[WHOLE][MEDIAN]) / copy_rate, 5)


def errors_of(cell: Cell) -> dict[str, float]:
    """By how much a method of an axis is wrong."""
    counters, errors = cell.counters, {}
    if {"missed_count", "false_count", "pairs_count"} <= counters.keys():
        if "right_pairs_count" in counters:
            errors["false pairs for each right one"] = accuracy.inflation(cell)
        elif counters["pairs_count"]:
            errors["share of wrong answers"] = accuracy.wrong(cell)
    if "relative_error" in counters:
        errors["relative error"] = counters["relative_error"]
    return errors


def measures_of(cell: Cell) -> dict[str, float]:
    """What its time may be weighed against: errors, and how good a tree is."""
    goodness = GOODNESS if cell.operation != "collide" else {}
    return errors_of(cell) | {text: cell.counters[key] for key, text in goodness.items() if key in cell.counters}


def cell_data(cell: Cell, copy_rate: float | None) -> Data:
    state = state_of(cell)
    data = {
        "experiment": cell.experiment, "operation": cell.operation, "who": who(cell), "builder": cell.builder,
        "collider": cell.collider, "scene": scene_name(cell), "triangles": cell.scene_facts.get("triangles"),
        "frame": cell.frame, "asked": asked(cell), "state": state, "why": cell.reason or cell.check.get("detail", ""), "n": len(cell.all_samples),
        "counters": cell.counters, "axis": cell.accuracy.get("axis"), "times": {}}
    if state not in WITHOUT_TIMES:
        times = data["times"] = times_of(cell)
        data |= {"on_host": cell.on_host, "copy_share": copy_share(cell, times, copy_rate) if times else None,
                 "errors": errors_of(cell), "measures": measures_of(cell)}
    return data


def column(values: list[Any]) -> Any:
    """One value in place of a list of equal ones."""
    return values[0] if values and all(value == values[0] for value in values) else values


def columns(rows: list[dict[str, Any]], left_out: str) -> dict[str, Any]:
    """By key, in the rows' order: nothing where a row lacks it."""
    keys = dict.fromkeys(key for row in rows for key in row if key != left_out)
    return {key: column([row.get(key) for row in rows]) for key in keys}


def samples_data(cell: Cell) -> Data:
    """All that a cell's samples say, column by column, a list being in the samples' order and one value being that of all."""
    samples = [by_stage(sample) for sample in cell.all_samples]
    return {"count": len(samples), "own": columns(cell.all_samples, "stages"),
            "whole": column([whole_ns(sample) for sample in samples]),
            "stages": {stage: columns([sample.get(stage, {}) for sample in samples], "stage")
                       for stage in dict.fromkeys(stage for sample in samples for stage in sample)},
            "facts": {key: value for key, value in cell.raw.items() if key != "samples"}}


def grouped_by(cells: list[Data], *keys: str) -> list[list[Data]]:
    return list(grouped(cells, lambda cell: tuple(cell[key] for key in keys)).values())


def mark_fronts(cells: list[Data]) -> None:
    """Each timed cell gets by which measures nothing else is as fast as and as good as it."""
    for group in grouped_by([cell for cell in cells if cell["times"]], *QUESTION):
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
            | bar_of(group) for group in grouped_by(cells, *QUESTION, "who")]


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
