// strut-compare A B [--relative 1e-9] [--absolute 0]: compares two results, or two histories (tools/README.md).
// Exit status: 0 equal within the tolerance, 1 different, 2 they cannot be compared.
//   strut-compare one-rank.e four-ranks.e --relative 1e-12
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "compare/difference.hpp"
#include "compare/series.hpp"

namespace {

using namespace strut::compare;

struct Request {
  std::vector<std::string> files;
  Tolerance tolerance;
};

double tolerance_of(const std::string& option, const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value >= 0)) {
    throw strut::Error(option + " is '" + word + "', expected a number from 0");
  }
  return value;
}

Request request_of(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      request.files.push_back(words[i]);
      continue;
    }
    const bool relative = words[i] == "--relative";
    if (!relative && words[i] != "--absolute") {
      throw strut::Error("unknown option " + words[i] + strut::did_you_mean(words[i], {"--relative", "--absolute"}));
    }
    if (i + 1 == words.size()) throw strut::Error("option " + words[i] + " needs a number");
    (relative ? request.tolerance.relative : request.tolerance.absolute) = tolerance_of(words[i], words[i + 1]);
    ++i;
  }
  if (request.files.size() != 2) {
    throw strut::Error(
        "usage: strut-compare A B [--relative 1e-9] [--absolute 0]   (two results .e or histories .csv)");
  }
  return request;
}

std::string where(const Difference& d, const std::vector<double>& times) {
  if (d.absolute == 0) return "";
  const std::string place = d.place + " " + std::to_string(d.index + 1);
  if (d.frame >= times.size()) return place;
  char time[40];
  std::snprintf(time, sizeof time, "t = %.6g s, ", times[d.frame]);
  return time + place;
}

// Prints a table; returns true if all differences are within the tolerance.
bool same(const Series& a, const Series& b, const Tolerance& tolerance) {
  const std::vector<std::string> problems = mismatches(a, b, tolerance);
  for (const std::string& problem : problems) std::printf("different: %s\n", problem.c_str());
  bool within = problems.empty();
  std::printf("  %-32s %14s %14s  %s\n", "variable", "|a - b|", "relative", "where");
  for (const Difference& d : differences(a, b, tolerance)) {
    within = within && d.within;
    std::printf("%s %-32s %14.6g %14.6g  %s\n", d.within ? " " : "!", d.name.c_str(), d.absolute, d.relative,
                where(d, a.times).c_str());
  }
  return within;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = request_of({argv + 1, argv + argc});
    const bool equal = same(read_series(request.files[0]), read_series(request.files[1]), request.tolerance);
    std::printf("%s (tolerance: %g of a frame's largest magnitude, or %g)\n", equal ? "the same" : "DIFFERENT",
                request.tolerance.relative, request.tolerance.absolute);
    return equal ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strut-compare: %s\n", error.what());
    return 2;
  }
}
