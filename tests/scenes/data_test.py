"""Tests `bvhbench data`: its list, and downloads by file:// addresses."""
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTENT = b"ply\n" + bytes(range(256)) * 50
SUM = hashlib.sha256(CONTENT).hexdigest()
COLUMNS = "name kind triangles vertices objects frames files sha256 url stand_ins licence source note"


class Data(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.data = self.folder / "data"
        (self.folder / "source").mkdir()
        (self.folder / "source" / "a.ply").write_bytes(CONTENT)

    def run_data(self, code: int, *words: object, url: str | None = None, checksum: str = SUM, folder: bool = True) -> str:
        """Runs the command with a manifest of two data sets, and returns its output and errors."""
        url = url or f"file://{self.folder}/source/a.ply"
        rows = [["armadillo", "mesh", "1234", "3", "1", "1", "a.ply", f"a.ply:{checksum}", url, "-", "free", "ask", "-"],
                ["dress", "frames", "-", "-", "-", "7", "dress", "-", "-", "-", "own terms", "download by hand from its author", "-"]]
        manifest = self.folder / "manifest.tsv"
        manifest.write_text("\n".join("\t".join(row) for row in [COLUMNS.split(), *rows]) + "\n", encoding="utf-8")
        given = ["--data", self.data] if folder else []
        environment = {key: value for key, value in os.environ.items() if key != "BVHBENCH_DATA"}
        done = subprocess.run([sys.executable, ROOT / "plots", "data", *map(str, words), "--manifest", manifest, *given],
                              capture_output=True, text=True, check=False, env=environment, timeout=600)
        self.assertEqual(done.returncode, code, done)
        if code in (2, 3):
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stdout + done.stderr

    def test_lists_what_there_is_and_where(self) -> None:
        said = self.run_data(0)
        self.assertRegex(said, rf"(?m)^armadillo +1234 +1 +download +{SUM[:12]}$")
        self.assertRegex(said, r"(?m)^dress +7 +hand$")
        self.assertIn("dress: own terms; download by hand from its author\n", said)
        self.run_data(0, "armadillo")
        self.assertRegex(self.run_data(0), r"(?m)^armadillo .* 12\.8 kB +download")

    def test_downloads_and_checks_and_then_leaves_it_alone(self) -> None:
        said = self.run_data(0, "armadillo")
        self.assertIn("licence: free", said)
        self.assertIn("a.ply downloaded", said)
        self.assertEqual((self.data / "a.ply").read_bytes(), CONTENT)
        self.assertIn("a.ply is there", self.run_data(0, "armadillo", url="file:///nowhere/a.ply"))

    def test_takes_files_from_a_mirror(self) -> None:
        self.run_data(0, "armadillo", "--mirror", f"file://{self.folder}/source", url="-")
        self.assertEqual((self.data / "a.ply").read_bytes(), CONTENT)
        self.assertIn("must begin with", self.run_data(2, "armadillo", "--mirror", "ftp://x"))

    def test_a_wrong_sum_leaves_nothing(self) -> None:
        self.assertIn(f"has SHA-256 {SUM} instead of 000", self.run_data(1, "armadillo", checksum="0" * 64))
        self.assertEqual(list(self.data.iterdir()), [])

    def test_what_cannot_be_reached_is_a_sentence_with_code_3(self) -> None:
        for url in ("file:///nowhere/a.ply", "http://127.0.0.1:1/a.ply"):
            self.assertIn("cannot be read", self.run_data(3, "armadillo", url=url))
        self.assertIn("dress is not for download here: download by hand", self.run_data(3, "dress"))

    def test_names_and_folders_that_are_missing_are_told(self) -> None:
        self.assertIn("no data set is called 'armadilo'; did you mean 'armadillo'?", self.run_data(2, "armadilo"))
        self.assertIn("--data or in BVHBENCH_DATA", self.run_data(2, "armadillo", folder=False))

    def test_the_real_list_can_be_read(self) -> None:
        done = subprocess.run([sys.executable, ROOT / "plots", "data"], capture_output=True, text=True, check=True, timeout=600)
        self.assertRegex(done.stdout, r"(?m)^bunny +144046 ")
