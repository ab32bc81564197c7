"""The two sides of a comparison. A side is the result file of one process, or of several that ran the same command."""
import itertools
import json
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass

from ..files.json_files import Json
from ..read.merging import merge, source_of


@dataclass(frozen=True)
class Sides:
    """What is known of how the processes of two sides ran."""

    why: str  # why there is no spread between processes; empty if the n-th of both sides ran beside each other or one after the other
    warnings: list[str]  # what may have distorted the times of a process


def side_of(files: Sequence[pathlib.Path], documents: Sequence[Json]) -> Json:
    """Returns one document with the samples of all. Raises WrongUsage for files that are not of one command."""
    if len(files) == 1:
        return documents[0]
    named = [(str(file), document) for file, document in zip(files, documents, strict=True)]
    return json.loads(merge(named, processes=True).text)


def processes_of(document: Json) -> list[Json]:
    """Returns what is kept of each process, in the order of the cells' samples."""
    sources = {source["id"]: source for source in document.get("merged_from") or [source_of(document["run"])]}
    order = next((cell["processes"] for cell in document["cells"] if "processes" in cell), list(sources))
    return [sources[name] for name in order if name in sources]


def conditions_of(document: Json) -> list[list[str]]:
    """Returns what each process of a document warns of."""
    return [process.get("conditions", {}).get("warnings", []) for process in processes_of(document)]


def warnings_of(first: list[list[str]], second: list[list[str]]) -> list[str]:
    """Returns what the processes of both sides warn of: "B, process 2: the host is on battery"."""
    return [f"{side}{f', process {number}' if len(processes) > 1 else ''}: {warning}"
            for side, processes in (("A", first), ("B", second)) for number, own in enumerate(processes, 1) for warning in own]


def sides_of(first: Json, second: Json) -> Sides:
    one, other = processes_of(first), processes_of(second)
    is_several = all(any("processes" in cell for cell in document["cells"]) for document in (first, second))
    why = ""
    if not is_several or len(one) != len(other):
        why = "the spread between processes is not known, for which each side needs the same number of them, two or more"
    else:
        starts = [[each.get("started_at", "") for each in pair] for pair in zip(one, other, strict=True)]
        if any(max(before) > min(after) for before, after in itertools.pairwise(starts)):
            why = "the processes of both sides did not take turns, so the machine may have changed between the sides"
    return Sides(why, warnings_of(conditions_of(first), conditions_of(second)))
