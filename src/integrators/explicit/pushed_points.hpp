// Points on which contact, tools or damping act: these limit their time-step levels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"

namespace strut {

// Marks owned points on which contact, or a tool with a mass, acts at time t (s) or is about to, once per step of dt
// (s). Empty if the scene has neither.
std::vector<std::uint8_t> pushed_points(const Body& body, const Conditions& conditions, const contact::Contact& contact,
                                        std::span<const Vector> velocities, double t, double dt);

// Marks points whose motion a condition damps, or the friction of a tool. Empty if none does.
std::vector<std::uint8_t> damped_points(const Body& body, const Conditions& conditions,
                                        std::span<const Vector> velocities, double t, double dt);

bool any_in_both(const std::vector<std::uint8_t>& some, const std::vector<std::uint8_t>& others);  // empty: no marks

}  // namespace strut
