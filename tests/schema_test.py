#!/usr/bin/env python3
"""Result files obey their schema, and the schema refuses what it must.

Usage: schema_test.py <source root> [<result file>...]

Checks the golden files, every result file under results/ and those named.
"""
import copy
import json
import lzma
import pathlib
import sys
import unittest

import jsonschema

ROOT = pathlib.Path()
NAMED: list[pathlib.Path] = []


def read(path: pathlib.Path) -> dict:
    packed = path.read_bytes()
    return json.loads(lzma.decompress(packed) if path.suffix == ".xz" else packed)


def result_files() -> list[pathlib.Path]:
    """Of every format, so that an older one that is still committed is found out."""
    folders = [ROOT / "tests" / "golden", ROOT / "results"]
    found = [path for folder in folders for path in sorted([*folder.rglob("*.json"), *folder.rglob("*.json.xz")])]
    return [path for path in found if {"format", "run", "cells"} <= read(path).keys()] + NAMED


class Schema(unittest.TestCase):
    def setUp(self) -> None:
        schema = read(ROOT / "results" / "schema" / "result-1.schema.json")
        jsonschema.Draft202012Validator.check_schema(schema)
        self.validator = jsonschema.Draft202012Validator(schema)
        self.document = read(ROOT / "tests" / "golden" / "table1.json")
        states = [cell["status"] for cell in self.document["cells"]]
        self.measured = self.document["cells"][states.index("measured")]
        self.skipped = self.document["cells"][states.index("skipped")]

    def assert_refused(self, words: str) -> None:
        errors = " ".join(error.message for error in self.validator.iter_errors(self.document))
        self.assertIn(words, errors)

    def test_every_result_file_obeys(self) -> None:
        for path in result_files():
            for error in self.validator.iter_errors(read(path)):
                self.fail(f"{path}: {error.json_path}: {error.message}")

    def test_there_are_golden_files_to_check(self) -> None:
        self.assertGreaterEqual(len(result_files()), 2)

    def test_refuses_a_time_without_a_verdict(self) -> None:
        del self.measured["check"]
        self.assert_refused("'check' is a required property")

    def test_refuses_a_missing_cell_without_a_reason(self) -> None:
        for status in ("skipped", "failed"):
            self.skipped["status"] = status
            self.skipped.pop("reason", None)
            self.assert_refused("'reason' is a required property")

    def test_refuses_an_undeclared_field_at_every_level(self) -> None:
        sample = self.measured["samples"][0]
        for place in (self.document, self.document["run"], self.document["run"]["device"], self.measured,
                      self.measured["scene"], sample, sample["stages"][0], self.measured["check"]):
            place["surprise"] = 1
            errors = list(self.validator.iter_errors(self.document))
            self.assertTrue(errors, place)
            del place["surprise"]

    def test_refuses_a_stage_on_both_clocks_and_on_none(self) -> None:
        stage = self.measured["samples"][0]["stages"][0]
        original = copy.copy(stage)
        stage["wall_ns"] = 1
        self.assertTrue(list(self.validator.iter_errors(self.document)))
        for key in ("wall_ns", "launches", "busy_ns", "span_ns", "moved_bytes"):
            stage.pop(key)
        self.assertTrue(list(self.validator.iter_errors(self.document)))
        stage.update(original)
        self.assertFalse(list(self.validator.iter_errors(self.document)))

    def test_refuses_errors_that_are_not_counted(self) -> None:
        accuracy = read(ROOT / "tests" / "golden" / "accuracy.json")
        self.document = accuracy | {"cells": accuracy["cells"][1:2]}
        self.assertFalse(list(self.validator.iter_errors(self.document)))
        cell = self.document["cells"][0]
        missed = cell["counters"].pop("missed_count")
        self.assertTrue(list(self.validator.iter_errors(self.document)))
        cell["counters"]["missed_count"] = missed
        del cell["accuracy"]
        self.assert_refused("'accuracy' is a required property")

    def test_refuses_another_major_format(self) -> None:
        self.document["format"] = "2.0"
        self.assert_refused("does not match")


if __name__ == "__main__":
    ROOT = pathlib.Path(sys.argv.pop(1))
    NAMED = [pathlib.Path(name) for name in sys.argv[1:]]
    unittest.main(argv=sys.argv[:1])
