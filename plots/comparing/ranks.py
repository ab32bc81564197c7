"""Compares two files of `bvhbench cluster`, or two of `bvhbench scale`: what differs, and what got worse."""
import pathlib
from collections.abc import Iterator
from typing import Any

import numpy

from ..files.output import WrongUsage
from ..read import rank_files
from ..words.tables import Table
from . import comparison_text, sides, times
from .facts import WORST_FIRST, run_remarks
from .refusals import Rules, machine, require_run, require_same_machine

Json = dict[str, Any]
Named = tuple[pathlib.Path, Json]
Found = tuple[list[str], list[str]]  # messages: regressions, and other changes
COUNTS = ("halo_sent_count", "sent_bytes", "device_peak_bytes")  # of ranks


def choices(run: Json) -> Json:
    """Returns what was asked for, but for the scene."""
    builder, collider = run["builder"], run.get("collider", {})
    return {"ranks": len(run["ranks"]), "partition": run["partition"], "builder": builder["name"], "order": builder["order"],
            "collider": collider.get("name"), "adjacent": collider.get("adjacent"), "narrow": collider.get("narrow", "none"),
            "boxes": run.get("boxes_count", rank_files.USUAL_BOXES), "frames": len(run.get("frames", [])),
            "devices": "shared" if run.get("shares_devices") else "one a rank"}


def results_of(document: Json) -> dict[str, Json]:
    """Returns the results in a file, by the names of their cells in a file of scale."""
    if rank_files.format_of(document) != rank_files.RUNS:
        return {"": document}
    return {f"{run['scene']}, ranks {run['ranks']}, {run['partition']}, boxes "
            f"{run['result'].get('boxes_count', rank_files.USUAL_BOXES)}: ": run["result"]
            for run in document["runs"] if run["status"] == "measured"}


def compare(first: Named, second: Named, rules: Rules, show_all: bool) -> tuple[str, int]:
    """Returns what differs, as text, and the number of regressions. Raises WrongUsage for files that cannot be compared."""
    if rules.builders:
        raise WrongUsage("--builders compares cells of result files, and `bvhbench cluster` has one builder a file")
    if rank_files.format_of(first[1]) != rank_files.format_of(second[1]):
        raise WrongUsage(f"{first[0]} has format {first[1]['format']} and {second[0]} {second[1]['format']}")
    before, after = results_of(first[1]), results_of(second[1])
    regressions = [] if rules.allow_missing else [f"{name}not in B" for name in before if name not in after]
    changes, rows, timed = [f"{name}only in B" for name in after if name not in before], Table("<stage", *comparison_text.COLUMNS[1:]), False
    for name in (name for name in before if name in after):
        pair = before[name], after[name]
        require_pair((first[0], pair[0]), (second[0], pair[1]), rules)
        for found, messages in zip((regressions, changes), facts(*pair), strict=True):
            found += [name + message for message in messages]
        is_same = choices(pair[0]) == choices(pair[1])
        for stage, change in time_changes(*pair, rules):
            timed = timed or stage == "frame"
            if stage == "frame" or show_all:
                rows.row(*comparison_text.row_of(name + stage if stage == "frame" else f"  {stage}", change), change.verdict)
            if stage == "frame" and change.verdict == times.SLOWER and is_same:
                regressions.append(f"{name}the frame takes {change.ratio.value:.3f} times as long")
    text = (rows.text() if timed else "") + "".join([f"REGRESSION {one}\n" for one in regressions] + [f"changed {one}\n" for one in changes])
    warnings = dict.fromkeys(warning for name in before if name in after
                             for warning in sides.warnings_of([before[name]["run"]], [after[name]["run"]]))
    text = "".join(f"warning: {warning}\n" for warning in warnings) + text
    count = len(regressions)
    return f"{text}{count or 'no'} regression{'s' if count > 1 else ''}\n", count


