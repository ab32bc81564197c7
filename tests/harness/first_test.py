#!/usr/bin/env python3
"""Tests `collide --first`: whether there is a contact, what cells tell, and the messages for what does not go with it."""
import pathlib
import sys

from program import ALL_CASES, cells_after, copied_kernels, expect, experiment, main, only

COLLIDE = ("collide", "--collider", "leaf", "--samples", "2", "--force", "--first", "--scene")


def contacts_of(*words: str) -> set[str]:
    """Returns the lines of all contacts, by the narrow phase."""
    words = tuple(word for word in (*COLLIDE, *words) if word != "--first")
    expect(0, *words, "--narrow", "exact", "--contacts", "all.csv")
    return set(pathlib.Path("all.csv").read_text().splitlines()[1:])


def test_a_cell_says_whether_there_is_a_contact():
    answers = set()
    questions = (("torus:700", "--adjacent", "drop"), ("two-spheres:1200:1",), ("n-body:6100:3", "--pairs-of", "within", "--adjacent", "drop"),
                 ("two-spheres:1200:1", "--pairs-of", "between"), ("n-body:6100:3",), ("n-body:6100:3", "--exclude", "0,0"))
    for words in questions if ALL_CASES else questions[:3]:
        there = contacts_of(*words)
        answer = "yes" if there else "no"
        answers.add(answer)
        shown = expect(0, *COLLIDE, *words, "--json", "f.json", "--contacts", "f.csv", says=f"first contact: {answer}")
        cell, rows = only("f.json"), pathlib.Path("f.csv").read_text().splitlines()[1:]
        assert cell["check"]["verdict"] == "agrees" and "contacts_hash" not in cell["check"], cell
        assert cell["collider"]["options"]["first"] is True and "leaf, " in shown and "first contact over oibvh-multi" in shown, shown
        assert len(rows) == cell["counters"]["contacts_count"] == bool(there) and set(rows) <= there, (rows, there)
        assert cell["first_contact"] == [int(number) for row in rows for number in row.split(",")[3:]], cell
    assert answers == {"yes", "no"}
    expect(0, *COLLIDE, "n-body:6100:3", "--pairs-of", "between", "--frames", "0:", says="first contact: yes in 0 of 2 frames")


def test_a_wrong_answer_differs():
    for file, pattern, text, why in (("flag", r"counters\[PAIRS_COUNT\] != 0u", "true", "no contact was found, and the oracle has"),
                                     ("first_contact", r"\(verdict & VERDICT_MEET\) != 0u", "true", "is no contact of the oracle's")):
        suffix = "cl" if file == "first_contact" else "clh"
        copied_kernels("k", f"collide/first/{file}.{suffix}", pattern, text)
        cell, = cells_after(*COLLIDE, "two-spheres:1200:1", "--pairs-of", "between", "--kernels", "k", code=1)
        assert cell["check"]["verdict"] == "differs" and why in cell["check"]["detail"], cell


def test_other_colliders_are_skipped_with_the_reason():
    leaf, group = cells_after("run", experiment("own.json", scenes=["torus:700"], pipelines=[
        {"builder": "oibvh-multi", "collider": ["leaf", "group"], "adjacent": "drop", "first": True}]))
    assert leaf["status"] == "measured" and leaf["first_contact"] == [], leaf
    assert group["status"] == "skipped" and group["reason"].startswith("the collider group finds all pairs; leaf ends at"), group


def test_what_does_not_go_with_it_is_refused_in_one_sentence():
    for words, why in ((("--narrow", "sat-f32", "--adjacent", "drop"), "the first contact is exact: beside 'first' 'narrow' is none or exact"),
                       (("--swept",), "'first' is about triangles, and swept pairs are of vertices, faces and edges"),
                       (("--pairs", "p.csv"), "finds contacts and no pairs of boxes: --contacts, not --pairs"),
                       (("--narrow", "exact", "--containment"), "needs all exact contacts between objects")):
        expect(2, *COLLIDE, "n-body:6100:3", *words, says=why)
    expect(4, *COLLIDE, "n-body:6100:3", "--trees", "scene", "--pairs-of", "between", says="with 'first' between objects 'trees' is object")


sys.exit(main(globals()))
