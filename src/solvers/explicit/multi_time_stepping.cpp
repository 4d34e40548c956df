#include "solvers/explicit/multi_time_stepping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mechanics/cost.hpp"
#include "mechanics/force_sum.hpp"
#include "mechanics/fracture/fracture.hpp"

namespace strut {

namespace {

constexpr int max_level = 6;

// The fastest motion of a point whose stress is stepped by Δt/2^h turns by no more than twice this angle in its step,
// and by four times in the step of the level below: less than half a period (docs/theory.md, Multi-time-stepping).
constexpr double most_turn = 0.6;

// What points cost is not timed in a run, which would then be another on another machine or the second time; these
// constants are measured (docs/decisions.md, What subcycling costs).
//
// A substep of a point, with its share of the points that it moves, beside a whole step of that point: more than is
// measured on one rank, for each substep has exchanges of its own.
constexpr double cost_of_substep = 1.5;

// Contact acts once a step, on points of level 1 at the most and no nearer than this to those of higher levels: an
// impulse a step is in resonance with what is faster than most_turn allows there (docs/theory.md, Multi-time-stepping).
constexpr int families_around_contact = 3;

constexpr double worth_while = 0.75;    // of the cost of a run without
constexpr double worth_a_change = 0.9;  // of the cost of a run whose step stays as it is

// A point's level falls when its frequency bound could be so much larger on the lower one: each change takes or gives
// energy, and bounds go up and down with vibrations.
constexpr double slack = 1.25;

// Of a frequency bound: those of points that are the same but for their places differ by so much at the most, and have
// the same level.
constexpr double round_off = 1e-9;

// What a step of which frequency bound costs, in classes that are an eighth of an octave wide.
class FrequencyHistogram {
 public:
  static constexpr int classes_per_octave = 8, octaves = 32, classes = classes_per_octave * octaves;

  FrequencyHistogram(double fastest, double margin) : fastest_(fastest), margin_(margin) {}
  void add(double frequency_bound, double cost) { costs_[class_of(frequency_bound)] += cost; }
  void agree(const Communicator& communicator) { communicator.sum(costs_); }

  // Frequency bounds of points of level 0 are below this, where the run costs least.
  double best() const {
    int best = 0;
    const int last = static_cast<int>(classes_per_octave * (max_level + std::log2(margin_)));
    for (int c = 1; c <= last; ++c) {
      if (cost(c) < cost(best)) best = c;
    }
    return bound(best);
  }

 private:
  double bound(int c) const { return fastest_ * std::exp2(-static_cast<double>(c) / classes_per_octave); }
  int class_of(double frequency_bound) const {
    const double c = std::floor(classes_per_octave * std::log2((1 + round_off) * fastest_ / frequency_bound));
    return c < classes ? static_cast<int>(std::max(c, 0.0)) : classes - 1;  // NaN, too: such a point has failed
  }
  // Of the same time, with steps for points of the frequency bound bound(c) and below.
  double cost(int c) const;

  double fastest_, margin_;
  std::array<double, classes> costs_{};  // of whole steps of all points in the class
};

// A point of a higher level is at most `margin` times as fast in its own steps as one of level 0.
int level_of(double frequency_bound, double bound, double margin) {
  const double least = (1 - round_off) * frequency_bound;
  if (!(least > bound)) return 0;
  return std::clamp(static_cast<int>(std::ceil(std::log2(least / (margin * bound)))), 1, max_level);
}

// The cost of a step of a point, in that of one of level 0.
double cost_of(int levels) { return 1 + cost_of_substep * ((1 << levels) - 1); }

double FrequencyHistogram::cost(int c) const {
  double sum = 0;
  for (int k = 0; k < classes; ++k) {
    sum += costs_[k] * cost_of(k < c ? level_of(bound(k), bound(c), margin_) : 0);
  }
  return sum * bound(c);
}

// Whether the points of a block may have smaller steps: not in a body with ordinary points, whose forces act once a
// step.
bool may_be_subcycled(const Body& body, std::size_t block) {
  if (body.fracture && body.fracture->may_break(block)) return false;  // bonds break between whole steps
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.domain.blocks[b].body == body.domain.blocks[block].body && body.blocks[b].is_ordinary()) return false;
  }
  return true;
}

