// Which points something outside the stress of the body acts on: these have limits to their time-step levels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"

namespace strut {

// Whether contact, or a tool with a mass, acts on an owned point at time t (s) or is about to: once a step of dt (s),
// on both alike. Empty where there is neither.
std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt);

// Points whose motion a condition damps. Empty where none does.
std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions);

bool any_in_both(const std::vector<std::uint8_t>& some, const std::vector<std::uint8_t>& others);  // empty: of none

}  // namespace strut
