"""Tests which commit and which changes a build stamps into the program: runs the script of cmake/BuildInfo.cmake in small trees."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
NOBODY = 65534


def git(folder: pathlib.Path, *words: str) -> str:
    done = subprocess.run(["git", "-C", folder, "-c", "user.name=a", "-c", "user.email=a@b", *words], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def begin(folder: pathlib.Path) -> str:
    """Makes a repository of all files of a folder and returns its commit."""
    git(folder, "init", "-q")
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "--allow-empty", "-m", folder.name)
    return git(folder, "rev-parse", "HEAD")


class BuildInfo(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.root = self.folder / "other/vendor/tree"
        shutil.copytree(ROOT / "cmake", self.root / "cmake")
        shutil.copy(ROOT / ".gitattributes", self.root)
        (self.root / "harness").mkdir()
        (self.root / "harness/main.cpp").write_text("")
        (self.root / "README.md").write_text("")

    def stamp(self, root: pathlib.Path | None = None, **environment: str) -> tuple[str, str, list[str]]:
        """Returns commit, dirty and changed files as a build would stamp them."""
        out = self.folder / "build_info.cpp"
        subprocess.run(["cmake", f"-DROOT={root or self.root}", f"-DOUT={out}", "-DVERSION=0", "-DCOMPILER=x", "-DBUILD_TYPE=Release",
                        "-DARCH=x", "-P", ROOT / "cmake/BuildInfoScript.cmake"], check=True, env={**os.environ, **environment})
        text = out.read_text()
        files = re.search(r"\.changed_files = \{(.*)\},", text)[1]
        return re.search(r'\.commit = "(.*)"', text)[1], re.search(r"\.dirty = (\w+)", text)[1], re.findall(r'"([^"]*)"', files)

    def test_only_what_the_build_reads_makes_it_dirty(self) -> None:
        clean = (begin(self.root), "false", [])
        self.assertEqual(self.stamp(), clean)
        written = (self.folder / "build_info.cpp").stat().st_mtime_ns
        for name in ("best.json", "before.json", "report.html", "pairs.csv", "mine/plugin.cpp", "harness/best.json"):
            (self.root / name).parent.mkdir(exist_ok=True)
            (self.root / name).write_text("")
        (self.root / "README.md").write_text("changed")
        self.assertEqual(self.stamp(), clean)
        self.assertEqual((self.folder / "build_info.cpp").stat().st_mtime_ns, written, "it would be compiled again")
        git(self.root, "config", "status.showUntrackedFiles", "no")
        (self.root / "harness/ne w.h").write_text("")
        self.assertEqual(self.stamp(), (clean[0], "true", ["harness/ne w.h"]))
        (self.root / "harness/main.cpp").write_text("changed")
        self.assertEqual(self.stamp(), (clean[0], "true", ["harness/main.cpp", "harness/ne w.h"]))

    def test_the_commit_is_its_own_or_unknown(self) -> None:
        unknown = ("unknown", "true", [])
        self.assertEqual(self.stamp(), unknown)
        other = begin(self.folder / "other")
        self.assertEqual(self.stamp(), unknown)
        own = begin(self.root)
        self.assertNotEqual(own, other)
        self.assertEqual(self.stamp(GIT_DIR=str(self.folder / "other/.git"), GIT_WORK_TREE=str(self.folder / "other")), (own, "false", []))
        (self.folder / "link").symlink_to(self.root)
        self.assertEqual(self.stamp(self.folder / "link"), (own, "false", []))

    @unittest.skipIf(os.geteuid() != 0, "only root may give a file to another user")
    def test_a_checkout_of_another_user_is_unknown(self) -> None:
        begin(self.root)
        for path in (self.root, *self.root.rglob("*")):
            os.chown(path, NOBODY, NOBODY)
        self.assertEqual(self.stamp(), ("unknown", "true", []))

    def test_an_archive_has_its_commit(self) -> None:
        own = begin(self.root)
        begin(self.folder / "other")
        git(self.root, "archive", "--prefix=unpacked/", "-o", str(self.folder / "a.tar"), "HEAD")
        for place in (self.folder, self.folder / "other"):  # outside any repository, and in another one
            subprocess.run(["tar", "xf", self.folder / "a.tar", "-C", place], check=True)
            self.assertEqual(self.stamp(place / "unpacked"), (own, "false", []))
            later = time.time() + 10
            for name in ("README.md", "harness/main.cpp"):
                os.utime(place / "unpacked" / name, (later, later))
            self.assertEqual(self.stamp(place / "unpacked"), (own, "true", ["harness/main.cpp"]))
