#!/usr/bin/env python3
"""What `show` prints of axes of accuracy and of what stress found, and how it reads and writes.

Usage: show_golden_test.py <source root>
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "plots"))

import results  # noqa: E402
from commands import show  # noqa: E402
from console import accuracy, stress  # noqa: E402


class OfGoldenFiles(unittest.TestCase):
    def test_the_axes_and_what_stress_found_have_their_pages(self) -> None:
        axes = results.everything(ROOT / "tests" / "golden" / "accuracy.json")
        self.assertEqual(show.pages(axes), accuracy.text(axes))
        self.assertEqual(sorted(set(re.findall(r"^seed \d+$", accuracy.text(axes), re.M))), ["seed 1"])
        self.assertIn("guigue-f64: 8,000 missed and 40 false of 150,000 pairs, wrong in 2 of 3 classes\n", accuracy.text(axes))
        self.assertRegex(accuracy.text(axes), r"\ngeneric +filter-f64\+exact +50,000 +20,000 +0 +0 +0.0 % +19.30 +0.41  agrees\n")
        self.assertEqual(accuracy.text(results.everything(ROOT / "tests" / "golden" / "table1.json")), "")
        found = results.everything(ROOT / "tests" / "golden" / "stress.json")
        self.assertEqual(show.pages(found), stress.text(found))
        self.assertTrue(stress.text(found).endswith("9 cells of ours, all right\n"))

    def test_what_stress_found_wrong_of_ours_is_told_at_the_end(self) -> None:
        found = results.everything(ROOT / "tests" / "golden" / "stress.json")
        first, second = [one for one in found.stress if not one.get("library") and one["kind"] != "host"][:2]
        for one, verdict in ((first, "broken"), (second, "refused")):
            one["findings"] = {"pairs": {"verdict": verdict, "checked": 9, "wrong": 5, "missed": 2, "detail": "why"}}
        where = [f"{one['family']}: {one['scene']}, {one['system']}, pairs: why" for one in (first, second)]
        text = stress.text(found)
        self.assertTrue(text.endswith(f"\nWRONG {where[0]}\nrefused {where[1]}\n9 cells of ours, 1 wrong, 1 refused\n"))
        self.assertRegex(text, rf"(?m)^{re.escape(first['system'])} .* -2 \+3")


class OfTheCommand(unittest.TestCase):
    def show(self, path: pathlib.Path | str, code: int = 0, **environment: str) -> str:
        done = subprocess.run([sys.executable, ROOT / "plots", "show", path], encoding="utf-8", capture_output=True, check=False,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, code, done)
        return done.stderr if code else done.stdout

    def test_a_path_is_named_as_it_was_given(self) -> None:
        for path in ("./no//where.json", ""):
            self.assertEqual(self.show(path, 3),
                             f"bvhbench: the result file '{path}' cannot be read: No such file or directory\n")

    def test_is_in_utf_8_in_any_locale(self) -> None:
        path = ROOT / "tests" / "golden" / "pairs.json"
        self.assertIn("±", self.show(path))
        self.assertEqual(self.show(path, PYTHONIOENCODING="ascii"), self.show(path))

    def test_a_mark_before_the_text_is_passed_over(self) -> None:
        path = ROOT / "tests" / "golden" / "table1.json"
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"\xef\xbb\xbf" + path.read_bytes())
            file.flush()
            self.assertEqual(self.show(file.name), self.show(path))


if __name__ == "__main__":
    unittest.main()
