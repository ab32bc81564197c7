#!/usr/bin/env python3
"""Tests that numbers in documents are those of the result files that they come from (plots/quotes.py)."""
import json
import pathlib
import re
import unittest

from base import ROOT, InFolder, cell  # first: it adds plots to sys.path

import headlines
import quotes
from cells import Cell

# They name result files as examples or for words, and quote no number of one.
NO_NUMBER_OF_A_FILE = {"docs/report.md"}


class TheDocuments(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.documents = quotes.documents()

    def test_quote_their_files(self) -> None:
        findings = [finding for one in self.documents for finding in one.findings()]
        self.assertEqual(findings, [], "\n".join(["", *findings, "plots/quotes.py --fill writes the files' numbers"]))
        self.assertGreater(sum(len(one.quotes) for one in self.documents), 1000)

    def test_have_a_list_if_they_name_a_result_file(self) -> None:
        listed = {one.path for one in self.documents}
        paths = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
        without = {str(path.relative_to(ROOT)) for path in paths
                   if path not in listed and quotes.RESULT.search(path.read_text(encoding="utf-8"))}
        self.assertEqual(without, NO_NUMBER_OF_A_FILE)

    def test_of_the_paper_have_a_verdict_and_a_command_for_each_claim(self) -> None:
        text = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (.*) \|$", text[text.index("## Claims"):text.index("## Index")], re.MULTILINE)[2:]
        self.assertGreaterEqual(len(rows), 26)
        for claim, printed, ours, verdict, command in (row.split(" | ") for row in rows):
            self.assertRegex(verdict, "^(holds|holds in part|holds rarely|does not hold|not tested)\\b", claim)
            self.assertTrue(command != "none" or verdict.startswith("not tested: "), claim)
            for name in re.findall(r"`bvhbench (?:run|reproduce) ([\w-]+)`", command):
                self.assertTrue((ROOT / "harness" / "experiments" / f"{name}.json").is_file(), claim)

    def test_have_no_new_number_without_a_file(self) -> None:
        known, found = json.loads(quotes.LOOSE_COUNTS.read_text(encoding="utf-8")), quotes.loose_counts(self.documents)
        wrong = [f"{name}: {found.get(name, 0)} numbers with decimals or thousands are in no list of results/quotes, "
                 f"{known.get(name, 0)} are known; plots/quotes.py --loose {name} prints them"
                 for name in sorted({*known, *found}) if found.get(name, 0) != known.get(name, 0)]
        self.assertEqual(wrong, [], "\n".join(["", *wrong]))


class AHeadline(unittest.TestCase):
    def test_tells_the_band_within_and_the_spread_between_processes(self) -> None:
        made = cell(processes=["a", "b", "c"])
        made["samples"] = []
        for process, (middle, half) in enumerate(((100, 1), (104, 10), (101, 2))):  # microseconds
            for us in (middle - half, middle, middle + half):
                made["samples"].append({"process": process, "wall_ns": 2000 * us,
                                        "stages": [{"stage": "hierarchy", "span_ns": 1000 * us, "launches": 1}]})
        # The median of all is 101; the widest band is that of the second, 94 to 114 at its ends, 96 to 112 at the percentiles.
        self.assertEqual(headlines.told([Cell(made)]), "0.101 (15.8 %, 4.0 %)")
        self.assertEqual(headlines.told([Cell(made)], by_host=True), "0.202 (15.8 %, 4.0 %)")
        single = cell()
        self.assertEqual(headlines.told([Cell(single)]), "0.100 (16.0 %, 0.0 %)")


class ADocument(InFolder):
    def made(self, text: str) -> quotes.Document:
        path = pathlib.Path(self.folder) / "made.md"
        path.write_text(text, encoding="utf-8")
        return quotes.Document(path, pathlib.Path(self.folder))

    def test_tells_line_number_and_value_of_what_differs(self) -> None:
        made = self.made("# One\n\nIt takes 25.4 µs\nand 1,234 bytes.\n")
        made.says("It takes {} µs and {} bytes", 25.44, 1234)
        self.assertEqual(made.findings(), [])
        made.says("takes {} µs", 25.51)
        self.assertEqual(made.findings(), ["made.md:3: 25.4, the file has 25.51"])
        made.says("takes {} µs\nand", 25.51)  # a second sentence with the same number
        self.assertIn("It takes 25.5 µs\nand 1,234 bytes", made.filled())

    def test_misses_no_digit_of_a_number(self) -> None:
        made = self.made("a 12.5 ms\n\nb 12\n")
        made.says("a {} ms", 12)
        self.assertEqual(made.findings(), ["made.md:1: 12.5, the file has 12"])
        made.says("2.{} ms", 5)
        self.assertEqual(len(made.faults), 1)

    def test_finds_rows_texts_and_bold_numbers_in_a_part(self) -> None:
        text = "## A\n| x | **1.50** | `leaf` |\n## B\n| x | 2.5e-8 | `bvtt` |\n"
        made = self.made(text)
        made.row("x", 1.5, "`leaf`")
        self.assertEqual(made.findings(), ["made.md:1: 2 text '| x | {} | {} |' from here on"])
        made = self.made(text)
        made.under("## A")
        made.row("x", 1.504, "`leaf`")
        made.under("## B")
        made.row("x", 3.14e-8, "`group`")
        self.assertEqual(made.findings(), ["made.md:4: 2.5e-8, the file has 3.14e-08", "made.md:4: `bvtt`, the file has `group`"])
        self.assertEqual(made.filled(), text.replace("2.5e-8 | `bvtt`", "3.1e-8 | `group`"))

    def test_counts_numbers_that_no_sentence_covers(self) -> None:
        made = self.made("Takes 1.5 ms or 2,000 in 3 of 4 cases, OpenCL `1.2`,\n[a 7.5](docs/1.5.md), v1.2.3, 9.25.\n")
        self.assertEqual([one.split(": ")[1] for one in made.loose()], ["1.5", "2,000", "7.5", "9.25"])
        made.says("Takes {} ms or {} in", 1.5, None)
        self.assertEqual([one.split(": ")[1] for one in made.loose()], ["2,000", "7.5", "9.25"])


if __name__ == "__main__":
    unittest.main()
