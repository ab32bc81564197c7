"""Reads and checks result files for console commands. A refusal is a sentence that names the file."""
import json
import os
import pathlib
from collections.abc import Iterable
from typing import Any

from .json_files import Number, Refused, bytes_of, value_of

MAJOR = "1"
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "results"
# Keys that the schema requires of a run, a cell and a result of stress.
RUN = ("id", "started_at", "command", "program", "host", "device", "libraries")
CELL = ("experiment", "scene", "builder", "status")
JOURNAL = b'{"run": '  # first bytes of a journal
STRESS = ("family", "scene", "system", "kind", "findings")


def file_text(path: str, what: str) -> bytes:
    """Returns the whole file, unpacked. Raises Refused with "WHAT 'path' cannot be read: REASON"."""
    subject = f"{what} '{path}'"
    if os.path.isdir(path):
        raise Refused(f"{subject} cannot be read: it is a folder")
    return bytes_of(path, subject, f"{subject} cannot be read")


def line_of(value: Any) -> str:
    """Returns JSON in one line. Numbers keep the digits that they were read with."""
    if isinstance(value, dict):
        return "{" + ",".join([f"{line_of(key)}:{line_of(item)}" for key, item in value.items()]) + "}"
    if isinstance(value, list):
        return "[" + ",".join([line_of(item) for item in value]) + "]"
    return value.text if isinstance(value, Number) else json.dumps(value, ensure_ascii=False)


def require(value: Any, keys: Iterable[str], place: str = "") -> None:
    """Raises ValueError if the value is no object or lacks one of the keys. `place` is where in the file it is."""
    if not isinstance(value, dict):
        raise ValueError(f"{place or 'it'} is no object")
    for key in keys:
        if key not in value:
            raise ValueError(f"{place} has no '{key}'" if place else f"key '{key}' not found")


def require_all(document: dict[str, Any], parts: str, keys: Iterable[str]) -> None:
    """Does the same for each entry of a list in a file, which may be absent."""
    for place, part in enumerate(document.get(parts, [])):
        require(part, keys, f"{parts}[{place}]")


def document_of(text: bytes, origin: str) -> dict[str, Any]:
    """Parses and checks a result file. Raises Refused if the text is not a result file or has another major format."""
    try:
        return checked(of_journal(text) if text.startswith(JOURNAL) else value_of(text), origin)
    except (KeyError, TypeError, ValueError) as error:
        raise Refused(f"{origin} is no result file: {error}") from error


def of_journal(text: bytes) -> dict[str, Any]:
    """Returns what a run that did not end has left (harness/record/journal.h), as a result file. A last line may be cut off. Raises
    ValueError."""
    lines = [value_of(line) for line in text.splitlines(keepends=True) if line.endswith(b"\n")]
    runs = [line["run"] for line in lines if "run" in line]
    if len(runs) != 1:
        raise ValueError(f"it is a journal of {len(runs)} runs; `bvhbench run --resume` goes on with them")
    parts: dict[str, list[Any]] = {}
    for line in lines[1:]:
        cells = parts.setdefault(line["part"], [])
        del cells[line.get("keeps", len(cells)):]
        cells += [line["cell"]] if "cell" in line else []
    stress = [line["stress"] for line in lines if "stress" in line]
    document = {"format": f"{MAJOR}.0", "run": runs[0], "cells": [cell for cells in parts.values() for cell in cells]}
    return document | ({"stress": stress} if stress else {})


def checked(document: Any, origin: str) -> dict[str, Any]:
    """Returns the document, if it has the keys that every result file has; tests hold files to the whole schema. Raises Refused."""
    try:
        require(document, ("format",))
        if isinstance(document["format"], str) and not document["format"].startswith(f"{MAJOR}."):
            raise Refused(f"{origin} has format {document['format']}; this program reads {MAJOR}.x")
        require(document, ("run", "cells"))
        require(document["run"], RUN, "run")
        require_all(document, "cells", CELL)
        require_all(document, "stress", STRESS)
    except (TypeError, ValueError) as error:
        raise Refused(f"{origin} is no result file: {error}") from error
    return document


def read(path: str) -> dict[str, Any]:
    """Reads and checks a result file. Raises Refused."""
    return document_of(file_text(path, "the result file"), path)
