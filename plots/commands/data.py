"""bvhbench data: lists the data sets of scenes/manifest.tsv, and downloads them by scenes/fetch.py."""
import argparse
import difflib
import importlib.util
import os
import pathlib
import textwrap
import types

from ..files import documents, output
from ..files.json_files import Refused
from ..files.output import WrongUsage
from ..program import command
from ..words import terminal
from ..words.tables import Table, size

SCENES = documents.FOLDER.parent / "scenes"


def parser() -> command.Parser:
    words = command.Parser(
        "data", "List the data sets that scenes are made of, or download some into the data folder",
        "Without a name: triangles, size where it is there, what can be downloaded, licence and source. With names: downloads "
        "what may be downloaded and checks its SHA-256. 1 if that is wrong, 3 if there is no network or it must be done by hand. "
        "The data folder is that of --data, else of BVHBENCH_DATA.",
        [("bvhbench data", "what there is"),
         ("bvhbench data armadillo_86482 --data ~/meshes", "one of them")], "scenes/README.md")
    words.add_argument("names", nargs="*", metavar="NAME", help="data sets")
    words.add_argument("--mirror", help="the address of a copy of a data folder (http, https or file)")
    words.add_argument("--manifest", type=pathlib.Path, default=SCENES / "manifest.tsv", help=argparse.SUPPRESS)  # for tests
    return words


def main(words: list[str]) -> int:
    arguments = parser().parse_args(words)
    fetch = fetcher()
    folder = arguments.data or os.environ.get("BVHBENCH_DATA", "")
    entries = {entry["name"]: entry for entry in fetch.read_manifest(arguments.manifest)}
    if not arguments.names:
        print(listing(fetch, list(entries.values()), pathlib.Path(folder) if folder else None), end="")
        return 0
    for name in arguments.names:
        if name not in entries:
            raise WrongUsage(f"no data set is called '{name}'{meant(name, list(entries))}; `bvhbench data` lists them")
    if not folder:
        raise WrongUsage("name the folder for data sets by --data or in BVHBENCH_DATA")
    if arguments.mirror and not arguments.mirror.startswith(("http://", "https://", "file://")):
        raise WrongUsage(f"--mirror must begin with http://, https:// or file://, not '{arguments.mirror}'")
    return max(fetched(fetch, entries[name], pathlib.Path(folder), arguments.mirror) for name in arguments.names)


def fetcher() -> types.ModuleType:
    """Returns scenes/fetch.py, which is also a script."""
    spec = importlib.util.spec_from_file_location("fetch", SCENES / "fetch.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def meant(name: str, names: list[str]) -> str:
    near = difflib.get_close_matches(name, names, 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def listing(fetch: types.ModuleType, entries: list[dict[str, str]], folder: pathlib.Path | None) -> str:
    """Returns a table of the data sets, and below it licence and source of each."""
    table = Table("<name", "triangles", "frames", "size", "<get it by", "<sha256")
    for entry in entries:
        sums = fetch.known_sums(entry)
        table.row(entry["name"], *(entry[key].replace("-", "") for key in ("triangles", "frames")), size_of(entry, folder),
                  "download" if fetch.downloads(entry, None) else "mirror" if sums else "hand",
                  next(iter(sums.values()), "")[:12])
    about = [f"{entry['name']}: {entry['licence']}; {entry['source'] if entry['url'] == '-' else entry['url']}" for entry in entries]
    if width := terminal.screen.width:
        about = [textwrap.fill(line, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False) for line in about]
    return "\n".join([table.text(), *about, ""])


def size_of(entry: dict[str, str], folder: pathlib.Path | None) -> str:
    """Returns the size of the data set in the folder; blank if it is not there."""
    for file in entry["files"].split() if folder else ():
        path = folder / file
        if path.exists():
            files = [path] if path.is_file() else [each for each in path.rglob("*") if each.is_file()]
            return size(sum(each.stat().st_size for each in files))
    return ""


def fetched(fetch: types.ModuleType, entry: dict[str, str], folder: pathlib.Path, mirror: str | None) -> int:
    """Downloads a data set. Returns the exit code. Raises Refused if a file cannot be reached."""
    wanted = fetch.downloads(entry, mirror)
    if not wanted:
        output.say(f"bvhbench: {entry['name']} is not for download here: {entry['source']} (as {entry['files'].split()[0]})")
        return 3
    print(f"{entry['name']}: licence: {entry['licence']}", flush=True)
    for download in wanted:
        try:
            print(f"{entry['name']}: {download.file} {fetch.fetch(download, folder)}", flush=True)
        except fetch.Unreachable as failure:
            raise Refused(f"{entry['name']}: {failure}") from failure
        except fetch.Failure as failure:
            output.say(f"bvhbench: {entry['name']}: {failure}")
            return 1
        except OSError as error:
            raise Refused(f"{folder / download.file} cannot be written: {error.strerror}") from error
    return 0
