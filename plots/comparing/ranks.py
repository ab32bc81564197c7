"""Compares the cells of several ranks in two result files: what differs, and what got worse."""
from collections.abc import Iterator

import numpy

from ..files.json_files import Json
from ..files.output import WrongUsage
from ..read import rank_files
from ..read.cells import Cell
from ..words.tables import Table
from . import comparison_text, sides, times
from .facts import Found, compare_verdicts, run_remarks
from .refusals import Named, Rules, machine, require_run, require_same_machine

COUNTS = ("halo_sent_count", "sent_bytes", "device_peak_bytes")  # of ranks


def cells_of(documents: list[Named]) -> list[dict[str, Json]]:
    """Returns the measured cells of each file, by their names; of two files with one cell each, whatever is asked there, without a
    name."""
    those = [rank_files.measured(rank_files.cells_of(document, str(file))) for file, document in documents]
    if all(len(document["cells"]) == len(cells) == 1 for (_, document), cells in zip(documents, those, strict=True)):
        return [{"": cells[0]} for cells in those]
    is_one = len({cell["experiment"] for cells in those for cell in cells}) == 1
    return [{"{}{}, ranks {ranks}, {partition}, boxes {boxes}: ".format(
        "" if is_one else f"{cell['experiment']}, ", cell["scene"]["name"], **rank_files.asked_of(cell)): cell
             for cell in cells} for cells in those]


def compare(first: Named, second: Named, rules: Rules, show_all: bool) -> tuple[str, int]:
    """Returns what differs, as text, and the number of regressions. Raises WrongUsage for files that cannot be compared."""
    if rules.builders:
        raise WrongUsage("--builders compares cells of one device, and these are of several ranks")
    runs = [require_run(name, document["run"], rules) or document["run"] for name, document in (first, second)]
    if not rules.other_devices:
        require_same_machine((first[0], runs[0]), (second[0], runs[1]), "compares only verdicts, answers and counts")
    before, after = cells_of([first, second])
    if not before.keys() & after.keys() and not rules.allow_missing:
        raise WrongUsage(f"{first[0]} and {second[0]} have no cell in common")
    regressions = [] if rules.allow_missing else [f"{name}not in B" for name in before if name not in after]
    changes = [f"not the same: {remark}" for remark in run_remarks(*runs)]
    changes += [f"{name}only in B" for name in after if name not in before]
    # Each once, as if a file was of one process.
    warnings = sides.warnings_of(*([list(dict.fromkeys(sum(sides.conditions_of(document), [])))] for _, document in (first, second)))
    rows, timed, may_tell = Table("<stage", *comparison_text.COLUMNS[1:]), machine(runs[0]) == machine(runs[1]), not warnings
    for name in (name for name in before if name in after):
        pair = before[name], after[name]
        require_one_scene((first[0], pair[0]), (second[0], pair[1]))
        for found, messages in zip((regressions, changes), facts(*pair), strict=True):
            found += [name + message for message in messages]
        is_same = rank_files.asked_of(pair[0]) == rank_files.asked_of(pair[1])
        for stage, change in time_changes(*pair, rules, may_tell) if timed else ():
            if stage == "frame" or show_all:
                rows.row(*comparison_text.row_of(name + stage if stage == "frame" else f"  {stage}", change), change.verdict)
            if stage == "frame" and change.verdict == times.SLOWER and is_same:
                regressions.append(f"{name}the frame takes {change.ratio.value:.3f} times as long")
    text = (rows.text() if rows.rows else "") + "".join([f"REGRESSION {one}\n" for one in regressions] + [f"changed {one}\n" for one in changes])
    text = "".join(f"warning: {warning}\n" for warning in warnings) + text
    count = len(regressions)
    return f"{text}{count or 'no'} regression{'s' if count > 1 else ''}\n", count


def require_one_scene(first: Named, second: Named) -> None:
    """Raises WrongUsage if two cells are of different scenes."""
    scenes = [run["scene"] for _, run in (first, second)]
    if any(scenes[0].get(key) != scenes[1].get(key) for key in ("name", "triangles")):
        raise WrongUsage(f"{first[0]} is of {scenes[0]['name']} and {second[0]} of {scenes[1]['name']}: only files of one scene are compared")


def facts(first: Json, second: Json) -> Found:
    """Compares all that is not a time."""
    found: Found = [], []
    asked = rank_files.asked_of(first), rank_files.asked_of(second)
    found[1].extend(f"{what} {asked[1][what]}, was {asked[0][what]}" for what in asked[0] if asked[0][what] != asked[1][what])
    contents = [run["scene"].get("content_hash") for run in (first, second)]
    if all(contents) and contents[0] != contents[1]:
        found[0].append(f"another scene of the same name: content {contents[1]}, was {contents[0]}")
        return found
    compare_verdicts(Cell(first), Cell(second), found)
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


def time_changes(first: Json, second: Json, rules: Rules, may_tell: bool) -> Iterator[tuple[str, times.TimeChange]]:
    """Yields the change of the frame's time, and of each stage on the rank where it takes longest; nothing for cells without times."""
    series = [samples_of(run) for run in (first, second)]
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
