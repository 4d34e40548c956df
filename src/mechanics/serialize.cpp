#include "mechanics/serialize.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "mechanics/formulation/flow.hpp"
#include "mechanics/fracture/fracture.hpp"
#include "mechanics/passes.hpp"

namespace strut {

namespace {

void serialize_vectors(Archive& archive, const std::string& name, std::vector<Vector>& vectors) {
  archive.field(name, 3, [&](std::size_t i, int c) -> double& { return vectors[i][c]; });
}

void serialize_numbers(Archive& archive, const std::string& name, std::vector<double>& numbers) {
  archive.field(name, 1, [&](std::size_t i, int) -> double& { return numbers[i]; });
}

// Collective. A number that changes with the node sets that points are in, however these are spread over the ranks.
double mark_of_sets(const Body& body) {
  constexpr std::uint64_t digits = (std::uint64_t{1} << 52) - 1;  // that a double holds
  const PointCloud& cloud = body.domain.cloud;
  std::uint64_t sum = 0;
  for (int i = 0; i < body.owned(); ++i) {
    std::uint64_t mixed = (cloud.sets[i] + 1) * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ (mixed >> 31) ^ static_cast<std::uint64_t>(cloud.ids[i])) * 0xbf58476d1ce4e5b9u;
    sum += mixed >> 20;
  }
  const std::int64_t all = body.domain.communicator.sum(static_cast<std::int64_t>(sum));
  return static_cast<double>(static_cast<std::uint64_t>(all) & digits);
}

// Collective. The mesh, to know it again: nothing of it is restored.
void compare_reference(Archive& archive, const Body& body) {
  const double own_sets = mark_of_sets(body);
  double sets = own_sets;
  archive.number("node_sets", sets);
  std::vector<Eigen::Array4d> kept;
  for (int i = 0; i < body.owned(); ++i) kept.push_back(body.domain.sites[i].reference);
  archive.field("reference", 4, [&](std::size_t i, int c) -> double& { return kept[i][c]; });
  bool same = true;
  for (int i = 0; i < body.owned(); ++i) same = same && (kept[i] == body.domain.sites[i].reference).all();
  raise_together(body.domain.communicator,
                 same && sets == own_sets
                     ? ""
                     : std::string("the mesh is not the one with which the run began: points are ") +
                           (same ? "in other node sets" : "at other places, or of other volumes") +
                           "; a run can go on with the same one only");
}

void serialize_motion(Archive& archive, Body& body) {
  archive.field("position", 3, [&](std::size_t i, int c) -> double& { return body.domain.sites[i].current[c]; });
  serialize_vectors(archive, "velocity", body.velocity);
  serialize_vectors(archive, "previous_velocity", body.previous_velocity);
  serialize_vectors(archive, "force_density", body.force_density);
}

void keep_points(Archive& archive, Body& body) {
  std::vector<MaterialPoint>& points = body.points;
  archive.field("deformation_gradient", 9,
                [&](std::size_t i, int c) -> double& { return points[i].deformation_gradient.data()[c]; });
  archive.field("rotation", 6, [&](std::size_t i, int c) -> double& { return points[i].rotation.number(c); });
  archive.field("stress", 6, [&](std::size_t i, int c) -> double& { return points[i].stress.data()[c]; });
  // A failed point has none left.
  archive.field("stabilization", 1, [&](std::size_t i, int) -> double& { return points[i].stabilization; });
  serialize_numbers(archive, "residual", body.residual);
  if (body.has_springs(ResidualKind::both_gradients)) serialize_numbers(archive, "bond_work", body.bond_work);
}

// The law points of quadratic correspondence.
void keep_cells(Archive& archive, MaterialBlock& block) {
  archive.field("flowed", 1, [&block](std::size_t k, int) -> std::uint8_t& { return block.flowed[k]; });
  const int places = block.places_a_point();
  const auto field = [&](const std::string& name, int first, int width) {
    archive.field("cell_" + name, width * places, [&block, first, width](std::size_t k, int c) -> double& {
      return block.cells.number(block.place(k, c / width), first + c % width);
    });
  };
  field("deformation_gradient", 0, 9);
  field("rotation", CellPoints::rotation, 6);
  field("stress", CellPoints::stress, 6);
}

void keep_block(Archive& archive, const Body& body, std::size_t number, MaterialBlock& block) {
  archive.points("block " + std::to_string(number) + " (" + block.name + ")", ids_of(body, block.points));
  const int places = block.places_a_point();
  const int columns =
      std::visit([]<class L>(const L&) { return static_cast<int>(materials::state_size<L>); }, block.material.law);
  if (columns > 0) {
    archive.field("state", columns * places, [&](std::size_t k, int c) -> double& {
      return block.state.at(block.place(k, c % places), c / places);
    });
  }
  if (block.is_quadratic()) keep_cells(archive, block);
  if (block.is_ordinary()) {
    archive.field("dilatation", 1, [&](std::size_t k, int) -> double& { return block.ordinary[k].dilatation; });
    archive.field("energy", 1, [&](std::size_t k, int) -> double& { return block.ordinary[k].energy; });
  }
  if (block.material.viscosity.any()) {
    archive.field("viscosity", 3 * places, [&](std::size_t k, int c) -> double& {
      ViscousPoint& point = block.viscous[block.place(k, c / 3)];
      return c % 3 == 0 ? point.pressure : c % 3 == 1 ? point.work : point.damping;
    });
  }
}

}  // namespace

std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points) {
  std::vector<std::int64_t> ids;
  ids.reserve(points.size());
  for (const int i : points) ids.push_back(body.domain.cloud.ids[i]);
  return ids;
}

void serialize(Archive& archive, Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    archive.number("rigid_motion_" + std::to_string(b), body.blocks[b].in_rigid_motion);
    keep_block(archive, body, b, body.blocks[b]);
  }
  const auto owned = body.domain.cloud.ids.begin() + body.owned();
  archive.points("all points", {body.domain.cloud.ids.begin(), owned});
  compare_reference(archive, body);
  serialize_motion(archive, body);
  keep_points(archive, body);
  if (archive.loading()) body.domain.halo.exchange_places(body.domain.sites);
  if (body.fracture) body.fracture->serialize(archive, body);
  if (archive.loading()) refit_flowed(body);
}

}  // namespace strut
