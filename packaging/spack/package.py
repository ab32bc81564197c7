from spack.package import *


class Bvhbench(CMakePackage):
    """Oi-BVH on an OpenCL queue as a library, and a program that compares builders of bounding volume hierarchies."""

    homepage = "https://example.org/bvhbench"  # fill in: the address of the project
    git = "https://example.org/bvhbench.git"  # fill in

    license("MIT")

    version("0.2.0", tag="v0.2.0")
    version("main", branch="main")

    variant("harness", default=True, description="The program besides the library")
    variant("shared", default=False, description="A shared library")
    variant("mpi", default=True, description="One scene on several devices: the command cluster, and the library's component")

    depends_on("cxx", type="build")
    depends_on("cmake@3.24:", type="build")
    depends_on("ninja", type="build")
    depends_on("opencl")
    depends_on("opencl-clhpp")
    depends_on("mpi", when="+mpi")
    with when("+harness"):
        depends_on("git", type="build")
        depends_on("assimp")
        depends_on("nlohmann-json")
        depends_on("cli11")
        depends_on("re2")
        depends_on("embree@3")
        depends_on("fcl@0.7:")
        depends_on("cgal@5.5:5")
        depends_on("python@3.11:", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-pandas", type="run")
        depends_on("py-plotly", type="run")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("BVHBENCH_BUILD_HARNESS", "harness"),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("BVHBENCH_WITH_MPI", "mpi"),
            self.define("BVHBENCH_INSTALL", True),
            self.define("BVHBENCH_ARCH", ""),
            self.define("BUILD_TESTING", False),
        ]
