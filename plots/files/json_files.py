"""Reads JSON files, plain or packed by xz."""
import json
import lzma
import math
import os
import pathlib
import re
from typing import Any

from . import host_memory

XZ = b"\xfd7zXZ\0"  # first bytes of a file packed by xz
MOST_BYTES = 1 << 28  # largest size of an unpacked text

Json = dict[str, Any]  # an object


class Refused(Exception):
    """A file or cell that must not be used; the text says which and why."""


def name_of(path: pathlib.Path) -> str:
    """Returns a result file's name without its endings (.json, .json.xz)."""
    return pathlib.Path(path.name.removesuffix(".xz")).stem


def files_in(folder: pathlib.Path) -> list[pathlib.Path]:
    """Returns every JSON file below a folder, packed by xz or not."""
    return sorted(path for path in folder.rglob("*") if path.name.endswith((".json", ".json.xz")))


class Number(float):
    """A number that is not an integer, with the digits that it was read with, so that it can be written back unchanged."""

    def __new__(cls, text: str) -> "Number":
        number = super().__new__(cls, text)
        number.text = text
        if math.isinf(number):
            raise ValueError(f"{text} is too large a number")
        return number


def bytes_of(path: str | pathlib.Path, subject: str, unreadable: str) -> bytes:
    """Returns the whole file, unpacked. Raises Refused with "SUBJECT cannot be unpacked: WHY" or "UNREADABLE: WHY"."""
    try:
        if why := host_memory.refusal(path, os.path.getsize(path)):
            raise Refused(why)
        with open(path, "rb") as file:
            return unpacked(file.read())
    except OSError as error:
        raise Refused(f"{unreadable}: {error.strerror}") from error
    except lzma.LZMAError as error:
        raise Refused(f"{subject} cannot be unpacked: {error}") from error


def parsed(path: pathlib.Path) -> Any:
    """Returns the value of a JSON file. Raises Refused."""
    if os.path.exists(path) and not os.path.isfile(path) and not path.is_fifo():
        raise Refused(f"{path}: it is a {'folder' if path.is_dir() else 'device'}, not a result file")
    try:
        return value_of(bytes_of(path, f"{path}:", f"{path}"))
    except ValueError as error:
        raise Refused(f"{path}: {error}") from error


def unpacked(text: bytes) -> bytes:
    """Returns the text, unpacked if it is packed by xz. Raises lzma.LZMAError with the reason."""
    if not text.startswith(XZ):
        return text
    parts, room = [], MOST_BYTES
    while text:
        decoder = lzma.LZMADecompressor(lzma.FORMAT_XZ)
        try:
            parts.append(decoder.decompress(text, max_length=room + 1))
        except lzma.LZMAError as error:
            raise lzma.LZMAError("it is cut off or damaged") from error
        room -= len(parts[-1])
        if room < 0:
            raise lzma.LZMAError(f"it would be larger than {MOST_BYTES >> 20} MiB")
        if not decoder.eof:
            raise lzma.LZMAError("it is cut off or damaged")
        text = decoder.unused_data
    return b"".join(parts)


def value_of(encoded: bytes) -> Any:
    """Returns the value of a JSON text. Raises ValueError with the reason."""
    if not encoded.strip():
        raise ValueError("it is empty")
    try:
        text = encoded.decode("utf-8-sig")  # some editors write a byte order mark
        value = json.loads(text, parse_constant=no_number, parse_float=Number)
        if re.search(r"\\u[dD]", text):
            json.dumps(value, ensure_ascii=False).encode("utf-8")
        return value
    except UnicodeDecodeError as error:
        raise ValueError(f"not text in UTF-8, at byte {error.start}") from error
    except UnicodeEncodeError as error:
        raise ValueError(f"a text in it has half a character, {error.object[error.start]!a}") from error
    except json.JSONDecodeError as error:
        raise ValueError(f"not JSON, at line {error.lineno}, column {error.colno}") from error
    except ValueError as error:
        raise ValueError(f"not JSON: {error}") from error
    except RecursionError as error:
        raise ValueError("nested too deeply") from error


def no_number(word: str) -> float:
    raise ValueError(f"{word} is no number")
