// What started this process says of it, in the environment: how many processes it started, and which of them this is.
#pragma once

#include <string>

namespace strut {

struct Launch {
  std::string variable;  // the environment's variable that told, "PMI_SIZE" say; empty where nothing did
  int processes = 1;
  int number = 0;  // of this one, from 0
};

// As mpirun of Open MPI or of MPICH and its kin says, or else Slurm's srun, whose tasks may be the mpiruns themselves.
Launch launch_of_process();

}  // namespace strut
