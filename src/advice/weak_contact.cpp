#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <type_traits>

#include "advice/checks.hpp"
#include "base/errors.hpp"
#include "base/text.hpp"
#include "deck/problems.hpp"

namespace strut {

namespace {

// A point that meets a face of a square lattice of points is at most this far from the nearest of them, in spacings.
constexpr double widest_gap = 1 / std::numbers::sqrt2;

// A block as contact sees it.
struct Side {
  std::string name;
  double spacing = 0, horizon = 0;  // m, means
  double modulus = 0;               // of longitudinal waves, Pa
  double impedance = 0;             // of longitudinal waves, kg/(m² s)
  double points = 0, mass = 0;      // over all ranks; kg
  double yields = 0;                // Pa, initial flow stress; infinite if it never yields

  double face() const { return spacing * spacing; }              // m², per point
  double volume() const { return spacing * spacing * spacing; }  // m³
};

double flow_stress(const BlockMaterial& material) {
  return std::visit([](const auto& law) { return law.flow_stress(materials::virgin_state_of(law)); }, material.law);
}

std::vector<Side> sides_of(const Body& body, const std::vector<double>& spacings) {
  std::vector<double> sums(2 * body.blocks.size(), 0);
  for (int i = 0; i < body.owned(); ++i) {
    const int block = body.domain.cloud.blocks[i];
    ++sums[2 * block];
    sums[2 * block + 1] += body.mass(i);
  }
  body.domain.communicator.sum(sums);
  std::vector<Side> sides;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const BlockMaterial& material = body.blocks[b].material;
    const BlockHorizons& horizons = body.domain.blocks[b];
    const double modulus = materials::moduli_of(material.law).longitudinal();
    sides.push_back({body.domain.cloud.block_names[b], spacings[b], 0.5 * (horizons.smallest + horizons.largest),
                     modulus, std::sqrt(modulus * material.density), sums[2 * b], sums[2 * b + 1],
                     flow_stress(material)});
  }
  return sides;
}

// The strength of contact before points pass each other.
struct Strength {
  double pressure = 0;  // Pa, between two faces
  double energy = 0;    // J, if all points press on all points within reach
};

// A point of each block, in two bodies, initially far apart.
contact::PointPair pair_of(const contact::PairLaw& law, const Side& a, const Side& b) {
  return {{a.volume(), b.volume()}, {a.horizon, b.horizon}, 2 * contact::radius_of(law), false};
}

Strength strength(const contact::PairLaw& law, const Side& a, const Side& b) {
  const double r = contact::radius_of(law), sphere = 4 * std::numbers::pi / 3 * r * r * r;
  const contact::PointPair pair = pair_of(law, a, b);
  const double partners = std::min(a.points * (1 + sphere / b.volume()), b.points * (1 + sphere / a.volume()));
  return std::visit(
      [&](const contact::ContactLaw auto& one) {
        return Strength{one.normal_force(pair, r) * r * r / (a.face() * b.face()),
                        partners * one.stored_energy(pair, r)};
      },
      law);
}

Strength strength(const contact::SurfaceLaw& law, const Side& a, const Side& b) {
  const double area = a.points * a.face() + b.points * b.face();
  return {law.pressure(law.spacing), area * law.energy(law.spacing)};
}

// Speed at which two blocks approach each other along the axes on which they are apart, m/s.
struct Approach {
  double least = 0, most = 0;
};

Approach approach(const Trajectory& a, const Trajectory& b) {
  Vector least = Vector::Zero(), most = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    const bool a_below = a.places.max()[c] < b.places.min()[c], b_below = b.places.max()[c] < a.places.min()[c];
    if (!a_below && !b_below) continue;
    const Trajectory &low = a_below ? a : b, &high = a_below ? b : a;
    least[c] = std::max(0.0, low.velocities.min()[c] - high.velocities.max()[c]);
    most[c] = std::max(0.0, low.velocities.max()[c] - high.velocities.min()[c]);
  }
  return {least.norm(), most.norm()};
}

// The approach in the view that has them farthest apart: no box tells of more than there is between them.
Approach approach(const std::vector<View>& views, const Vector& shift) {
  Approach widest;
  double most = -1;
  for (const View& view : views) {
    const Trajectory b = shifted(view.b, view.axes.transpose() * shift);
    const double apart = view.a.places.exteriorDistance(b.places);
    if (apart > (1 + 1e-6) * most) most = apart, widest = approach(view.a, b);
  }
  return widest;
}

