#include "integrators/explicit/time_step_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mechanics/formulation/formulation.hpp"
#include "mechanics/mechanics.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

void with_ghosts(const Body& body, std::vector<std::uint8_t>& numbers) {
  numbers.resize(body.domain.sites.size());
  body.domain.halo.exchange(numbers);
}

void spread(const Body& body, int families, std::vector<std::uint8_t>& marks) {
  with_ghosts(body, marks);
  for (int n = 0; n < families; ++n) {
    const std::vector<std::uint8_t> before = marks;
    for (int i = 0; i < body.owned(); ++i) {
      body.domain.families.for_each(i, [&](int j) { marks[i] = std::max(marks[i], before[j]); });
    }
    marks.resize(body.owned());
    with_ghosts(body, marks);
  }
}

namespace {

constexpr int max_level = 6;

// The fastest motion of a point whose stress is updated every Δt/2^h turns by at most twice this angle (rad) in its
// step, and four times in the step of the level below: less than half a period (docs/theory.md, Multi-time-stepping).
constexpr double most_turn = 0.6;

// Costs are not timed in the run, because the run would then differ on another machine or when repeated; these
// constants are measured (docs/decisions.md, Cost of subcycling).
//
// Cost of a substep of a point, including the neighbors that it moves, relative to a whole step of that point. It is
// larger than measured on one rank, because each substep has its own exchanges.
constexpr double cost_of_substep = 1.5;

constexpr double worth_while = 0.75;    // relative to the cost of a run without levels
constexpr double worth_a_change = 0.9;  // relative to the cost of a run that keeps its step

// A point's level falls only if the lower one would allow a frequency bound this much larger: each change adds or
// removes energy, and bounds fluctuate with vibrations.
constexpr double slack = 1.25;

// Relative: frequency bounds of points that are equal except for their positions differ by at most this, and get the
// same level.
constexpr double round_off = 1e-9;

// The cost of steps by frequency bound, in classes of an eighth of an octave.
class FrequencyHistogram {
 public:
  static constexpr int classes_per_octave = 8, octaves = 32, classes = classes_per_octave * octaves;

  FrequencyHistogram(double fastest, double margin) : fastest_(fastest), margin_(margin) {}
  void add(double frequency_bound, double cost) { costs_[class_of(frequency_bound)] += cost; }
  void agree(const Communicator& communicator) { communicator.sum(costs_); }

  // The frequency bound up to which points have level 0 at the least cost.
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
  // The cost of a given simulated time, if the step fits points of the frequency bound bound(c) and below.
  double cost(int c) const;

  double fastest_, margin_;
  std::array<double, classes> costs_{};  // of whole steps of all points in the class
};

// A point of a higher level may be at most `margin` times as fast in its own step as one of level 0.
int level_of(double frequency_bound, double bound, double margin) {
  const double least = (1 - round_off) * frequency_bound;
  if (!(least > bound)) return 0;
  return std::clamp(static_cast<int>(std::ceil(std::log2(least / (margin * bound)))), 1, max_level);
}

// The cost of a step of a point, relative to one of level 0.
double cost_of(int levels) { return 1 + cost_of_substep * ((1 << levels) - 1); }

double FrequencyHistogram::cost(int c) const {
  double sum = 0;
  for (int k = 0; k < classes; ++k) {
    sum += costs_[k] * cost_of(k < c ? level_of(bound(k), bound(c), margin_) : 0);
  }
  return sum * bound(c);
}

// True if points of a block may have substeps: not in a body with ordinary points, whose forces act once per
// step.
bool may_be_subcycled(const Body& body, std::size_t block) {
  if (body.may_break(block)) return false;  // bonds break between whole steps
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.domain.blocks[b].body == body.domain.blocks[block].body && body.blocks[b].is_ordinary()) return false;
  }
  return true;
}

// The cost of a whole step of a point, also in rigid motion, which will not last.
double cost_of_point(const Body& body, int i) { return body.block_of(i).is_quadratic() ? cost_of_quadratic : 1; }

// Calls visit(i, whether it may have a higher level) for the owned points.
template <class Visit>
void over_points(const Body& body, Visit&& visit) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const bool may = may_be_subcycled(body, b);
    for (const int i : body.blocks[b].points) visit(i, may);
  }
}

// Frequency bounds of the owned points; over all ranks, the largest, and the largest of points that may not have a
// higher level.
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

// All points in the family of a point of level h have at least level h − 1 (docs/theory.md, Multi-time-stepping). Few
// points have level 2 or more: without ghosts, each of them raises its neighbors, and other families are not visited.
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
    with_ghosts(body, levels);
  }
}

