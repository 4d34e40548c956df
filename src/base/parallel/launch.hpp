// The launcher of this process, from the environment: how many processes it started, and which one this is.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace strut {

struct Launch {
  std::string variable;  // environment variable with the number, e.g. "PMI_SIZE"; empty if there is none
  int processes = 1;
  int number = 0;  // of this process, from 0
};

// By mpirun of Open MPI, or of MPICH and its relatives, else by Slurm's srun, whose tasks may be processes of mpirun.
Launch launch_of_process();

// Why `ranks` of a process are refused: a launcher of another MPI starts each process as a run of one rank, and all
// would do the same work. "" if it is none. `command`: of the process, for the message.
std::string wrong_launcher(const Launch& launch, int ranks, const std::string& command);

// The integer in a word of a command line or of the environment; nullopt if the word is anything else, or exceeds an
// int.
inline std::optional<int> whole_number(std::string_view word) {
  int number = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, problem] = std::from_chars(word.data(), end, number);
  if (problem != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace strut
