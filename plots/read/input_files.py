"""Result files as users give them: files, and folders that stand for all result files below them."""
import os
import pathlib
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ..files import output
from ..files.json_files import Refused, files_in, name_of
from . import results

MOST_NAMED = 5


Path = str | os.PathLike[str]


class Given(NamedTuple):
    """A result file, as it was given, and its folder below the folder that was given; "." if the file itself was given."""

    path: Path
    below: pathlib.Path
    is_of_folder: bool


def files_of(given: Iterable[Path]) -> list[Given]:
    """Returns the files, with the result files of folders in the order of their paths. A note names the JSON files of a folder
    that are not result files. Raises Refused for a folder without result files. Files are read later, and refused then."""
    found: list[Given] = []
    for path in given:
        found += of_folder(pathlib.Path(path)) if os.path.isdir(path) else [Given(path, pathlib.Path("."), False)]
    return found


def titles_of(paths: Sequence[pathlib.Path]) -> list[str]:
    """Returns each file's name without its ending; its whole path if another file has the same name. It may hold bytes that are no text."""
    names = [name_of(path) for path in paths]
    return [name if names.count(name) == 1 else str(path) for path, name in zip(paths, names, strict=True)]


def of_folder(folder: pathlib.Path) -> list[Given]:
    paths = files_in(folder)
    those = [path for path in paths if results.is_result(path)]
    if not those:
        raise Refused(f"the folder {folder} has no result file (.json or .json.xz) in it")
    if others := [str(path) for path in paths if path not in set(those)]:
        more = f" and {len(others) - MOST_NAMED} more" if len(others) > MOST_NAMED else ""
        output.say(f"bvhbench: passed over, because they are no result files: {', '.join(others[:MOST_NAMED])}{more}")
    return [Given(path, path.parent.relative_to(folder), True) for path in those]
