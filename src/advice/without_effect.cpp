#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "advice/checks.hpp"
#include "setup/families.hpp"
#include "setup/found_points.hpp"

namespace strut {

namespace {

template <class All, class IsUsed>
std::string unnamed(const All& all, const std::string& section, const std::string& nobody, IsUsed is_used) {
  std::string text;
  for (int n = 0; n < static_cast<int>(all.size()); ++n) {
    if (!is_used(n)) text += "WARNING: " + section + " > " + all[n].name + ": " + nobody + ": it has no effect\n";
  }
  return text;
}

// The ball around a crack; the normal of a surface of triangles is 0.
struct Ball {
  Vector center, normal;
  double radius;
};

Ball around(const RectangularCrack& crack) {
  const Vector diagonal = crack.length * crack.along + crack.width * crack.along.cross(crack.normal);
  return {crack.corner + 0.5 * diagonal, crack.normal, 0.5 * diagonal.norm()};
}

Ball around(const TriangulatedCrack& crack) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : crack.triangles) {
    for (const Vector& corner : triangle) box.extend(corner);
  }
  return {box.center(), Vector::Zero(), 0.5 * box.diagonal().norm()};
}

Ball around(const DiskCrack& crack) { return {crack.center, crack.normal, crack.radius}; }

// True if the crack is within the horizon of point i, so that it may cross bonds of the point.
bool may_part(const Ball& crack, const Domain& domain, int i) {
  const Vector apart = domain.reference(i) - crack.center;
  const double horizon = domain.horizon(i);
  return std::abs(apart.dot(crack.normal)) <= horizon && apart.norm() <= crack.radius + horizon;
}

// The name of crack k in messages: its position, or the file that the deck names.
std::string name_of(std::size_t k, std::size_t drawn, const Ball& ball, const deck::Discretization& discretization) {
  return k < drawn ? "the crack around " + place_text(ball.center)
                   : "the crack of " + discretization.shells[k - drawn].filename().string();
}

std::string misplaced_cracks(const deck::Deck& deck, const Scene& scene) {
  const Body& body = scene.body;
  const Domain& domain = body.domain;
  const std::vector<Crack> cracks = cracks_of(deck, domain.communicator);
  const std::size_t drawn = cracks.size() - deck.discretization.shells.size();
  std::ostringstream text;
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    const Ball ball = std::visit([](const auto& one) { return around(one); }, cracks[k]);
    const std::string name = "WARNING: Discretization > Bond Filters: " + name_of(k, drawn, ball, deck.discretization);
    std::vector<int> beside;
    for (const auto& [i, other] : domain.separated) {
      if ((beside.empty() || beside.back() != i) && may_part(ball, domain, i)) beside.push_back(i);
    }
    if (!domain.communicator.any(!beside.empty())) {
      text << name << " cuts no bond";
      if (scene.dropped.points > 0)
        text << " of the points that are left (" << scene.dropped.points << " were dropped)";
      text << "; are its lengths in m, and is it in a body?\n";
    }
    const FoundPoints found = found_points(body, {points_on(cracks[k], beside, domain)})[0];
    if (found.count == 0) continue;
    text << name << " runs through " << found.count << " points, one at " << place_text(found.one)
         << ", which lose their bonds to both sides; expected one between layers of points\n";
  }
  return text.str();
}

std::string sets_of_all_points(const deck::Deck& deck, const Domain& domain) {
  const PointCloud& cloud = domain.cloud;
  std::string text;
  for (const deck::NodeSet& set : deck.node_sets) {
    const auto at = std::find(cloud.set_names.begin(), cloud.set_names.end(), set.name) - cloud.set_names.begin();
    if (set.numbers || at == static_cast<std::ptrdiff_t>(cloud.set_names.size())) continue;
    const bool some_are_not =
        std::any_of(cloud.sets.begin(), cloud.sets.end(), [at](std::uint64_t in) { return ((in >> at) & 1) == 0; });
    if (domain.communicator.any(some_are_not)) continue;
    text += "WARNING: Node Sets > " + set.name + ": holds all points, as 'all' does; are its lengths in m?\n";
  }
  return text;
}

}  // namespace

std::string without_effect(const Situation& situation) {
  const deck::Deck& deck = situation.deck;
  const auto has_damage = [&deck](int n) {
    return std::ranges::any_of(deck.blocks, [n](const deck::Block& block) { return block.damage_model == n; });
  };
  const auto is_of_contact = [&deck](int n) {
    return std::ranges::any_of(deck.interactions, [n](const deck::Interaction& one) { return one.model == n; });
  };
  const auto is_of_block = [&deck](int n) {
    return std::ranges::any_of(deck.blocks, [n](const deck::Block& block) { return block.material == n; });
  };
  return unnamed(deck.materials, "Materials", "no section of Blocks names it", is_of_block) +
         unnamed(deck.damage_models, "Damage Models", "no section of Blocks names it as its Damage Model", has_damage) +
         unnamed(deck.contact_models, "Contact > Models", "no interaction names it", is_of_contact) +
         misplaced_cracks(deck, situation.scene) + sets_of_all_points(deck, situation.scene.body.domain);
}

}  // namespace strut
