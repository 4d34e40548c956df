#include "integrators/explicit/multi_time_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/force_sum.hpp"

namespace strut {

namespace {

bool moves_rigidly(const Body& body, int i) { return body.block_of(i).in_rigid_motion; }

void scale(QuadraticState& state, double factor) {
  double* numbers = state.first;
  for (std::size_t n = 0; n < sizeof(QuadraticState) / sizeof(double); ++n) numbers[n] *= factor;
}

// Length of the step after a choice of levels over the sum of the steps before and after it. It is predicted from the
// frequency bounds, because the critical time step is estimated only later. 1 if no step came before.
double part_after(const PresentStep& present, double bound, bool anew) {
  if (present.is_first) return 1;
  const double ratio = anew && present.bound > 0 && bound > 0 ? present.bound / bound : 1;
  return ratio / (1 + ratio);
}

// At a change of levels, the impulse of a point's force lasts for half of the point's own step before the change and
// half of its own step after it. Scales the forces of points whose own step changes by this duration. `after`: length
// of the whole step after the change over the sum of both whole steps.
void spread_impulses(Body& body, const std::vector<std::uint8_t>& before, double after) {
  for_each_point(0, body.owned(), [&](int i) {
    const double old_fraction = before.empty() ? 1 : power_of_two(-before[i]), step_fraction = body.step_fraction(i);
    if (step_fraction == old_fraction) return;
    const double mean = (1 - after) * old_fraction + after * step_fraction;
    if (!body.force_states.tensors.empty()) {
      for (Eigen::Array4d& column : body.force_states.tensors[i].column) column *= mean / old_fraction;
    }
    if (!body.force_states.quadratics.empty()) scale(body.force_states.quadratics[i], mean / old_fraction);
    if (body.block_of(i).has_springs(ResidualKind::both_gradients))
      body.force_states.gradients[i].force_factor() = mean;
    body.force_density[i] *= mean / old_fraction;
  });
}

template <class State>
void exchange_states(Halo& halo, std::vector<State>& states) {
  if (!states.empty()) halo.exchange(states);
}

// The force of the far ends of the bonds on the points of a cluster.
template <class Weight>
small::Vector3<small::Lanes> far_force(const Body& body, const Cluster& cluster, Weight weight) {
  const ForceStates& states = body.force_states;
  small::Vector3<small::Lanes> sum = bonds::zero_vector<small::Lanes>();
  const auto add = [&sum](const small::Vector3<small::Lanes>& force) {
    for (int c = 0; c < 3; ++c) sum.c[c] += force.c[c];
  };
  if (!states.tensors.empty()) {
    add(bonds::far_force<true>(bonds::OfCluster{cluster}, body.domain.sites.data(), states.tensors.data(), weight));
  }
  if (!states.quadratics.empty()) add(quadratic_far_forces(body, cluster, states, weight));
  return sum;
}

}  // namespace

double MultiTimeStepping::choose(Body& body, double safety_factor, const PresentStep& present,
                                 const ActedOn& acted_on) {
  const std::vector<std::uint8_t> before = std::move(*body.time_levels);
  TimeStepLevels chosen = choose_levels(body, safety_factor, present, acted_on, before, !levels_.empty());
  anew_ = chosen.anew;
  bound_ = chosen.bound;
  body.time_levels = std::move(chosen.levels);
  make_levels(body);
  spread_impulses(body, before, part_after(present, bound_, anew_));
  return fastest_of(body);
}

double MultiTimeStepping::drop(Body& body, const PresentStep& present) {
  const std::vector<std::uint8_t> before = std::move(*body.time_levels);
  body.time_levels->clear();
  make_levels(body);
  const double fastest = fastest_of(body);
  anew_ = true, bound_ = body.domain.communicator.max(fastest);
  spread_impulses(body, before, part_after(present, bound_, anew_));
  return fastest;
}

// The largest product of frequency bound and fraction of the step of any point on this rank, 1/s.
double MultiTimeStepping::fastest_of(Body& body) {
  double fastest = 0;
  for (MaterialBlock& block : body.blocks) {
    const double of_block = largest_frequency_bound(body, block);
    if (block.in_rigid_motion) block.rest_frequency_bound = of_block;
    fastest = std::max(fastest, of_block);
  }
  return fastest;
}

// Sets up the substeps from the time-step levels of the points.
void MultiTimeStepping::make_levels(Body& body) {
  levels_.clear();
  motion_levels_.clear();
  exposed_.clear();
  updates_ = 1;
  double agreed[] = {0};  // the highest time-step level of any point
  for (const std::uint8_t h : body.time_levels) agreed[0] = std::max<double>(agreed[0], h);
  body.domain.communicator.max(agreed);
  const int count = static_cast<int>(agreed[0]);
  if (count == 0) return;
  motion_levels_ = motion_levels_of(body, body.time_levels);
  std::vector<std::uint8_t> everywhere = motion_levels_;
  with_ghosts(body, everywhere);
  for (int m = 1; m <= count; ++m) levels_.push_back(make_level(body, everywhere, m));
  if (count > 1) {
    for (int i = 0; i < body.owned(); ++i) exposed_.push_back(body.time_levels[i] > 1);
    spread(body, families_around_contact, exposed_);
  }
  double updates[] = {0, static_cast<double>(body.owned())};
  for (int i = 0; i < body.owned(); ++i) updates[0] += 1 << body.time_levels[i];
  body.domain.communicator.sum(updates);
  updates_ = updates[0] / updates[1];
}

void MultiTimeStepping::serialize(Archive& archive, Body& body) {
  bool any = body.domain.communicator.any(!body.time_levels.empty());  // ranks without points have none
  std::vector<std::uint8_t> levels(body.owned(), 0);
  if (!body.time_levels.empty()) std::copy_n(body.time_levels.begin(), body.owned(), levels.begin());
  archive.number("has_time_levels", any);
  archive.field("time_levels", 1, [&](std::size_t i, int) -> std::uint8_t& { return levels[i]; });
  if (!archive.loading()) return;
  body.time_levels->clear();
  if (any) {
    with_ghosts(body, levels);
    body.time_levels = std::move(levels);
  }
  make_levels(body);
}

MultiTimeStepping::Level MultiTimeStepping::make_level(const Body& body, const std::vector<std::uint8_t>& motion_levels,
                                                       int level) const {
  std::vector<std::uint8_t> wanted(motion_levels.size());
  for (std::size_t i = 0; i < motion_levels.size(); ++i) wanted[i] = motion_levels[i] >= level;
  Level result{.halo = body.domain.halo.restricted_to(body.domain.communicator, wanted)};
  const auto by_id = [&](int j) { return body.domain.id(j); };
  const auto family = [&](int i, const auto& visit) { body.domain.families.for_each(i, visit); };
  for (const MaterialBlock& block : body.blocks) {
    SelectedPoints& stressed = result.stressed.emplace_back();
    std::vector<int> points;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      if (body.time_levels[block.points[k]] < level) continue;
      stressed.places.push_back(static_cast<int>(k));
      points.push_back(block.points[k]);
    }
    ClusterLists::Builder(stressed.lists, motion_levels.size()).add_all(points, family, by_id);
  }
  for (int i = 0; i < body.owned(); ++i) {
    if (motion_levels[i] >= level) result.moved.push_back(i);
  }
  const auto sources = [&](int i, const auto& visit) {
    body.domain.families.for_each(i, [&](int j) {
      if (body.time_levels[j] >= level) visit(j);
    });
  };
  ClusterLists::Builder(result.sources, motion_levels.size()).add_all(result.moved, sources, by_id);
  set_moment_errors(body, result);
  return result;
}

