#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "advice/checks.hpp"
#include "setup/changes_in_time.hpp"
#include "setup/found_points.hpp"
#include "setup/periods.hpp"
#include "topology/cell_edges.hpp"
#include "topology/point_group.hpp"

namespace strut {

namespace {

constexpr double deep = 1e-3;     // spacings: accuracy of positions
constexpr double along = 1e-3;    // component of a normal along a held direction
constexpr double opposite = 0.9;  // the same for a symmetry plane, whose adjacent cells a tool may push obliquely

// A direction in which a condition holds points.
struct Held {
  int condition;  // index in the deck
  Vector direction;
  double part;  // least component of a tool's normal that counts as held
  std::vector<int> points;
  bool at_faces = false;          // on a symmetry plane, where cells end: only mirror images may hold their points
  Vector plane = Vector::Zero();  // a point on it, m
};

std::vector<Held> held_directions(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<Held> all;
  for (std::size_t place = 0; place < deck.conditions.size(); ++place) {
    const deck::Condition& condition = deck.conditions[place];
    const auto* motion = std::get_if<PrescribedMotion>(&condition.kind);
    const auto* plane = std::get_if<SymmetryPlane>(&condition.kind);
    if (!motion && !plane) continue;
    std::vector<int> points = PointGroup(cloud, condition.node_set, "Node Set").points(cloud);
    const int c = static_cast<int>(place);
    if (plane) all.push_back({c, plane->normal, opposite, std::move(points), true, plane->point});
    for (const int axis : motion ? motion->components : std::vector<int>{})
      all.push_back({c, Vector::Unit(axis), along, points});
  }
  return all;
}

// Two conditions of the deck and their common points, for each non-reflecting end and each condition that holds its
// points along its normal.
std::map<IndexPair, std::vector<int>> held_points_of_ends(const deck::Deck& deck, const PointCloud& cloud,
                                                          const std::vector<Held>& held) {
  std::map<IndexPair, std::vector<int>> pairs;
  for (std::size_t place = 0; place < deck.conditions.size(); ++place) {
    const auto* end = std::get_if<NonReflectingEnd>(&deck.conditions[place].kind);
    if (!end) continue;
    const PointGroup group(cloud, deck.conditions[place].node_set, "Node Set");
    for (const Held& one : held) {
      if (std::abs(end->normal.dot(one.direction)) < one.part) continue;
      std::vector<int>& common = pairs[{static_cast<int>(place), one.condition}];
      std::ranges::copy_if(one.points, std::back_inserter(common), [&](int i) { return group.counts(cloud, i); });
    }
  }
  return pairs;
}

// The initial position of a point, or of the face of its cell on a symmetry plane; second: true for the latter.
std::pair<Vector, bool> place_of(const Held& held, int i, const Domain& domain) {
  const Vector X = domain.reference(i);
  const double off = held.direction.dot(X - held.plane);
  const bool is_face = held.at_faces && std::abs(off) < domain.cloud.spacings[i];
  return {is_face ? Vector(X - off * held.direction) : X, is_face};
}

// The times at which paths are looked at, from the start on, s. Collective.
std::vector<double> times_of(const Situation& situation, const std::vector<Held>& held) {
  const double start = situation.start, end = start + situation.duration;
  const Body& body = situation.scene.body;
  std::vector<double> changes;
  const auto add = [&](const Function& value, const std::vector<int>& points) {
    std::ranges::copy(changes_of(value, where(points, body), start, end), std::back_inserter(changes));
  };
  for (const deck::Condition& condition : situation.deck.conditions) {
    const auto* tool = std::get_if<RigidTool>(&condition.kind);
    if (!tool || tool->free) continue;
    for (const Function& travel : tool->values_at_points()) add(travel, {});
  }
  for (const Held& one : held) {
    const auto* motion = std::get_if<PrescribedMotion>(&situation.deck.conditions[one.condition].kind);
    if (motion) add(motion->value, one.points);
  }
  return sample_times(std::move(changes), start, situation.duration);
}

// For each tool and condition: the time of the first contact, and the points met.
using Meetings = std::map<std::pair<int, int>, std::pair<double, std::set<int>>>;

// The points decide how far a force moves a tool. Here it does so by the least that counts, in spacings, which shows if
// the tool presses on points that it touches.
Vector pressed(const RigidTool& tool, double time) {
  Vector force = Vector::Zero();
  for (int c = 0; tool.free && c < 3; ++c) {
    if (tool.free->force[c]) force[c] = tool.free->force[c]->evaluate(Vector::Zero(), time);
  }
  return force.allFinite() ? Vector(2 * deep * force.stableNormalized()) : Vector(Vector::Zero());
}

void note_meetings(const RigidTool& tool, int n, const std::vector<Held>& held, const Body& body,
                   const std::vector<Vector>& displacements, double time, Meetings& met) {
  const Vector offset = tool.offset(time), press = pressed(tool, time);
  for (const Held& one : held) {
    for (const int i : one.points) {
      if (!std::binary_search(tool.points.begin(), tool.points.end(), i)) continue;
      const auto [X, is_face] = place_of(one, i, body.domain);
      const Vector place =
          tool.nearest_image(body.domain, X + displacements[i] - offset - body.domain.cloud.spacings[i] * press);
      const auto met_by = [&](const auto& shape) {
        return is_face ? surface(shape, place) : tool.met_by(i, shape, place);
      };
      const Surface at = std::visit(met_by, tool.shape);
      if (!(at.gap < -deep * body.domain.cloud.spacings[i])) continue;
      if (std::abs(at.normal.dot(one.direction)) < one.part) continue;
      auto& [first, points] = met.try_emplace({n, one.condition}, time, std::set<int>{}).first->second;
      points.insert(i);
    }
  }
}

// For each body, over all ranks: the bonds that it has across the sides of the period, and the points that no
// condition holds along its axis, or one whose value depends on place and may follow the sides.
std::vector<std::array<double, 2>> free_points(const Situation& situation, const Period& period,
                                               const std::vector<Held>& held) {
  const Domain& domain = situation.scene.body.domain;
  std::vector<std::uint8_t> is_held(domain.owned, 0);
  for (const Held& one : held) {
    const auto* motion = std::get_if<PrescribedMotion>(&situation.deck.conditions[one.condition].kind);
    if (std::abs(one.direction[period.axis]) < one.part || (motion && motion->value.depends_on_position())) continue;
    for (const int i : one.points) is_held[i] = 1;
  }
  const std::vector<Vector> shifts = shifts_by_periods(domain);
  std::vector<std::array<double, 2>> counts(domain.body_count(), {0, 0});
  for (int i = 0; i < domain.owned; ++i) {
    auto& [across, free] = counts[domain.body_of(i)];
    domain.families.for_each(i, [&](int j) { across += shifts[j][period.axis] != 0 ? 1 : 0; });
    free += is_held[i] != 0 ? 0 : 1;
  }
  for (auto& body : counts) domain.communicator.sum(body);
  return counts;
}

}  // namespace

std::string held_stretches(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::string text;
  if (domain.periods.empty()) return text;
  const std::vector<Held> held = held_directions(situation.deck, domain.cloud);
  for (const Period& period : domain.periods) {
    if (!period.stretch.depends_on_time()) continue;
    const auto counts = free_points(situation, period, held);
    for (std::size_t b = 0; b < domain.blocks.size(); ++b) {
      const auto& [across, free] = counts[domain.blocks[b].body];
      if (across == 0 || free > 0) continue;
      text += "WARNING: Boundary Conditions > " + situation.deck.conditions[period.number].name +
              " > Stretch: conditions hold all points of the body of block '" + domain.cloud.block_names[b] +
              "' along " + "xyz"[period.axis] +
              ": the bonds across the sides take all of the stretch; expected points that are free to follow it\n";
    }
  }
  return text;
}

namespace {

// An end drags with the impedance of the material. Inertia that is s times as large reflects (√s − 1)²/(√s + 1)² of the
// energy of a wave.
void tell_scaled_ends(const Situation& situation, std::ostringstream& text) {
  constexpr double tells = 1.5;  // s, 1 % of the energy
  const Body& body = situation.scene.body;
  // A rank without points has none.
  if (!body.domain.communicator.any(!body.mass_scale.empty())) return;
  situation.scene.conditions.visit([&](const NonReflectingEnd& end) {
    double most = 1;
    for (const auto& drag : end.drags) most = std::max(most, body.mass_scale[drag.point]);
    most = body.domain.communicator.max(most);
    if (most <= tells) return;
    const double back = std::pow((std::sqrt(most) - 1) / (std::sqrt(most) + 1), 2);
    text << "WARNING: Mass Scaling gives points of a non-reflecting end up to " << most
         << " times their inertia: where it does so around them, too, the end reflects " << 100 * back
         << " % of a wave's energy; expected a smaller Mass Scaling dt\n";
  });
}

// An end has the traction −ρ c v of waves that leave; whatever else stands at it in the state that the run starts from
// is let go.
void tell_standing_ends(const Situation& situation, std::ostringstream& text) {
  // `tells`: a fraction of the body's mean stress; the outer points of a free end, half a layer below its surface, have
  // less. `of_waves_too`: a fraction of the traction at the end; oblique waves leave a fifth of theirs.
  constexpr double tells = 0.25, of_waves_too = 0.5;
  const Body& body = situation.scene.body;
  if (!situation.deck.start_from) return;
  const auto stress = [&](int i) -> Tensor {
    const Tensor R = body.points[i].rotation.tensor();
    return R * to_tensor(body.points[i].stress) * R.transpose();
  };
  double mean = 0, volume = 0;
  for (int i = 0; i < body.owned(); ++i)
    mean += body.domain.volume(i) * body.points[i].stress.norm(), volume += body.domain.volume(i);
  mean = body.domain.communicator.sum(mean) / body.domain.communicator.sum(volume);
  situation.scene.conditions.visit([&](const NonReflectingEnd& end) {
    double force = 0, area = 0, borne = 0;
    for (const auto& drag : end.drags) {
      const int i = drag.point;
      const double h = edge_of_cell(body.domain, i, end.normal), here = body.domain.volume(i) / h;
      const Vector v = body.velocity[i], along = v.dot(end.normal) * end.normal;
      const Vector of_waves =
          -0.5 * body.block_of(i).material.density * h * (drag.along * along + drag.across * (v - along));
      const Vector traction = stress(i) * end.normal;
      force += here * (traction - of_waves).norm(), borne += here * traction.norm(), area += here;
    }
    std::vector<double> sums = {force, borne, area};
    body.domain.communicator.sum(sums);
    if (!(sums[0] > tells * mean * sums[2]) || !(sums[0] > of_waves_too * sums[1])) return;
    text << "WARNING: the non-reflecting end '" << situation.deck.conditions[end.index].name
         << "' lets go at once of about " << sums[0]
         << " N that stand at it in the state of Start From: it absorbs waves and bears nothing that rests; expected a "
            "Body Force of that size on its points\n";
  });
}

}  // namespace

std::string held_ends(const Situation& situation) {
  const deck::Deck& deck = situation.deck;
  const Body& body = situation.scene.body;
  const std::vector<Held> held = held_directions(deck, body.domain.cloud);
  std::ostringstream text;
  text.precision(3);
  tell_scaled_ends(situation, text);
  tell_standing_ends(situation, text);
  for (const auto& [pair, found] : found_points_of_pairs(body, held_points_of_ends(deck, body.domain.cloud, held))) {
    text << "WARNING: '" << deck.conditions[pair[1]].name << "' holds " << found.count
         << " points of the non-reflecting end '" << deck.conditions[pair[0]].name
         << "' along its normal, one of them at " << place_text(found.one)
         << ": waves are reflected there; expected a Node Set without these points\n";
  }
  return text.str();
}

std::string overruled_motions(const Situation& situation) {
  const deck::Deck& deck = situation.deck;
  const Scene& scene = situation.scene;
  const double start = situation.start, duration = situation.duration;
  const Body& body = scene.body;
  const std::vector<RigidTool> tools = tools_of(scene.conditions);
  const std::vector<Held> held = held_directions(deck, body.domain.cloud);
  if (tools.empty() || held.empty()) return "";
  Meetings met;
  std::vector<Vector> displacements(body.owned());
  for (int i = 0; i < body.owned(); ++i) displacements[i] = body.displacement(i);  // other than 0 after Start From
  const std::vector<double> times = times_of(situation, held);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double time = times[k];
    move_on(scene.conditions, body.domain, time, time - times[k - 1], displacements);
    for (std::size_t n = 0; n < tools.size(); ++n) {
      note_meetings(tools[n], static_cast<int>(n), held, body, displacements, time, met);
    }
  }
  const int count = static_cast<int>(deck.conditions.size());
  std::vector<std::vector<int>> lists(tools.size() * count);
  std::vector<double> firsts(lists.size(), -start - duration);
  for (auto& [pair, found] : met) {
    lists[pair.first * count + pair.second].assign(found.second.begin(), found.second.end());
    firsts[pair.first * count + pair.second] = -found.first;
  }
  body.domain.communicator.max(firsts);
  const std::vector<FoundPoints> found = found_points(body, lists);
  std::ostringstream text;
  for (std::size_t n = 0; n < found.size(); ++n) {
    if (found[n].count == 0) continue;
    text << "WARNING: the tool '" << scene.tools[n / count].name << "' runs into " << found[n].count << " points that '"
         << deck.conditions[n % count].name << "' holds along its normal, one of them at " << place_text(found[n].one)
         << ", by t = " << -firsts[n] << " s: "
         << (scene.quasi_static ? "held points stay, so that there is no equilibrium from then on"
                                : "tools have the last word, so that they do not move as prescribed")
         << (tools[n / count].free ? ", and what the tool loses to them depends on the time step" : "")
         << "; expected paths that agree, or a Node Set of the tool without these points\n";
  }
  return text.str();
}

}  // namespace strut
