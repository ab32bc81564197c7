"""Merges several result files into one that has each cell once. Cells keep entries that this program does not know."""
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ..files.documents import line_of
from ..files.json_files import Json
from ..files.output import WrongUsage
from . import cells

WORST_FIRST = ("differs", "not_checked", "counted", "agrees")


@dataclass(frozen=True)
class Merged:
    """The text of a merged file. `runs` counts the runs that its cells come from, `repeated` the cells that several parts have
    with equal contents; `differs` is true if an answer is wrong."""

    text: str
    cells: int
    runs: int
    repeated: int
    differs: bool


@dataclass(frozen=True)
class Part:
    """A result file to be merged. `runs` holds what is kept of each of its runs, by id."""

    origin: str
    document: Json
    runs: dict[str, Json]


def document_text(run: Json, cell_lines: list[str], stress_lines: list[str], sources: list[str], format_: str) -> str:
    """Returns the text of a result file with one cell in each line, so that files can be compared."""
    lists = (("merged_from", sources), ("cells", cell_lines), ("stress", stress_lines))
    told = [f',\n"{name}": [{",".join(chr(10) + line for line in lines)}\n]' for name, lines in lists if lines or name == "cells"]
    return f'{{"format": "{format_}",\n"run": {line_of(run)}{"".join(told)}}}\n'


def source_of(run: Json) -> Json:
    parts = ((run, "id", "id"), (run, "started_at", "started_at"), (run, "finished_at", "finished_at"),
             (run, "command", "command"), (run["program"], "commit", "commit"), (run["program"], "dirty", "dirty"),
             (run["host"], "name", "host"), (run["device"], "name", "device"), (run["device"], "driver", "driver"),
             (run, "copy_rate_bytes_per_s", "copy_rate_bytes_per_s"), (run, "launch_cost_ns", "launch_cost_ns"),
             (run, "conditions", "conditions"))
    return {kept: facts[key] for facts, key, kept in parts if key in facts}


def part_of(origin: str, document: Json) -> Part:
    sources = document.get("merged_from") or [source_of(document["run"])]
    return Part(origin, document, dict(sorted((source["id"], source) for source in sources)))


def device_of(source: Json) -> str:
    return f"{source.get('device', '')}, driver {source.get('driver', '')}"


def commit_of(source: Json) -> str:
    return source.get("commit", "")[:10] + (" with changes" if source.get("dirty", False) else "")


def require_alike(parts: list[Part], other_devices: bool, other_commits: bool) -> None:
    """Raises WrongUsage for the first part whose format, device or commit differs from the first part's."""
    first = parts[0]
    like = next(iter(first.runs.values()))
    for part in parts:
        if (one := first.document["format"]) != (other := part.document["format"]):
            raise WrongUsage(f"{first.origin} has format {one} and {part.origin} {other}: merge takes files of one format")
        for source in part.runs.values():
            if not other_devices and device_of(source) != device_of(like):
                raise WrongUsage(f"{first.origin} is of {device_of(like)}, and {part.origin} of {device_of(source)}: "
                                 "--other-devices merges them all the same")
            if not other_commits and commit_of(source) != commit_of(like):
                raise WrongUsage(f"{first.origin} is of commit {commit_of(like)}, and {part.origin} of {commit_of(source)}: "
                                 "--other-commits merges them all the same")


def called(cell: Json) -> str:
    """Returns the name of a cell in messages."""
    scene = cell["scene"]
    names = [scene if isinstance(scene, str) else scene["name"]]
    names += [cell[who]["name"] for who in ("builder", "collider") if who in cell]
    return ", ".join(names + ([cell["system"]] if "system" in cell else []))


def keyed(part: Part, kind: str) -> Iterable[tuple[str, Json]]:
    """Yields the cells of a part, each with its run and a key that identifies it. If a file has a cell twice, the second
    one has a different key, which equals that of another file's second one."""
    times: Counter[str] = Counter()
    for raw in part.document.get(kind, []):
        cell = raw if "run" in raw else {**raw, "run": part.document["run"]["id"]}
        key = cells.identity(cell) + device_of(part.runs.get(cell["run"], {}))
        yield f"{key}#{times[key]}", cell
        times[key] += 1


