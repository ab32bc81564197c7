#!/usr/bin/env python3
"""Tests results/remake: that it knows every file of results/h200, and makes, leaves and refuses.

Usage: remake_test.py <bvhbench> <source root>"""
import argparse
import json
import lzma
import os
import pathlib
import re
import runpy
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

PROGRAM, ROOT = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1)).resolve()
SCRIPT = ROOT / "results" / "remake"


def remake(*words: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, SCRIPT, *words], capture_output=True, text=True, check=False)


class Remake(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def maker(self) -> tuple[dict, object]:
        """Returns the names of the script, and its maker of quick files into the test's folder."""
        script = runpy.run_path(str(SCRIPT))
        maker = script["Maker"](argparse.Namespace(program=PROGRAM, device="cpu", out=str(self.folder), quick=True, machine="h200"))
        maker.ask()
        return script, maker

    def build(self, name: str, builder: str, samples: str) -> None:
        """Builds a tree, and leaves its packed file in the test's folder."""
        file = self.folder / f"{name}.json"
        subprocess.run([PROGRAM, "build", "--scene", "torus:64", "--builder", builder, "--samples", samples, "--device", "cpu", "--json",
                        file], check=True, capture_output=True)
        (self.folder / f"{name}.json.xz").write_bytes(lzma.compress(file.read_bytes()))
        file.unlink()

    def quick(self, *words: str) -> subprocess.CompletedProcess:
        return remake("--program", PROGRAM, "--device", "cpu", "--quick", "--out", str(self.folder), *words)

    def test_lists_every_file_and_those_of_an_h200_in_parts_of_less_than_ten_minutes(self) -> None:
        for machine, most_s in (("h200", 600), ("pocl-2-cores", 3600)):
            listed = remake("--list", "--machine", machine)
            self.assertEqual((listed.returncode, listed.stderr), (0, ""))
            names = set(re.findall(r"^ *([\w-]+?)(?:\.\d+)? +(?:\d+ s  |cannot be made again)", listed.stdout, re.MULTILINE))
            self.assertEqual(names, {path.name.removesuffix(".json.xz") for path in (ROOT / "results" / machine).glob("*.json.xz")})
            seconds = [int(text) for text in re.findall(r"^part \d+: (\d+) s", listed.stdout, re.MULTILINE)]
            self.assertLess(max(seconds), most_s)
            self.assertGreater(len(seconds), 5)
            self.assertNotIn("not there", listed.stdout)

    def test_names_experiments_and_filters_that_there_are(self) -> None:
        script = runpy.run_path(str(SCRIPT))
        for unit in [unit for machine in script["MACHINES"] for unit in script["units"](machine)]:
            if unit.command.startswith("run "):
                name = unit.command.split()[1]
                self.assertTrue((ROOT / "harness" / "experiments" / f"{name}.json").is_file(), unit)

    def test_gives_plug_ins_to_those_commands_that_need_them(self) -> None:
        script = runpy.run_path(str(SCRIPT))
        with mock.patch.dict(os.environ, BVHBENCH_PLUGINS="mine.so"):
            for needs in ("", "plug-ins"):
                given = script["environment"](script["Unit"]("builders", 1, "run builders", needs))
                self.assertEqual("BVHBENCH_PLUGINS" in given, needs == "plug-ins")

    def test_makes_a_part_once(self) -> None:
        first = self.quick("--part", "2", "--only", "rebuild")
        self.assertEqual((first.returncode, first.stdout), (0, "rebuild: run rebuild --quick\n"), first.stderr)
        made = self.folder / "rebuild.json.xz"
        document = json.loads(lzma.decompress(made.read_bytes()))
        self.assertEqual(({cell["status"] for cell in document["cells"]}, document["run"]["device"]["kind"]), ({"measured"}, "cpu"))
        self.assertEqual([path.name for path in self.folder.iterdir()], [made.name])
        before = made.stat().st_mtime_ns
        self.assertEqual(self.quick("--only", "rebuild").stdout, "rebuild: is of this commit\n")
        self.assertEqual(made.stat().st_mtime_ns, before)
        document["run"]["program"]["commit"] = "0123456789" * 4  # another commit: it is made again
        made.write_bytes(lzma.compress(json.dumps(document).encode()))
        self.assertEqual(self.quick("--only", "rebuild").stdout, "rebuild: run rebuild --quick\n")
        self.assertEqual(self.quick("--only", "accuracy-sums").stdout, "accuracy-sums: left out, its command has no --quick\n")

    def test_makes_files_of_scale(self) -> None:
        script, maker = self.maker()
        self.assertTrue(maker.make(script["Unit"]("scaled", 1, "scale strong --scene torus:64 --ranks 1 --samples 1", piece="scaled")))
        self.assertTrue(maker.is_there("scaled"))

    def test_tells_scenes_without_data(self) -> None:
        cells = [{"scene": {"name": "torus:9", "stand_in_for": name}} for name in ("bunny", "n-body")]
        cells.append({"scene": {"name": "hand"}, "reason": "data set 'hand' is not there: not in '/tmp'"})
        without_data = runpy.run_path(str(SCRIPT))["without_data"]
        self.assertEqual([without_data({"cells": cells}, before) for before in ({"cells": cells[:1]}, {})], [["hand", "n-body"], ["hand"]])
        by_another = [{"scene": {"name": "cloth", "stand_in_for": "bunny"}}, *cells[1:]]
        self.assertEqual(without_data({"cells": cells}, {"cells": by_another}), ["bunny", "hand"])

    def test_merges_what_several_commands_made(self) -> None:
        script, maker = self.maker()
        pieces = {"both.1": "oibvh-single", "both.2": "karras"}
        both = [script["Unit"]("both", 1, "build", piece=name) for name in pieces]
        for name, builder in pieces.items():
            self.assertTrue(maker.merge("both", both))  # not all is there
            self.build(name, builder, "1")
        self.assertTrue(maker.merge("both", both))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["both.json.xz"])
        document = json.loads(lzma.decompress((self.folder / "both.json.xz").read_bytes()))
        self.assertEqual([cell["builder"]["name"] for cell in document["cells"]], list(pieces.values()))

    def test_joins_what_several_processes_made(self) -> None:
        script, maker = self.maker()
        headlines = [unit for unit in script["units"]("h200") if unit.file == "headlines"]
        pieces = [unit.piece for unit in headlines]
        self.assertEqual(pieces, ["headlines.1", "headlines.2", "headlines.3"])
        for name in pieces:
            self.build(name, "oibvh-single", "2")
        self.assertTrue(maker.merge("headlines", headlines))
        cell, = json.loads(lzma.decompress((self.folder / "headlines.json.xz").read_bytes()))["cells"]
        self.assertEqual([sample["process"] for sample in cell["samples"]], [0, 0, 1, 1, 2, 2])
        self.assertTrue(maker.is_there("headlines"))

    def test_refuses_in_one_sentence(self) -> None:
        for words, code, said in ((("--part", "99"), 2, "there is no part 99; there are 1 to "),
                                  (("--only", "nothing"), 2, "there is no file nothing; --list"),
                                  (("--quick",), 2, "--quick makes no results; name another folder with --out"),
                                  (("--program", "/no/program"), 3, "remake: there is no program /no/program\n"),
                                  (("--program", "/bin/false"), 3, "remake: /bin/false does not run: exit code 1\n"),
                                  (("--program", PROGRAM, "--device", "no such"), 3, "no such"),
                                  (("--program", PROGRAM, "--device", "cpu"), 3,
                                   "remake: results/h200 is of an NVIDIA H200, and this is ")):
            done = remake(*words)
            self.assertEqual((done.returncode, done.stdout), (code, ""), done)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
