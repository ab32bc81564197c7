# SPDX-License-Identifier: MIT
"""Builds the Python module by CMake, without the program: pip install . (docs/python.md)."""
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, find_namespace_packages, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        module = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                        "-DBVHBENCH_BUILD_HARNESS=OFF", "-DBVHBENCH_WITH_MPI=OFF", "-DBVHBENCH_WITH_PYTHON=ON", "-DBUILD_TESTING=OFF",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "bvhbench_python"], check=True)
        module.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(next((build / "python/bvhbench").glob("_core.*"))), str(module))


PLOTS = ["", *("." + name for name in find_namespace_packages("plots"))]
setup(name="bvhbench",
      version=re.search(r"project\(bvhbench VERSION ([\d.]+) ", (ROOT / "CMakeLists.txt").read_text())[1],
      description="Pairs of triangles that overlap, intersect or are near, by Oi-BVHs on a processor or a GPU",
      license="MIT",
      python_requires=">=3.11",
      install_requires=["numpy"],
      extras_require={"results": ["pandas"]},
      packages=["bvhbench", *("bvhbench._plots" + name for name in PLOTS)],
      package_dir={"bvhbench": "python/bvhbench", "bvhbench._plots": "plots"},
      package_data={"bvhbench": ["py.typed"]},
      ext_modules=[Extension("bvhbench._core", [])],
      cmdclass={"build_ext": BuildByCMake})
