// The launcher of this process, from the environment: how many processes it started, and which one this is.
#pragma once

#include <string>

namespace strut {

struct Launch {
  std::string variable;  // environment variable with the number, e.g. "PMI_SIZE"; empty if there is none
  int processes = 1;
  int number = 0;  // of this process, from 0
};

// From mpirun of Open MPI, or of MPICH and its relatives, else from Slurm's srun, whose tasks may be the mpiruns.
Launch launch_of_process();

// Why `ranks` of a process are refused: a launcher of another MPI starts each process as a run of one rank, and all would
// do the same work. "" if it is none. `command`: of the process, for the message.
std::string wrong_launcher(const Launch& launch, int ranks, const std::string& command);

}  // namespace strut
