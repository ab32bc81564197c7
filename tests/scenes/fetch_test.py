#!/usr/bin/env python3
"""Test scenes/fetch.py against a server on this machine.

Usage: fetch_test.py <path of fetch.py>
"""
import hashlib
import http.server
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

FETCH = pathlib.Path(sys.argv.pop(1)).resolve()
CONTENT = b"ply\n" + bytes(range(256)) * 5000
SUM = hashlib.sha256(CONTENT).hexdigest()
COLUMNS = "name kind triangles vertices objects frames files sha256 url stand_ins licence source note"


class Server(http.server.BaseHTTPRequestHandler):
    """Serves CONTENT under every path but /missing*; sends the rest of it when asked for a range."""

    asked: list = []

    def do_GET(self):
        Server.asked.append((self.path, self.headers.get("Range")))
        if self.path.startswith("/missing"):
            self.send_error(404)
            return
        begin = int(self.headers["Range"][6:-1]) if self.headers.get("Range") else 0
        self.send_response(206 if begin else 200)
        self.send_header("Content-Length", str(len(CONTENT) - begin))
        self.end_headers()
        sent = CONTENT[begin : len(CONTENT) // 2] if self.path.startswith("/short") else CONTENT[begin:]
        self.wfile.write(sent)

    def log_message(self, *_):
        pass


class Fetch(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        self.base = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        Server.asked = []

    def manifest(self, url="-", sums="-", files="static/a.ply a.ply"):
        row = ["a", "mesh", "1", "3", "1", "1", files, sums, url, "-", "free", "ask the author", "-"]
        path = self.folder / "manifest.tsv"
        path.write_text("# a comment\n" + "\t".join(COLUMNS.split()) + "\n" + "\t".join(row) + "\n")
        return ["--manifest", str(path)]

    def run_fetch(self, *arguments):
        return subprocess.run(
            [sys.executable, str(FETCH), *map(str, arguments)],
            capture_output=True, text=True, timeout=60, check=False)

    def test_downloads_and_checks(self):
        options = self.manifest(f"{self.base}/a.ply", f"a.ply:{SUM}")
        done = self.run_fetch(*options, self.folder, "a")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "a.ply").read_bytes(), CONTENT)
        self.assertIn("licence: free", done.stdout)

    def test_leaves_alone_what_is_there(self):
        options = self.manifest(f"{self.base}/a.ply", f"a.ply:{SUM}")
        (self.folder / "a.ply").write_bytes(CONTENT)
        self.assertEqual(self.run_fetch(*options, self.folder, "a").returncode, 0)
        self.assertEqual(Server.asked, [])

    def test_replaces_a_damaged_file(self):
        options = self.manifest(f"{self.base}/a.ply", f"a.ply:{SUM}")
        (self.folder / "a.ply").write_bytes(b"damaged")
        self.assertEqual(self.run_fetch(*options, self.folder, "a").returncode, 0)
        self.assertEqual((self.folder / "a.ply").read_bytes(), CONTENT)

    def test_refuses_a_wrong_sum_and_leaves_nothing(self):
        options = self.manifest(f"{self.base}/a.ply", "a.ply:" + 64 * "0")
        done = self.run_fetch(*options, self.folder, "a")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"has SHA-256 {SUM} instead of 000", done.stderr)
        self.assertEqual(list(self.folder.glob("a.ply*")), [])

    def test_goes_on_where_it_stopped(self):
        options = self.manifest(f"{self.base}/short/a.ply", f"a.ply:{SUM}")
        done = self.run_fetch(*options, self.folder, "a")
        self.assertEqual(done.returncode, 1)
        self.assertFalse((self.folder / "a.ply").exists())
        options = self.manifest(f"{self.base}/a.ply", f"a.ply:{SUM}")
        self.assertEqual(self.run_fetch(*options, self.folder, "a").returncode, 0)
        self.assertEqual((self.folder / "a.ply").read_bytes(), CONTENT)
        self.assertEqual(Server.asked[-1][1], f"bytes={len(CONTENT) // 2}-")

    def test_takes_all_files_from_a_mirror(self):
        options = self.manifest(sums=f"dynamic/s/mesh.ply:{SUM} dynamic/s/frames.f32:{SUM}")
        done = self.run_fetch(*options, "--mirror", self.base + "/copy/", self.folder, "a")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "dynamic/s/frames.f32").exists())
        self.assertEqual(Server.asked[0][0], "/copy/dynamic/s/mesh.ply")

    def test_says_where_to_get_what_it_may_not_download(self):
        done = self.run_fetch(*self.manifest(), self.folder, "a")
        self.assertEqual(done.returncode, 3)
        self.assertIn("ask the author (as static/a.ply)", done.stdout)
        self.assertEqual(Server.asked, [])

    def test_tells_of_files_and_servers_that_are_not_there(self):
        done = self.run_fetch(*self.manifest(f"{self.base}/missing.ply"), self.folder, "a")
        self.assertEqual(done.returncode, 1)
        self.assertIn("answers 404", done.stderr)
        done = self.run_fetch(*self.manifest("http://127.0.0.1:1/a.ply"), self.folder, "a")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot be read", done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def test_bad_usage(self):
        options = self.manifest()
        for arguments in ([], [self.folder], [self.folder, "b"], ["--mirror", "ftp://x", self.folder, "a"]):
            self.assertEqual(self.run_fetch(*options, *arguments).returncode, 2)

    def test_lists_the_real_manifest_which_is_sound(self):
        done = self.run_fetch("--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("bunny ", done.stdout)
        sys.path.insert(0, str(FETCH.parent))
        import fetch  # noqa: the script under test
        for entry in fetch.read_manifest(FETCH.with_name("manifest.tsv")):
            self.assertNotIn(None, entry.values(), entry["name"])
            for download in fetch.downloads(entry, None):
                self.assertIn(download.file, entry["files"].split(), entry["name"])
            for file, digest in fetch.known_sums(entry).items():
                self.assertEqual(len(digest), 64)
                self.assertTrue(file.startswith(entry["files"].split()[0]), entry["name"])


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