// Collective. The fastest approach of two blocks that meet, or of one to an image of the other one period away.
Approach approach(const Situation& situation, int a, int b) {
  const Domain& domain = situation.scene.body.domain;
  const std::vector<Trajectory>& all = situation.trajectories;
  const Images images(domain.periods, 0);
  Approach fastest;
  std::vector<View> views;  // empty until boxes along the axes of space meet
  for (int image = 0; image < images.count(); ++image) {
    const Vector shift = images[image].stretched(domain.halo.stretch()).shift;
    if (!meeting_time(all[a], shifted(all[b], shift), situation.duration)) continue;
    if (views.empty()) views = views_of(situation.scene.body, all, a, b);
    if (!meeting_time(views, situation.duration, shift)) continue;
    const Approach one = approach(views, shift);
    if (one.most > fastest.most) fastest = one;
  }
  return fastest;
}

// The pressure in an impact of elastic bodies, Pa.
double impact_pressure(const Side& a, const Side& b, double speed) {
  return speed * a.impedance * b.impedance / (a.impedance + b.impedance);
}

// "" if points cannot slip between each other.
std::string gap(const contact::Law& law, const Side& a, const Side& b) {
  const double spacing = std::min(a.spacing, b.spacing), radius = contact::radius_of(law);
  if (std::holds_alternative<contact::SurfaceLaw>(law) || radius >= widest_gap * spacing) return "";
  return text_of("Contact Radius ", radius, " m is less than 0.71 of the spacing, ", spacing,
                 " m, so that points slip between those of the other body; a spacing is a good choice");
}

std::string of_blocks(const Side& a, const Side& b) { return "contact of blocks " + a.name + " and " + b.name; }

// A warning if the contact radius is so large that bodies push each other over a gap of several spacings.
std::string far_reach(const contact::Law& law, const Side& a, const Side& b) {
  constexpr double far = 3;
  const double spacing = std::max(a.spacing, b.spacing), radius = contact::radius_of(law);
  if (std::holds_alternative<contact::SurfaceLaw>(law) || radius <= far * spacing) return "";
  return text_of(of_blocks(a, b), ": Contact Radius ", radius, " m is ", radius / spacing, " spacings of ", spacing,
                 " m: bodies push each other from so far; a spacing is a good choice (is it in m?)");
}

std::string remedy(const contact::Law& law, const Side& a, const Side& b, double times) {
  const std::string slips = gap(law, a, b);
  if (!slips.empty()) return slips;
  return text_of(std::setprecision(2), "to bear the pressure of an elastic impact its ",
                 std::holds_alternative<contact::SurfaceLaw>(law) ? "Stiffness Factor" : "spring constant",
                 " should be ", times, " times as large");
}

// Describes a weak contact; `surely`: it certainly cannot withstand the impact.
std::string weakness(const contact::Law& law, const Side& a, const Side& b, const Approach& speed, bool& surely) {
  const Strength bears = std::visit([&](const auto& one) { return strength(one, a, b); }, law);
  const double impact = 0.5 * a.mass * b.mass / (a.mass + b.mass) * speed.least * speed.least;
  const double pressure = impact_pressure(a, b, speed.most);
  surely = impact > bears.energy;
  if (!surely && pressure <= bears.pressure) return "";
  std::ostringstream text;
  text.precision(3);
  if (surely) {
    text << of_blocks(a, b) << " takes up " << bears.energy << " J at most, less than the " << impact
         << " J of an impact at " << speed.least << " m/s: they will pass through each other; ";
  } else {
    text << of_blocks(a, b) << " bears " << bears.pressure << " Pa before points pass each other, less than the "
         << pressure << " Pa of an elastic impact at " << speed.most << " m/s; ";
  }
  text << remedy(law, a, b, pressure / bears.pressure);
  return text.str();
}

// Stiffness of contact between two points that overlap by a tenth of a spacing, relative to M h of the stiffer block.
double relative_stiffness(const contact::PairLaw& law, const Side& a, const Side& b) {
  const contact::PointPair pair = pair_of(law, a, b);
  const double overlap = 0.1 * std::min(a.spacing, b.spacing);
  const double spring =
      std::visit([&](const contact::ContactLaw auto& one) { return one.tangent_stiffness(pair, overlap); }, law);
  return spring / std::max(a.modulus * a.spacing, b.modulus * b.spacing);
}

// A warning if surfaces are so stiff that a first touch, whose step is as long as those before it, changes the energy:
// by the fraction (ω Δt)²/4, ω of the contact.
std::string stiffness_of_first_touches(const contact::SurfaceLaw& law, const Side& a, const Side& b) {
  constexpr double much = 1;
  if (law.factor < much) return "";
  return text_of(
      of_blocks(a, b), " has a Stiffness Factor of ", law.factor,
      ": the step does not foresee how stiff a touch of surfaces will be, so that each first touch may cost or give "
      "some percent of the energy of the impact (1 % with 1, the more the stiffer); expected 0.25, or what is below "
      "1");
}