void MultiTimeStepping::set_moment_errors(const Body& body, Level& level) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for (std::size_t b = 0; b < body.blocks.size(); ++b) {
      if (body.blocks[b].lattice < 0) continue;
      for (const int k : level.stressed[b].places) {
        const int i = body.blocks[b].points[k];
        const bonds::OfPoint family{{i}, body.domain.families};
        const Vector moment = bonds::first_moment(family, body.domain.sites.data(), weight);
        level.moment_errors.emplace_back(i, moment - body.first_moment[i]);
      }
    }
  });
}

StepReport MultiTimeStepping::forces(Body& body, int level, double dt, double time) {
  Level& now = levels_[level - 1];
  StepReport report;
  now.halo.exchange_positions(body.domain.sites);
  set_expansion(body, time, dt, level);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    MaterialBlock& block = body.blocks[b];
    if (block.in_rigid_motion || now.stressed[b].places.empty()) continue;
    const LaneGroups groups(block, now.stressed[b]);
    if (block.is_quadratic()) {
      advance_quadratic(body, block, {dt, level}, groups, report);
    } else {
      advance_stress(body, block, {dt, level}, groups, report);
    }
  }
  for (const int i : now.moved) {
    // The force of the point's own state acts at other times, or is zero. force_density still has the force of the last
    // whole step, with loads, and must be cleared.
    if (body.time_levels[i] < level || moves_rigidly(body, i)) body.force_density[i].setZero();
  }
  for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) { add_residuals<S>(kind, body, now, level); });
  for (const auto& [i, error] : now.moment_errors) {
    if (!moves_rigidly(body, i)) body.force_density[i] += bonds::tensor_of(body.force_states.tensors[i]) * error;
  }
  exchange_states(now.halo, body.force_states.tensors);
  exchange_states(now.halo, body.force_states.quadratics);
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, now.sources.count(), [&, weight](int b) {
      const Cluster cluster = now.sources[b];
      const small::Vector3<small::Lanes> far = far_force(body, cluster, weight);
      for (int l = 0; l < static_cast<int>(cluster.points.size()); ++l) {
        const int i = cluster.points[l];
        if (!moves_rigidly(body, i)) body.force_density[i] += at(far, l);
      }
    });
  });
  return report;
}

// Adds the springs on both ends' gradients to the points that are stressed at this level.
template <class S>
void MultiTimeStepping::add_residuals(std::size_t kind, Body& body, Level& now, int level) const {
  ForceStates& states = body.force_states;
  if (states.gradients.empty()) return;
  exchange_states(now.halo, states.gradients);
  const auto is_active = [&](int i) {
    const MaterialBlock& block = body.block_of(i);
    return body.time_levels[i] >= level && block.material.stabilization.index() == kind &&
           block.has_springs(ResidualKind::both_gradients) && !block.in_rigid_motion;
  };
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, now.sources.count(), [&, weight](int b) {
      const Cluster cluster = now.sources[b];
      const auto sums = bonds::residual<S>(kind, bonds::OfCluster{cluster}, body.domain.sites.data(),
                                           states.gradients.data(), weight);
      for (int l = 0; l < static_cast<int>(cluster.points.size()); ++l) {
        const int i = cluster.points[l];
        if (!is_active(i)) continue;
        add_residual(at(sums.force, l), at(sums.moment, l), body.shape_inverse[i], body.first_moment[i],
                     states.tensors[i], body.force_density[i]);
      }
    });
  });
}

}  // namespace strut
