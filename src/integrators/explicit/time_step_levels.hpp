// The time-step levels of points: which points take substeps, and how many.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"
#include "mechanics/body.hpp"

namespace strut {

struct PresentStep {
  double bound;  // 1/s, the frequency bound for which this step was chosen; 0: none yet
  double slack;  // factor by which the bound may grow before the step must be shorter
  bool is_first = false;
};

// Marks of owned points on which something acts once per step, whatever their levels. Empty: none.
struct ActedOn {
  const std::vector<std::uint8_t>& pushed;  // by contact, or a tool with a mass
  const std::vector<std::uint8_t>& damped;  // by a condition
  const std::vector<std::uint8_t>& rubbed;  // by a tool with friction, and without a mass
};

// Marks owned points on which contact, or a tool with a mass, acts at time t (s) or is about to, once per step of dt
// (s). Empty if the scene has neither.
std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt);

// Marks owned points that a tool meets at time t (s), or is about to. Empty if there is none.
std::vector<std::uint8_t> met_points(const Body& body, const Conditions& conditions, std::span<const Vector> velocities,
                                     double t, double dt);

// Marks owned points that a tool without a mass rubs at time t (s), or is about to. Empty if there is none with
// friction.
std::vector<std::uint8_t> rubbed_points(const Body& body, const Conditions& conditions,
                                        std::span<const Vector> velocities, double t, double dt);

// True if a marked point of this rank has neighbors of another level.
bool is_uneven(const Body& body, const std::vector<std::uint8_t>& marks);

// Marks points whose motion a condition damps. Empty if none does.
std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions);

bool any_in_both(const std::vector<std::uint8_t>& some, const std::vector<std::uint8_t>& others);  // empty: no marks

// Contact acts once per step, on points of level 1 at most, and at least this many families from higher levels: one
// impulse per step resonates with motion faster than most_turn allows (docs/theory.md, Multi-time-stepping).
inline constexpr int families_around_contact = 3;

// levels: of owned points and ghosts, empty if there are none; bound: the frequency bound (1/s) up to which points have
// level 0; work: cost of a step, relative to a step of a point by correspondence.
struct TimeStepLevels {
  std::vector<std::uint8_t> levels = {};
  double bound, work;
  bool anew = true;  // the step must be chosen anew
};

// Collective. The levels of least cost; none if they save little; those of `before`, as far as possible, unless others
// are much better.
TimeStepLevels choose_levels(Body& body, double safety_factor, const PresentStep& present, const ActedOn& acted_on,
                             const std::vector<std::uint8_t>& before, bool has_levels);

// The level of the motion of each owned point: the highest level of any point whose stress moves it.
std::vector<std::uint8_t> motion_levels_of(const Body& body, const std::vector<std::uint8_t>& levels);

// Collective. Appends the values of the ghosts to those of the owned points.
void with_ghosts(const Body& body, std::vector<std::uint8_t>& numbers);

// Collective. Marks all points, also ghosts, within this many families of a marked point.
void spread(const Body& body, int families, std::vector<std::uint8_t>& marks);

}  // namespace strut