// Of a whole step of a point, also while it is in rigid motion: it will not stay so.
double cost_of_point(const Body& body, int i) { return body.block_of(i).is_quadratic() ? cost_of_quadratic : 1; }

bool moves_rigidly(const Body& body, int i) { return body.block_of(i).in_rigid_motion; }

// Calls visit(i, whether it may have a higher level) for the owned points.
template <class Visit>
void over_points(const Body& body, Visit&& visit) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const bool may = may_be_subcycled(body, b);
    for (const int i : body.blocks[b].points) visit(i, may);
  }
}

// The frequency bounds of owned points over all ranks: the largest, and the largest of those that may not have a higher
// level.
struct FrequencyBounds {
  std::vector<double> values;
  double largest = 0, floor = 0;
};

FrequencyBounds frequency_bounds_of(const Body& body) {
  FrequencyBounds bounds{frequency_bounds(body)};
  double agreed[] = {0, 0};
  over_points(body, [&](int i, bool may) {
    agreed[0] = std::max(agreed[0], bounds.values[i]);
    if (!may) agreed[1] = std::max(agreed[1], bounds.values[i]);
  });
  body.domain.communicator.max(agreed);
  bounds.largest = agreed[0], bounds.floor = agreed[1];
  return bounds;
}

// The ghosts' too.
void exchange(const Body& body, const Halo& halo, std::vector<std::uint8_t>& numbers) {
  numbers.resize(body.domain.sites.size());
  halo.exchange(numbers);
}

// In the family of a point of level h all are of level h − 1 at least (docs/theory.md, Multi-time-stepping). Few points
// are of level 2 and more: where no ghost is, each of them raises its neighbors, and other families are not looked at.
void smooth_levels(Body& body, std::vector<std::uint8_t>& levels) {
  const int owned = body.owned();
  double highest[] = {0};
  for (const std::uint8_t h : levels) highest[0] = std::max<double>(highest[0], h);
  body.domain.communicator.max(highest);
  for (int n = 1; n < highest[0]; ++n) {
    const std::vector<std::uint8_t> before = levels;
    const auto is_high = [&before](int i) { return before[i] >= 2; };
    const auto raise = [&](int i, int j) {
      if (i < owned && before[j] > levels[i] + 1) levels[i] = before[j] - 1;
    };
    bool high_ghosts = false;
    for (int j = owned; j < static_cast<int>(before.size()); ++j) high_ghosts = high_ghosts || is_high(j);
    for (int i = 0; i < owned; ++i) {
      if (high_ghosts) body.domain.families.for_each(i, [&](int j) { raise(i, j); });
      if (!high_ghosts && is_high(i)) body.domain.families.for_each(i, [&](int j) { raise(j, i); });
    }
    levels.resize(owned);
    exchange(body, body.domain.halo, levels);
  }
}

// All that is so many families from a marked point at the most.
void spread(const Body& body, int families, std::vector<std::uint8_t>& marks) {
  exchange(body, body.domain.halo, marks);
  for (int n = 0; n < families; ++n) {
    const std::vector<std::uint8_t> before = marks;
    for (int i = 0; i < body.owned(); ++i) {
      body.domain.families.for_each(i, [&](int j) { marks[i] = std::max(marks[i], before[j]); });
    }
    marks.resize(body.owned());
    exchange(body, body.domain.halo, marks);
  }
}

// Of each body, the points that move damped ones have one bound, so that they are of one level: between the impulses of
// coarser steps a damper lets the velocity decay, and an impulse does the work of the mean of the velocities before and
// after it, which is then more than that over its step. The bound is that of all points whose level reaches there.
void even_out(const Body& body, std::vector<std::uint8_t> damped, FrequencyBounds& bounds) {
  std::vector<std::uint8_t> reaching = damped;
  spread(body, 1, damped);
  spread(body, max_level, reaching);  // levels fall by one a family
  std::vector<double> most(body.blocks.size(), 0);  // of bodies, which are no more than blocks
  const auto of_body = [&](int i) -> double& { return most[body.domain.blocks[body.domain.cloud.blocks[i]].body]; };
  for (int i = 0; i < body.owned(); ++i) {
    if (reaching[i]) of_body(i) = std::max(of_body(i), bounds.values[i]);
  }
  body.domain.communicator.max(most);
  over_points(body, [&](int i, bool may) {
    if (!damped[i]) return;
    bounds.values[i] = of_body(i);
    if (!may) bounds.floor = std::max(bounds.floor, bounds.values[i]);
  });
  bounds.floor = body.domain.communicator.max(bounds.floor);
}