// In each body, all points whose stress moves damped points get the same bound, and so the same level. Else a damper
// would reduce the velocity between the impulses of points with longer steps: an impulse does work by the mean of the
// velocities before and after it, which would then exceed the mean velocity over its step. The common bound is the
// largest bound of the points near enough to raise the level there.
void even_out(const Body& body, std::vector<std::uint8_t> damped, FrequencyBounds& bounds) {
  std::vector<std::uint8_t> reaching = damped;
  spread(body, 1, damped);
  spread(body, max_level, reaching);  // levels fall by one a family
  std::vector<double> most(body.domain.body_count(), 0);
  const auto of_body = [&](int i) -> double& { return most[body.domain.body_of(i)]; };
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

// All points whose stress moves a point that a tool rubs get one level. Else friction would take the velocity between
// the impulses of points with longer steps, as a damper does (even_out). Bonds that may break keep level 0.
void even_out_rubbed(Body& body, const std::vector<std::uint8_t>& rubbed, std::vector<std::uint8_t>& levels) {
  const auto may_rise = [&body](int i) { return may_be_subcycled(body, body.domain.cloud.blocks[i]); };
  for (bool changed = true; body.domain.communicator.any(changed);) {
    changed = false;
    std::vector<std::uint8_t> needed(body.owned(), 0);
    for (int i = 0; i < body.owned(); ++i) {
      if (!rubbed[i]) continue;
      needed[i] = levels[i];
      body.domain.families.for_each(i, [&](int j) { needed[i] = std::max(needed[i], levels[j]); });
    }
    spread(body, 1, needed);
    for (int i = 0; i < body.owned(); ++i) {
      if (needed[i] <= levels[i] || !may_rise(i)) continue;
      levels[i] = needed[i], changed = true;
    }
    levels.resize(body.owned());
    with_ghosts(body, levels);
  }
}

// The frequency bound of level 0 for which the marked points have level 1.
double floor_of_pushed(const Body& body, const FrequencyBounds& bounds, double margin,
                       const std::vector<std::uint8_t>& marks) {
  double most = 0;
  for (int i = 0; i < body.owned(); ++i) most = std::max(most, marks[i] ? bounds.values[i] : 0);
  return body.domain.communicator.max(most) / (2 * margin);
}

double work_of_step(const Body& body, const std::vector<std::uint8_t>& levels) {
  double work = 0;
  for (int i = 0; i < body.owned(); ++i) work += cost_of_point(body, i) * cost_of(levels.empty() ? 0 : levels[i]);
  return body.domain.communicator.sum(work);
}

// `before`: the present levels, if any; a level falls only if the bound allows `slack`, or where something pushes.
TimeStepLevels levels_for(Body& body, const FrequencyBounds& bounds, double bound, double margin,
                          const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& pushed,
                          const std::vector<std::uint8_t>& rubbed) {
  std::vector<std::uint8_t> levels(body.owned(), 0);
  over_points(body, [&](int i, bool may) {
    if (!may) return;
    levels[i] = level_of(bounds.values[i], bound, margin);
    if (before.empty() || before[i] <= levels[i] || (!pushed.empty() && pushed[i])) return;
    levels[i] = std::max<int>(levels[i], std::min<int>(before[i], level_of(slack * bounds.values[i], bound, margin)));
  });
  with_ghosts(body, levels);
  smooth_levels(body, levels);
  if (body.domain.communicator.any(!rubbed.empty())) {
    even_out_rubbed(body, rubbed, levels);
    smooth_levels(body, levels);
  }
  const double work = work_of_step(body, levels);
  return {std::move(levels), bound, work};
}

// The levels of least cost, including the levels of points near stiff ones.
TimeStepLevels cheapest_levels(Body& body, const FrequencyBounds& bounds, double margin,
                               const std::vector<std::uint8_t>& rubbed) {
  FrequencyHistogram histogram(bounds.largest, margin);
  for (int i = 0; i < body.owned(); ++i) histogram.add(bounds.values[i], cost_of_point(body, i));
  histogram.agree(body.domain.communicator);
  const double bound = std::max(histogram.best(), bounds.floor);
  TimeStepLevels none{{}, bounds.largest, work_of_step(body, {})};
  if (!(bound < bounds.largest)) return none;
  TimeStepLevels some = levels_for(body, bounds, bound, margin, {}, {}, rubbed);
  return some.work * bound < worth_while * none.work * none.bound ? some : none;
}

}  // namespace

