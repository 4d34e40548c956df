#include "base/parallel/launch.hpp"

#include <cstdlib>
#include <optional>

#include "base/build_facts.hpp"

namespace strut {

namespace {

std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? whole_number(text) : std::nullopt;
}

}  // namespace

Launch launch_of_process() {
  struct Variables {
    const char *processes, *number;
  };
  for (const auto& [processes, number] :
       {Variables{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, Variables{"PMI_SIZE", "PMI_RANK"},
        Variables{"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}}) {
    if (const auto count = number_in(processes)) return {processes, *count, number_in(number).value_or(0)};
  }
  return {};
}

std::string wrong_launcher(const Launch& launch, int ranks, const std::string& command) {
  if (launch.processes <= 1 || ranks > 1) return "";
  return "one of " + std::to_string(launch.processes) + " processes (" + launch.variable +
         "), but each is a run of one rank: expected the mpirun of " + mpi_library() +
         ", with which strut was built, or srun with an --mpi that it knows ('srun --mpi=list'). Where these are meant "
         "to be runs of their own: 'env -u " +
         launch.variable + " " + command + "'";
}

}  // namespace strut
