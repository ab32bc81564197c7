"""Reads and checks result files for console commands. A refusal is a sentence that names the file."""
import functools
import json
import os
import pathlib
from typing import Any

from . import shape
from .json_files import Number, Refused, bytes_of, value_of

MAJOR = "1"
FOLDER = pathlib.Path(__file__).resolve().parents[2] / "results"
SCHEMA = FOLDER / "schema" / "result-1.schema.json"


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


@functools.cache
def schema() -> dict[str, Any]:
    return json.loads(SCHEMA.read_text(encoding="utf-8"))


@functools.cache
def check_of(part: str) -> shape.Check:
    """Returns the check of a part that the schema defines, or of the whole file if `part` is empty."""
    return shape.check_of(schema()["$defs"][part] if part else schema(), schema())


def document_of(text: bytes, origin: str) -> dict[str, Any]:
    """Parses and checks a result file. Raises Refused if the text is not a result file or has another major format."""
    try:
        document = value_of(text)
        if not isinstance(document, dict):
            raise ValueError("it is no object")
        for key in ("format", "run", "cells"):
            if key not in document:
                raise ValueError(f"key '{key}' not found")
            if key == "format" and isinstance(document[key], str) and not document[key].startswith(f"{MAJOR}."):
                raise Refused(f"{origin} has format {document[key]}; this program reads {MAJOR}.x")
        check_of("")(document)
    except (ValueError, shape.Wrong) as error:
        raise Refused(f"{origin} is no result file: {error}") from error
    return document


def read(path: str) -> dict[str, Any]:
    """Reads and checks a result file. Raises Refused."""
    return document_of(file_text(path, "the result file"), path)
