#!/usr/bin/env python3
"""Tests `--separation`: when features of a step come as near, what cells tell, and the messages for what does not go with it."""
import math
import pathlib
import sys

from program import cells_after, copied_kernels, expect, main

BALLS = ("--scene", "n-body:2000:8", "--frames", "4:5")
LEAF = ("collide", "--swept", "--samples", "1", "--collider", "leaf", "--narrow")


def cells_of(*words: str, code: int = 0, of: tuple[str, ...] = BALLS, narrow: str = "ccd-f64-1e-6") -> list[dict]:
    return cells_after(*LEAF, narrow, *of, *words, code=code)


def test_steps_end_where_features_come_as_near():
    pathlib.Path("fall").mkdir()
    for at, rounding in ((0, 0), (100_000.3, 1e-10)):  # far from the origin, floats are off by 1e-2
        for frame, z in enumerate((1, -1)):  # a triangle falls onto another: they are S apart at (1 - S) / 2
            corners = ((0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, z), (1.5, 1, z), (1, 1.5, z))
            pathlib.Path("fall", f"{frame}.obj").write_text("".join(f"v {x + at} {y + at} {z + at}\n" for x, y, z in corners) + "f 1 2 3\nf 4 5 6\n")
        for word, separation in (("0.5", .5), ("1e-9", 1e-9), ("3", 3), ("5%", .05 * 33 ** .5)):
            vf, _ = cells_of("--separation", word, "--doubles", "kept", of=("--scene", "fall/"))
            time = max(0, (1 - separation) / 2)
            assert math.isclose(vf["separation"], separation) and time - 1e-4 <= vf["counters"]["earliest_impact"] <= time + rounding, vf
            assert vf["collider"]["options"]["separation"] == word and vf["samples"][0]["stages"][0]["stage"] == "pad", vf


def test_no_separation_is_as_none_and_more_finds_more_and_misses_none():
    def facts(cell: dict) -> tuple:
        return {key: value for key, value in cell["counters"].items() if not key.endswith("_ns")}, cell["check"], cell.get("separation")

    none, zero, *others = ([*map(facts, cells_of(*words, narrow=narrow))] for words, narrow in (
        ((), "ccd-1e-4"), (("--separation", "0%"), "ccd-1e-4"), (("--separation", "0.1%"), "ccd-1e-4"),
        (("--separation", "1%", "--builder", "karras"), "ccd-f64-1e-4"), (("--separation", "5%", "--doubles", "as-is"), "ccd-f64-1e-6")))
    assert none == zero and all(separation is None for *_, separation in none), none
    right = [sum(counters["contacts_count"] - counters["false_count"] for counters, *_ in cells) for cells in (none, *others)]
    assert right == sorted(set(right)) and all(check["verdict"] == "counted" for cells in others for _, check, _ in cells), right
    assert all(counters["missed_count"] == 0 <= counters["uncertain_count"] < 5 for cells in others for counters, *_ in cells), others


def test_wrong_kernels_differ():
    for file, pattern, text in (("moving/advance.clh", r"separation \* sqrt", "0.5f * separation * sqrt"), ("separation/pad_step.cl", r"reach\)", "0.0f)")):
        copied_kernels("k", f"collide/{file}", pattern, text)
        assert {cell["check"]["verdict"] for cell in cells_of("--separation", "1%", "--kernels", "k", code=1)} == {"differs"}, (file, text)
        copied_kernels("k")


def test_what_does_not_go_with_it_is_refused_in_one_sentence():
    for words, why in (((*LEAF, "ccd-1e-4", *BALLS, "--within", "1"), "'within' is about one moment, and swept boxes are not"),
                       ((*LEAF, "ccd-1e-4", *BALLS, "--pairs-of", "within", "--pairs", "p.csv"), "--separation finds contacts and none of boxes"),
                       ((*LEAF, "none", *BALLS), "'separation' is about contacts: it needs a narrow phase; there are: ccd-1e-2"),
                       (("collide", *BALLS, "--collider", "leaf"), "'separation' is about the way between two frames: it needs 'swept'"),
                       ((*LEAF[:-3], "--collider", "brute", "--narrow", "ccd-1e-4", *BALLS), "'separation' pads boxes on the device"),
                       (("accuracy", "--axis", "swept"), "--separation is about motions: it needs --axis impacts or queries")):
        expect(4 if "pads" in why else 2, *words, "--separation", "1", says=why)
    for word in ("-1", "inf", "nan", "1e400", "one", "1%%", "%"):
        expect(2, *LEAF, "ccd-1e-4", *BALLS, f"--separation={word}", says="'separation' takes none, a distance, or a share")


sys.exit(main(globals()))
