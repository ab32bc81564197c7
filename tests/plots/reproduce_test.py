"""Tests what `reproduce` runs and prints, and its exit codes, with a stand-in program that returns prepared files."""
import io
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from base import GOLDEN, ROOT  # first: it adds the source root to sys.path

from plots.commands import reproduce
from plots.console import claims
from plots.read import results

# Its exit codes are in CODES, such as "table1=1 view=3". It appends each call to the file "calls".
PROGRAM = f"""#!{sys.executable}
import json, os, shutil, signal, sys
words = sys.argv[1:]
print(*words, file=open("calls", "a"))
codes = dict(pair.split("=") for pair in os.environ["CODES"].split())
code = int(codes.get(words[1] if words[0] == "run" else words[0], 0))
if words[0] == "facts" and code == 0:
    print('{{"run": {{}}}}')
elif words[0] == "expand":
    print(json.dumps([{{}} for _ in json.load(sys.stdin)]))
elif words[0] == "run" and code in (0, 1, 4):
    out = words[words.index("--out") + 1]
    shutil.copy("{GOLDEN}/" + words[1].replace("fig13", "table4") + ".json", out)
    print("written:", out)
elif code > 128:
    os.kill(os.getppid(), code - 128)
    signal.pause()
sys.exit(code)
"""
NO_MATPLOTLIB = """raise ModuleNotFoundError("No module named 'matplotlib'", name="matplotlib")"""


