#include <algorithm>
#include <sstream>

#include "advice/checks.hpp"
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

// The ball around a crack.
struct Ball {
  Vector center, normal;
  double radius;
};

Ball around(const RectangularCrack& crack) {
  const Vector diagonal = crack.length * crack.along + crack.width * crack.along.cross(crack.normal);
  return {crack.corner + 0.5 * diagonal, crack.normal, 0.5 * diagonal.norm()};
}

Ball around(const TriangulatedCrack&) { return {}; }

Ball around(const DiskCrack& crack) { return {crack.center, crack.normal, crack.radius}; }

// True if the crack is within the horizon of point i, so that it may cross bonds of the point.
bool may_part(const Ball& crack, const Domain& domain, int i) {
  const Vector apart = domain.reference(i) - crack.center;
  const double horizon = domain.horizon(i);
  return std::abs(apart.dot(crack.normal)) <= horizon && apart.norm() <= crack.radius + horizon;
}

std::string cracks_that_cut_nothing(const deck::Deck& deck, const Domain& domain) {
  std::ostringstream text;
  for (const Crack& crack : deck.discretization.cracks) {
    const Ball ball = std::visit([](const auto& one) { return around(one); }, crack);  // none is of triangles
    const bool cuts = std::any_of(domain.separated.begin(), domain.separated.end(),
                                  [&](const auto& pair) { return may_part(ball, domain, pair.first); });
    if (domain.communicator.max(cuts ? 1.0 : 0.0) > 0) continue;
    text << "WARNING: Discretization > Bond Filters: the crack around " << place_text(ball.center)
         << " cuts no bond; are its lengths in m, and is it in a body?\n";
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
    if (domain.communicator.max(some_are_not ? 1.0 : 0.0) > 0) continue;
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
         cracks_that_cut_nothing(deck, situation.scene.body.domain) +
         sets_of_all_points(deck, situation.scene.body.domain);
}

}  // namespace strut
