#include "setup/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "setup/found_points.hpp"

namespace strut {

namespace {

constexpr double round_off = 1e-9;  // of directions and values

// Directions closer than this count as one: motion orthogonal to them would have to be a hundred times as fast.
constexpr double smallest_part = 0.01;

// The values of several conditions are compared at this number of times in a run. If displacements and velocities are
// mixed, velocities are integrated, and compared with this relative tolerance.
constexpr int looks = 16;
constexpr double of_sums = 1e-3;

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

// The times in a run at which values are compared.
struct Times {
  double start, end;
  int count;
  double step() const { return (end - start) / count; }
  double middle(int k) const { return start + (k + 0.5) * step(); }
};

// Targets of a hold at the end of each interval: velocities at mid-interval, or displacements. `summed`: these since
// the start, as sums of velocities are.
std::vector<double> targets(const Hold& hold, const Vector& X, const Times& times, bool as_displacements, bool summed) {
  std::vector<double> all(times.count, 0);
  if (!hold.value) return all;
  const auto at = [&](double t) { return hold.value->evaluate(X[0], X[1], X[2], t); };
  const double before = summed && !hold.is_velocity ? at(times.start) : 0;
  double sum = 0;
  for (int k = 0; k < times.count; ++k) {
    if (!hold.is_velocity) {
      all[k] = at(times.start + (k + 1) * times.step()) - before;
    } else {
      const double velocity = at(times.middle(k));
      all[k] = as_displacements ? sum += velocity * times.step() : velocity;
    }
  }
  return all;
}

using Pair = std::pair<int, int>;  // two conditions

// The hold's condition, with the earlier one whose direction is nearest to that of the hold.
Pair pair_of(const Holds& holds, std::size_t h) {
  double nearest = -1;
  int other = holds[h].condition;
  for (std::size_t k = 0; k < h; ++k) {
    const double along = std::abs(holds[k].direction.dot(holds[h].direction));
    if (holds[k].condition != holds[h].condition && along > nearest) nearest = along, other = holds[k].condition;
  }
  return std::minmax(other, holds[h].condition);
}

// The two conditions that leave the point no motion, if any do: the directions are held one after the other, each in
// the space that the earlier ones leave free.
std::optional<Pair> contradiction(const Holds& holds, const Vector& X, const Times& times) {
  const auto is_velocity = [](const Hold& one) { return one.is_velocity; };
  const bool as_displacements = !std::all_of(holds.begin(), holds.end(), is_velocity);
  const bool summed = as_displacements && std::any_of(holds.begin(), holds.end(),
                                                      [](const Hold& one) { return one.is_velocity && one.value; });
  std::vector<std::vector<double>> wanted;
  for (const Hold& one : holds) wanted.push_back(targets(one, X, times, as_displacements, summed));
  for (int k = 0; k < times.count; ++k) {
    Tensor free = Tensor::Identity();
    Vector motion = Vector::Zero();
    for (std::size_t h = 0; h < holds.size(); ++h) {
      const Vector& direction = holds[h].direction;
      const Vector left = free * direction;
      const double length = left.norm(), missing = wanted[h][k] - direction.dot(motion);
      const double scale = std::max(std::abs(wanted[h][k]), motion.norm());
      if (length < smallest_part && std::abs(missing) > (summed ? of_sums : round_off) * scale)
        return pair_of(holds, h);
      if (length < smallest_part) continue;
      motion += missing / length * (left / length);
      free -= left / length * (left / length).transpose();
    }
  }
  return std::nullopt;
}

bool depends_on_place(const Holds& holds) {
  return std::any_of(holds.begin(), holds.end(),
                     [](const Hold& one) { return one.value && one.value->depends_on_place(); });
}

// For each pair of conditions, the points at which they contradict each other.
std::map<Pair, std::vector<int>> contradicting_points(const SharedPoints& shared, const Body& body,
                                                      const Times& times) {
  std::map<Pair, std::vector<int>> all;
  std::map<std::vector<int>, std::optional<Pair>> known;  // by conditions, for values independent of position
  for (const auto& [i, holds] : shared) {
    std::vector<int> conditions;
    for (const Hold& one : holds) conditions.push_back(one.condition);
    std::optional<Pair> found;
    const auto before = known.find(conditions);
    if (before != known.end() && !depends_on_place(holds)) {
      found = before->second;
    } else {
      found = contradiction(holds, body.domain.reference(i), times);
      known[conditions] = found;
    }
    if (found) all[*found].push_back(i);
  }
  return all;
}

void tell(const std::map<Pair, std::vector<int>>& points, const std::string& what, const deck::Deck& deck,
          const Body& body, deck::Problems& problems) {
  const int count = static_cast<int>(deck.conditions.size());
  std::vector<std::vector<int>> lists(count * count);
  for (const auto& [pair, some] : points) lists[pair.first * count + pair.second] = some;
  const std::vector<FoundPoints> found = found_points(body, lists);
  for (int n = 0; n < count * count; ++n) {
    if (found[n].count == 0) continue;
    problems.add("Boundary Conditions > " + deck.conditions[n % count].name,
                 "contradicts '" + deck.conditions[n / count].name + "': both prescribe the " + what + " of " +
                     std::to_string(found[n].count) + " points, one of them at " + place_text(found[n].one) +
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
  const double start = deck.solver.initial_time;
  const SharedPoints held = shared_points(deck, points);
  tell(contradicting_points(held, body, {start, deck.solver.final_time, looks}), "motion", deck, body, problems);
  const deck::Solver& steps = deck.next_solver ? *deck.next_solver : deck.solver;  // which initial velocities begin
  if (deck.next_solver)
    tell(contradicting_points(held, body, {steps.initial_time, steps.final_time, looks}), "motion", deck, body,
         problems);
  tell(contradicting_points(shared(holds_by_condition(deck, initial_holds_of<InitialVelocity>), points), body,
                            {steps.initial_time, steps.initial_time, 1}),
       "initial velocity", deck, body, problems);
  tell(contradicting_points(shared(holds_by_condition(deck, initial_holds_of<InitialDisplacement>), points), body,
                            {start, start, 1}),
       "initial displacement", deck, body, problems);
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

// The condition as one of type Type, else null.
template <class Type>
const Type* of_kind(const deck::Condition& condition) {
  return std::get_if<Type>(&condition.kind);
}

std::vector<int> axes_of(const deck::Condition& condition) {
  if (const auto* one = of_kind<PrescribedMotion>(condition)) return one->components;
  if (const auto* one = of_kind<InitialVelocity>(condition)) return one->components;
  if (const auto* one = of_kind<InitialDisplacement>(condition)) return one->components;
  if (const auto* one = of_kind<BodyForce>(condition)) return one->components;
  return {};
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

}  // namespace strut
