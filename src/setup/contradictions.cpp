#include "setup/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <variant>

#include "base/math/time_integral.hpp"
#include "setup/changes_in_time.hpp"
#include "setup/found_points.hpp"

namespace strut {

namespace {

constexpr double round_off = 1e-9;  // of directions and values

// Directions closer than this count as one: motion orthogonal to them would have to be a hundred times as fast.
constexpr double smallest_part = 0.01;

// If displacements and velocities are mixed, velocities are integrated, and compared with this relative tolerance.
constexpr double of_sums = 1e-3;

// Values that depend on place are compared at each point, so at fewer times if there are many: some seconds at most.
constexpr int fewest_samples = 64;
constexpr double most_samples_of_points = 1e7;

using Holds = std::vector<Hold>;

// The holds of a condition at each of its points.
Holds holds_of(const deck::Condition& condition, int place) {
  Holds holds;
  if (const auto* motion = std::get_if<PrescribedMotion>(&condition.kind)) {
    for (const int c : motion->components)
      holds.push_back({place, Vector::Unit(c), &motion->value, motion->is_velocity});
  }
  if (const auto* plane = std::get_if<SymmetryPlane>(&condition.kind)) {
    holds.push_back({place, plane->normal, nullptr, true});
  }
  return holds;
}

// The holds of a condition of the type Initial, which sets the state at the initial time.
template <class Initial>
Holds initial_holds_of(const deck::Condition& condition, int place) {
  Holds holds;
  if (const auto* initial = std::get_if<Initial>(&condition.kind)) {
    for (const int c : initial->components) holds.push_back({place, Vector::Unit(c), &initial->value, true});
  }
  return holds;
}

bool are_across(const Holds& some, const Holds& others) {
  for (const Hold& one : some) {
    for (const Hold& other : others) {
      if (std::abs(one.direction.dot(other.direction)) > round_off) return false;
    }
  }
  return true;
}

SharedPoints shared(const std::vector<Holds>& holds, const PointsOfConditions& points) {
  std::vector<int> counts;
  std::vector<bool> may_share(holds.size(), false);
  for (std::size_t c = 0; c < holds.size(); ++c) {
    for (std::size_t d = 0; d < holds.size(); ++d)
      may_share[c] = may_share[c] || (c != d && !are_across(holds[c], holds[d]));
    if (!may_share[c]) continue;
    for (const int i : points[c]) {
      if (i >= static_cast<int>(counts.size())) counts.resize(i + 1, 0);
      ++counts[i];
    }
  }
  SharedPoints all;
  for (const bool planes : {false, true}) {
    for (std::size_t c = 0; c < holds.size(); ++c) {
      if (!may_share[c] || (holds[c].front().value == nullptr) != planes) continue;
      for (const int i : points[c]) {
        if (counts[i] > 1) all[i].insert(all[i].end(), holds[c].begin(), holds[c].end());
      }
    }
  }
  return all;
}

// Values are compared in the middle of each of these intervals, displacements and sums of velocities at their ends.
struct Interval {
  double from, to;  // s; equal for a single time
  double middle() const { return 0.5 * (from + to); }
};
using Times = std::vector<Interval>;

// Intervals of about one length, which end also where values may turn or jump; load steps and their middles by
// themselves.
Times times_of(const deck::Solver& steps, const std::vector<double>& changes, int samples) {
  constexpr double at_once = 1e-9;  // of the run: no more than round-off in the time of a jump
  const double start = steps.initial_time, duration = steps.final_time - start;
  std::vector<double> ends = thinned(changes, samples);
  std::ranges::copy(uneven_times(start, start + duration, samples), std::back_inserter(ends));
  std::ranges::sort(ends);
  Times times;
  for (std::size_t n = 1; n < ends.size(); ++n) {
    if (ends[n] - ends[n - 1] > at_once * duration) times.push_back({ends[n - 1], ends[n]});
  }
  const int halves = steps.quasi_static ? std::min(2 * steps.quasi_static->load_steps, 2 * samples) : 0;
  for (int k = 1; k <= halves; ++k) {
    const double t = start + duration * k / halves;
    times.push_back({t, t});
  }
  std::ranges::sort(times, {}, &Interval::to);
  return times;
}

// Targets of a hold in each interval, at its middle; or, if `summed`, displacements since the start at its end.
std::vector<double> targets(const Hold& hold, const Vector& X, const Times& times, bool summed) {
  std::vector<double> all(times.size(), 0);
  if (!hold.value) return all;
  const auto at = [&](double t) { return hold.value->evaluate(X, t); };
  const auto start = [&] { return std::ranges::min(times, {}, &Interval::from).from; };  // not of the first load step
  const double before = summed && !hold.is_velocity ? at(start()) : 0;
  double sum = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Interval& one = times[k];
    if (summed && !hold.is_velocity) {
      all[k] = at(one.to) - before;
    } else {
      const double value = at(one.middle());
      all[k] = summed ? sum += value * (one.to - one.from) : value;
    }
  }
  return all;
}

// The hold's condition, with the earlier one whose direction is nearest to that of the hold.
IndexPair pair_of(const Holds& holds, std::size_t h) {
  double nearest = -1;
  int other = holds[h].condition;
  for (std::size_t k = 0; k < h; ++k) {
    const double along = std::abs(holds[k].direction.dot(holds[h].direction));
    if (holds[k].condition != holds[h].condition && along > nearest) nearest = along, other = holds[k].condition;
  }
  return {std::min(other, holds[h].condition), std::max(other, holds[h].condition)};
}

// A hold in the space that the earlier ones leave free.
struct Left {
  Vector along;   // of unit length; zero if they leave it no motion
  double length;  // of the part of its direction that is left
};

std::vector<Left> what_is_left(const Holds& holds) {
  Tensor free = Tensor::Identity();
  std::vector<Left> all;
  for (const Hold& one : holds) {
    const Vector left = free * one.direction;
    const double length = left.norm();
    all.push_back({length < smallest_part ? Vector(Vector::Zero()) : Vector(left / length), length});
    free -= all.back().along * all.back().along.transpose();
  }
  return all;
}

double largest_of(const std::vector<std::vector<double>>& wanted) {
  double largest = 0;
  for (const auto& targets : wanted) {
    for (const double one : targets) largest = std::isfinite(one) ? std::max(largest, std::abs(one)) : largest;
  }
  return largest;
}

// The two conditions that leave the point no motion, if any do: the directions are held one after the other, each in
// the space that the earlier ones leave free.
std::optional<IndexPair> contradiction(const Holds& holds, const Vector& X, const Times& times) {
  const auto is_velocity = [](const Hold& one) { return one.is_velocity; };
  const bool summed = !std::ranges::all_of(holds, is_velocity) &&
                      std::ranges::any_of(holds, [](const Hold& one) { return one.is_velocity && one.value; });
  std::vector<std::vector<double>> wanted;
  for (const Hold& one : holds) wanted.push_back(targets(one, X, times, summed));
  const std::vector<Left> left = what_is_left(holds);
  const double none = round_off * largest_of(wanted);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (summed && times[k].from == times[k].to) continue;  // sums are those up to the interval before
    Vector motion = Vector::Zero();
    for (std::size_t h = 0; h < holds.size(); ++h) {
      const double missing = wanted[h][k] - holds[h].direction.dot(motion);
      const double scale = std::max(std::abs(wanted[h][k]), motion.norm());
      if (left[h].length >= smallest_part) {
        motion += missing / left[h].length * left[h].along;
      } else if (std::abs(missing) > (summed ? of_sums : round_off) * scale + none) {
        return pair_of(holds, h);
      }
    }
  }
  return std::nullopt;
}

