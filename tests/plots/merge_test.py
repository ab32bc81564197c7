"""Tests that `merge` keeps every cell once, unchanged, refuses parts that differ, and reserves its output."""
import copy
import json
import unittest

import jsonschema
from base import GOLDEN, ROOT, InFolder  # first: it adds the source root to sys.path

from plots.files import documents
from plots.files.json_files import Refused
from plots.files.output import WrongUsage
from plots.files.reserved import reserved
from plots.read import cells, merging

SCHEMA = json.loads((ROOT / "results" / "schema" / "result-1.schema.json").read_text(encoding="utf-8"))


def golden(name: str = "table1") -> dict:
    return documents.read(str(GOLDEN / f"{name}.json"))


def of_run(document: dict, name: str) -> dict:
    """Returns a copy of the document that looks like another run."""
    other = copy.deepcopy(document)
    other["run"]["id"] = name
    return other


class Merging(unittest.TestCase):
    def test_cells_come_back_as_they_were(self) -> None:
        for name in ("table1", "stress", "swept", "accuracy"):
            document = golden(name)
            merged = json.loads(merging.merge([("a", document)]).text)
            for kind in ("cells", "stress"):
                expected = [{**cell, "run": document["run"]["id"]} for cell in document.get(kind, [])]
                self.assertEqual(merged.get(kind, []), expected)
            self.assertEqual(merged["run"], document["run"])
            self.assertEqual([source["id"] for source in merged["merged_from"]], [document["run"]["id"]])
            self.assertEqual(merged["merged_from"][0]["driver"], document["run"]["device"]["driver"])

    def test_numbers_keep_their_digits(self) -> None:
        document = golden()
        digits = "150.48477172851563"  # Python would print 150.48477172851562
        new = f'"counters": {{"new_count": 18446744073709551615, "new": {digits}, '
        text = json.dumps(document).replace('"counters": {', new)
        merged = merging.merge([("a", documents.document_of(text.encode(), "a"))]).text
        self.assertIn(f'"counters":{{"new_count":18446744073709551615,"new":{digits},', merged)

    def test_a_cell_is_a_line(self) -> None:
        document = golden()
        lines = merging.merge([("a", document)]).text.splitlines()
        self.assertEqual(len(lines), 7 + len(document["cells"]))
        self.assertEqual(json.loads(lines[-2])["run"], document["run"]["id"])

    def test_parts_follow_each_other_and_say_whose_cells_are_whose(self) -> None:
        whole = {**golden(), "format": "1.9"}
        parts = [of_run({**whole, "cells": whole["cells"][start::2]}, name) for start, name in ((1, "z"), (0, "a"))]
        merged = merging.merge(zip(("one", "two"), parts))
        document = json.loads(merged.text)
        self.assertEqual((merged.cells, merged.runs, merged.repeated, merged.differs), (len(whole["cells"]), 2, 0, False))
        self.assertEqual([source["id"] for source in document["merged_from"]], ["z", "a"])
        self.assertEqual(document["run"]["id"], "z")
        first = len(parts[0]["cells"])
        self.assertEqual([cell["run"] for cell in document["cells"]], ["z"] * first + ["a"] * (len(whole["cells"]) - first))
        again = merging.merge([("both", document), ("two", parts[1])])
        self.assertEqual((again.runs, again.repeated), (2, len(parts[1]["cells"])))
        self.assertEqual(json.loads(again.text)["cells"], document["cells"])
        sources = json.loads(again.text)["merged_from"]
        self.assertEqual([source["id"] for source in sources], ["a", "z"])  # sources of one part are sorted by id

    def test_unfinished_parts_of_all_are_kept(self) -> None:
        one, two = golden(), golden("swept")
        self.assertNotIn("unfinished_parts", json.loads(merging.merge([("a", one)]).text)["run"])
        for document, keys in ((one, ["0123"]), (two, ["0123", "4567"])):
            document["run"]["unfinished_parts"] = keys
        merged = merging.merge([("a", one), ("b", two)], other_commits=True, other_devices=True).text
        self.assertEqual(json.loads(merged)["run"]["unfinished_parts"], ["0123", "4567"])

    def test_a_journal_is_read_without_cells_that_were_measured_again(self) -> None:
        document = golden()
        run, (first, second, third) = document["run"], document["cells"][:3]
        lines = [{"run": run}, {"part": "a", "cell": first}, {"part": "b", "cell": first}, {"part": "b", "cell": second},
                 {"part": "b", "keeps": 1}, {"part": "b", "cell": third}, {"part": "b", "ended": 1.5}]
        text = "".join(json.dumps(line) + "\n" for line in lines).encode()
        read = documents.document_of(text + b'{"part": "b", "ce', "x.journal")
        self.assertEqual((read["run"], read["cells"]), (run, [first, first, third]))
        with self.assertRaisesRegex(Refused, "^x.journal is no result file: it is a journal of 2 runs"):
            documents.document_of(text + json.dumps({"run": run}).encode() + b"\n", "x.journal")
        with self.assertRaisesRegex(Refused, "^x.journal is no result file"):
            documents.document_of(b'{"run": {}}\n5\n', "x.journal")

    def test_a_run_without_a_cell_is_not_told(self) -> None:
        document = golden()
        empty = of_run({**document, "cells": []}, "empty")
        self.assertEqual(merging.merge([("a", document), ("b", empty)]).runs, 1)

    def test_a_cell_that_a_file_has_twice_is_two(self) -> None:
        document = golden()
        twice = {**document, "cells": document["cells"][:1] * 2}
        self.assertEqual(merging.merge([("a", twice)]).cells, 2)
        merged = merging.merge([("a", twice), ("b", twice)])
        self.assertEqual((merged.cells, merged.repeated), (2, 2))

    def test_the_same_cell_with_other_contents_is_refused(self) -> None:
        document = golden()
        with self.assertRaisesRegex(WrongUsage, "^a and b both have .*, and not the same of it"):
            merging.merge([("a", document), ("b", of_run(document, "other"))])

    def test_options_and_caches_tell_cells_apart(self) -> None:
        document = golden()
        for change in (lambda cell: cell["builder"].setdefault("options", {}).update(new="7"),
                       lambda cell: cell.update(sampling={"stopped": "number", "caches": "cold"}),
                       lambda cell: cell["scene"].update(frame=3)):
            other = of_run(document, "other")
            for cell in other["cells"]:
                change(cell)
            self.assertEqual(merging.merge([("a", document), ("b", other)]).cells, 2 * len(document["cells"]))

    def test_parts_of_other_formats_devices_and_commits_are_refused(self) -> None:
        document = golden()
        other = of_run(document, "other")
        other["format"] = "1.77"
        with self.assertRaisesRegex(WrongUsage, f"^a has format {document['format']} and b 1.77: "):
            merging.merge([("a", document), ("b", other)], True, True)
        for part, key, asked in (("device", "name", "--other-devices"), ("program", "commit", "--other-commits")):
            other = of_run(document, "other")
            other["run"][part][key] = "another"
            with self.assertRaisesRegex(WrongUsage, f"^a is of .*, and b of .*another.*: {asked} merges them all the same$"):
                merging.merge([("a", document), ("b", other)], part != "device", part != "program")
        other = of_run(document, "other")
        other["run"]["device"]["name"] = "another"
        merged = merging.merge([("a", document), ("b", other)], other_devices=True)
        self.assertEqual((merged.cells, merged.runs), (2 * len(document["cells"]), 2))

    def test_wrong_answers_are_told(self) -> None:
        document = golden()
        document["cells"][-1]["check"]["verdict"] = "differs"
        merged = merging.merge([("a", document)])
        self.assertTrue(merged.differs)
        jsonschema.Draft202012Validator(SCHEMA).validate(json.loads(merged.text))


