// Measured errors of struts a few cells thick by quadratic correspondence, in one table that the program and strut-mesh
// print. It is header-only, so that the mesh tool does not link mechanics.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace strut {

struct ExpectedError {
  double thickness;     // cells
  double stiffness;     // relative error, plus or minus: the largest over single struts in any direction and over foams
  double above, below;  // relative error of the plateau stress where metal flows: too high, too low
};

// Measured on round struts whose cells know their material (tests/reference/bench_thin_members); on the limit load of
// clamped struts with points at elements and at nodes (bench_limit_load); on lattices, sheared nodes and Kelvin's foam
// against finite elements (tests/reference/README.md). test_thin_members and test_limit_load check the table: no error
// exceeds its entry, and some strut or foam reaches at least half of it.
inline constexpr std::array<ExpectedError, 4> expected_errors = {
    {{2, 0.20, 0.15, 0.06}, {3, 0.14, 0.05, 0.06}, {4, 0.11, 0.03, 0.06}, {6, 0.07, 0.02, 0.04}}};

// Whole cells approximate a curved surface by stairs, as voxels do on a round strut; errors of the stiffness are then
// larger by this factor (the same bench and test).
inline constexpr int times_by_stairs = 3;

// Linear between the entries and proportional to 1/thickness beyond the last; thinner struts get the first entry.
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

// E.g. "up to ±14 % in the stiffness and +5/-6 % in the plateau". `whole`: cells are whole, so surfaces may be stairs.
inline std::string expected_error_text(double thickness, const std::string& plateau, bool whole = false) {
  constexpr double known = 0.9;  // fraction of the least thickness of the table; below it errors exceed the table's
  const ExpectedError error = expected_error(thickness);
  const char* bound = thickness < known * expected_errors.front().thickness ? "more than" : "up to";
  char text[100];
  std::snprintf(text, sizeof text, "%s ±%.0f %% in the stiffness", bound, 100 * error.stiffness);
  std::string described = text;
  if (whole) described += " (some " + std::to_string(times_by_stairs) + " times that where whole cells make stairs)";
  if (plateau.empty()) return described;
  std::snprintf(text, sizeof text, " and +%.0f/-%.0f %% ", 100 * error.above, 100 * error.below);
  return described + text + plateau;
}

}  // namespace strut
