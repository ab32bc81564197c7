"""Tests that all files that name the version name that of the build, and that the container is what the README says."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]


def text(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


class Packaging(unittest.TestCase):
    def test_every_file_has_the_version_of_the_build(self) -> None:
        version = re.search(r"project\(bvhbench VERSION ([\d.]+) ", text("CMakeLists.txt"))[1]
        self.assertEqual(re.search(r"^## \[([^]]+)\]", text("CHANGELOG.md"), re.MULTILINE)[1], version)
        self.assertEqual(re.search(r"^version: (\S+)", text("CITATION.cff"), re.MULTILINE)[1], version)
        self.assertIn(f'"{version}"', text("library/include/bvhbench/oibvh.h"))

    def test_the_container_is_the_system_of_the_readme_and_builds_by_the_launcher(self) -> None:
        docker = text("packaging/Dockerfile")
        self.assertIn("\nFROM debian:12\n", docker)
        for command in ("./bvhbench reproduce table1", "./bvhbench test"):
            self.assertIn(command, docker)
            self.assertIn(command, text("README.md"))
        for line in text(".dockerignore").split():
            self.assertIn(line, ("build", "out"), "the commit is read from .git, so it is copied too")


if __name__ == "__main__":
    unittest.main()