// A warning if contact is so stiff that points vibrate at its frequency instead of the bodies': a touch then lasts only
// a step or two.
std::string stiffness_of_short_touches(const contact::Law& law, const Side& a, const Side& b) {
  constexpr double much = 10;
  if (const auto* of_surfaces = std::get_if<contact::SurfaceLaw>(&law))
    return stiffness_of_first_touches(*of_surfaces, a, b);
  const auto* of_points = std::get_if<contact::PairLaw>(&law);
  const double ratio = of_points ? relative_stiffness(*of_points, a, b) : 0;
  if (!(ratio > much)) return "";
  // The key that sets the stiffness of a law in Pa, where it has one.
  const std::string wanted = std::visit(
      [ratio]<class Law>(const Law& one) -> std::string {
        std::ostringstream text;
        text.precision(2);
        if constexpr (std::is_same_v<Law, contact::HertzLaw>)
          text << "an Effective Modulus of " << one.effective_modulus / ratio;
        if constexpr (std::is_same_v<Law, contact::PenaltyLaw>) text << "a Spring Constant of " << one.penalty / ratio;
        return text.str().empty() ? "" : "; as stiff as that block is " + text.str() + " Pa";
      },
      *of_points);
  return text_of(std::setprecision(2), of_blocks(a, b), " is ", ratio,
                 " times as stiff as the stiffer block: the time step falls with it, and a touch lasts a few steps "
                 "only, which may cost or give as much energy as the points had",
                 wanted);
}

// True if a tool or a third block that either one may touch could stop them.
bool may_be_stopped(const Scene& scene, const std::vector<contact::Interaction>& interactions, int a, int b) {
  const auto with_another = [a, b](const contact::Interaction& one) {
    const bool has_first = one.first == a || one.first == b, has_second = one.second == a || one.second == b;
    return has_first != has_second;
  };
  return !scene.tools.empty() || std::any_of(interactions.begin(), interactions.end(), with_another);
}

// True if a prescribed motion or a load may end before they meet.
bool may_be_spared(const Body& body, const Conditions& conditions, int a, int b) {
  bool driven = false;
  const auto look = [&](const std::vector<int>& points) {
    for (const int i : points) {
      const int block = body.domain.cloud.blocks[i];
      driven = driven || block == a || block == b;
    }
  };
  conditions.visit([&](const PrescribedMotion& one) { look(one.points); });
  conditions.visit([&](const BodyForce& one) { look(one.points); });
  return body.domain.communicator.any(driven);
}

// For parts of one body, which may be pressed on each other at any time: contact must withstand the flow stress of the
// softer one.
std::string weakness_when_pressed(const contact::Law& law, const Side& a, const Side& b) {
  const double bears = std::visit([&](const auto& one) { return strength(one, a, b); }, law).pressure;
  const double yields = std::min(a.yields, b.yields);
  if (!std::isfinite(yields) || bears >= yields) return "";
  return text_of(
      std::setprecision(3), of_blocks(a, b), " bears ", bears, " Pa before points pass each other, less than the ",
      yields, " Pa at which the material yields: parts that are crushed onto each other pass through each other; its ",
      std::holds_alternative<contact::SurfaceLaw>(law) ? "Stiffness Factor" : "spring constant", " should be ",
      yields / bears, " times as large");
}

}  // namespace

std::string weak_contacts(const Situation& situation) {
  const deck::Deck& deck = situation.deck;
  const Scene& scene = situation.scene;
  const auto& interactions = situation.interactions;
  const auto& spacings = situation.spacings;
  const Domain& domain = scene.body.domain;
  if (interactions.empty()) return "";
  const std::vector<Side> sides = sides_of(scene.body, spacings);
  deck::Problems problems;
  std::string warnings;
  for (const auto& [first, second, model] : interactions) {
    const Side &a = sides[first], &b = sides[second];
    if (a.points == 0 || b.points == 0) continue;
    bool surely = false;
    std::string text;
    if (domain.blocks[first].body == domain.blocks[second].body)
      text = weakness_when_pressed(model.law, a, b);
    else if (!scene.quasi_static)
      text = weakness(model.law, a, b, approach(situation, first, second), surely);
    if (surely && deck.watch.stops && !may_be_stopped(scene, interactions, first, second) &&
        !may_be_spared(scene.body, scene.conditions, first, second))
      problems.add("Contact", text);
    if (text.empty()) text = far_reach(model.law, a, b);
    if (text.empty() && !scene.quasi_static) text = stiffness_of_short_touches(model.law, a, b);
    const std::string slips = gap(model.law, a, b);
    if (text.empty() && !slips.empty()) text = of_blocks(a, b) + ": " + slips;
    if (!text.empty()) warnings += "WARNING: " + text + "\n";
  }
  raise_together(domain.communicator, problems.text(deck.file.string()));
  return warnings;
}

}  // namespace strut