class JoiningProcesses(unittest.TestCase):
    def joined(self, *documents_: dict) -> dict:
        merged = merging.merge(zip("abc", documents_), processes=True)
        document = documents.document_of(merged.text.encode(), "merged")
        jsonschema.Draft202012Validator(SCHEMA).validate(document)
        return document

    def test_a_cell_has_the_samples_of_all_and_each_says_whose_it_is(self) -> None:
        parts = [of_run(golden(), name) for name in ("x", "y", "z")]
        parts[1]["cells"].reverse()
        document = self.joined(*parts)
        self.assertEqual([source["id"] for source in document["merged_from"]], ["x", "y", "z"])
        self.assertEqual(len(document["cells"]), len(parts[0]["cells"]))
        measured = 0
        for before, after in zip(parts[0]["cells"], document["cells"]):
            if before["status"] != "measured":
                self.assertEqual(after, {**before, "run": "x"})
                continue
            measured += 1
            self.assertEqual((after["run"], after["processes"], after["counters"]), ("x", ["x", "y", "z"], before["counters"]))
            count = len(before["samples"])
            self.assertEqual([sample["process"] for sample in after["samples"]], [0] * count + [1] * count + [2] * count)
            self.assertEqual([sample["stages"] for sample in after["samples"]], [sample["stages"] for sample in before["samples"]] * 3)
            order = [sample["order"] for sample in after["samples"]]
            self.assertEqual(order, sorted(set(order)))
            self.assertEqual([one.raw["samples"] for one in cells.Cell(after).processes],
                             [after["samples"][k * count:(k + 1) * count] for k in range(3)])
        self.assertGreater(measured, 0)

    def test_is_as_good_as_its_worst_process(self) -> None:
        parts = [of_run(golden(), name) for name in "xyz"]
        place = next(k for k, cell in enumerate(parts[0]["cells"]) if cell["status"] == "measured")
        parts[1]["cells"][place]["check"] |= {"verdict": "differs", "detail": "a node is lost"}
        merged = merging.merge(zip("abc", parts), processes=True)
        self.assertTrue(merged.differs)
        self.assertEqual(json.loads(merged.text)["cells"][place]["check"]["detail"], "a node is lost")
        parts[2]["cells"][place] = {key: value for key, value in parts[2]["cells"][place].items() if key not in ("samples", "check")} | {
            "status": "failed", "reason": "no memory"}
        self.assertEqual(self.joined(*parts)["cells"][place]["reason"], "no memory")

    def test_refuses_what_is_not_the_same_in_processes_of_their_own(self) -> None:
        document = golden()
        other, fewer, wrong = (of_run(document, name) for name in "xyz")
        fewer["cells"].pop()
        measured = next(cell for cell in wrong["cells"] if cell["status"] == "measured")
        measured["check"]["tree_hash"] = "0123456789abcdef"
        several = json.loads(merging.merge([("a", {**document, "cells": document["cells"][::2]}),
                                            ("b", of_run({**document, "cells": document["cells"][1::2]}, "w"))]).text)
        for parts, says in (((document,), "at least two processes, each once"), ((document, document), "at least two processes, each once"),
                            ((document, fewer), "a and b do not have the same cells: .* is in one of them"),
                            ((document, other, wrong), "a and c do not agree on .*0123456789abcdef"),
                            (({**several, "format": document["format"]}, other), "a is not what one process of `run`")):
            with self.assertRaisesRegex(WrongUsage, says):
                merging.merge(zip("abc", parts), processes=True)