bool depends_on_position(const Holds& holds) {
  return std::any_of(holds.begin(), holds.end(),
                     [](const Hold& one) { return one.value && one.value->depends_on_position(); });
}

// The times for values that depend on time alone, and for the others.
struct SampleTimes {
  Times of_time, of_place;
};

// Collective.
SampleTimes sample_times(const SharedPoints& shared, const deck::Deck& deck, const deck::Solver& steps,
                         const PointsOfConditions& points, const Body& body) {
  const Communicator& communicator = body.domain.communicator;
  if (communicator.sum(static_cast<double>(shared.size())) == 0) return {};  // nothing is compared
  std::vector<double> changes;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const auto* motion = std::get_if<PrescribedMotion>(&deck.conditions[c].kind);
    if (!motion || !motion->value.depends_on_time()) continue;
    const std::vector<double> some =
        changes_of(motion->value, where(points[c], body), steps.initial_time, steps.final_time);
    changes.insert(changes.end(), some.begin(), some.end());
  }
  std::ranges::sort(changes);
  double count = 0;
  for (const auto& [i, holds] : shared) count += depends_on_position(holds) ? 1 : 0;
  count = std::max(1.0, communicator.sum(count));
  const double samples = std::clamp<double>(most_samples_of_points / count, fewest_samples, samples_in_a_run);
  return {times_of(steps, changes, std::max<int>(samples_in_a_run, static_cast<int>(changes.size()))),
          times_of(steps, changes, static_cast<int>(samples))};
}