def require_pair(first: Named, second: Named, rules: Rules) -> None:
    """Raises WrongUsage if two results cannot be compared under these rules."""
    for name, run in (first, second):
        require_run(name, run["run"], rules)
    scenes = [run["scene"] for _, run in (first, second)]
    if any(scenes[0].get(key) != scenes[1].get(key) for key in ("name", "triangles")):
        raise WrongUsage(f"{first[0]} is of {scenes[0]['name']} and {second[0]} of {scenes[1]['name']}: only files of one scene are compared")
    if not rules.other_devices:
        require_same_machine((first[0], first[1]["run"]), (second[0], second[1]["run"]), "compares only verdicts, answers and counts")


def facts(first: Json, second: Json) -> Found:
    """Compares all that is not a time."""
    found: Found = [], [f"not the same: {remark}" for remark in run_remarks(first["run"], second["run"]) if "was stopped" not in remark]
    asked = choices(first), choices(second)
    found[1].extend(f"{what} {asked[1][what]}, was {asked[0][what]}" for what in asked[0] if asked[0][what] != asked[1][what])
    contents = [run["scene"].get("content_hash") for run in (first, second)]
    if all(contents) and contents[0] != contents[1]:
        found[0].append(f"another scene of the same name: content {contents[1]}, was {contents[0]}")
        return found
    if "check" in first and "check" in second:
        verdicts = [run["check"]["verdict"].replace("_", " ") for run in (first, second)]
        if verdicts[0] != verdicts[1]:
            is_worse = WORST_FIRST.index(verdicts[1]) < WORST_FIRST.index(verdicts[0])
            detail = f" ({second['check']['detail']})" if second["check"]["detail"] else ""
            found[not is_worse].append(f"{verdicts[1]}{detail}, was {verdicts[0]}")
    is_one_question = asked[0]["adjacent"] == asked[1]["adjacent"] and asked[0]["frames"] == asked[1]["frames"]
    for what, is_asked in (("pairs", is_one_question), ("contacts", is_one_question and asked[0]["narrow"] == asked[1]["narrow"])):
        keys = f"{what}_count", f"{what}_set_hash"
        if is_asked and any(first.get(key) != second.get(key) for key in keys):
            found[0].append("other {}: {} of set hash {}, were {} of {}".format(
                what, *(run.get(key, "none") for run in (second, first) for key in keys)))
    if asked[0]["ranks"] == asked[1]["ranks"]:
        for key in COUNTS:
            most = [max(rank.get(key, 0) for rank in run["ranks"]) for run in (first, second)]
            if most[0] != most[1]:
                found[1].append(f"{key} of the rank with the most {most[1]:,}, was {most[0]:,}")
    return found


def time_changes(first: Json, second: Json, rules: Rules) -> Iterator[tuple[str, times.TimeChange]]:
    """Yields the change of the frame's time, and of each stage on the rank where it takes longest; nothing between two machines and
    for files without times."""
    if machine(first["run"]) != machine(second["run"]):
        return
    series, may_tell = [samples_of(run) for run in (first, second)], not sides.warnings_of([first["run"]], [second["run"]])
    for stage in series[0]:
        if stage in series[1]:
            change = times.time_change([series[0][stage]], [series[1][stage]], rules.threshold, rules.error)
            yield stage, change if may_tell else times.without_verdict(change)


def samples_of(run: Json) -> dict[str, numpy.ndarray]:
    """Returns the times of each sample: of the frame and of each stage, the longest over the ranks."""
    each = [rank.get("samples", []) for rank in run["ranks"]]
    if not all(each):
        return {}
    found = {"frame": numpy.array([[sample["whole_ns"] for sample in samples] for samples in each]).max(axis=0)}
    for k, stage in enumerate(each[0][0]["stages"]):
        longest = numpy.array([[sample["stages"][k]["host_ns"] for sample in samples] for samples in each]).max(axis=0)
        if longest.any():  # without a narrow phase, its stage takes no time
            found[stage["stage"]] = longest
    return found
