#include "run/first_step.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "materials/user_law.hpp"

namespace strut {

void check_libraries(const Body& body, const StepControl& control, double limit) {
  const double whole = control.fixed_dt > 0 ? control.fixed_dt : control.safety_factor * limit;
  if (!std::isfinite(whole)) return;
  const std::vector<std::uint8_t>& levels = *body.time_levels;
  std::string problem;
  for (const MaterialBlock& block : body.blocks) {
    const auto* law = std::get_if<materials::UserLaw>(&block.material.law);
    if (!law) continue;
    int level = 0;
    for (const int i : block.points) level = std::max(level, levels.empty() ? 0 : static_cast<int>(levels[i]));
    const std::string stiff = materials::too_stiff_in(*law, std::ldexp(whole, -level));
    if (problem.empty() && !stiff.empty())
      problem = "Materials > " + law->name + " > Library: '" + law->function.file + "' " + stiff;
  }
  raise_together(body.domain.communicator, problem);
}

}  // namespace strut
