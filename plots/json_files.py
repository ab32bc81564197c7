"""JSON files as they are kept, plain or packed by xz."""
from __future__ import annotations

import json
import lzma
import math
import pathlib
import re
import stat
from typing import Any

XZ = b"\xfd7zXZ\0"  # how a file packed by xz begins


class Refused(Exception):
    """A file or cell that no figure may be made of; the text says which and why."""


def name_of(path: pathlib.Path) -> str:
    """A result file's name without what says how it is written."""
    return pathlib.Path(path.name.removesuffix(".xz")).stem


def files_in(folder: pathlib.Path) -> list[pathlib.Path]:
    """Every JSON file below a folder, packed by xz or not."""
    return sorted(path for path in folder.rglob("*") if path.name.endswith((".json", ".json.xz")))


def parsed(path: pathlib.Path) -> Any:
    """What a JSON file holds. Raises Refused."""
    try:
        kind = path.stat().st_mode
        if not stat.S_ISREG(kind) and not stat.S_ISFIFO(kind):
            raise Refused(f"{path}: it is a {'folder' if stat.S_ISDIR(kind) else 'device'}, not a result file")
        packed = path.read_bytes()
        text = (lzma.decompress(packed) if packed.startswith(XZ) else packed).decode("utf-8")
        if not text.strip():
            raise Refused(f"{path}: it is empty")
        document = json.loads(text, parse_constant=no_number, parse_float=finite)
        if re.search(r"\\u[dD]", text):
            json.dumps(document, ensure_ascii=False).encode("utf-8")
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}") from error
    except lzma.LZMAError as error:
        raise Refused(f"{path}: cannot be unpacked: it is cut off or damaged") from error
    except UnicodeDecodeError as error:
        raise Refused(f"{path}: not text in UTF-8, at byte {error.start}") from error
    except UnicodeEncodeError as error:
        raise Refused(f"{path}: a text in it has half a character, {error.object[error.start]!a}") from error
    except ValueError as error:
        raise Refused(f"{path}: not JSON: {error}") from error
    except RecursionError as error:
        raise Refused(f"{path}: nested too deeply") from error
    return document


def no_number(word: str) -> float:
    raise ValueError(f"{word} is no number")


def finite(text: str) -> float:
    if math.isinf(value := float(text)):
        raise ValueError(f"{text} is too large a number")
    return value
