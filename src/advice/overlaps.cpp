#include "advice/overlaps.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "contact/passing.hpp"
#include "setup/found_points.hpp"

namespace strut {

namespace {

// Limit of a family's volume over that of the sphere: lattices have at most 1.2 from a horizon of 1.5 spacings on,
// meshes of other elements 1 ± 0.25; a body that is defined twice has 2.
constexpr double crowded = 1.65;
constexpr double least_horizon = 1.5;  // in edges of a cube with the point's volume

bool is_crowded(const Domain& domain, int i) {
  const double volume = domain.volume(i), horizon = domain.horizon(i);
  if (domain.families.lattice(i) || horizon < least_horizon * std::cbrt(volume)) return false;
  return volume + family_volume(domain, i) > crowded * 4 * std::numbers::pi / 3 * horizon * horizon * horizon;
}

std::string crowds(const Body& body) {
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (is_crowded(body.domain, i)) points.push_back(i);
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
  text << crowds(body);
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
