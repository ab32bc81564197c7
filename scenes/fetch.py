#!/usr/bin/env python3
"""Download data sets of scenes/manifest.tsv into a data folder.

Usage: fetch.py --list
       fetch.py [--mirror URL] [--manifest FILE] DATA_FOLDER NAME...

A file is taken from the manifest's url, or with --mirror from URL/FILE, where URL is a copy of a data folder
served over http or https. What has neither must be downloaded by hand; the script says where. Files that
are there with the right SHA-256 are left alone; a broken download is taken up where it stopped; a file
appears under its name only once it is whole and its SHA-256 is right.

Exit codes: 0 all there; 1 a download failed or its SHA-256 is wrong; 2 bad usage; 3 must be done by hand.
"""
import argparse
import csv
import hashlib
import os
import pathlib
import sys
import urllib.error
import urllib.request
from typing import NamedTuple, Optional

TIMEOUT_S = 60
BLOCK = 1 << 20


class Failure(Exception):
    """A download that did not give the file."""


class Unreachable(Failure):
    """A server or file that cannot be reached."""


class Download(NamedTuple):
    """One file of a data set: its path under the data folder, where it is, and its sum if known."""

    file: str
    url: str
    sha256: Optional[str]


def read_manifest(path: pathlib.Path) -> list[dict[str, str]]:
    lines = [line for line in path.read_text().splitlines() if line and line[0] != "#"]
    return list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))


def known_sums(entry: dict[str, str]) -> dict[str, str]:
    return dict(pair.rsplit(":", 1) for pair in entry["sha256"].split() if pair != "-")


def downloads(entry: dict[str, str], mirror: Optional[str]) -> list[Download]:
    """What to download for an entry; empty if that must be done by hand."""
    sums = known_sums(entry)
    if mirror:
        return [Download(file, f"{mirror.rstrip('/')}/{file}", sums[file]) for file in sums]
    if entry["url"] == "-":
        return []
    file = entry["url"].rsplit("/", 1)[1]
    return [Download(file, entry["url"], sums.get(file))]


def sha256(path: pathlib.Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while block := file.read(BLOCK):
            digest.update(block)
    return digest.hexdigest()


def append_rest(url: str, part: pathlib.Path) -> None:
    """Download what `part` lacks of `url`, or all of it if the server cannot send a rest."""
    have = part.stat().st_size if part.exists() else 0
    request = urllib.request.Request(url, headers={"Range": f"bytes={have}-"} if have else {})
    with urllib.request.urlopen(request, timeout=TIMEOUT_S) as answer:
        resumed = answer.status == 206
        expected = answer.headers.get("Content-Length")
        with part.open("ab" if resumed else "wb") as file:
            got = 0
            while block := answer.read(BLOCK):
                file.write(block)
                got += len(block)
    if expected is not None and got != int(expected):
        raise Failure(f"{url} broke off after {got} of {expected} bytes; run again to go on")


def fetch(download: Download, folder: pathlib.Path) -> str:
    """Make sure of one file and say how."""
    target = folder / download.file
    if target.exists() and download.sha256 in (None, sha256(target)):
        return "is there" if download.sha256 else "is there; its SHA-256 is not known"
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.with_name(target.name + ".part")
    try:
        append_rest(download.url, part)
    except urllib.error.HTTPError as error:
        part.unlink(missing_ok=True)  # 416: what is there is longer than the file
        raise Unreachable(f"{download.url} answers {error.code} {error.reason}") from error
    except urllib.error.URLError as error:
        raise Unreachable(f"{download.url} cannot be read: {error.reason}") from error
    except (ConnectionError, TimeoutError) as error:
        raise Unreachable(f"{download.url} cannot be read: {error}") from error
    except OSError as error:
        raise Failure(f"{part} cannot be written: {error.strerror}") from error
    found = sha256(part)
    if download.sha256 not in (None, found):
        part.unlink()
        raise Failure(f"{download.url} has SHA-256 {found} instead of {download.sha256}")
    os.replace(part, target)
    return "downloaded" if download.sha256 else f"downloaded, SHA-256 {found}, not checked"


def fetch_entry(entry: dict[str, str], folder: pathlib.Path, mirror: Optional[str]) -> int:
    wanted = downloads(entry, mirror)
    if not wanted:
        print(f"{entry['name']}: {entry['source']} (as {entry['files'].split()[0]})")
        return 3
    print(f"{entry['name']}: licence: {entry['licence']}")
    for download in wanted:
        try:
            print(f"{entry['name']}: {download.file} {fetch(download, folder)}")
        except Failure as failure:
            print(f"{entry['name']}: {failure}", file=sys.stderr)
            return 1
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="print every data set and stop")
    parser.add_argument("--mirror", metavar="URL", help="a copy of a data folder")
    parser.add_argument(
        "--manifest",
        type=pathlib.Path,
        default=pathlib.Path(__file__).with_name("manifest.tsv"),
        help="another manifest than the one beside this script",
    )
    parser.add_argument("folder", nargs="?", type=pathlib.Path, metavar="DATA_FOLDER")
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    if options.mirror and not options.mirror.startswith(("http://", "https://")):
        parser.error(f"a mirror begins with http:// or https://, and there is '{options.mirror}'")
    entries = {entry["name"]: entry for entry in read_manifest(options.manifest)}
    if options.list:
        for entry in entries.values():
            how = "download" if downloads(entry, None) else "by hand"
            print(f"{entry['name']:22} {how:9} {entry['note']}")
        return 0
    if options.folder is None or not options.names:
        parser.error("a data folder and at least one name are needed")
    for name in options.names:
        if name not in entries:
            parser.error(f"no data set is called '{name}'; there are: {', '.join(entries)}")
    codes = [fetch_entry(entries[name], options.folder, options.mirror) for name in options.names]
    return 1 if 1 in codes else max(codes)


if __name__ == "__main__":
    sys.exit(main())
