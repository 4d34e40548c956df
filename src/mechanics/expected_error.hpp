// The errors of struts a few cells thick by quadratic correspondence: the one table of them, which the program and
// strut-mesh print. It stands in a header, so that the mesh tool needs none of mechanics to be linked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace strut {

struct ExpectedError {
  double thickness;     // cells
  double stiffness;     // share, either way: the largest of single struts in any direction, and of foams
  double above, below;  // shares of the plateau, too much and too little, where metal flows
};

// Round struts of cells that know what is in them (tests/reference/bench_thin_members); the limit load of clamped ones
// at elements and at nodes (bench_limit_load), lattices, sheared nodes and Kelvin's foam beside finite elements
// (tests/reference/README.md). test_thin_members and test_limit_load keep it true: nothing is off by more, and some
// strut or foam by half as much.
inline constexpr std::array<ExpectedError, 4> expected_errors = {
    {{2, 0.20, 0.15, 0.06}, {3, 0.14, 0.05, 0.06}, {4, 0.11, 0.03, 0.06}, {6, 0.07, 0.02, 0.04}}};

// Where whole cells make stairs of a surface, as voxels do of a round strut, errors of the stiffness are so many times
// as large (the same bench and test).
inline constexpr int times_by_stairs = 3;

// Between the entries linear, beyond the last one as 1/thickness; of thinner struts that of the first.
inline ExpectedError expected_error(double thickness) {
  const auto &first = expected_errors.front(), &last = expected_errors.back();
  if (thickness >= last.thickness) {
    const double part = last.thickness / thickness;
    return {thickness, part * last.stiffness, part * last.above, part * last.below};
  }
  if (!(thickness > first.thickness)) return {thickness, first.stiffness, first.above, first.below};
  const auto b = std::find_if(expected_errors.begin(), expected_errors.end(),
                              [&](const ExpectedError& e) { return e.thickness > thickness; });
  const auto a = b - 1;
  const double t = (thickness - a->thickness) / (b->thickness - a->thickness);
  return {thickness, std::lerp(a->stiffness, b->stiffness, t), std::lerp(a->above, b->above, t),
          std::lerp(a->below, b->below, t)};
}

// E.g. "up to ±14 % in the stiffness and +5/-6 % in the plateau". `whole`: the cells are, so that there may be stairs.
inline std::string expected_error_text(double thickness, const std::string& plateau, bool whole = false) {
  constexpr double known = 0.9;  // of the thinnest: below it, errors are larger than those of the table
  const ExpectedError error = expected_error(thickness);
  const char* bound = thickness < known * expected_errors.front().thickness ? "more than" : "up to";
  char text[100];
  std::snprintf(text, sizeof text, "%s ±%.0f %% in the stiffness", bound, 100 * error.stiffness);
  std::string told = text;
  if (whole) told += " (some " + std::to_string(times_by_stairs) + " times that where whole cells make stairs)";
  if (plateau.empty()) return told;
  std::snprintf(text, sizeof text, " and +%.0f/-%.0f %% ", 100 * error.above, 100 * error.below);
  return told + text + plateau;
}

}  // namespace strut
