"""strut for Spack from 1.0 on (checked against its documentation, not run), from a working copy:
`spack repo add cmake/spack/spack_repo/strut && spack dev-build strut@main`."""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Strut(CMakePackage):
    """Correspondence peridynamics of foams and bars under impact."""

    version("main")  # of a working copy

    variant("tools", default=True, description="strut-mesh, strut-point and strut-evaluate")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("mpi")
    depends_on("eigen@3.4:")
    depends_on("netcdf-c")
    depends_on("trilinos@14:16 cxxstd=17 +mpi +kokkos +tpetra +amesos2 +belos +ifpack2 +muelu +zoltan +exodus ~openmp")
    depends_on("voropp", when="+tools")

    conflicts("%gcc@:11")
    conflicts("%clang@:16")

    def cmake_args(self):  # -march comes from Spack's target
        return [self.define_from_variant("STRUT_TOOLS", "tools"), self.define("BUILD_TESTING", False)]
