#include "mesh/section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"

namespace strut::mesh {

namespace {

bool all(int, int) { return true; }

// Shirley & Chiu's map of the square [-1, 1]² to the unit disc: squares around the origin become circles, and all areas
// are multiplied by π/4, so that equal squares give cells of equal area (except for the sagitta of their edges).
Point disc_of_square(double u, double v) {
  if (u == 0 && v == 0) return Point::Zero();
  const double quarter = std::numbers::pi / 4;
  const bool sideways = std::abs(u) >= std::abs(v);
  const double radius = sideways ? u : v;
  const double angle = quarter * (sideways ? v / u : u / v);
  const double along = radius * std::cos(angle);
  const double across = radius * std::sin(angle);
  return sideways ? Point(along, across) : Point(across, along);
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<double> uniform_levels(double spacing, double height) {
  const int layers = std::max(1, static_cast<int>(std::lround(height / spacing)));
  const double layer = height / layers;
  std::vector<double> levels;
  for (int k = 0; k < layers; ++k) levels.push_back(layer * k);
  levels.push_back(height);  // without round-off: another body may begin there
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

double Section::area(int i, int j) const {
  return cross(place(i + 1, j + 1) - place(i, j), place(i, j + 1) - place(i + 1, j)) / 2;  // of its diagonals
}

int cells_across(double radius, double spacing, Body::Centered centered) {
  if (centered == Body::Centered::corner) return 2 * static_cast<int>(std::ceil(radius / spacing));
  return 2 * static_cast<int>(std::ceil(radius / spacing - 0.5)) + 1;
}

Section lattice_disc(double radius, double spacing, Body::Centered centered) {
  const int n = cells_across(radius, spacing, centered);
  // In units of half a spacing these are exact integers, so the section is symmetric to the last bit.
  const double square = std::pow(2 * radius / spacing, 2) * (1 + 1e-12);
  const auto keeps = [=](int i, int j) {
    const double x = 2 * i + 1 - n;
    const double y = 2 * j + 1 - n;
    return x * x + y * y <= square;
  };
  if (!keeps(n / 2, n / 2)) throw Error("no cell's center lies within the radius: the spacing is too large");
  return {n, n, keeps, [=](int i, int j) { return Point((2 * i - n) * spacing / 2, (2 * j - n) * spacing / 2); }};
}

Section fitted_disc(double radius, double spacing) {
  // n² cells for the area π radius² at the spacing; an odd n would give a much smaller cell in the middle.
  const double wanted = radius * std::sqrt(std::numbers::pi) / spacing;
  const int n = std::max(2, 2 * static_cast<int>(std::lround(wanted / 2)));
  return {n, n, all, [=](int i, int j) -> Point {
            return radius * disc_of_square((2 * i - n) / static_cast<double>(n), (2 * j - n) / static_cast<double>(n));
          }};
}

Section rectangle(double a, double b, double spacing) {
  const int n = std::max(1, static_cast<int>(std::lround(a / spacing)));
  const int m = std::max(1, static_cast<int>(std::lround(b / spacing)));
  // a * n / n may differ from a by round-off.
  return {n, m, all, [=](int i, int j) { return Point(i == n ? a : a * i / n, j == m ? b : b * j / m); }};
}

std::vector<double> levels_of(const Body& body, double height) {
  return body.grading > 1 ? graded_levels(body, height) : uniform_levels(body.spacing, height);
}

}  // namespace strut::mesh
