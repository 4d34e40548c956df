// Program and build that wrote a file: for every output, and for error reports.
#pragma once

#include <string>
#include <string_view>

namespace strut {

std::string strut_version();  // "0.1"
std::string mpi_library();    // of the running library, "Open MPI 4.1.4"

// The result of MPI_Get_library_version, shortened to name and version.
std::string mpi_library(std::string_view said);

// "strut 0.1 (GCC 12.2.0, -O3 …, Trilinos 13.2, Open MPI 4.1.4)", on one line.
std::string build_facts();

}  // namespace strut