def collected(parts: list[Part], kind: str) -> tuple[list[Json], int]:
    """Returns the cells of all parts, each once, and the number of repeated cells. Raises WrongUsage if two cells with the same
    key have different contents."""
    seen: dict[str, tuple[Part, Json]] = {}
    repeated = 0
    for part in parts:
        for key, cell in keyed(part, kind):
            if key not in seen:
                seen[key] = (part, cell)
                continue
            earlier, there = seen[key]
            if line_of(there) != line_of(cell):
                raise WrongUsage(f"{earlier.origin} and {part.origin} both have {called(cell)}, and not the same of it: a merged "
                                 "file has each cell once, so leave one of them out")
            repeated += 1
    return [cell for _, cell in seen.values()], repeated


def answers_of(cell: Json) -> Json:
    """Returns what a cell is about and what it found, which must not vary between processes."""
    return {key: value for key, value in cell.get("check", {}).items() if key.endswith("_hash")} | {
        "content_hash": cell["scene"].get("content_hash"), "outside": cell.get("outside")}


def joined(parts: list[Part]) -> tuple[list[Json], int]:
    """Returns each cell once, with the samples of all parts, and 0. What was not measured in one part was not measured. Raises
    WrongUsage if a part lacks a cell, is of several runs itself, or found something else."""
    keyed_parts = [dict(keyed(part, "cells")) for part in parts]
    for part, cells_of_part in zip(parts, keyed_parts, strict=True):
        if any("cluster" in cell for cell in cells_of_part.values()):
            raise WrongUsage(f"{part.origin} has cells of several ranks, whose samples are not joined")
        if len(part.runs) > 1 or part.document.get("stress"):
            raise WrongUsage(f"{part.origin} is not what one process of `run`, `build` or `collide` wrote")
        for key in keyed_parts[0].keys() ^ cells_of_part.keys():
            cell = keyed_parts[0].get(key) or cells_of_part[key]
            raise WrongUsage(f"{parts[0].origin} and {part.origin} do not have the same cells: {called(cell)} is in one of them")
    if len({name for part in parts for name in part.runs}) < max(2, len(parts)):
        raise WrongUsage("--processes joins the files of at least two processes, each once")
    return [join(parts, [cells_of_part[key] for cells_of_part in keyed_parts]) for key in keyed_parts[0]], 0


def join(parts: list[Part], same: list[Json]) -> Json:
    for cell in same:
        if cell["status"] != "measured":
            return cell
    for part, cell in zip(parts, same, strict=True):
        if answers_of(cell) != answers_of(same[0]):
            raise WrongUsage(f"{parts[0].origin} and {part.origin} do not agree on {called(cell)}: {answers_of(same[0])} and "
                             f"{answers_of(cell)}")
    whole = {**same[0], "processes": [cell["run"] for cell in same], "samples": [],
             "check": min((cell["check"] for cell in same), key=lambda check: WORST_FIRST.index(check["verdict"]))}
    first = 0  # place of the process's first sample
    for process, cell in enumerate(same):
        whole["samples"] += [{**sample, "order": first + sample["order"], "process": process} for sample in cell["samples"]]
        first += 1 + max((sample["order"] for sample in cell["samples"]), default=0)
    return whole


def merge(parts: Iterable[tuple[str, Json]], other_devices: bool = False, other_commits: bool = False,
          processes: bool = False) -> Merged:
    """Merges the cells of all parts, in their order, into one result file. `run` is the first part's; `merged_from` describes
    each run, and a cell's `run` names its run. A part is a name for messages and a checked result file.

    Cells are equal if builder or pipeline, options, frame and device are equal. Raises WrongUsage if equal cells have different
    contents, or if format, device or commit of the parts differ and no option permits it. With `processes` each part has the same
    cells, and a cell gets the samples of all."""
    files = [part_of(origin, document) for origin, document in parts]
    require_alike(files, other_devices, other_commits)
    (measured, repeated), (stress, repeated_stress) = joined(files) if processes else collected(files, "cells"), collected(files, "stress")
    used = {name for cell in measured + stress for name in cell.get("processes", [cell["run"]])}
    sources: dict[str, Json] = {}
    for part in files:
        for name, source in part.runs.items():
            if name in used:
                sources.setdefault(name, source)
    first = files[0].document
    unfinished = list(dict.fromkeys(key for part in files for key in part.document["run"].get("unfinished_parts", ())))
    text = document_text(first["run"] | ({"unfinished_parts": unfinished} if unfinished else {}), [line_of(cell) for cell in measured], [line_of(cell) for cell in stress],
                         [line_of(source) for source in sources.values()],
                         first["format"])
    return Merged(text, len(measured) + len(stress), len(sources), repeated + repeated_stress,
                  any(cell.get("check", {}).get("verdict") == "differs" for cell in measured))
