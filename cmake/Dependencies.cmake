# The libraries strut stands on: Debian 12's packages (tools/packages lists them), or any in CMAKE_PREFIX_PATH.
# Everything is included as SYSTEM.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(OpenMP COMPONENTS CXX)  # without it ranks have one thread
find_package(Eigen3 REQUIRED NO_MODULE)
# The module is for the Python of the tools, whose first lines name it, unless another one is named.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
if(Python3_FOUND)
  find_package(pybind11 QUIET CONFIG)
endif()
if(NOT pybind11_FOUND)
  set(pybind11_FOUND OFF)
  message(STATUS "without the module for Python: its headers or pybind11 are not there")
endif()
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
endif()
if(STRUT_BENCHES)
  find_package(benchmark REQUIRED)
endif()
if(STRUT_TOOLS)
  find_library(VORO_LIBRARY voro++ REQUIRED)
  find_path(VORO_INCLUDE_DIR voro++/voro++.hh REQUIRED)
endif()

find_library(EXODUS_LIBRARY NAMES exoIIv2c exodus NAMES_PER_DIR REQUIRED)  # Debian's name, Exodus' own
find_path(EXODUS_INCLUDE_DIR exodusII.h REQUIRED)
find_library(NETCDF_LIBRARY NAMES netcdf REQUIRED)
find_path(NETCDF_INCLUDE_DIR netcdf.h REQUIRED)
add_library(with_exodus INTERFACE)
target_include_directories(with_exodus SYSTEM INTERFACE ${EXODUS_INCLUDE_DIR} ${NETCDF_INCLUDE_DIR})
target_link_libraries(with_exodus INTERFACE ${EXODUS_LIBRARY} ${NETCDF_LIBRARY})

# Trilinos (14 and later) exports a target for each of its packages. 13.2 does not, and in Debian 12 its configuration of
# MueLu asks for packages that are not there: headers in one folder, libraries by their names, Debian's with a prefix.
find_package(Tpetra QUIET CONFIG)
if(TARGET Tpetra::all_libs)
  set(STRUT_TRILINOS "exported targets, ${Tpetra_DIR}")
else()
  find_path(TRILINOS_INCLUDE_DIR Teuchos_ParameterList.hpp PATH_SUFFIXES trilinos REQUIRED)
  set(STRUT_TRILINOS "libraries by their names, ${TRILINOS_INCLUDE_DIR}")
endif()
message(STATUS "Trilinos: ${STRUT_TRILINOS}")

# strut_trilinos(TARGET PACKAGES packages that export targets… LIBRARIES names, where there are no targets…)
function(strut_trilinos target)
  cmake_parse_arguments(trilinos "" "" "PACKAGES;LIBRARIES" ${ARGN})
  add_library(${target} INTERFACE)
  if(TARGET Tpetra::all_libs)
    foreach(package IN LISTS trilinos_PACKAGES)
      if(NOT TARGET ${package}::all_libs)
        find_package(${package} REQUIRED CONFIG)
      endif()
      target_link_libraries(${target} INTERFACE ${package}::all_libs)
    endforeach()
  else()
    target_include_directories(${target} SYSTEM INTERFACE ${TRILINOS_INCLUDE_DIR})
    foreach(name IN LISTS trilinos_LIBRARIES)
      find_library(TRILINOS_${name} NAMES trilinos_${name} ${name} NAMES_PER_DIR REQUIRED)
      target_link_libraries(${target} INTERFACE ${TRILINOS_${name}})
    endforeach()
  endif()
  target_link_libraries(${target} INTERFACE MPI::MPI_CXX)
endfunction()

strut_trilinos(with_teuchos PACKAGES Teuchos
               LIBRARIES teuchoscore teuchosparser teuchosparameterlist teuchoscomm)
strut_trilinos(with_kokkos PACKAGES Kokkos LIBRARIES kokkoscore)
strut_trilinos(with_tpetra PACKAGES Tpetra
               LIBRARIES tpetra teuchosparameterlist teuchoscomm teuchoscore kokkoscore)
strut_trilinos(with_krylov PACKAGES MueLu Belos Ifpack2 Xpetra Amesos2 Tpetra
               LIBRARIES muelu muelu-adapters muelu-interface belostpetra belos ifpack2 xpetra xpetra-sup amesos2 tpetra
                         teuchosnumerics teuchosparameterlist teuchoscomm teuchoscore kokkoscore)
strut_trilinos(with_zoltan PACKAGES Zoltan LIBRARIES zoltan)
