// Reads a finished result completely, for comparison.
#include "base/errors.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"

namespace strut::io {

ExodusResult read_result(const std::filesystem::path& path) {
  const ExodusFile file = ExodusFile::open(path);
  ExodusResult result;
  result.times = file.times();
  result.places = file.coordinates(0, file.sizes().nodes);
  result.nodal_names = file.variable_names(ExodusFile::On::nodes);
  result.element_names = file.variable_names(ExodusFile::On::elements);
  const int steps = static_cast<int>(result.times.size());
  result.nodal.resize(result.nodal_names.size());
  result.element.resize(result.element_names.size());
  for (int step = 0; step < steps; ++step) {
    for (std::size_t v = 0; v < result.nodal.size(); ++v) {
      result.nodal[v].push_back(file.nodal_values(step, static_cast<int>(v)));
    }
    for (std::size_t v = 0; v < result.element.size(); ++v) {
      result.element[v].push_back(file.element_values(step, static_cast<int>(v)));
    }
  }
  return result;
}

std::optional<double> last_time_of_result(const std::filesystem::path& file) {
  try {
    const std::vector<double> times = ExodusFile::open(file).times();
    if (!times.empty()) return times.back();
  } catch (const Error&) {
  }
  return std::nullopt;
}

}  // namespace strut::io
