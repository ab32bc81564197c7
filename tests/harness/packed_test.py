# SPDX-License-Identifier: MIT
"""A result file packed by xz is read as the plain one is, and a damaged one is a sentence."""
import lzma
import pathlib
import sys

from program import expect, main


def packed(name: str, data: bytes) -> str:
    pathlib.Path(name).write_bytes(data)
    return name


def result() -> bytes:
    expect(0, "build", "--builder", "karras", "--scene", "soup:100", "--samples", "2", "--json", "r.json", "--force")
    return pathlib.Path("r.json").read_bytes()


def test_every_reader_takes_both():
    packed("r.json.xz", lzma.compress(result()))
    assert expect(0, "show", "r.json.xz").replace("r.json.xz", "r.json") == expect(0, "show", "r.json")
    expect(0, "compare", "r.json", "r.json.xz", "--allow-dirty")
    expect(0, "merge", "r.json.xz", "-o", "merged.json")
    expect(0, "report", "r.json.xz", "-o", "r.html")
    assert "<h2>r</h2>" in pathlib.Path("r.html").read_text()


def test_what_cannot_be_unpacked_is_a_sentence():
    whole = lzma.compress(result())
    for name, data in (("cut.json.xz", whole[:-9]), ("wrong.json.xz", whole[:40] + b"!" + whole[41:]), ("more.json.xz", whole + b"more")):
        packed(name, data)
        expect(3, "show", name, says="cut off or damaged")
        expect(3, "report", name, "-o", "none.html", says="cut off or damaged")


def test_what_is_too_large_unpacked_is_refused_before_it_is_there():
    packed("large.json.xz", lzma.compress(bytes(257 << 20), preset=0))
    expect(3, "show", "large.json.xz", says="large.json.xz' cannot be unpacked: it would be larger than 256 MiB")


def test_results_are_not_written_packed():
    expect(2, "build", "--builder", "karras", "--scene", "soup:10", "--json", "new.json.xz", says="pack it with xz")
    assert not pathlib.Path("new.json.xz").exists()


sys.exit(main(globals()))
