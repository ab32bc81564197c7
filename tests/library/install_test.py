#!/usr/bin/env python3
"""Installs the library and builds the examples against it as a separate project without access to the source tree.

Usage: install_test.py <cmake> <build folder> <source root> <compiler> <library file> [<compiler flags>]

The build folder must contain the built library. The flags are compiler flags that users of the library need as well, such as a
sanitizer's. The installed files are moved before use, to show that the package contains no absolute paths.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CMAKE, BUILD, ROOT, COMPILER, LIBRARY = sys.argv[1:6]
FLAGS = sys.argv[6] if len(sys.argv) > 6 else ""
CLUSTER_HEADER = "include/bvhbench/oibvh_cluster.h"  # tests/library_cluster/package_test.py tests its component


def run(*words, fails: bool = False, **environment: str) -> str:
    """Runs a command and returns its output. Asserts that it succeeds or, with `fails`, that it fails."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=600, check=False,
                          env={**os.environ, **environment})
    said = done.stdout + done.stderr
    assert (done.returncode != 0) == fails, f"{' '.join(map(str, words))} ended with {done.returncode}:\n{said}"
    return said


def installed(prefix: pathlib.Path) -> list[str]:
    return sorted(path.relative_to(prefix).as_posix() for path in prefix.rglob("*") if not path.is_dir())


def check_files(prefix: pathlib.Path) -> None:
    """Asserts that the header, that of plug-ins, one library, the package files and the licence are installed, free of local paths and -march."""
    names = [pathlib.PurePath(name).name for name in installed(prefix)]
    headers = [name for name in installed(prefix) if name.endswith((".h", ".hpp", ".clh", ".cl"))]
    assert set(headers) - {CLUSTER_HEADER} == {"include/bvhbench/oibvh.h", "include/bvhbench/plugin.h"}, headers
    assert names.count(pathlib.Path(LIBRARY).name) == 1, names
    package = {"bvhbench-oibvh.pc", "bvhbenchConfig.cmake", "bvhbenchConfigVersion.cmake", "bvhbenchTargets.cmake", "LICENSE"}
    assert package <= set(names), names
    for path in prefix.rglob("*"):
        if path.suffix not in (".cmake", ".h", ".pc"):
            continue
        text = path.read_text()
        for word in (ROOT, BUILD, "-march", "project_flags"):
            assert word not in text, f"{path.name} says {word}"
    header = (prefix / "include/bvhbench/oibvh.h").read_text()
    included = [line for line in header.splitlines() if line.startswith("#include")]
    assert all("<CL/cl.h>" in line or "/" not in line for line in included), included
    assert not any('"' in line for line in included), included


# Parameters that declare the names which the documents' examples use but do not define.
GIVEN = ("cl_command_queue queue, cl_mem points, std::size_t point_count, cl_mem faces, std::size_t face_count, "
         "std::uint32_t cloth_faces, std::uint32_t ball_faces, std::span<const bvhbench::oibvh::Point> link_points, "
         "std::span<const bvhbench::oibvh::Face> link_faces, const bvhbench::oibvh::Input& input, const bvhbench::oibvh::Input& moved, "
         "const bvhbench::oibvh::Input& scene, const bvhbench::oibvh::Input& frame, bvhbench::oibvh::Tree& world")


def examples(document: str) -> list[str]:
    """Returns the C++ examples of a document that use a public header."""
    blocks = re.findall(r"```cpp\n(.*?)```", (pathlib.Path(ROOT) / document).read_text(), re.DOTALL)
    return [block for block in blocks if "oibvh" in block or document.startswith("docs")]


def as_function(blocks: list[str], name: str, parameters: str) -> str:
    """Returns the examples as the body of a function, behind their includes."""
    lines = "".join(blocks).splitlines(keepends=True)
    outside = [line for line in lines if line.startswith(("#include", "namespace"))]
    inside = [line for line in lines if line not in outside]
    return f"{''.join(outside)}void {name}({parameters})\n{{\n{''.join(inside)}}}\n"