// For each pair of conditions, the points at which they contradict each other.
std::map<IndexPair, std::vector<int>> contradicting_points(const SharedPoints& shared, const Body& body,
                                                           const SampleTimes& samples) {
  std::map<IndexPair, std::vector<int>> all;
  std::map<std::vector<int>, std::optional<IndexPair>> known;  // by conditions, for values independent of position
  for (const auto& [i, holds] : shared) {
    std::vector<int> conditions;
    for (const Hold& one : holds) conditions.push_back(one.condition);
    const bool by_place = depends_on_position(holds);
    std::optional<IndexPair> found;
    const auto before = known.find(conditions);
    if (before != known.end() && !by_place) {
      found = before->second;
    } else {
      found = contradiction(holds, body.domain.reference(i), by_place ? samples.of_place : samples.of_time);
      if (!by_place) known[conditions] = found;
    }
    if (found) all[*found].push_back(i);
  }
  return all;
}

void tell(const std::map<IndexPair, std::vector<int>>& points, const std::string& what, const deck::Deck& deck,
          const Body& body, deck::Problems& problems) {
  for (const auto& [pair, found] : found_points_of_pairs(body, points)) {
    problems.add("Boundary Conditions > " + deck.conditions[pair[1]].name,
                 "contradicts '" + deck.conditions[pair[0]].name + "': both prescribe the " + what + " of " +
                     std::to_string(found.count) + " points, one of them at " + place_text(found.one) +
                     ", along one axis, or along axes that are not across each other, with different values; expected "
                     "one value for each point");
  }
}

std::vector<Holds> holds_by_condition(const deck::Deck& deck, Holds (*of)(const deck::Condition&, int)) {
  std::vector<Holds> holds;
  for (int c = 0; c < static_cast<int>(deck.conditions.size()); ++c) holds.push_back(of(deck.conditions[c], c));
  return holds;
}

}  // namespace

SharedPoints shared_points(const deck::Deck& deck, const PointsOfConditions& points) {
  return shared(holds_by_condition(deck, holds_of), points);
}

void check_contradictions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                          deck::Problems& problems) {
  const SharedPoints held = shared_points(deck, points);
  const auto check = [&](const deck::Solver& steps) {
    tell(contradicting_points(held, body, sample_times(held, deck, steps, points, body)), "motion", deck, body,
         problems);
  };
  check(deck.solver);
  if (deck.next_solver) check(*deck.next_solver);
  const auto check_initial = [&](Holds (*of)(const deck::Condition&, int), double t, const std::string& what) {
    const Times at_once{{t, t}};
    tell(contradicting_points(shared(holds_by_condition(deck, of), points), body, {at_once, at_once}), what, deck, body,
         problems);
  };
  const deck::Solver& steps = deck.next_solver ? *deck.next_solver : deck.solver;  // which initial velocities begin
  check_initial(initial_holds_of<InitialVelocity>, steps.initial_time, "initial velocity");
  check_initial(initial_holds_of<InitialDisplacement>, deck.solver.initial_time, "initial displacement");
}

