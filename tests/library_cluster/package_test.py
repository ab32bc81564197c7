#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Installs the package and builds the example of its component `cluster`, as a separate project without access to the source tree;
runs it on two ranks. Where MPI is missing, in the package or at its user, the package says so.

Usage: package_test.py <cmake> <build folder> <source root> <compiler> <library file> [<compiler flags>], as of
tests/library/install_test.py. Needs mpicxx and mpirun.
"""
import os
import pathlib
import shutil
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(sys.argv[3]) / "tests" / "library"))
from install_test import CLUSTER_HEADER, CMAKE, COMPILER, FLAGS, LIBRARY, ROOT, as_function, configure, examples, linked, moved, place, run, said_to_user  # noqa: E402, E501

# What mpirun needs of root, in containers and with more ranks than cores; the sanitizer would report what MPI keeps to its end.
RANKS = ("mpirun", "-np", "2", "--oversubscribe", "--bind-to", "none")
SETTINGS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "ASAN_OPTIONS": "detect_leaks=0"}

# What the guide's example uses but does not define.
GIVEN = ("MPI_Comm comm, cl_command_queue queue, const std::vector<oibvh::Point>& points, "
         "const std::vector<oibvh::Point>& moved, const std::vector<oibvh::Face>& faces, "
         "const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& vertices")

USER = """#include <bvhbench/oibvh_cluster.h>

#include <cstdio>

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    try {
        bvhbench::oibvh::DistributedTree(MPI_COMM_WORLD, nullptr);
    } catch (const bvhbench::oibvh::BadInput& error) {
        std::puts(error.what());
    }
    MPI_Finalize();
}
"""


def check_documents(folder: pathlib.Path, prefix: pathlib.Path) -> None:
    """Asserts that the guide's examples of the component compile unchanged."""
    blocks = [block for block in examples("docs/library.md") if "DistributedTree" in block]
    assert blocks
    source = folder / "documents.cpp"
    source.write_text("#include <bvhbench/oibvh_cluster.h>\nnamespace oibvh = bvhbench::oibvh;\n" +
                      as_function(blocks, "example", GIVEN))
    run("mpicxx", "-std=c++20", "-fsyntax-only", "-DCL_TARGET_OPENCL_VERSION=120", f"-I{prefix / 'include'}", source)


def check_pkg_config(folder: pathlib.Path, prefix: pathlib.Path, libraries: dict[str, str]) -> None:
    """Asserts that pkg-config's flags and MPI's compiler command compile and link a program. Its error is caught by its type."""
    _, program = linked("mpicxx", "bvhbench-oibvh-cluster", USER, folder, prefix)
    said = run(*RANKS, program, **SETTINGS, **libraries)
    assert said == 2 * "a Device wants a cl_command_queue, and it is null\n", said


def check_example(project: pathlib.Path, prefix: pathlib.Path, libraries: dict[str, str]) -> None:
    """Asserts that the example finds on two ranks what one device does."""
    shutil.copytree(pathlib.Path(ROOT) / "examples" / "cluster", project)
    run(*configure(project, prefix), f"-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror {FLAGS}")
    run(CMAKE, "--build", project / "build")
    said = run(*RANKS, project / "build" / "sheets", **SETTINGS, **libraries)
    assert said.count("on 2 ranks") == said.count(": the same;") == 4, said


def check_absence(folder: pathlib.Path, prefix: pathlib.Path) -> None:
    """Asserts that the package says why it lacks the component: MPI was missing where it was built, or is where it is used."""
    asks = "find_package(bvhbench)\nfind_package(bvhbench REQUIRED COMPONENTS cluster)"
    assert "its component cluster needs MPI 3.0, which was not found" in said_to_user(
        folder / "without-mpi", prefix, asks, "-DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON")
    alone, without = folder / "alone", folder / "without"
    run(CMAKE, "-S", ROOT, "-B", alone, f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DBVHBENCH_BUILD_HARNESS=OFF", "-DBVHBENCH_WITH_MPI=OFF")
    (alone / "library" / "libbvhbench-oibvh.a").touch()  # not built: only the package's files are of interest
    run(CMAKE, "--install", alone, "--prefix", without)
    assert not (without / CLUSTER_HEADER).exists()
    assert "its component cluster is missing, because it was built without MPI" in said_to_user(folder / "no-component", without, asks)


def check_symbols(prefix: pathlib.Path) -> None:
    """Asserts that a shared library shows DistributedTree and the types of errors, and nothing else."""
    library = next(prefix.rglob("libbvhbench-oibvh-cluster.so"))
    names = run("nm", "-DC", "--defined-only", library).splitlines()
    strange = [name for name in names if "DistributedTree::" not in name and " for bvhbench::oibvh::" not in name]
    assert len(names) > 10 and not strange, strange


def main() -> int:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix = moved(folder)
        header = (prefix / CLUSTER_HEADER).read_text()
        assert 'include "' not in header and ROOT not in header
        of_cluster = LIBRARY.replace("-oibvh.", "-oibvh-cluster.")
        where = place(prefix, pathlib.Path(of_cluster).name)
        libraries = {"LD_LIBRARY_PATH": os.pathsep.join([where, os.environ.get("LD_LIBRARY_PATH", "")]).rstrip(os.pathsep)}
        if LIBRARY.endswith(".so"):
            check_symbols(prefix)
        check_documents(folder, prefix)
        check_pkg_config(folder, prefix, libraries)
        check_example(folder / "project", prefix, libraries)
        check_absence(folder, prefix)
    print("installed, moved, found, built against and run on two ranks")
    return 0


if __name__ == "__main__":
    sys.exit(main())
