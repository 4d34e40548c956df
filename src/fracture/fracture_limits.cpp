// Limits: the stretch at which bonds break, how long steps are for that, and the steepness that a family with broken
// bonds may have.
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

using small::Lanes;

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

namespace {

// True if the stress of a point of a gradual crack has fallen before it did work, in a step that led far beyond it.
bool fell_at_once(const MaterialBlock& block, int i) {
  const auto at = std::lower_bound(block.points.begin(), block.points.end(), i);
  const auto k = static_cast<int>(at - block.points.begin());
  const auto fell = [&]<class L>(const L& law) {
    if constexpr (materials::opens_cracks<L>) {
      for (int q = 0; q < block.points_per_cell(); ++q) {
        const auto state = block.state_of<L>(block.index(k, q));
        if (state.damage > 0.9 && state.dissipated * law.width < 0.5 * law.fracture_energy) return true;
      }
    }
    return false;
  };
  return std::visit(fell, block.material.law);
}

}  // namespace

// Adds one end of a bond that breaks in a step of dt; load: of its energy at the step's start, over the critical one,
// if it breaks by that.
//
// By its stretch, which goes from s to s' in the step, a break takes s s'/s_c² of the energy of the bond at s_c, since
// the force acts over the means of both ends (work_balance.hpp): over many breaks 1 − d²/6 where the steps are d s_c
// long, but nothing where one leads from 0 beyond s_c. By its energy it takes that at the step's start. A gradual crack
// takes what it should, or next to nothing if its stress falls to nothing in one step: measured where a step opens it
// by 0.4 of its last opening, beneath a surface layer, which opens alone, by 0.25.
void Fracture::count_in_steps(const Body& body, int i, int j, double load, double dt) {
  constexpr double leap = 0.5;  // of the critical stretch
  const int weaker = limits_[i] < limits_[j] ? i : j;
  const double expansion = body.expansion_of_sites.empty() ? 0 : body.expansion_of_sites[weaker];
  const double rest = (body.domain.reference(j) - body.domain.reference(i)).norm();
  const double before = (start_[j] - start_[i]).norm() / rest - 1 - expansion,
               after = (body.domain.current(j) - body.domain.current(i)).norm() / rest - 1 - expansion;
  const double by_stretch = std::sqrt(limits_[weaker]) - 1 - expansion;
  const double critical = load > 1 ? before / std::sqrt(load) : by_stretch, moved = (after - before) / critical;
  if (!(critical > 0) || moved == 0 || (load <= 1 && before >= critical)) return;
  const MaterialBlock& block = body.blocks[block_of_[i]];
  const bool is_gradual = block.material.damage && block.material.damage->is_gradual;
  const double by_step = !is_gradual                               ? before * after / (critical * critical)
                         : moved < leap && !fell_at_once(block, i) ? 1
                                                                   : 0;
  in_steps_.ends += 1;
  in_steps_.taken += load > 1 ? std::min(load, (1 + moved) * (1 + moved)) : by_step;
  in_steps_.speed2 += moved * moved / (dt * dt);
}

void Fracture::count_in_steps(const Body& body, const MaterialBlock& block, const Cluster& cluster,
                              const std::vector<std::uint8_t>& gone, double dt) {
  std::vector<Lanes> loads(gone.size(), Lanes::Zero());
  if (holds_energy(body, block)) {
    energies_.over(body, cluster, start_, [&](std::size_t n, const Lanes& load, const Lanes&) { loads[n] = load; });
  }
  for (std::size_t n = 0; n < gone.size(); ++n) {
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      if (gone[n] >> l & 1) count_in_steps(body, cluster.points[l], cluster.near[n], loads[n][l], dt);
    }
  }
}

BreaksInSteps Fracture::breaks_in_steps(const Communicator& ranks) const {
  return {ranks.sum(in_steps_.ends), ranks.sum(in_steps_.taken), ranks.sum(in_steps_.speed2)};
}

void Fracture::serialize_steps(Archive& archive) {
  archive.rank_sum("breaks_in_steps_ends", in_steps_.ends);
  archive.rank_sum("breaks_in_steps_taken", in_steps_.taken);
  archive.rank_sum("breaks_in_steps_speed2", in_steps_.speed2);
}

// The limit of a point's steepness is `steepness_of_corners` times the least in the blocks of its body that are of its
// formulation, which is that of an interior point, however the body is cut in blocks; both are compared in spacings and
// for whole cells. So families with broken bonds do not reduce the critical time step below that of corners. A point
// that is steeper from the start may grow by half.
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
  const std::vector<double> of_blocks = least;
  for (std::size_t a = 0; a < least.size(); ++a) {
    for (std::size_t b = 0; b < least.size(); ++b) {
      const bool are_alike = body.domain.blocks[a].body == body.domain.blocks[b].body &&
                             body.blocks[a].material.formulation == body.blocks[b].material.formulation;
      if (are_alike) least[a] = std::max(least[a], of_blocks[b]);
    }
  }
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