class Reserving(InFolder):
    def reserve(self, name: str, force: bool = False, inputs: tuple = ()) -> None:
        with reserved(str(self.folder / name), "--out", force, inputs):
            pass

    def test_an_earlier_file_is_replaced_with_force_only(self) -> None:
        (self.folder / "r.json").write_bytes((GOLDEN / "table1.json").read_bytes())
        with self.assertRaisesRegex(WrongUsage, f"is a result of {len(golden()['cells'])} cells; --force replaces it"):
            self.reserve("r.json")
        self.reserve("r.json", force=True)
        with self.assertRaisesRegex(WrongUsage, "is read by this command"):
            self.reserve("r.json", force=True, inputs=(str(self.folder),))
        (self.folder / "notes").write_text("mine")
        with self.assertRaisesRegex(WrongUsage, "notes is there already; --force replaces it"):
            self.reserve("notes")
        (self.folder / "empty").touch()
        self.reserve("empty")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["empty", "notes", "r.json"])  # and no lock

    def test_names_that_cannot_be_written_are_refused(self) -> None:
        for name, error, says in ((".", WrongUsage, "is a folder"), ("r.json.xz", WrongUsage, "is not written packed"),
                                  ("none/r.json", Refused, "there is no folder")):
            with self.assertRaisesRegex(error, says):
                self.reserve(name)
        (self.folder / "loop").symlink_to("loop")
        with self.assertRaisesRegex(Refused, "too many links"):
            self.reserve("loop")

    def test_two_commands_do_not_reserve_one_file_by_whatever_name(self) -> None:
        (self.folder / "link").symlink_to("r.json")
        with reserved(str(self.folder / "r.json"), "--out", False):
            with self.assertRaisesRegex(Refused, "link is being written by another process"):
                self.reserve("link")
        self.reserve("link")