Vector push_of_plane(const std::vector<Hold>& holds, int condition) {
  Tensor free = Tensor::Identity();
  for (const Hold& one : holds) {
    const Vector left = free * one.direction;
    const double length2 = left.squaredNorm();
    const bool is_held = length2 < smallest_part * smallest_part;
    if (one.condition == condition) return is_held ? Vector(Vector::Zero()) : Vector(left / length2);
    if (!is_held) free -= left * left.transpose() / length2;
  }
  return Vector::Zero();
}

namespace {

std::vector<int> axes_of(const deck::Condition& condition) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.components; }) return one.components;
        return std::vector<int>();
      },
      condition.kind);
}

std::vector<int> common(const std::vector<int>& some, const std::vector<int>& others) {
  std::vector<int> both;
  std::set_intersection(some.begin(), some.end(), others.begin(), others.end(), std::back_inserter(both));
  return both;
}

}  // namespace

std::string let_the_last_count(const deck::Deck& deck, const Body& body, PointsOfConditions& points) {
  const auto is_numbered = [](const deck::NodeSet& set) { return set.numbers.has_value(); };
  if (!deck.from_peridigm && std::none_of(deck.node_sets.begin(), deck.node_sets.end(), is_numbered)) return "";
  std::string text;
  for (std::size_t last = 0; last < points.size(); ++last) {
    for (std::size_t c = 0; c < last; ++c) {
      const auto &one = deck.conditions[c], &other = deck.conditions[last];
      if (one.kind.index() != other.kind.index() || axes_of(one).empty() || axes_of(one) != axes_of(other)) continue;
      const std::vector<int> both = common(points[c], points[last]);
      const FoundPoints found = found_points(body, {both})[0];
      if (found.count == 0) continue;
      std::erase_if(points[c], [&](int i) { return std::binary_search(both.begin(), both.end(), i); });
      text += "WARNING: Boundary Conditions > " + one.name + ": " + std::to_string(found.count) +
              " of its points, one of them at " + place_text(found.one) + ", are of '" + other.name +
              "', too, which stands later and alone counts there, as in Peridigm\n";
    }
  }
  return text;
}

std::string temperatures_without_effect(const deck::Deck& deck, const Body& body, const PointsOfConditions& points) {
  const auto heat = [&](std::size_t c) { return std::get_if<PrescribedTemperature>(&deck.conditions[c].kind); };
  const auto changes = [&](std::size_t c) { return heat(c) && heat(c)->value.depends_on_time(); };
  PointsOfConditions left(points.size()), kept(points.size());
  for (std::size_t c = 0; c < points.size(); ++c) {
    if (!heat(c)) continue;
    left[c] = points[c];
    for (std::size_t later = c + 1; later < points.size(); ++later) {
      if (!heat(later)) continue;
      std::erase_if(left[c], [&](int i) { return std::ranges::binary_search(points[later], i); });
    }
    for (std::size_t before = 0; before < c; ++before) {
      if (changes(before)) std::ranges::copy(common(left[c], points[before]), std::back_inserter(kept[c]));
    }
  }
  const std::vector<FoundPoints> found_left = found_points(body, left), found_kept = found_points(body, kept);
  std::string text;
  bool changed_before = false;  // else the check of the deck has warned already
  for (std::size_t c = 0; c < points.size(); ++c) {
    if (!heat(c)) continue;
    const std::string path = "WARNING: Boundary Conditions > " + deck.conditions[c].name;
    if (found_left[c].count == 0) {
      text += path + ": has no effect: later conditions of its type have all its points, where the last one counts\n";
    } else if (changed_before && !changes(c) && !deck.start_from && found_kept[c].count == 0) {
      text += path +
              " > Value: has no effect: points expand by the change of T since the initial time; expected a function "
              "of t\n";
    }
    changed_before = changed_before || changes(c);
  }
  return text;
}

}  // namespace strut
