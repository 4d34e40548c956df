// strut-compare A B [--relative 1e-9] [--absolute 0]: compares two results, or two histories (tools/README.md).
// Exit status: 0 equal within the tolerance, 1 different, 2 they cannot be compared.
//   strut-compare one-rank.e four-ranks.e --relative 1e-12
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iomanip>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "compare/series.hpp"

namespace {

using namespace strut::compare;
using strut::text_of;

// Values may differ by the larger of `absolute` and `relative` times the largest magnitude, in either result, of that
// quantity over the frame. The components of a vector or tensor (names that end in X, Y, Z, XX, XY, …) are one
// quantity: a shear stress that is zero up to round-off is compared with the scale of the stress.
struct Tolerance {
  double relative = 1e-9;
  double absolute = 0;
};

struct Difference {
  std::string name;
  double absolute = 0;  // the largest, at `frame` and `index`
  double relative = 0;  // the largest of |a - b| / (magnitude over the frame)
  std::size_t frame = 0;
  std::size_t index = 0;
  std::string place;  // the entity that `index` counts
  bool within = true;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double gap = std::abs(a - b);
  return std::isnan(gap) ? infinity : gap;
}

// The largest finite magnitude: NaN and infinity are no scale for other values.
double magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

// "ForceX" -> "Force", "StressXY" -> "Stress"
std::string quantity(const std::string& name) {
  const std::size_t last = name.find_last_not_of("XYZ");
  if (last == std::string::npos || name.size() - last > 3) return name;
  return name.substr(0, last + 1);
}

using Scales =
    std::map<std::pair<std::string, std::string>, std::vector<double>>;  // by place and quantity, in each frame

// The largest magnitudes in both results.
Scales scales_of(const Series& a, const Series& b) {
  Scales scales;
  for (const Series* series : {&a, &b}) {
    for (const Variable& variable : series->variables) {
      std::vector<double>& scale = scales[{variable.place, quantity(variable.name)}];
      scale.resize(std::max(scale.size(), variable.frames.size()), 0.0);
      for (std::size_t f = 0; f < variable.frames.size(); ++f) {
        scale[f] = std::max(scale[f], magnitude(variable.frames[f]));
      }
    }
  }
  return scales;
}

const Variable* find(const Series& series, const Variable& like) {
  const auto same = [&](const Variable& v) { return v.name == like.name && v.place == like.place; };
  const auto found = std::find_if(series.variables.begin(), series.variables.end(), same);
  return found == series.variables.end() ? nullptr : &*found;
}

std::size_t places(const Variable& variable) { return variable.frames.empty() ? 0 : variable.frames.front().size(); }

Difference difference(const Variable& a, const Variable& b, const std::vector<double>& scales,
                      const Tolerance& tolerance) {
  Difference result;
  result.name = a.name;
  result.place = a.place;
  for (std::size_t f = 0; f < std::min(a.frames.size(), b.frames.size()); ++f) {
    const double allowed = std::max(tolerance.absolute, tolerance.relative * scales[f]);
    for (std::size_t i = 0; i < a.frames[f].size(); ++i) {
      const double gap = distance(a.frames[f][i], b.frames[f][i]);
      if (gap == 0) continue;
      result.within = result.within && gap <= allowed;
      result.relative = std::max(result.relative, scales[f] > 0 ? gap / scales[f] : infinity);
      if (gap <= result.absolute) continue;
      result.absolute = gap;
      result.frame = f;
      result.index = i;
    }
  }
  return result;
}

std::string time_problem(const Series& a, const Series& b, const Tolerance& tolerance) {
  const std::size_t frames = std::min(a.times.size(), b.times.size());
  for (std::size_t f = 0; f < frames; ++f) {
    const double gap = distance(a.times[f], b.times[f]);
    if (gap <= std::max(tolerance.absolute, tolerance.relative * std::abs(a.times[f]))) continue;
    return text_of("frame ", f + 1, " is at t = ", std::setprecision(17), a.times[f], " s and ", b.times[f], " s");
  }
  return "";
}

// Compares the positions of the nodes, which are not among the variables.
std::string place_problem(const Series& a, const Series& b, const Tolerance& tolerance) {
  double extent = 0;
  for (const Series* one : {&a, &b}) {
    for (const std::vector<double>& x : one->places) {
      const auto [low, high] = std::minmax_element(x.begin(), x.end());
      if (low != x.end()) extent = std::max(extent, *high - *low);
    }
  }
  for (std::size_t i = 0; i < std::min(a.places[0].size(), b.places[0].size()); ++i) {
    double gap = 0;
    for (int c = 0; c < 3; ++c) gap = std::max(gap, distance(a.places[c][i], b.places[c][i]));
    if (gap <= std::max(tolerance.absolute, tolerance.relative * extent)) continue;
    const auto place = [i](const Series& one) {
      return text_of(std::setprecision(9), "(", one.places[0][i], ", ", one.places[1][i], ", ", one.places[2][i],
                     ") m");
    };
    return text_of("node ", i + 1, " is at ", place(a), " and at ", place(b), " before anything moves");
  }
  return "";
}

// The differences of all common variables over the common frames. NaN equals NaN, and differs infinitely from a number.
std::vector<Difference> differences(const Series& a, const Series& b, const Tolerance& tolerance) {
  const Scales scales = scales_of(a, b);
  std::vector<Difference> all;
  for (const Variable& variable : a.variables) {
    const Variable* other = find(b, variable);
    if (other == nullptr || places(variable) != places(*other)) continue;
    all.push_back(difference(variable, *other, scales.at({variable.place, quantity(variable.name)}), tolerance));
  }
  return all;
}

// Points of other blocks may have the same values, and other materials.
std::string block_problem(const Series& a, const Series& b) {
  if (a.blocks == b.blocks) return "";
  const auto described = [](const Series& one) {
    std::string text;
    for (const auto& [name, elements] : one.blocks)
      text += (text.empty() ? "" : ", ") + name + " (" + std::to_string(elements) + ")";
    return text;
  };
  return "the first has the blocks (elements) " + described(a) + ", the second " + described(b);
}

// Differences of structure: number of frames, their times, blocks, names, numbers of entities.
std::vector<std::string> mismatches(const Series& a, const Series& b, const Tolerance& tolerance) {
  std::vector<std::string> problems;
  if (a.times.size() != b.times.size()) {
    problems.push_back(text_of("the first has ", a.times.size(), " frames, the second ", b.times.size()));
  }
  const std::string times = time_problem(a, b, tolerance);
  if (!times.empty()) problems.push_back(times);
  for (const std::string& problem : {place_problem(a, b, tolerance), block_problem(a, b)})
    if (!problem.empty()) problems.push_back(problem);
  for (const Variable& variable : a.variables) {
    const Variable* other = find(b, variable);
    if (other == nullptr) {
      problems.push_back("only the first has the " + variable.place + " variable '" + variable.name + "'");
    } else if (places(variable) != places(*other)) {
      problems.push_back(
          text_of("'", variable.name, "' has ", places(variable), " ", variable.place, "s and ", places(*other)));
    }
  }
  for (const Variable& variable : b.variables) {
    if (find(a, variable) != nullptr) continue;
    problems.push_back("only the second has the " + variable.place + " variable '" + variable.name + "'");
  }
  return problems;
}

struct Request {
  std::vector<std::string> files;
  Tolerance tolerance;
};

double tolerance_of(const std::string& option, const std::string& word) {
  const auto number = strut::to_real(word);
  if (!number || !(*number >= 0)) throw strut::Error(option + " is '" + word + "', expected a number from 0");
  return *number;
}

const char* const usage =
    "usage: strut-compare A B [--relative 1e-9] [--absolute 0]   (two results .e or histories .csv)";

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
    throw strut::Error(usage);
  }
  return request;
}

std::string where(const Difference& d, const std::vector<double>& times) {
  if (d.absolute == 0) return "";
  const std::string place = d.place + " " + std::to_string(d.index + 1);
  if (d.frame >= times.size()) return place;
  return text_of("t = ", times[d.frame], " s, ", place);
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
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words == std::vector<std::string>{"--help"}) return std::puts(usage) < 0;
  try {
    const Request request = request_of(words);
    const bool equal = same(read_series(request.files[0]), read_series(request.files[1]), request.tolerance);
    std::printf("%s (tolerance: %g of a frame's largest magnitude, or %g)\n", equal ? "the same" : "DIFFERENT",
                request.tolerance.relative, request.tolerance.absolute);
    return equal ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strut-compare: %s\n", error.what());
    return 2;
  }
}
