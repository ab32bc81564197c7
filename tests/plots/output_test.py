"""Tests the handling of files that pages and pictures are written to, and of files that are not results."""
import contextlib
import io
import json
import os
import pathlib
import resource
import stat
import subprocess
import sys
import tempfile
import unittest

from base import GOLDEN, ROOT, InFolder, golden  # first: it adds the source root to sys.path

from plots.files import output

TABLE1 = GOLDEN / "table1.json"
DEEP = "[" * 100_000
MALFORMED = {
    "it is empty": b"",
    "is no result file: it is no object": b"[]",
    "not JSON": b"{\"format\": \"1.0\", ",
    "NaN is no number": b"[NaN]",
    "Infinity is no number": b"[-Infinity]",
    "1e999 is too large a number": b"[1e999]",
    "nested too deeply": DEEP.encode(),
    "not text in UTF-8, at byte 2": b"[\"\xff\"]",
    "half a character": b"[\"\\ud800\"]",
}
CHANGES = {  # of a result file
    "key 'run' not found": lambda document: document.pop("run"),
    "run has no 'device'": lambda document: document["run"].pop("device"),
    "cells[0] has no 'scene'": lambda document: document["cells"][0].pop("scene"),
    "cells[0] is no object": lambda document: document.update(cells=[1]),
}
UNFORESEEN = (  # of a cell
    lambda cell: cell.update(scene=[]),
    lambda cell: cell["scene"].update(name=7),
    lambda cell: cell["samples"][1]["stages"][0].update(span_ns="1"),
    lambda cell: cell["samples"][0]["stages"][0].update(span_ns=10**400),
    lambda cell: cell.pop("check"),
    lambda cell: cell["samples"][0]["stages"][0].update(span_ns=-1),
    lambda cell: cell["samples"][1].update(wall_ns=0),
    lambda cell: cell.update(operation="collide"),
    lambda cell: cell["builder"].update(options={"order": json.loads("[" * 50 + "]" * 50)}),
)


class Malformed(InFolder):
    def assert_told(self, path: pathlib.Path, words: str) -> None:
        for script, out in (("__main__.py report", self.folder / "r.html"), ("__main__.py plot", self.folder / "out")):
            done = self.run_script(script, path, "--out", out)
            self.assertEqual((done.returncode, done.stdout), (3, ""), done)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(str(path), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse(out.exists())

    def test_files_that_are_no_results_are_told_in_a_sentence(self) -> None:
        path = self.folder / "bad.json"
        for words, content in MALFORMED.items():
            path.write_bytes(content)
            self.assert_told(path, words)

    def commands(self, bad: pathlib.Path, out: pathlib.Path) -> tuple[list[object], ...]:
        return (["show", bad], ["compare", TABLE1, bad], ["merge", bad, "-o", out], ["export", bad, "--format", "csv"],
                ["plot", bad, "--out", out])

    def test_every_command_that_reads_results_tells_it(self) -> None:
        bad, out = self.folder / "bad.json", self.folder / "out"
        for words, change in CHANGES.items():
            document = golden("table1")
            change(document)
            self.assert_told(self.written(document, "bad.json"), words)
            for command in self.commands(bad, out):
                done = self.run_script("__main__.py", *command)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (3, "", 1), done)
                self.assertIn(words, done.stderr)
                self.assertFalse(out.exists())

    def test_what_no_reader_checks_is_shown_as_it_is_or_refused_in_a_sentence(self) -> None:
        bad, out = self.folder / "bad.json", self.folder / "out"
        for change in UNFORESEEN:
            document = golden("table1")
            document["cells"] = document["cells"][:2]
            change(document["cells"][0])
            self.written(document, "bad.json")
            for command in (*self.commands(bad, out), ["report", bad, "--force", "-o", self.folder / "r.html"]):
                done = self.run_script("__main__.py", *command, "--force")
                self.assertIn((done.returncode, done.stderr.count("\n")), ((0, 0), (1, 0), (2, 1), (3, 1)), done)

    def test_an_error_that_no_reader_foresaw_is_a_sentence(self) -> None:
        errors = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        with contextlib.redirect_stdout(io.TextIOWrapper(io.BytesIO())), contextlib.redirect_stderr(errors):
            self.assertEqual(output.to_an_end(lambda: [][0], "bvhbench: "), 3)
        errors.seek(0)
        self.assertRegex(errors.read(), r"^bvhbench: what was read cannot be used: IndexError, list index out of range \(output_test.py:\d+\)\n$")

    def test_devices_are_no_results(self) -> None:
        self.assert_told(pathlib.Path("/dev/null"), "it is a device, not a result file")

    def test_a_folder_without_result_files_has_no_page(self) -> None:
        done = self.run_script("__main__.py report", self.folder, "--out", self.folder / "r.html")
        self.assertEqual((done.returncode, done.stderr), (3, f"bvhbench: the folder {self.folder} has no result file (.json or .json.xz) in it\n"))

    def test_a_page_of_nothing_is_wrong_usage(self) -> None:
        done = self.run_script("__main__.py report", "--out", self.folder / "r.html")
        self.assertEqual((done.returncode, done.stderr), (2, "bvhbench: name result files, or a --scene to show\n"))

    def test_control_characters_of_a_name_do_not_reach_the_terminal(self) -> None:
        done = self.run_script("__main__.py report", self.folder / "a\x1b[31m\nb", "--out", self.folder / "r.html")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1))
        self.assertIn("a\\x1b[31m\\nb: No such file", done.stderr)

    def test_a_name_may_be_any_bytes(self) -> None:
        path = pathlib.Path(os.fsdecode(os.fsencode(self.folder) + b"/\xff.json"))
        path.write_bytes(TABLE1.read_bytes())
        self.assertIn("/\udcff.html, ", self.made("__main__.py report", path, "-o", path.with_suffix(".html")).stdout)