// The frequency bound of level 0 that leaves the marked points level 1.
double floor_of_pushed(const Body& body, const FrequencyBounds& bounds, double margin,
                       const std::vector<std::uint8_t>& marks) {
  double most = 0;
  for (int i = 0; i < body.owned(); ++i) most = std::max(most, marks[i] ? bounds.values[i] : 0);
  return body.domain.communicator.max(most) / (2 * margin);
}

// Of owned points and ghosts, empty of none; for steps that points of the frequency bound `bound` and below can have;
// and the work of a step.
struct Levels {
  std::vector<std::uint8_t> levels = {};
  double bound, work;
};

double work_of_step(const Body& body, const std::vector<std::uint8_t>& levels) {
  double work = 0;
  for (int i = 0; i < body.owned(); ++i) work += cost_of_point(body, i) * cost_of(levels.empty() ? 0 : levels[i]);
  return body.domain.communicator.sum(work);
}

// `before`: the levels so far, if any, that points keep which nothing pushes.
Levels levels_for(Body& body, const FrequencyBounds& bounds, double bound, double margin,
                  const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& pushed) {
  std::vector<std::uint8_t> levels(body.owned(), 0);
  over_points(body, [&](int i, bool may) {
    if (!may) return;
    levels[i] = level_of(bounds.values[i], bound, margin);
    if (before.empty() || before[i] <= levels[i] || (!pushed.empty() && pushed[i])) return;
    levels[i] = std::max<int>(levels[i], std::min<int>(before[i], level_of(slack * bounds.values[i], bound, margin)));
  });
  exchange(body, body.domain.halo, levels);
  smooth_levels(body, levels);
  const double work = work_of_step(body, levels);
  return {std::move(levels), bound, work};
}

// What costs least; points between stiff ones count, too.
Levels cheapest_levels(Body& body, const FrequencyBounds& bounds, double margin) {
  FrequencyHistogram histogram(bounds.largest, margin);
  for (int i = 0; i < body.owned(); ++i) histogram.add(bounds.values[i], cost_of_point(body, i));
  histogram.agree(body.domain.communicator);
  const double bound = std::max(histogram.best(), bounds.floor);
  Levels none{{}, bounds.largest, work_of_step(body, {})};
  if (!(bound < bounds.largest)) return none;
  Levels some = levels_for(body, bounds, bound, margin, {}, {});
  return some.work * bound < worth_while * none.work * none.bound ? some : none;
}

// The level of the motion of each point: that of any point whose stress moves it.
std::vector<std::uint8_t> motion_levels_of(const Body& body, const std::vector<std::uint8_t>& levels) {
  std::vector<std::uint8_t> motion_levels(levels.begin(), levels.begin() + body.owned());
  for_each_point(0, body.owned(), [&](int i) {
    body.domain.families.for_each(i, [&](int j) { motion_levels[i] = std::max(motion_levels[i], levels[j]); });
  });
  return motion_levels;
}

void scale(QuadraticState& state, double factor) {
  double* numbers = state.first;
  for (std::size_t n = 0; n < sizeof(QuadraticState) / sizeof(double); ++n) numbers[n] *= factor;
}

// Half of the impulse belongs to the interval before, half to the one after.
void spread_impulses(Body& body, const std::vector<std::uint8_t>& before) {
  over_points(body, [&](int i, bool) {
    const double old_share = before.empty() ? 1 : power_of_two(-before[i]), share = body.share(i);
    if (share == old_share) return;
    const double mean = 0.5 * (old_share + share);
    if (!body.force_states.tensors.empty()) {
      for (Eigen::Array4d& column : body.force_states.tensors[i].column) column *= mean / old_share;
    }
    if (!body.force_states.quadratics.empty()) scale(body.force_states.quadratics[i], mean / old_share);
    if (body.block_of(i).has_springs(ResidualKind::both_gradients)) body.force_states.gradients[i].step_share() = mean;
    body.force_density[i] *= mean / old_share;
  });
}

template <class State>
void exchange_states(Halo& halo, std::vector<State>& states) {
  if (!states.empty()) halo.exchange(states);
}

