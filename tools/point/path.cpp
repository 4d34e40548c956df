#include "point/path.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "base/errors.hpp"
#include "base/files.hpp"

namespace strut::point {
namespace {

constexpr std::string_view blanks = " \t\r";
const std::string columns = "seven numbers separated by commas: time, xx, yy, zz, xy, yz, zx";

// The numbers of `line`, separated by commas, or nullopt.
std::optional<std::vector<double>> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  const char *at = line.data(), *const end = line.data() + line.size();
  const auto skip_blanks = [&] {
    while (at != end && blanks.find(*at) != std::string_view::npos) ++at;
  };
  while (true) {
    skip_blanks();
    double number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    at = next;
    skip_blanks();
    if (at == end) return numbers;
    if (*at++ != ',') return {};
  }
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
    const auto start = line.find_first_not_of(blanks);
    if (start == std::string::npos || line[start] == '#') continue;
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
