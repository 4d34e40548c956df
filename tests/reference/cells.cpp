#include "cells.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

namespace strut::reference {

namespace {

const std::array<Place, 6> faces = {Place(-1, 0, 0), Place(1, 0, 0),  Place(0, -1, 0),
                                    Place(0, 1, 0),  Place(0, 0, -1), Place(0, 0, 1)};

void visit_filled(const SmallCubes& body, const std::function<void(const Place&)>& visit) {
  for (int k = body.low[2]; k < body.high[2]; ++k) {
    for (int j = body.low[1]; j < body.high[1]; ++j) {
      for (int i = body.low[0]; i < body.high[0]; ++i) {
        if (body.is_filled({i, j, k})) visit({i, j, k});
      }
    }
  }
}

Cell of_one_cube(const SmallCubes& body, const Place& cube) {
  const Vector middle = cube.cast<double>().matrix() + Vector::Constant(0.5);
  Cell cell{Place::Zero(), 1, middle, middle * middle.transpose()};
  for (const Place& face : faces) {
    if (body.is_filled(cube + face)) continue;
    const Vector n = face.cast<double>().matrix();
    cell.surface += n;
    cell.surface_moments += n * (middle + 0.5 * n).transpose();
  }
  return cell;
}

CellShape shape_of(const Cell& cell, double edge, const Vector& position) {
  const Vector centroid = cell.first / cell.cubes;
  Tensor moments = cell.second / cell.cubes - centroid * centroid.transpose();
  moments.diagonal().array() += 1.0 / 12;  // those of the small cubes themselves
  const Tensor surface_moments = cell.surface_moments - cell.surface * position.transpose() / edge;
  return {edge * centroid - position, edge * edge * symmetric_part(moments), edge * edge * cell.surface,
          edge * edge * edge * surface_moments};
}

}  // namespace

void Cell::take(const Cell& other) {
  cubes += other.cubes;
  first += other.first;
  second += other.second;
  surface += other.surface;
  surface_moments += other.surface_moments;
}

std::vector<Cell> gathered(const SmallCubes& body, const std::function<Place(const Place&)>& cell_of) {
  std::map<std::int64_t, Cell> cells;
  visit_filled(body, [&](const Place& cube) {
    const Place place = cell_of(cube);
    Cell& cell = cells[number_of(place)];
    cell.place = place;
    cell.take(of_one_cube(body, cube));
  });
  std::vector<Cell> in_order;
  for (const auto& [number, cell] : cells) in_order.push_back(cell);
  return in_order;
}

void merge_small(std::vector<Cell>& cells, int fewest) {
  std::unordered_map<std::int64_t, int> by_number;
  for (std::size_t n = 0; n < cells.size(); ++n) by_number[number_of(cells[n].place)] = static_cast<int>(n);
  const auto largest_neighbor = [&](const Cell& cell) {
    Cell* largest = nullptr;
    for (const Place& face : faces) {
      const auto found = by_number.find(number_of(cell.place + face));
      if (found == by_number.end()) continue;
      Cell& neighbor = cells[found->second];
      if (neighbor.cubes > 0 && (!largest || neighbor.cubes > largest->cubes)) largest = &neighbor;
    }
    return largest;
  };
  // Cells only grow or become empty, so that one that is too large for a size is for the sizes before it.
  for (int size = 1; size < fewest; ++size) {
    for (Cell& cell : cells) {
      if (cell.cubes != size) continue;
      Cell* neighbor = largest_neighbor(cell);
      if (!neighbor) continue;
      neighbor->take(cell);
      cell.cubes = 0;
    }
  }
  std::erase_if(cells, [](const Cell& cell) { return cell.cubes == 0; });
}

std::int64_t number_of(const Place& place) {
  constexpr std::int64_t most = std::int64_t{1} << 20;
  const auto part = [&](int axis) { return place[axis] + most / 2; };
  return (part(2) * most + part(1)) * most + part(0);
}

PointCloud cloud_of(const std::vector<Cell>& cells, double edge, double spacing, bool at_grid) {
  PointCloud cloud;
  cloud.block_names = {"strut"};
  cloud.has_shared_nodes = true;
  for (const Cell& cell : cells) {
    const Vector centroid = edge * cell.first / cell.cubes;
    const Vector position = at_grid ? Vector(spacing * cell.place.cast<double>().matrix()) : centroid;
    cloud.ids.push_back(static_cast<std::int64_t>(cloud.ids.size()));
    cloud.element_ids.push_back(cloud.ids.back() + 1);
    cloud.positions.push_back(position);
    cloud.volumes.push_back(cell.cubes * edge * edge * edge);
    cloud.spacings.push_back(spacing);
    cloud.blocks.push_back(0);
    cloud.sets.push_back(0);
    cloud.shapes.push_back(shape_of(cell, edge, position));
  }
  return cloud;
}

}  // namespace strut::reference