// What the far ends of the bonds of a cluster give to the forces on its points.
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
                                 const std::vector<std::uint8_t>& pushed, const std::vector<std::uint8_t>& damped) {
  const std::vector<std::uint8_t> before = std::move(*body.time_levels);
  const double margin = std::min(1.0, most_turn / safety_factor);
  const double bearable = (1 + round_off) * present.slack * present.bound;
  FrequencyBounds bounds = frequency_bounds_of(body);
  if (body.domain.communicator.max(damped.empty() ? 0.0 : 1.0) > 0) even_out(body, damped, bounds);
  std::vector<std::uint8_t> around = pushed;
  if (body.domain.communicator.max(pushed.empty() ? 0.0 : 1.0) > 0) {  // a rank without points has no marks
    spread(body, families_around_contact, around);
    bounds.floor = std::max(bounds.floor, floor_of_pushed(body, bounds, margin, around));
  }
  Levels best = cheapest_levels(body, bounds, margin);
  anew_ = true;
  if (present.bound > 0 && bearable >= bounds.floor) {
    Levels kept = levels_for(body, bounds, bearable, margin, before, around);
    const bool of_none = levels_.empty() && best.bound == bounds.largest && bearable >= bounds.largest;
    anew_ = !of_none && best.work * best.bound < worth_a_change * kept.work * present.bound;
    if (!anew_) best = std::move(kept);
  }
  bound_ = best.bound;
  body.time_levels = std::move(best.levels);
  make_levels(body);
  spread_impulses(body, before);
  double fastest = 0;
  for (MaterialBlock& block : body.blocks) {
    const double of_block = largest_frequency_bound(body, block);
    if (block.in_rigid_motion) block.rest_frequency_bound = of_block;
    fastest = std::max(fastest, of_block);
  }
  return fastest;
}

// What the time-step levels of the points mean for their steps.
void MultiTimeStepping::make_levels(Body& body) {
  levels_.clear();
  motion_levels_.clear();
  exposed_.clear();
  updates_ = 1;
  double agreed[] = {0};  // the most time-step levels of any point
  for (const std::uint8_t h : body.time_levels) agreed[0] = std::max<double>(agreed[0], h);
  body.domain.communicator.max(agreed);
  const int count = static_cast<int>(agreed[0]);
  if (count == 0) return;
  motion_levels_ = motion_levels_of(body, body.time_levels);
  std::vector<std::uint8_t> everywhere = motion_levels_;
  exchange(body, body.domain.halo, everywhere);
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
  bool any = body.domain.communicator.max(body.time_levels.empty() ? 0.0 : 1.0) > 0;  // ranks without points have none
  std::vector<std::uint8_t> levels(body.owned(), 0);
  if (!body.time_levels.empty()) std::copy_n(body.time_levels.begin(), body.owned(), levels.begin());
  archive.number("has_time_levels", any);
  archive.field("time_levels", 1, [&](std::size_t i, int) -> std::uint8_t& { return levels[i]; });
  if (!archive.loading()) return;
  body.time_levels->clear();
  if (any) {
    exchange(body, body.domain.halo, levels);
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
        const bonds::OfPoint family{body.domain.families, i};
        const Vector moment = bonds::first_moment(family, body.domain.sites.data(), weight);
        level.moment_errors.emplace_back(i, moment - body.first_moment[i]);
      }
    }
  });
}

StepReport MultiTimeStepping::forces(Body& body, int level, double dt) {
  Level& now = levels_[level - 1];
  StepReport report;
  now.halo.exchange_places(body.domain.sites);
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
    // Its own state acts at other times, or is none: what is left is the force of the last whole step, with its loads.
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

// The springs on both ends' gradients, of the bonds between points that are due.
template <class S>
void MultiTimeStepping::add_residuals(std::size_t kind, Body& body, Level& now, int level) const {
  ForceStates& states = body.force_states;
  if (states.gradients.empty()) return;
  exchange_states(now.halo, states.gradients);
  const auto is_due = [&](int i) {
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
        if (!is_due(i)) continue;
        add_residual(at(sums.force, l), at(sums.moment, l), body.shape_inverse[i], body.first_moment[i],
                     states.tensors[i], body.force_density[i]);
      }
    });
  });
}

}  // namespace strut
