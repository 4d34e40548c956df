// Limits: the stretch at which bonds break, and the steepness that a family with broken bonds may have.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "fracture/fracture.hpp"
#include "fracture/separation.hpp"
#include "mechanics/steepness.hpp"
#include "topology/mirror_planes.hpp"

namespace strut {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double of_failed = 1e-200;  // a limit that every bond exceeds

}  // namespace

void Fracture::set_limits(const Body& body, double time) {
  std::vector<double> of_block;
  for (const MaterialBlock& block : body.blocks) {
    const auto& damage = block.material.damage;
    const double s = damage && damage->critical_stretch ? (*damage->critical_stretch)(0, 0, 0, time) : never;
    if (!(s > 0)) {  // the same on all ranks
      throw Error(text_of("the critical stretch of block '", block.name, "' is ", s, " at t = ", time,
                          " s; expected a number > 0"));
    }
    of_block.push_back(1 + s);
  }
  limits_.resize(block_of_.size(), 0);
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    if (limits_[i] == of_failed) continue;
    const double expansion = body.expansion_of_sites.empty() ? 0 : body.expansion_of_sites[i];
    const double most = of_block[block_of_[i]] + expansion;  // of |η|/|ξ|
    limits_[i] = most * most;
  }
}

bool Fracture::limits_change(const Body& body) const { return by_time_ || !body.expansion.empty(); }

// Points that failed in the last step: all of their bonds break, and the clusters of both ends are checked.
void Fracture::take_failed(const Body& body) {
  std::vector<char> is_new;  // empty if there are none, as in most steps
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    if (limits_[i] == of_failed || !may_fail_[block_of_[i]]) continue;
    if (!body.force_states.has_failed(i)) continue;
    limits_[i] = of_failed;
    is_new.resize(limits_.size());
    is_new[i] = true;
  }
  mark_for_check(body, is_new);
}

// The limit of a point's steepness is `steepness_of_corners` times the least in its block, which is that of an interior
// point; both are compared in spacings and for whole cells. So families with broken bonds do not reduce the critical
// time step below that of corners. A point that is steeper from the start may grow by half.
void Fracture::set_most_steepness(const Body& body) {
  constexpr double more_than_first = 1.5;
  const auto per_steepness = [&body](int i) {
    return coincident_images(body.domain, i) * std::pow(body.domain.cloud.spacings[i], 2);
  };
  const auto in_spacings = [&](int i) { return steepness(body, i) * per_steepness(i); };
  std::vector<double> least;  // of each block, with negative sign
  for (const MaterialBlock& block : body.blocks) {
    double most = -never;
    for (const int i : block.points) most = std::max(most, in_spacings(i) > 0 ? -in_spacings(i) : -never);
    least.push_back(most);
  }
  body.domain.communicator.max(least);
  for (int i = 0; i < body.owned(); ++i) {
    const double of_block = -steepness_of_corners * least[body.domain.cloud.blocks[i]] / per_steepness(i);
    most_steepness_.push_back(std::max(of_block, more_than_first * steepness(body, i)));
  }
}

void Fracture::set_shortest(const Body& body) {
  for (std::size_t b = 0; b < next_checks_.size(); ++b) {
    const Cluster cluster = body.domain.families.lists[static_cast<int>(b)];
    double shortest = never;
    for (std::size_t n = 0; n < cluster.near.size(); ++n) {
      for (std::size_t l = 0; l < cluster.points.size(); ++l) {
        if (!(cluster.mask[n] >> l & 1)) continue;
        const Vector xi = body.domain.reference(cluster.near[n]) - body.domain.reference(cluster.points[l]);
        shortest = std::min(shortest, xi.norm());
      }
    }
    shortest_.push_back(shortest);
  }
}

}  // namespace strut
