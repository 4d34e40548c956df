#include "mechanics/serialize.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "mechanics/formulation/flow.hpp"
#include "mechanics/passes.hpp"

namespace strut {

namespace {

// Collective. A hash of the node sets that points are in, independent of their distribution over the ranks.
double mark_of_sets(const Body& body) {
  constexpr std::uint64_t digits = (std::uint64_t{1} << 52) - 1;  // that a double holds exactly
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

enum class Sets { same, any };

// Collective. Compares the mesh with that of the checkpoint; nothing of it is restored.
void compare_reference(Archive& archive, const Body& body, Sets which) {
  const double own_sets = which == Sets::same ? mark_of_sets(body) : 0;
  double sets = own_sets;
  if (which == Sets::same) archive.number("node_sets", sets);
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

Places places_of(const MaterialBlock& block) {
  return {block.points_per_cell(), [&block](std::size_t k, int q) { return block.place(k, q); }};
}

}  // namespace

std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points) {
  std::vector<std::int64_t> ids;
  ids.reserve(points.size());
  for (const int i : points) ids.push_back(body.domain.cloud.ids[i]);
  return ids;
}

namespace {

void serialize(Archive& archive, Body& body, Sets sets) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    archive.number("rigid_motion_" + std::to_string(b), body.blocks[b].in_rigid_motion);
    MaterialBlock& block = body.blocks[b];
    archive.points("block " + std::to_string(b) + " (" + block.name + ")", ids_of(body, block.points));
    block.fields.serialize(archive, places_of(block));
  }
  const auto owned = body.domain.cloud.ids.begin() + body.owned();
  archive.points("all points", {body.domain.cloud.ids.begin(), owned});
  compare_reference(archive, body, sets);
  archive.field("position", 3, [&](std::size_t i, int c) -> double& { return body.domain.sites[i].current[c]; });
  body.fields.serialize(archive);
  Vector stretch = body.domain.halo.stretch();
  for (const Period& period : body.domain.periods) {
    archive.number(std::string("stretch_") + "xyz"[period.axis], stretch[period.axis]);
  }
  if (!archive.loading()) return;
  body.domain.halo.set_stretch(stretch);  // before ghosts get their places
  body.domain.halo.exchange_places(body.domain.sites);
  refit_flowed(body);
}

}  // namespace

void serialize(Archive& archive, Body& body) { serialize(archive, body, Sets::same); }
void serialize_for_start(Archive& archive, Body& body) { serialize(archive, body, Sets::any); }

}  // namespace strut
