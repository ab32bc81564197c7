#!/usr/bin/env python3
"""Builds the package of Debian, unpacks it into a folder, and uses the program and the Python module there.

Usage: package_test.py <cpack> <build folder>
"""
import os
import pathlib
import subprocess
import sys
import tempfile

CPACK, BUILD = sys.argv[1:]
LATER = """import bvhbench, numpy
points = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [.2, .2, -1], [.2, .2, 1], [2, .2, 0]], float)
tree = bvhbench.Tree(points, [[0, 1, 2], [3, 4, 5]])
assert tree.contacts().tolist() == [[0, 1]], tree.contacts()
assert set(bvhbench.read("c.json").collider) == {"group"}"""

with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    own = {key: value for key, value in os.environ.items() if key != "BVHBENCH_HOME"}

    def expect(code: int, *words: str, says: str = "", **environment: str) -> None:
        done = subprocess.run(words, capture_output=True, text=True, check=False, env=own | environment)
        assert done.returncode == code and says in done.stdout + done.stderr, (words, done)

    expect(0, CPACK, "-G", "DEB", "--config", f"{BUILD}/CPackConfig.cmake", "-B", folder)
    package, = pathlib.Path(folder).glob("bvhbench_*.deb")
    expect(0, "dpkg-deb", "-f", str(package), "Depends", says="python3-numpy")
    expect(0, "dpkg-deb", "-x", str(package), "root")
    program = f"{folder}/root/usr/bin/bvhbench"
    pathlib.Path("mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv .2 .2 -1\nv .2 .2 1\nv 2 .2 0\nf 1 2 3\nf 4 5 6\n")
    expect(0, program, "list", "builders", says="oibvh-multi")
    expect(0, program, "collide", "--scene", "mesh.obj", "--narrow", "exact", "--json", "c.json", says="contacts_count 1")
    expect(0, program, "best", "mesh.obj", "--builders", "karras,oibvh-multi", "--colliders", "leaf", says="\ntake `leaf` over ")
    expect(0, program, "show", "c.json", says="verdict: agrees")
    expect(0, program, "reproduce", "table1", "--quick", says="written: ")
    expect(0, sys.executable, "-c", LATER, PYTHONPATH=f"{folder}/root/usr/lib/python3/dist-packages")
    pathlib.Path("root/usr/share/bvhbench/plots").rename("plots")  # which is what was used, not the sources
    expect(3, program, "show", "c.json", says="root/usr/share/bvhbench/plots/__main__.py is not there")