TimeStepLevels choose_levels(Body& body, double safety_factor, const PresentStep& present, const ActedOn& acted_on,
                             const std::vector<std::uint8_t>& before, bool has_levels) {
  const Communicator& communicator = body.domain.communicator;
  const auto any = [&](const std::vector<std::uint8_t>& marks) {  // a rank without points has no marks
    return communicator.any(!marks.empty());
  };
  const double margin = std::min(1.0, most_turn / safety_factor);
  const double bearable = (1 + round_off) * present.slack * present.bound;
  FrequencyBounds bounds = frequency_bounds_of(body);
  if (any(acted_on.damped)) even_out(body, acted_on.damped, bounds);
  std::vector<std::uint8_t> around = acted_on.pushed;
  if (any(acted_on.pushed)) {
    spread(body, families_around_contact, around);
    bounds.floor = std::max(bounds.floor, floor_of_pushed(body, bounds, margin, around));
  }
  TimeStepLevels best = cheapest_levels(body, bounds, margin, acted_on.rubbed);
  if (!(present.bound > 0 && bearable >= bounds.floor)) return best;
  TimeStepLevels kept = levels_for(body, bounds, bearable, margin, before, around, acted_on.rubbed);
  const bool of_none = !has_levels && best.bound == bounds.largest && bearable >= bounds.largest;
  if (!of_none && best.work * best.bound < worth_a_change * kept.work * present.bound) return best;
  kept.anew = false;
  return kept;
}

std::vector<std::uint8_t> motion_levels_of(const Body& body, const std::vector<std::uint8_t>& levels) {
  std::vector<std::uint8_t> motion_levels(levels.begin(), levels.begin() + body.owned());
  for_each_point(0, body.owned(), [&](int i) {
    body.domain.families.for_each(i, [&](int j) { motion_levels[i] = std::max(motion_levels[i], levels[j]); });
  });
  return motion_levels;
}

namespace {

// Levels are chosen one step ahead: marks points that a tool with this velocity would reach, at theirs, within the next
// `steps` steps.
void mark_met(const RigidTool& tool, const Vector& velocity, const Body& body, std::span<const Vector> velocities,
              double t, double dt, std::vector<std::uint8_t>& marks) {
  // Margin for changes meanwhile, in steps and spacings; a gap of a round number must not depend on round-off.
  constexpr double steps = 2, near = 0.05 + 1e-6;
  const Vector offset = tool.offset(t);
  for (const int i : tool.points) {
    const Vector place = tool.nearest_image(body.domain, body.current(i) - offset);
    const Surface at = tool.met_by(i, tool.shape, place);
    const double closing = std::max(0.0, at.normal.dot(velocity - velocities[i]));
    if (at.gap < steps * dt * closing + near * body.domain.cloud.spacings[i]) marks[i] = 1;
  }
}

Vector velocity_of(const RigidTool& tool, double t, double dt) {
  if (tool.free) return tool.free->velocity;
  return dt > 0 ? Vector((tool.offset(t + dt) - tool.offset(t)) / dt) : Vector(Vector::Zero());
}

// Marks those of the tools for which acts(tool) is true; empty if there is none.
std::vector<std::uint8_t> points_met_by(const auto& acts, const Body& body, const Conditions& conditions,
                                        std::span<const Vector> velocities, double t, double dt) {
  std::vector<std::uint8_t> marks;
  for (const RigidTool& tool : tools_of(conditions)) {
    if (!acts(tool)) continue;
    marks.resize(body.owned(), 0);
    mark_met(tool, velocity_of(tool, t, dt), body, velocities, t, dt, marks);
  }
  return marks;
}

}  // namespace

std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt) {
  const auto is_free = [](const RigidTool& tool) { return tool.free != nullptr; };
  std::vector<std::uint8_t> marks = points_met_by(is_free, body, conditions, velocities, t, dt);
  if (contact.any()) {
    marks.resize(body.owned(), 0);
    contact.mark_touching(marks);
  }
  return marks;
}

std::vector<std::uint8_t> met_points(const Body& body, const Conditions& conditions, std::span<const Vector> velocities,
                                     double t, double dt) {
  return points_met_by([](const RigidTool&) { return true; }, body, conditions, velocities, t, dt);
}

std::vector<std::uint8_t> rubbed_points(const Body& body, const Conditions& conditions,
                                        std::span<const Vector> velocities, double t, double dt) {
  const auto rubs = [](const RigidTool& tool) { return tool.friction != 0 && !tool.free; };
  return points_met_by(rubs, body, conditions, velocities, t, dt);
}

bool is_uneven(const Body& body, const std::vector<std::uint8_t>& marks) {
  bool uneven = false;
  for (int i = 0; i < std::ssize(marks); ++i) {
    if (!marks[i] || !may_be_subcycled(body, body.domain.cloud.blocks[i])) continue;
    body.domain.families.for_each(i, [&](int j) { uneven |= body.time_levels[j] != body.time_levels[i]; });
  }
  return uneven;
}

std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions) {
  std::vector<std::uint8_t> marks;
  conditions.visit([&](const NonReflectingEnd& end) {
    marks.resize(body.owned(), 0);
    for (const auto& drag : end.drags) marks[drag.point] = 1;
  });
  return marks;
}

bool any_in_both(const std::vector<std::uint8_t>& some, const std::vector<std::uint8_t>& others) {
  if (others.empty()) return false;
  for (std::size_t i = 0; i < some.size(); ++i) {
    if (some[i] && others[i]) return true;
  }
  return false;
}

}  // namespace strut
