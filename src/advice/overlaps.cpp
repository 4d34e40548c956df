#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "advice/checks.hpp"
#include "contact/interpenetration.hpp"
#include "setup/found_points.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut {

namespace {

// Limit of a family's volume over that of the sphere: lattices have at most 1.2 from a horizon of 1.5 spacings on,
// meshes of other elements 1 ± 0.25; a body that is defined twice has 2.
constexpr double crowded = 1.65;
constexpr double least_horizon = 1.5;  // in edges of a cube with the point's volume

// A point as it travels to other ranks.
struct Grain {
  double place[3], volume;
  std::int64_t body;
};

// Collective. For each owned point the volume of its body within the horizon, itself included, bonded or not.
std::vector<double> volumes_within_horizons(const Domain& domain) {
  std::vector<Vector> places;
  std::vector<Grain> grains;
  Eigen::AlignedBox3d mine;
  double reach = 0;
  for (int i = 0; i < domain.owned; ++i) {
    const Vector X = domain.reference(i);
    places.push_back(X);
    grains.push_back({{X[0], X[1], X[2]}, domain.volume(i), domain.body_of(i)});
    mine.extend(X);
    reach = std::max(reach, domain.horizon(i));
  }
  reach = domain.communicator.max(reach);
  for (const Grain& one : from_nearby_ranks(mine, places, std::span<const Grain>(grains), reach, domain.communicator)) {
    places.emplace_back(one.place[0], one.place[1], one.place[2]);
    grains.push_back(one);
  }
  const CellGrid grid(places, reach);
  std::vector<double> volumes(domain.owned, 0);
  for (int i = 0; i < domain.owned; ++i) {
    const double horizon = domain.horizon(i);
    grid.visit_near(places[i], [&](int j, const Vector& y) {
      const bool is_within = (y - places[i]).squaredNorm() < horizon * horizon;
      if (is_within && grains[j].body == grains[i].body) volumes[i] += grains[j].volume;
    });
  }
  return volumes;
}

// The volume (m³) of owned point i and of those points of its family that lie within its own horizon: the family of a
// small point also holds larger points farther away.
double volume_of_neighbors(const Domain& domain, int i) {
  const double horizon = domain.horizon(i);
  double volume = domain.volume(i);
  domain.families.for_each(i, [&](int j) {
    const bool is_within = (domain.reference(j) - domain.reference(i)).squaredNorm() < horizon * horizon;
    if (is_within) volume += domain.volume(j);
  });
  return volume;
}

bool is_crowded(const Domain& domain, int i, double volume_within) {
  const double horizon = domain.horizon(i);
  if (horizon < least_horizon * std::cbrt(domain.volume(i))) return false;
  return volume_within > crowded * 4 * std::numbers::pi / 3 * horizon * horizon * horizon;
}

// In a body of several pieces, visibility may leave out bonds between coincident points; otherwise families show them.
bool has_pieces(const Domain& domain, std::int64_t pieces) {
  std::int64_t bodies = 0;
  for (const BlockHorizons& block : domain.blocks) bodies = std::max<std::int64_t>(bodies, block.body + 1);
  return pieces > bodies;
}

std::string crowds(const Body& body, std::int64_t pieces) {
  const Domain& domain = body.domain;
  std::vector<double> volumes;
  if (has_pieces(domain, pieces)) volumes = volumes_within_horizons(domain);
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (domain.families.lattice(i)) continue;
    if (is_crowded(domain, i, volumes.empty() ? volume_of_neighbors(domain, i) : volumes[i])) points.push_back(i);
  }
  const FoundPoints found = found_points(body, {points})[0];
  if (found.count == 0) return "";
  std::ostringstream text;
  text << "WARNING: around " << found.count << " points, one of them at " << place_text(found.one) << ", there is "
       << crowded << " times as much material as fits within the horizon, or more: elements that overlap, or are given "
       << "twice? Mass and stiffness count twice there\n";
  return text.str();
}

}  // namespace

std::string overlaps(const Situation& situation) {
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  std::ostringstream text;
  // Cells of a grid do not overlap, and boxes of them hold more than the horizon.
  if (situation.deck.discretization.type != deck::MeshType::grid) text << crowds(body, situation.scene.pieces);
  for (const auto& [first, second, points] : contact::overlapping_blocks(domain)) {
    const FoundPoints found = found_points(body, {points})[0];
    if (found.count == 0) continue;
    text << "WARNING: " << found.count << " points of the blocks '" << domain.cloud.block_names[first] << "' and '"
         << domain.cloud.block_names[second] << "', one of them at " << place_text(found.one)
         << ", are inside of the other one at the start: mass counts twice there, and no contact parts them\n";
  }
  return text.str();
}

}  // namespace strut
