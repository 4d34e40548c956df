#include "base/build_facts.hpp"

#include <Trilinos_version.h>
#include <mpi.h>

namespace strut {

std::string strut_version() { return STRUT_VERSION; }

std::string build_facts() {
  char library[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(library, &length);  // may be asked before MPI starts
  std::string mpi(library, static_cast<std::size_t>(length));
  mpi = mpi.substr(0, mpi.find_first_of(",\n"));
  if (const std::size_t end = mpi.find(" v"); end != std::string::npos) mpi.erase(end + 1, 1);
  return "strut " + strut_version() + " (" + STRUT_COMPILER + ", " + STRUT_FLAGS + ", Trilinos " +
         TRILINOS_VERSION_STRING + ", " + mpi + ")";
}

}  // namespace strut
