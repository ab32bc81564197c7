"""Tests that tables and numbers in documents are those of the result files that they come from (plots/evidence/quotes.py)."""
import collections
import pathlib
import re
import unittest

from base import ROOT, InFolder, cell  # first: it adds the source root to sys.path

from plots.evidence import headlines, quotes
from plots.read.cells import Cell

# They name result files as examples or for words, and quote no number of one.
NO_NUMBER_OF_A_FILE = {"docs/report.md"}


class TheDocuments(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.documents = quotes.documents()

    def test_quote_their_files(self) -> None:
        findings = [finding for one in self.documents for finding in one.findings()]
        self.assertEqual(findings, [], "\n".join(["", *findings, "python3 -m plots.evidence.quotes --fill writes the files' tables and numbers"]))
        self.assertGreater(sum(len(one.made) for one in self.documents), 30)

    def test_have_a_list_if_they_name_a_result_file(self) -> None:
        listed = {one.path for one in self.documents}
        paths = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
        without = {str(path.relative_to(ROOT)) for path in paths
                   if path not in listed and quotes.RESULT.search(path.read_text(encoding="utf-8"))}
        self.assertEqual(without, NO_NUMBER_OF_A_FILE)

    def test_of_the_paper_have_a_verdict_and_a_command_for_each_claim(self) -> None:
        text = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (.*) \|$", text[text.index("## Claims"):text.index("## Index")], re.MULTILINE)[2:]
        verdicts = collections.Counter[str]()
        for claim, printed, ours, verdict, command in (row.split(" | ") for row in rows):
            verdicts[re.match("(?:confirmed in part|confirmed|not confirmed)?", verdict)[0]] += 1
            self.assertNotEqual(command, "none", claim)
            for name in re.findall(r"`bvhbench (?:run|reproduce) ([\w-]+)`", command):
                self.assertTrue((ROOT / "harness" / "experiments" / f"{name}.json").is_file(), claim)
        self.assertIn("Of {} claims {confirmed} are confirmed, {confirmed in part} in part and {not confirmed} not".format(len(rows), **verdicts),
                      text)


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
        self.assertEqual(headlines.told([Cell(cell())]), "0.100 (16.0 %, 0.0 %)")


class ADocument(InFolder):
    def made(self, text: str) -> quotes.Document:
        path = pathlib.Path(self.folder) / "made.md"
        path.write_text(text, encoding="utf-8")
        return quotes.Document(path, pathlib.Path(self.folder))

    def test_tells_line_number_and_value_of_what_differs(self) -> None:
        made = self.made("# One\n\nIt takes 25.4 µs\nand **1,234** bytes, 2.5e-8 `bvtt` |\n")
        made.says("It takes {} µs and {} bytes, {} {} |", 25.44, 1234, 2.5e-8, "`bvtt`")
        self.assertEqual(made.findings(), [])
        made.says("takes {} µs", 25.51)
        self.assertEqual(made.findings(), ["made.md:3: 25.4, the file has 25.51"])
        made.says("bytes, {} {} |", 3.14e-8, "`leaf`")
        self.assertIn("It takes 25.5 µs\nand **1,234** bytes, 3.1e-8 `leaf` |", made.filled())

    def test_misses_no_digit_of_a_number(self) -> None:
        made = self.made("a 12.5 ms\n\nb 12\n")
        made.says("a {} ms", 12)
        self.assertEqual(made.findings(), ["made.md:1: 12.5, the file has 12"])
        made.says("2.{} ms", 5)
        self.assertEqual(made.faults, ["made.md: no text '2.{} ms'"])

    def test_has_the_tables_of_its_list_between_their_marks(self) -> None:
        text = "A\n<!-- generated: one -->\n<!-- end -->\nB\n<!-- generated: two -->\n| 7 |\n<!-- end -->\n"
        made, rows = self.made(text), [["`x`", 1234.4, 6], ["y", 0.05, None]]
        made.table("one", "< name | ms | count", rows)
        self.assertEqual(made.findings(), ["made.md: the marks and the list of tables differ: ['one', 'two'], ['one']",
                                           "made.md:3: nothing, the file has | name |     ms | count |"])
        filled = "| name |     ms | count |\n| ---- | -----: | ----: |\n| `x`  |  1,234 |     6 |\n| y    | 0.0500 |       |\n"
        self.assertEqual(made.filled(), text.replace("one -->\n", "one -->\n" + filled))
        made = self.made(made.filled().replace("1,234", "1,235"))
        made.table("one", "< name | ms | count", rows)
        self.assertIn("made.md:3: | `x`  |  1,235 |     6 |, the file has | `x`  |  1,234 |     6 |", made.findings())
        made.table("three", "< name", [])
        self.assertEqual(made.faults, ["made.md: the block 'three' has no marks, or no end"])
        self.assertIn("made.md: the marks and the list of tables differ: ['one', 'two'], ['one', 'three']", made.findings())
