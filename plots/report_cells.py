"""What a page says of each cell of a result file, wrong, skipped and failed ones too, and its raw samples beside it.

Times are nanoseconds: 10th percentile, median, 90th percentile, by results.quantiles. A cell whose answer was wrong, or that
has none, has no times.
"""
import pathlib
from typing import Any

import accuracy
import names
import results
from cells import whole_ns

WITHOUT_TIMES = ("differs", "skipped", "failed")
WHOLE = "whole"
# What tells how good a tree is, by counter, and what the page calls it.
GOODNESS = {"sah_cost": "surface area cost", "epo": "end-point overlap", "sibling_overlap": "overlap of siblings",
            "box_tests_count": "box tests of a query", "tree_bytes": "bytes of the tree"}
FINDS_CONTACTS = ("fcl", "fcl-refit")  # in their broad phase, and are held to the exact ones


def state_of(raw: dict[str, Any]) -> str:
    """The verdict of what was measured, else why it was not."""
    return raw["check"]["verdict"] if raw["status"] == "measured" else raw["status"]


def named_options(part: dict[str, Any]) -> dict[str, Any]:
    return part.get("options", {})


def who(raw: dict[str, Any]) -> str:
    """A builder or pipeline with the options that are not the usual ones; along an axis of accuracy, the method."""
    if "accuracy" in raw:
        return raw["accuracy"]["method"]
    if "collider" in raw:
        return results.called(raw)
    name = names.variant(raw["builder"]["name"], named_options(raw["builder"]))
    return f"{name}, refit" if raw.get("operation") == "refit" else name


def asked(raw: dict[str, Any]) -> str:
    """What a frame was asked for: cells that were asked something else are not to be compared."""
    if "collider" not in raw or "accuracy" in raw:
        return ""
    options = named_options(raw["collider"])
    words = [f"pairs {options['pairs_of']} objects" if options.get("pairs_of", "all") != "all" else "all pairs"]
    if "swept" in raw:
        words.append(raw["swept"]["pairs"])
    if options.get("adjacent") == "drop":
        words.append("adjacent dropped")
    narrow = "exact" if raw["collider"]["name"] in FINDS_CONTACTS else options.get("narrow", "none")
    if narrow != "none":
        words.append(f"contacts ({narrow})")
    return ", ".join(words)


def scene_name(scene: dict[str, Any]) -> str:
    """A stand-in says for what it stands."""
    if not (other := scene.get("stand_in_for")):
        return names.scene(scene)
    return f"{scene['name']} ({'a stand-in' if other == scene['name'] else f'for {other}'})"


def quantiles_ns(seconds: Any) -> list[float]:
    found = results.quantiles(seconds)
    return [round(1e9 * value, 1) for value in (found.p10, found.median, found.p90)]


def times_of(cell: results.Cell) -> dict[str, list[float]]:
    """By stage, and of the whole, from first start to last end."""
    if not cell.samples:
        return {}
    times = {WHOLE: quantiles_ns(cell.times_s())}
    for stage in dict.fromkeys(stage for sample in cell.samples for stage in sample):
        times[stage] = quantiles_ns(cell.times_s(stage))
    return times


def copy_share(cell: results.Cell, times: dict[str, list[float]], copy_rate: float | None) -> float | None:
    """The bytes that all stages must move, in the whole time, as a share of what a plain copy moves; of no host stages."""
    moved = [cell.moved_bytes(stage) for stage in times if stage != WHOLE]
    if not copy_rate or not moved or None in moved or times[WHOLE][1] <= 0:
        return None
    return round(sum(moved) / (1e-9 * times[WHOLE][1]) / copy_rate, 5)


def errors_of(cell: results.Cell) -> dict[str, float]:
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


def measures_of(cell: results.Cell) -> dict[str, float]:
    """What its time may be weighed against: errors, and how good a tree is."""
    goodness = GOODNESS if cell.operation != "collide" else {}
    return errors_of(cell) | {text: cell.counters[key] for key, text in goodness.items() if key in cell.counters}


def cell_data(path: pathlib.Path, raw: dict[str, Any], copy_rate: float | None) -> dict[str, Any]:
    scene, state = raw["scene"], state_of(raw)
    data = {
        "experiment": raw["experiment"], "operation": raw.get("operation", "build"), "who": who(raw),
        "builder": raw["builder"]["name"], "collider": raw.get("collider", {}).get("name"), "scene": scene_name(scene),
        "triangles": scene.get("triangles"), "frame": scene.get("frame", 0), "asked": asked(raw), "state": state,
        "why": raw.get("reason") or raw.get("check", {}).get("detail", ""), "n": len(raw.get("samples", [])),
        "counters": raw.get("counters", {}), "axis": raw.get("accuracy", {}).get("axis"), "times": {}}
    if state not in WITHOUT_TIMES:
        cell = results.cell_of(path, raw)
        times = data["times"] = times_of(cell)
        data |= {"on_host": cell.on_host, "copy_share": copy_share(cell, times, copy_rate) if times else None,
                 "errors": errors_of(cell), "measures": measures_of(cell)}
    return data


def column(values: list[Any]) -> Any:
    """One value in place of a list of equal ones."""
    return values[0] if values and all(value == values[0] for value in values) else values


def samples_data(raw: dict[str, Any]) -> dict[str, Any]:
    """All that a cell's samples say, column by column, a list being in the samples' order and one value being that of all."""
    samples = raw.get("samples", [])
    stages: dict[str, dict[str, list[Any]]] = {}
    for place, sample in enumerate(samples):
        for entry in sample["stages"]:
            columns = stages.setdefault(entry["stage"], {})
            for key, value in entry.items():
                if key != "stage":
                    columns.setdefault(key, [None] * len(samples))[place] = value
    own = {key: column([sample.get(key) for sample in samples])
           for key in dict.fromkeys(key for sample in samples for key in sample if key != "stages")}
    return {"count": len(samples), "own": own,
            "whole": column([whole_ns({entry["stage"]: entry for entry in sample["stages"]}) for sample in samples]),
            "stages": {stage: {key: column(values) for key, values in columns.items()}
                       for stage, columns in stages.items()},
            "facts": {key: value for key, value in raw.items() if key != "samples"}}
