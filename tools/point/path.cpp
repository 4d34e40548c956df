#include "point/path.hpp"

#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/numbers.hpp"

namespace strut::point {
namespace {

const std::string columns = "seven numbers separated by commas: time, xx, yy, zz, xy, yz, zx";

// The numbers of `line`, separated by commas, or nullopt.
std::optional<std::vector<double>> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  for (const std::string& cell : to_cells(line)) {
    const auto number = to_finite(cell);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

// The error of the next row, or nothing.
std::string problem_of(const std::vector<Row>& rows, const Row& row) {
  if (rows.empty()) return row.value.isZero(0) ? "" : "the first row is the unloaded start: all its components are 0";
  return row.time > rows.back().time ? "" : "the time does not rise";
}

}  // namespace

Path uniaxial(const StressPrescribed& prescribed, double rate, double final) {
  Path path{prescribed, {{0, Symmetric::Zero()}, {std::abs(final) / rate, Symmetric::Zero()}}};
  path.rows[1].value[0] = final;
  return path;
}

Path read_path(const std::filesystem::path& file, const StressPrescribed& prescribed) {
  if (const std::string why = unreadable(file); !why.empty()) throw Error(why);
  std::ifstream in(file);
  Path path{prescribed, {}};
  std::string line;
  bool header_allowed = true;
  for (int number = 1; std::getline(in, line); ++number) {
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    const std::string place = file.string() + ":" + std::to_string(number) + ": ";
    const auto numbers = numbers_of(line);
    const bool header = header_allowed && !numbers;
    header_allowed = false;
    if (header) continue;
    if (!numbers || numbers->size() != 7) throw Error(place + "expected " + columns);
    const Row row{numbers->front(), Symmetric(numbers->data() + 1)};
    if (const std::string problem = problem_of(path.rows, row); !problem.empty()) throw Error(place + problem);
    path.rows.push_back(row);
  }
  if (path.rows.size() < 2) throw Error(file.string() + ": expected two rows or more of " + columns);
  return path;
}

}  // namespace strut::point
