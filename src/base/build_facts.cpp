#include "base/build_facts.hpp"

#include <Trilinos_version.h>
#include <mpi.h>

#include <cctype>
#include <sstream>

namespace strut {

std::string strut_version() { return STRUT_VERSION; }

// "Open MPI v4.1.4, package: …", "MPICH Version:\t4.0.2", "MPI VERSION    : CRAY MPICH version 8.1 …", and more lines.
std::string mpi_library(std::string_view said) {
  std::istringstream words(std::string(said.substr(0, said.find_first_of(",\n"))));
  std::string name;
  for (std::string word; words >> word;) {
    if (word.size() > 1 && word[0] == 'v' && std::isdigit(static_cast<unsigned char>(word[1]))) word.erase(0, 1);
    if (word.ends_with(':')) word.pop_back();
    if (!word.empty()) name += (name.empty() ? "" : " ") + word;
  }
  return name;
}

std::string mpi_library() {
  char said[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(said, &length);  // may be called before MPI starts
  return mpi_library(std::string_view(said, static_cast<std::size_t>(length)));
}

std::string build_facts() {
  return "strut " + strut_version() + " (" + STRUT_COMPILER + ", " + STRUT_FLAGS + ", Trilinos " +
         TRILINOS_VERSION_STRING + ", " + mpi_library() + ")";
}

}  // namespace strut
