// Who wrote a file, and how it was built: for every output, and for reports of errors.
#pragma once

#include <string>

namespace strut {

std::string strut_version();  // "0.1"

// "strut 0.1 (GCC 12.2.0, -O3 …, Trilinos 13.2, Open MPI 4.1.4)", on one line.
std::string build_facts();

}  // namespace strut
