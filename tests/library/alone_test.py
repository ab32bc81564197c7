#!/usr/bin/env python3
"""The library alone needs only OpenCL: it configures with all other packages disabled, and its objects include no headers but
the project's, the system's and OpenCL's.

Usage: alone_test.py <cmake> <ninja> <build folder> <source root> <compiler>

The test does not build the library again, which takes a minute; .ci/nightly does. It reads the included headers from the
whole build, whose sources and compiler options for the library are the same.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

CMAKE, NINJA, BUILD, ROOT, COMPILER = sys.argv[1:6]
OTHERS = ("assimp", "benchmark", "nlohmann_json", "CLI11", "embree", "fcl", "CGAL", "GTest", "Boost", "TBB", "Eigen3", "MPI")
ROOMS = ("geometry", "device", "builders", "oibvh", "collide", "library")
TOGETHER = re.compile(r'^#include "(.*)"$', re.MULTILINE)
# Headers directly in /usr/include can be included even if their package was not requested.
SYSTEM = re.compile(r"^/usr/(?:include/(?:c\+\+/|x86_64-linux-gnu/|\w+-linux-gnu/|CL/|linux/|asm-generic/|[\w-]+\.h$|"
                    r"(?:bits|sys|gnu|rpc)/)|lib/|local/lib/)")


def sources_of(commands: pathlib.Path) -> dict[str, str]:
    """Returns the compile command of each source in the library's rooms, by its path from the source root. Sources that are compiled
    as one are included by a file of CMake's."""
    found = {}
    for command in json.loads(commands.read_text()):
        path = pathlib.Path(command["file"])
        for source in map(pathlib.Path, TOGETHER.findall(path.read_text())) if path.parent.name == "Unity" else [path]:
            if source.is_relative_to(ROOT) and source.relative_to(ROOT).parts[0] in ROOMS:
                found[source.relative_to(ROOT).as_posix()] = command["command"]
    return found


def strange_headers() -> list[str]:
    """Returns headers that objects of the library's rooms include and that are not the project's, the system's or OpenCL's."""
    said = subprocess.run([NINJA, "-C", BUILD, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    strange, objects, ours = set(), 0, False
    for line in said.splitlines():
        if line and not line.startswith(" "):
            name = line.split(":")[0]
            # exact_reference has its own target, which is not part of the library.
            ours = name.split("/")[0] in ROOMS and "exact_reference.dir" not in name
            objects += ours
        elif ours and line.strip():
            path = (pathlib.Path(BUILD) / line.strip()).resolve()
            if not path.is_relative_to(ROOT) and not SYSTEM.match(line.strip()):
                strange.add(line.strip())
    assert objects >= 10, f"{objects} objects of the rooms: this test looks in the wrong place"
    return sorted(strange)


def main() -> int:
    assert strange_headers() == [], strange_headers()
    with tempfile.TemporaryDirectory() as name:
        alone = pathlib.Path(name)
        done = subprocess.run(
            [CMAKE, "-S", ROOT, "-B", alone, "-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={NINJA}",
             f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DCMAKE_BUILD_TYPE=Release", "-DBVHBENCH_BUILD_HARNESS=OFF",
             "-DBVHBENCH_WITH_MPI=OFF",
             *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{package}=ON" for package in OTHERS)],
            capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        # CMake warns of variables that were never read, so a warning for each package shows that none was searched for.
        unasked = set(re.findall(r"^ +CMAKE_DISABLE_FIND_PACKAGE_(\w+)$", done.stderr, re.MULTILINE))
        assert unasked == set(OTHERS), set(OTHERS) - unasked
        here, whole = sources_of(alone / "compile_commands.json"), sources_of(pathlib.Path(BUILD) / "compile_commands.json")
        # A build with CGAL has the first three files, a build without CGAL the last.
        only_one = {f"collide/oracles/{name}.cpp" for name in ("exact_reference", "swept_reference", "cgal_pairs", "no_exact_reference")}
        assert set(here) - only_one == set(whole) - only_one, set(here) ^ set(whole)
        march = [path for path, command in here.items() if "-march" in command]
        assert not march, f"compiled for one kind of processor only: {march}"
        assert all("-fPIC" in command for command in here.values())
        targets = subprocess.run([NINJA, "-C", alone, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
        assert re.search(r"^library/libbvhbench-oibvh\.a: CXX_STATIC_LIBRARY_LINKER", targets, re.MULTILINE), targets
        assert ": CXX_EXECUTABLE_LINKER" not in targets, targets
    print(f"{len(here)} sources, OpenCL and nothing else")
    return 0


if __name__ == "__main__":
    sys.exit(main())
