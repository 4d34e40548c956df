#include "thin_members.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "cells.hpp"
#include "frequencies.hpp"

namespace strut::reference {

namespace {

constexpr double radius = 0.5;       // m
constexpr int parts = 6;             // of a cut cell, along an edge
constexpr double least_part = 0.30;  // of a cell that stays

// Rounded down, as integer division is not.
Place divided(const Place& place, int by) { return (place.cast<double>() / by).floor().cast<int>(); }

std::vector<std::int64_t> corners(const Place& cell) {
  std::vector<std::int64_t> numbers;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) numbers.push_back(number_of(cell + Place(i, j, k)));
    }
  }
  return numbers;  // ascending, as numbers go by z, y, x
}

// The elements around a node, each made of 2³ small cubes.
std::vector<std::int64_t> elements_around(const Place& node, const SmallCubes& body) {
  std::vector<std::int64_t> numbers;
  for (int k = -1; k < 1; ++k) {
    for (int j = -1; j < 1; ++j) {
      for (int i = -1; i < 1; ++i) {
        const Place element = node + Place(i, j, k);
        if (body.is_filled(2 * element)) numbers.push_back(number_of(element));
      }
    }
  }
  return numbers;
}

double uniform(std::mt19937& engine) { return static_cast<double>(engine()) / 4294967296.0; }

// So many small cubes that their middles, `half` from the origin at most along an axis, are among them.
SmallCubes around_origin(double edge, const Vector& half, const Vector& offset) {
  const Eigen::Array3d reach = half.array() / edge;
  return {edge, (offset.array() - reach).floor().cast<int>(), (offset.array() + reach).ceil().cast<int>() + 1, {}};
}

bool is_in_cylinder(const Vector& x, const Vector& axis) {
  const double along = x.dot(axis);
  return std::abs(along) <= 0.5 * frequencies_length && x.squaredNorm() - along * along <= radius * radius;
}

}  // namespace

PointCloud square_prism(int across, int along, PointsAt at) {
  // Elements have 2³ small cubes, so that nodes have theirs, too.
  const double spacing = 1.0 / across;
  SmallCubes body{spacing / 2, Place::Zero(), 2 * Place(across, across, along), {}};
  body.is_filled = [&](const Place& cube) { return (cube >= body.low).all() && (cube < body.high).all(); };
  const bool at_nodes = at == PointsAt::nodes;
  const int shift = at_nodes ? 1 : 0;
  const auto cells = gathered(body, [&](const Place& cube) { return divided(cube + shift, 2); });
  PointCloud cloud = cloud_of(cells, body.edge, spacing, at_nodes);
  cloud.at = at;
  for (const Cell& cell : cells) {
    cloud.shared_nodes.push_back(at_nodes ? elements_around(cell.place, body) : corners(cell.place));
  }
  const Vector middle(0.5, 0.5, 0.5 * along * spacing);
  for (Vector& position : cloud.positions) position -= middle;
  return cloud;
}

std::vector<Placement> random_placements(int count) {
  std::mt19937 engine(20);  // its numbers are the standard's; those of its distributions are not
  std::vector<Placement> placements;
  for (int n = 0; n < count; ++n) {
    const double z = 2 * uniform(engine) - 1, angle = 2 * std::numbers::pi * uniform(engine);
    const double across = std::sqrt(1 - z * z);
    const double x = uniform(engine), y = uniform(engine), along = uniform(engine);
    placements.push_back({{across * std::cos(angle), across * std::sin(angle), z}, {x, y, along}});
  }
  return placements;
}

PointCloud round_cylinder(int across, const Placement& placement, Cells cells) {
  const double spacing = 1.0 / across;
  const int per_edge = cells == Cells::cut ? parts : 1;
  const Vector half = 0.5 * frequencies_length * placement.axis.cwiseAbs() + Vector::Constant(radius);
  const Vector offset = per_edge * placement.offset;
  SmallCubes body = around_origin(spacing / per_edge, half, offset);
  body.is_filled = [&](const Place& cube) {
    const Vector middle = cube.cast<double>().matrix() + Vector::Constant(0.5);
    return is_in_cylinder(body.edge * (middle - offset), placement.axis);
  };
  std::vector<Cell> kept = gathered(body, [&](const Place& cube) { return divided(cube, per_edge); });
  merge_small(kept, static_cast<int>(std::ceil(least_part * per_edge * per_edge * per_edge)));
  PointCloud cloud = cloud_of(kept, body.edge, spacing, false);
  for (const Cell& cell : kept) cloud.shared_nodes.push_back(corners(cell.place));
  for (Vector& position : cloud.positions) position -= spacing * placement.offset;
  return cloud;
}

}  // namespace strut::reference
