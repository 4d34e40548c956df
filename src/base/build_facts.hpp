// Who wrote a file, and how it was built: for every output, and for reports of errors.
#pragma once

#include <string>
#include <string_view>

namespace strut {

std::string strut_version();  // "0.1"
std::string mpi_library();    // that runs, "Open MPI 4.1.4"

// What MPI_Get_library_version says, shortened to its name and version.
std::string mpi_library(std::string_view said);

// "strut 0.1 (GCC 12.2.0, -O3 …, Trilinos 13.2, Open MPI 4.1.4)", on one line.
std::string build_facts();

}  // namespace strut
