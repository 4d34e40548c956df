# The libraries strut stands on, all Debian packages (tools/packages lists them). Everything is included as SYSTEM.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(GTest REQUIRED)
find_package(benchmark REQUIRED)
find_library(EXODUS_LIBRARY NAMES exoIIv2c exodus REQUIRED)
find_library(NETCDF_LIBRARY NAMES netcdf REQUIRED)
find_library(VORO_LIBRARY voro++ REQUIRED)
find_path(VORO_INCLUDE_DIR voro++/voro++.hh REQUIRED)

# Debian's Trilinos: headers in one folder, libraries with one prefix. Naming the libraries is shorter than its
# exported targets, which pull in every package that Debian built.
find_path(TRILINOS_INCLUDE_DIR Teuchos_ParameterList.hpp PATH_SUFFIXES trilinos REQUIRED)
function(strut_trilinos target)
  add_library(${target} INTERFACE)
  target_include_directories(${target} SYSTEM INTERFACE ${TRILINOS_INCLUDE_DIR})
  foreach(name IN LISTS ARGN)
    find_library(TRILINOS_${name} trilinos_${name} REQUIRED)
    target_link_libraries(${target} INTERFACE ${TRILINOS_${name}})
  endforeach()
  target_link_libraries(${target} INTERFACE MPI::MPI_CXX)
endfunction()

strut_trilinos(trilinos_teuchos teuchoscore teuchosparser teuchosparameterlist teuchoscomm)
strut_trilinos(trilinos_kokkos kokkoscore)
strut_trilinos(trilinos_tpetra tpetra teuchosparameterlist teuchoscomm teuchoscore kokkoscore)
strut_trilinos(trilinos_krylov muelu muelu-adapters muelu-interface belostpetra belos ifpack2 xpetra xpetra-sup
  amesos2 tpetra teuchosnumerics teuchosparameterlist teuchoscomm teuchoscore kokkoscore)
strut_trilinos(trilinos_zoltan zoltan)
