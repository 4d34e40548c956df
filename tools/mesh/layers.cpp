#include "mesh/layers.hpp"

#include <algorithm>
#include <cmath>

namespace strut::mesh {

namespace {

std::vector<double> uniform_levels(double spacing, double height) {
  const int layers = std::max(1, static_cast<int>(std::lround(height / spacing)));
  const double layer = height / layers;
  std::vector<double> levels;
  for (int k = 0; k <= layers; ++k) levels.push_back(layer * k);
  return levels;
}

double next_thickness(const Body& body, double thickness, double level) {
  if (level < body.uniform * (1 - 1e-9)) return thickness;  // round-off adds no layer
  const double grown = thickness * body.grading;
  return body.coarsest > 0 ? std::min(grown, body.coarsest) : grown;
}

std::vector<double> graded_levels(const Body& body, double height) {
  std::vector<double> levels{0};
  double thickness = body.spacing;
  // The number of layers closest to the height.
  while (levels.size() == 1 || levels.back() + thickness / 2 <= height) {
    levels.push_back(levels.back() + thickness);
    thickness = next_thickness(body, thickness, levels.back());
  }
  const double scale = height / levels.back();
  for (double& level : levels) level *= scale;
  levels.back() = height;
  return levels;
}

}  // namespace

std::vector<double> levels_of(const Body& body, double height) {
  return body.grading > 1 ? graded_levels(body, height) : uniform_levels(body.spacing, height);
}

}  // namespace strut::mesh
