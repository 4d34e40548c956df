#include "base/parallel/launch.hpp"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace strut {

namespace {

std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (!text) return std::nullopt;
  const std::string_view digits(text);
  int number = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (problem != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
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

}  // namespace strut