def check_documents(folder: pathlib.Path, prefix: pathlib.Path) -> None:
    """Asserts that the C++ examples of the guide and of the README compile unchanged."""
    text, count = "", 0
    for document in ("docs/library.md", "README.md"):
        blocks = [block for block in examples(document) if "DistributedTree" not in block]
        count += len(blocks)
        text += as_function(blocks, f"example_{len(text)}", GIVEN)
    assert count >= 4, count
    source = folder / "documents.cpp"
    source.write_text(text)
    run(COMPILER, "-std=c++20", "-fsyntax-only", "-DCL_TARGET_OPENCL_VERSION=120", f"-I{prefix / 'include'}", source)


USER = """#include <bvhbench/oibvh.h>

#include <iostream>

int main() { std::cout << bvhbench::oibvh::version() << std::endl; }
"""


def place(prefix: pathlib.Path, name: str) -> str:
    """Returns the folder of an installed file."""
    return str(next(prefix.rglob(name)).parent)


def linked(compiler: str, package: str, user: str, folder: pathlib.Path, prefix: pathlib.Path) -> tuple[str, pathlib.Path]:
    """Compiles and links a program by pkg-config's flags. Returns the package's version, as it says, and the program."""
    where = {"PKG_CONFIG_PATH": place(prefix, f"{package}.pc")}
    flags = run("pkg-config", "--cflags", "--libs", package, **where).split()
    source, program = folder / "user.cpp", folder / "user"
    source.write_text(user)
    run(compiler, "-std=c++20", *FLAGS.split(), "-DCL_TARGET_OPENCL_VERSION=120", source, "-o", program, *flags)
    return run("pkg-config", "--modversion", package, **where).strip(), program


def configure(project: pathlib.Path, prefix: pathlib.Path) -> list[str]:
    return [CMAKE, "-S", str(project), "-B", str(project / "build"), f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={COMPILER}"]


def said_to_user(project: pathlib.Path, prefix: pathlib.Path, asks: str, *options: str) -> str:
    """Configures a project that asks for the package in vain, and returns what CMake says, as one line."""
    project.mkdir()
    (project / "CMakeLists.txt").write_text(f"cmake_minimum_required(VERSION 3.16)\nproject(user LANGUAGES CXX)\n{asks}\n")
    return " ".join(run(*configure(project, prefix), *options, fails=True).split())


def moved(folder: pathlib.Path) -> pathlib.Path:
    """Installs into a folder, moves what was installed, and returns where it is."""
    run(CMAKE, "--install", BUILD, "--prefix", folder / "first")
    (folder / "moved").mkdir()
    return (folder / "first").rename(folder / "moved" / "prefix")


def main() -> int:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = moved(folder)
        check_files(prefix)
        check_documents(folder, prefix)

        project = folder / "project"
        shutil.copytree(pathlib.Path(ROOT) / "examples" / "oibvh", project)
        build = project / "build"
        run(*configure(project, prefix), "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", f"-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror {FLAGS}")
        commands = (build / "compile_commands.json").read_text()
        of_package = commands.replace(FLAGS, "")
        assert "-march" not in of_package and ROOT not in of_package, commands
        run(CMAKE, "--build", build, "--parallel", "2")

        version = next(prefix.rglob("bvhbenchConfigVersion.cmake")).read_text().split('PACKAGE_VERSION "')[1].split('"')[0]
        shared = {"LD_LIBRARY_PATH": place(prefix, pathlib.Path(LIBRARY).name)}
        packaged, program = linked(COMPILER, "bvhbench-oibvh", USER, folder, prefix)
        assert packaged == version and run(program, **shared) == f"{version}\n", packaged

        # The programs must run without the source tree and without the installed headers.
        shutil.rmtree(prefix / "include")
        nowhere = {"BVHBENCH_KERNELS": str(folder / "nowhere")}
        said = run(build / "torus", **nowhere, **shared)
        assert said.startswith(f"bvhbench {version}\n"), said
        assert "4800 leaves on level 13 of 14, 9603 nodes of 24 bytes" in said, said
        assert "31485 pairs" in said and "the same" in said, said
        said = run(build / "own_kernel", **nowhere, **shared)
        assert said == "2400 points lie in 14500 boxes; 0 counts differ from brute force\n", said
        said = said_to_user(folder / "newer", prefix, "find_package(bvhbench 99 REQUIRED)")
        assert "bvhbenchConfig.cmake, version:" in said, said
    print("installed, moved, found, built against and run")
    return 0


if __name__ == "__main__":
    sys.exit(main())