class OfReproduce(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "program").write_text(PROGRAM)
        (self.folder / "program").chmod(0o755)
        (self.folder / "matplotlib.py").write_text(NO_MATPLOTLIB)

    def reproduce(self, code: int, *words: str, codes: str = "") -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "BVHBENCH_PROGRAM": str(self.folder / "program"), "CODES": codes,
                       "PYTHONPATH": str(self.folder)}
        done = subprocess.run([sys.executable, ROOT / "plots", "reproduce", *words], cwd=self.folder, env=environment,
                              text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def calls(self) -> list[str]:
        calls = self.folder / "calls"
        return calls.read_text().splitlines() if calls.exists() else []

    def test_prints_the_run_then_the_table_then_what_was_written_and_drawn(self) -> None:
        said = self.reproduce(0, "table1", "--quick", "--epo", "--sah-inner", "2", "--out", "./o/", "--device", "0").stdout
        order = [said.index(part) for part in ("device: ", "% of copy", "written: ./o/table1.json", "nothing was drawn; ")]
        self.assertEqual(order, sorted(order))
        self.assertTrue(said.endswith("nothing was drawn; where Python and matplotlib are, draw it with: "
                                      "bvhbench plot ./o/table1.json --only table1 --out ./o/\n"), said)
        self.assertEqual(self.calls(), ["facts --device 0", "run table1 --out ./o/table1.json --quiet --sah-inner 2.0 "
                                        "--sah-triangle 1 --quick --epo --device 0"])

    def test_figures_of_one_experiment_are_measured_once_and_count_without_matplotlib(self) -> None:
        done = self.reproduce(0, "all")
        runs = [call.split()[1] for call in self.calls() if call.startswith("run ")]
        self.assertEqual(runs, ["table1", "fig8", "table2", "table3", "table4", "fig13"])
        self.assertIn("15 of 30 claims", done.stdout)
        for figure in ("fig9", "fig10"):
            self.assertIn(f"bvhbench plot out/table2.json --only {figure} ", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], f"no page was made: {sys.executable} has no module matplotlib; elsewhere: "
                                                       "bvhbench report out/*.json -o out/report.html")
        self.assertEqual(done.stderr, f"bvhbench: {sys.executable} has no module matplotlib\n" * 8)  # one for each figure

    def test_a_verdict_follows_from_the_ratios(self) -> None:
        for values, bounds, says in (([1.2, 2], (), "confirmed"), ([0.9, 1.1], (), "confirmed in part"), ([0.9, 1], (), "not confirmed"),
                                     ([2, 5], (4,), "confirmed in part"), ([0.95, 2], (0.9, 0.9), "confirmed"), ([], (), "not judged: nothing was measured")):
            self.assertEqual(claims.verdict(values, *bounds), says, values)
        table1 = results.everything(str(GOLDEN / "table1.json"))
        times = {cell.builder: cell.median_ns("hierarchy") for cell in table1.all_cells[::-1]}  # of the first scene
        self.assertEqual(claims.ratios(claims.CLAIMS[0], table1)[0], times["apetrei"] / min(times["oibvh-single"], times["oibvh-multi"]))

    def test_ends_as_the_worst_run_that_measured_something(self) -> None:
        self.reproduce(1, "all", codes="fig8=1 table2=4")
        self.reproduce(4, "fig9", codes="table2=4")
        for path in self.folder.glob("out/*"):
            path.unlink()
        nothing = self.reproduce(4, "all", codes="table1=4 fig8=4 table2=4 table3=4 table4=4 fig13=4")
        self.assertNotIn("drawn", nothing.stdout)
        self.assertNotIn("no page", nothing.stdout)

    def test_what_fails_ends_it_at_once(self) -> None:
        self.reproduce(3, "all", codes="fig8=3")
        self.assertEqual([call.split()[1] for call in self.calls()[1:]], ["table1", "fig8"])

    def test_a_signal_goes_to_the_run_and_ends_both(self) -> None:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            self.reproduce(128 + number, "fig8", codes=f"fig8={128 + number}")

    def test_wrong_words_run_nothing(self) -> None:
        for words, says in ((("fig99",), "WHAT: there is no 'fig99'; there are: table1, "),
                            (("table1", "--out", ""), "--out names no"),
                            (("table1", "--sah-inner", "1000001"), "must be a number from 0 to 1000000, not '1000001'"),
                            (("table1", "--sah-inner", "0", "--sah-triangle", "0"), "must not both be 0")):
            self.assertIn(says, self.reproduce(2, *words).stderr)
        self.assertEqual(self.calls(), [])

    def test_no_folder_is_made_where_there_is_no_device(self) -> None:
        self.reproduce(3, "table1", codes="facts=3")
        self.assertFalse((self.folder / "out").exists())

    def test_what_is_there_is_kept_and_nothing_is_measured(self) -> None:
        out = self.folder / "out"
        for name in ("fig13.json", "report.html", "mine.png"):
            shutil.rmtree(out, ignore_errors=True)
            out.mkdir()
            (out / name).write_text("mine")
            self.assertIn(f"out/{name} is there already; --force replaces it", self.reproduce(2, "all").stderr)
            self.assertEqual([(path.name, path.read_text()) for path in out.iterdir()], [(name, "mine")])
        self.assertEqual([call for call in self.calls() if call.startswith("run ")], [])
        (out / "fig13.json").write_text("mine")
        self.reproduce(0, "fig13", "--force")
        self.assertNotEqual((out / "fig13.json").read_text(), "mine")


class OfThePage(unittest.TestCase):
    def page(self, end: BaseException | int) -> str:
        arguments = reproduce.parser().parse_args(["all"])
        with mock.patch.dict(sys.modules, {"plots.commands.report": mock.Mock(main=mock.Mock(side_effect=[end]))}), \
                mock.patch("sys.stdout", io.StringIO()) as said:
            self.code = reproduce.page(arguments, ["out/table1.json"], "out/report.html")
        return said.getvalue()

    def test_one_that_cannot_be_made_costs_nothing(self) -> None:
        elsewhere = "elsewhere: bvhbench report out/*.json -o out/report.html\n"
        for end, why in ((results.Refused("no room"), "no room"), (SystemExit(3), "its scene cannot be shown")):
            self.assertEqual((self.page(end), self.code), (f"no page was made: {why}; {elsewhere}", 0))

    def test_its_own_code_counts_and_so_does_being_stopped(self) -> None:
        self.assertEqual((self.page(1), self.code), ("", 1))
        with self.assertRaises(SystemExit):
            self.page(SystemExit(130))
