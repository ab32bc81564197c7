#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that right answers are kept from run to run, and that no file among them can change a verdict."""
import contextlib
import os
import pathlib
import sys

from program import ALL_CASES, PATIENCE_S, at_work, copied_kernels, expect, main, only

COLLIDE = ("collide", "--scene", "hairball:60000", "--adjacent", "drop", "--samples", "1")
LEAF = (*COLLIDE, "--collider", "leaf", "--builder", "oibvh-multi")
AGREES = "verdict: agrees with "
KERNELS = {"POCL_CACHE_DIR": os.environ.get("POCL_CACHE_DIR") or os.path.abspath("kernels")}
pathlib.Path("kernels").mkdir(exist_ok=True)  # of an earlier run


def found_by(folder: str, *words: str, code: int = 0, says: str = AGREES) -> dict:
    """Runs the program with its answers in a folder, and returns the cell."""
    done = expect(code, *words, "--json", "cell.json", "--force", XDG_CACHE_HOME=os.path.abspath(folder), **KERNELS)
    assert says in done, done
    return only("cell.json")


def answers(folder: str) -> dict[pathlib.Path, tuple[str, int]]:
    """Returns the text and inode of each kept answer."""
    return {path: (path.read_text(errors="replace"), path.stat().st_ino)
            for path in sorted(pathlib.Path(folder, "bvhbench/answers").glob("*"))}


def sealed(line: str) -> str:
    """Returns a line with its hash behind it, as in a file of the program."""
    state = 1469598103934665603
    for byte in line.encode():
        state = (state ^ byte) * 1099511628211 % 2**64
    return f"{line}{state:016x}\n"


def test_a_kept_answer_is_used_and_gives_the_same_verdict():
    first = found_by("used", *LEAF)
    kept = answers("used")
    assert len(kept) == 1 and first["counters"]["pairs_count"] > 100_000, (kept, first)
    (text, _), = kept.values()
    assert text == sealed(text[:-17]) and int(text.split()[3], 16) == first["counters"]["pairs_count"], text
    second = found_by("used", *LEAF)
    assert second["check"] == first["check"] and answers("used") == kept, second["check"]  # not computed, and so not written
    listed = found_by("used", *LEAF, "--pairs", "p.csv")
    assert listed["check"] == first["check"], listed["check"]
    assert len(pathlib.Path("p.csv").read_text().splitlines()) == 1 + first["counters"]["pairs_count"]
    other = found_by("used", *COLLIDE[:3], *COLLIDE[5:], "--collider", "grid")  # with adjacent ones: another answer
    assert other["check"]["pairs_hash"] != first["check"]["pairs_hash"] and len(answers("used")) == 2


def test_contacts_are_kept_as_well():
    plane = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    pathlib.Path("copies.obj").write_text(plane * 500 + "".join(f"f {k} {k + 1} {k + 2}\n" for k in range(1, 1500, 3)))
    words = ("collide", "--scene", "copies.obj", "--samples", "1", "--collider", "leaf", "--narrow", "exact")
    first = found_by("contacts", *words)
    assert first["counters"]["contacts_count"] == 500 * 499 / 2, first
    kept = answers("contacts")
    assert len(kept) == (2 if "CGAL" in first["check"]["against"] else 1), kept
    assert found_by("contacts", *words)["check"] == first["check"] and answers("contacts") == kept


def test_files_that_are_damaged_or_foreign_are_written_anew():
    right = found_by("damaged", *LEAF)["check"]
    (path, (text, _)), = answers("damaged").items()
    key = text.split()[2]
    texts = ("", "x" * 100_000, sealed(text[:-17].replace(key, key[::-1])), text.replace("answer", "Answer"), text[:40], text[:-1],
             text + " ", text.replace(key, key[::-1]))
    for wrong in texts if ALL_CASES else texts[:4]:
        path.write_text(wrong)
        assert found_by("damaged", *LEAF)["check"] == right
        assert path.read_text() == text, wrong
    path.unlink()
    path.mkdir()
    assert found_by("damaged", *LEAF)["check"] == right


def test_only_the_list_condemns():
    right = found_by("condemned", *LEAF)["check"]
    (path, (text, _)), = answers("condemned").items()
    words = text.split()
    for place in (3, 4, 5):  # a well-formed file with a wrong count or set
        wrong = [*words[:-1]]
        wrong[place] = f"{int(wrong[place], 16) ^ 1:016x}"
        path.write_text(sealed(" ".join(wrong) + " "))
        assert found_by("condemned", *LEAF)["check"] == right
        assert path.read_text() == text, place


def test_a_wrong_collider_differs_from_a_kept_answer():
    right = found_by("wrong", *LEAF)
    kept = answers("wrong")
    kernels = copied_kernels("loose", "geometry/aabb.h", r"a\.min_z <= b\.max_z &&", "")
    cell = found_by("wrong", *LEAF, "--kernels", kernels, code=1, says="differs")
    assert cell["check"]["verdict"] == "differs" and cell["counters"]["pairs_count"] > right["counters"]["pairs_count"], cell
    assert f"the oracle has {right['counters']['pairs_count']:.0f} pairs of the hash " in cell["check"]["detail"], cell["check"]
    assert {path: text for path, (text, _) in answers("wrong").items()} == {path: text for path, (text, _) in kept.items()}


def night_test_many_pairs_are_hashed_on_the_device_and_only_their_list_condemns():
    plane = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    count = 5800
    pathlib.Path("many.obj").write_text(plane * count + "".join(f"f {k} {k + 1} {k + 2}\n" for k in range(1, 3 * count, 3)))
    words = ("collide", "--scene", "many.obj", "--samples", "1", "--collider", "leaf")
    right = found_by("device", *words)
    assert right["counters"]["pairs_count"] == count * (count - 1) / 2 > 2**24, right
    hashes = "collide/oracles/pair_sets.cl"
    wrong = copied_kernels("wrong-hash", hashes, r"hashes\[item\] = .*;", "hashes[item] = (ulong2)(1ul, 1ul);")
    assert found_by("device", *words, "--kernels", wrong)["check"] == right["check"]
    missing = copied_kernels("no-hash", hashes, "hash_pairs", "hash_nothing")
    expect(4, *words, "--kernels", missing, says="CL_INVALID_KERNEL_NAME", XDG_CACHE_HOME=os.path.abspath("device"), **KERNELS)


def night_test_two_processes_keep_one_answer():
    with contextlib.ExitStack() as stack:
        for process in [stack.enter_context(at_work(*LEAF, XDG_CACHE_HOME=os.path.abspath("both"), **KERNELS)) for _ in range(2)]:
            out, error = process.communicate(timeout=PATIENCE_S)
            assert process.returncode == 0 and AGREES in out, (out, error)
    assert len(answers("both")) == 1


def night_test_a_folder_with_too_many_files_is_emptied_and_one_that_cannot_be_is_none():
    found_by("many", *LEAF)
    path, = answers("many")
    path.unlink()
    for number in range(4096):
        path.with_name(f"{number}.txt").touch()
    found_by("many", *LEAF)
    assert list(answers("many")) == [path]
    pathlib.Path("file").touch()
    for folder in ("/proc/no", "file"):
        found_by(folder, *LEAF)


def test_what_is_listed_at_once_is_not_kept():
    found_by("small", "collide", "--scene", "torus:2000", "--samples", "1", "--collider", "leaf")
    assert not answers("small")


sys.exit(main(globals()))
