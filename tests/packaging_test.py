"""Tests the files of packaging/ against the build, the lists of packages and the version. Builds nothing."""
import ast
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
PACKAGING = ROOT / "packaging"
# What each dependency of Spack and conda is in packages.txt.
DEBIAN = {"cxx": "build-essential", "cmake": "cmake", "ninja": "ninja-build", "git": "git", "opencl": "ocl-icd-opencl-dev",
          "ocl-icd": "ocl-icd-opencl-dev", "opencl-clhpp": "opencl-clhpp-headers", "assimp": "libassimp-dev",
          "nlohmann-json": "nlohmann-json3-dev", "cli11": "libcli11-dev", "re2": "libre2-dev", "embree": "libembree-dev",
          "fcl": "libfcl-dev", "cgal": "libcgal-dev", "mpi": "libopenmpi-dev", "python": "python3"}


def text(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def debian(name: str) -> str:
    return f"python3-{name[3:]}" if name.startswith("py-") else DEBIAN[name]


def listed() -> set[str]:
    return {line.split("#")[0].strip() for line in text("packages.txt").splitlines()} - {""}


class Packaging(unittest.TestCase):
    def setUp(self) -> None:
        self.version = re.search(r"project\(bvhbench VERSION ([\d.]+) ", text("CMakeLists.txt"))[1]
        self.spack = ast.parse(text("packaging/spack/package.py"))  # its syntax

    def calls(self, name: str) -> list[ast.Call]:
        return [node for node in ast.walk(self.spack) if isinstance(node, ast.Call)
                and (getattr(node.func, "id", "") == name or getattr(node.func, "attr", "") == name)]

    def test_every_file_has_the_version_of_the_build(self) -> None:
        self.assertEqual(re.search(r"^## \[([^]]+)\]", text("CHANGELOG.md"), re.MULTILINE)[1], self.version)
        self.assertEqual(re.search(r"^version: (\S+)", text("CITATION.cff"), re.MULTILINE)[1], self.version)
        self.assertEqual(re.search(r'set version = "([^"]+)"', text("packaging/conda/meta.yaml"))[1], self.version)
        self.assertIn(self.version, [call.args[0].value for call in self.calls("version")])
        self.assertIn(f'"{self.version}"', text("library/include/bvhbench/oibvh.h"))

    def test_dependencies_are_those_of_the_lists(self) -> None:
        names = [call.args[0].value.split("@")[0] for call in self.calls("depends_on")]
        conda = re.findall(r"^    - ([\w-]+)", text("packaging/conda/meta.yaml").split("requirements:")[1].split("test:")[0], re.MULTILINE)
        self.assertGreater(len(names), 10)
        self.assertGreater(len(conda), 3)
        self.assertEqual({debian(name) for name in [*names, *conda]} - listed(), set())

    def test_cmake_options_exist(self) -> None:
        known = set(re.findall(r"(?:option|set)\((BVHBENCH_\w+)", text("CMakeLists.txt"))) | {"BUILD_SHARED_LIBS", "BUILD_TESTING"}
        known |= {f"BVHBENCH_WITH_{name}" for name in re.findall(r"optional_library\((\w+) ", text("CMakeLists.txt"))}
        used = {call.args[0].value for name in ("define", "define_from_variant") for call in self.calls(name)}
        used |= set(re.findall(r"-D((?:BVHBENCH|BUILD)_\w+)", text("packaging/conda/meta.yaml")))
        self.assertGreater(len(used), 3)
        self.assertEqual(used - known, set())
        variants = {call.args[0].value for call in self.calls("variant")}
        self.assertEqual({call.args[1].value for call in self.calls("define_from_variant")} - variants, set())

    def test_the_container_is_the_system_of_the_readme_and_builds_by_the_launcher(self) -> None:
        docker = text("packaging/Dockerfile")
        self.assertIn("\nFROM debian:12\n", docker)
        for command in ("./bvhbench reproduce table1", "./bvhbench test"):
            self.assertIn(command, docker)
            self.assertIn(command, text("README.md"))
        for line in text(".dockerignore").split():
            self.assertIn(line, ("build", "out"), "the commit is read from .git, so it is copied too")

    def test_what_the_recipe_looks_for_is_installed(self) -> None:
        for path in re.findall(r"test -f \$PREFIX/(\S+)", text("packaging/conda/meta.yaml")):
            self.assertIn(pathlib.PurePath(path).name, text("library/CMakeLists.txt"))
