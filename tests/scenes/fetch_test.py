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
    """Serves CONTENT for every path except /missing*, and only half of it for /short*; supports range requests."""

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
        self.wfile.write(CONTENT[begin : len(CONTENT) // 2] if self.path.startswith("/short") else CONTENT[begin:])

    def log_message(self, *_):
        pass


class Fetch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.file = self.folder / "a.ply"
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        self.base = f"http://127.0.0.1:{server.server_port}"
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        Server.asked = []

    def run_fetch(self, code, *arguments):
        done = subprocess.run([sys.executable, str(FETCH), *map(str, arguments)], capture_output=True, text=True, timeout=600, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def fetch(self, code, url="-", sums=f"a.ply:{SUM}", words=None):
        """Fetches a file by a manifest of that file alone, expects exit code `code`, and returns the output."""
        row = ["a", "mesh", "1", "3", "1", "1", "static/a.ply a.ply", sums, url, "-", "free", "ask the author", "-"]
        path = self.folder / "manifest.tsv"
        path.write_text("# a comment\n" + "\t".join(COLUMNS.split()) + "\n" + "\t".join(row) + "\n")
        return self.run_fetch(code, "--manifest", path, *([self.folder, "a"] if words is None else words))

    def test_downloads_and_checks_and_then_leaves_it_alone(self):
        self.assertIn("licence: free", self.fetch(0, f"{self.base}/a.ply").stdout)
        self.assertEqual(self.file.read_bytes(), CONTENT)
        Server.asked = []
        self.fetch(0, f"{self.base}/a.ply")
        self.assertEqual(Server.asked, [])

    def test_replaces_a_damaged_file(self):
        self.file.write_bytes(b"damaged")
        self.fetch(0, f"{self.base}/a.ply")
        self.assertEqual(self.file.read_bytes(), CONTENT)

    def test_refuses_a_wrong_sum_and_leaves_nothing(self):
        self.assertIn(f"has SHA-256 {SUM} instead of 000", self.fetch(1, f"{self.base}/a.ply", "a.ply:" + 64 * "0").stderr)
        self.assertEqual(list(self.folder.glob("a.ply*")), [])

    def test_goes_on_where_it_stopped(self):
        self.fetch(1, f"{self.base}/short/a.ply")
        self.assertFalse(self.file.exists())
        self.fetch(0, f"{self.base}/a.ply")
        self.assertEqual(self.file.read_bytes(), CONTENT)
        self.assertEqual(Server.asked[-1][1], f"bytes={len(CONTENT) // 2}-")

    def test_takes_all_files_from_a_mirror(self):
        self.fetch(0, sums=f"dynamic/s/mesh.ply:{SUM} dynamic/s/frames.f32:{SUM}",
                   words=["--mirror", self.base + "/copy/", self.folder, "a"])
        self.assertTrue((self.folder / "dynamic/s/frames.f32").exists())
        self.assertEqual(Server.asked[0][0], "/copy/dynamic/s/mesh.ply")

    def test_says_where_to_get_what_it_may_not_download(self):
        self.assertIn("ask the author (as static/a.ply)", self.fetch(3, sums="-").stdout)
        self.assertEqual(Server.asked, [])

    def test_tells_of_files_and_servers_that_are_not_there(self):
        for base, says in ((self.base + "/missing", "answers 404"), ("http://127.0.0.1:1/a", "cannot be read")):
            error = self.fetch(1, f"{base}.ply", "-").stderr
            self.assertIn(says, error)
            self.assertNotIn("Traceback", error)

    def test_bad_usage(self):
        for words in ([], [self.folder], [self.folder, "b"], ["--mirror", "ftp://x", self.folder, "a"]):
            self.fetch(2, sums="-", words=words)

    def test_lists_the_real_manifest_which_is_sound(self):
        self.assertIn("bunny ", self.run_fetch(0, "--list").stdout)
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