class Outputs(InFolder):
    """Tests a page and a picture, each written over an existing file."""

    def setUp(self) -> None:
        super().setUp()
        self.page, self.picture = self.folder / "r.html", self.folder / "table1.svg"
        document = golden("table1")
        document["cells"] = [cell for cell in document["cells"] if cell["scene"]["name"] == "bunny"]  # few are drawn in less time
        self.small = self.written(document)
        self.made = (("__main__.py report", self.page, self.page), ("__main__.py plot --only table1", self.picture, self.folder))

    def make(self, code: int, script: str, out: pathlib.Path, *more: str) -> str:
        """Runs a script and returns its standard error."""
        done = self.run_script(script, self.small, "--out", out, *more)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (code, 1 if code else 0), done)
        return done.stderr

    def assert_made(self, path: pathlib.Path) -> None:
        self.assertTrue(path.read_text(encoding="utf-8").rstrip().endswith(("</html>", "</svg>")), path)

    def test_a_file_too_large_leaves_what_was_there(self) -> None:
        for script, path, out in self.made:
            self.make(0, script, out)
            before = path.read_bytes()
            _, hard = limit = resource.getrlimit(resource.RLIMIT_FSIZE)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, hard))
            self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, limit)
            self.assertIn("cannot be written: File too large", self.make(3, script, out))
            resource.setrlimit(resource.RLIMIT_FSIZE, limit)
            self.assertEqual(path.read_bytes(), before)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["r.html", "table1.json", "table1.png", "table1.svg"])

    def test_a_full_device_is_a_sentence(self) -> None:
        self.assertIn("/dev/full cannot be written: No space left on device", self.make(3, "__main__.py report", pathlib.Path("/dev/full")))
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))

    def test_a_full_standard_output_is_a_sentence(self) -> None:
        with open("/dev/full", "wb") as full:
            done = subprocess.run([sys.executable, ROOT / "plots", "show", self.small], stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual((done.returncode, done.stderr), (3, b"bvhbench: standard output cannot be written: No space left on device\n"))

    def test_a_page_goes_to_standard_output_if_asked(self) -> None:
        with tempfile.TemporaryFile() as out:
            out.write(b"before\n")
            out.flush()
            subprocess.run([sys.executable, ROOT / "plots", "report", TABLE1, "-o", "/dev/stdout"], stdout=out, check=True)
            out.seek(0)
            text = out.read()
        self.assertTrue(text.startswith(b"before\n<!DOCTYPE html>"), text[:40])
        self.assertTrue(text.endswith(b"</html>\n"))

    def test_links_are_followed_and_modes_kept(self) -> None:
        (self.folder / "real").mkdir()
        for script, path, out in self.made:
            real = self.folder / "real" / path.name
            real.touch()
            real.chmod(0o640)
            path.symlink_to(pathlib.Path("real") / path.name)
            self.make(0, script, out)
            self.assertTrue(path.is_symlink())
            self.assert_made(real)
            self.assertEqual(stat.S_IMODE(real.stat().st_mode), 0o640)

    def test_only_pages_and_pictures_are_replaced_without_force(self) -> None:
        for script, path, out in self.made:
            path.write_text("my notes\n", encoding="utf-8")
            self.assertIn(f"{path} is there already; --force replaces it, or choose another file", self.make(2, script, out))
            self.assertEqual(path.read_text(encoding="utf-8"), "my notes\n")
            self.make(0, script, out, "--force")
            self.make(0, script, out)
            self.assert_made(path)

    def test_an_input_is_no_output(self) -> None:
        for script, path, out in self.made:
            path.write_bytes(TABLE1.read_bytes())
            for more in ((), ("--force",)):
                done = self.run_script(script, path, "--out", out, *more)
                self.assertEqual(done.returncode, 2, done)
                self.assertIn(f"{path} is read by this command; it is not replaced, choose another file", done.stderr)
            self.assertEqual(path.read_bytes(), TABLE1.read_bytes())

    def test_a_folder_is_made_for_pictures_and_not_for_a_page(self) -> None:
        self.make(0, "__main__.py plot --only table1", self.folder / "a" / "b")
        self.assert_made(self.folder / "a" / "b" / "table1.svg")
        self.assertIn("there is no folder", self.make(3, "__main__.py report", self.folder / "c" / "r.html"))
        self.assertFalse((self.folder / "c").exists())
        self.assertIn("cannot be made: ", self.make(3, "__main__.py plot --only table1", self.folder / "a" / "b" / "table1.svg" / "d"))
