// The time-step levels of points: who takes steps of its own, and how many of them in a step of all.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// The step of a run so far.
struct PresentStep {
  double bound;  // 1/s, the frequency bound that it was chosen for; 0: there is none
  double slack;  // so many times as much is bearable
};

// Marks of the owned points that something acts on once a step, whatever their levels. Empty: none.
struct ActedOn {
  const std::vector<std::uint8_t>& pushed;  // by contact, or a tool with a mass
  const std::vector<std::uint8_t>& damped;  // by a condition
};

// Contact acts once a step, on points of level 1 at the most and no nearer than this to those of higher levels: an
// impulse a step is in resonance with what is faster than most_turn allows there (docs/theory.md, Multi-time-stepping).
inline constexpr int families_around_contact = 3;

// Of owned points and ghosts, empty of none; for steps that points of the frequency bound `bound` (1/s) and below can
// have; and the work of a step, in that of a step of a point by correspondence.
struct TimeStepLevels {
  std::vector<std::uint8_t> levels = {};
  double bound, work;
  bool anew = true;  // the step is to be chosen anew
};

// Collective. What costs least; none where that saves little; those of `before`, as far as they may stay, unless others
// are much better.
TimeStepLevels choose_levels(Body& body, double safety_factor, const PresentStep& present, const ActedOn& acted_on,
                             const std::vector<std::uint8_t>& before, bool has_levels);

// The level of the motion of each owned point: that of any point whose stress moves it.
std::vector<std::uint8_t> motion_levels_of(const Body& body, const std::vector<std::uint8_t>& levels);

// Numbers of owned points, with those of the ghosts behind them. Collective.
void with_ghosts(const Body& body, std::vector<std::uint8_t>& numbers);

// Collective. Marks all that is so many families from a marked point at the most, ghosts too.
void spread(const Body& body, int families, std::vector<std::uint8_t>& marks);

}  // namespace strut
