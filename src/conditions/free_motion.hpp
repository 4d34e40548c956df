// The motion of a rigid tool that has a mass: what it pushes pushes back. Central differences, as of the points.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/archive.hpp"
#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "conditions/mid_steps.hpp"

namespace strut {

struct Body;
struct ImpulseWork;

// It does not turn. The same on all ranks, but for what is of the points of a rank.
struct FreeMotion {
  double mass = 0;                   // kg
  Vector velocity = Vector::Zero();  // m/s, over the step that begins at `time`; at first the initial one
  std::array<std::optional<Function>, 3> force = {};  // along x, y, z, of t only, N

  Vector before = Vector::Zero();  // m/s, over the step before
  Vector offset = Vector::Zero();  // m, how far it has come at `time`
  double time = 0, step = 0;       // s; the step that begins at `time`
  MidSteps mid_steps;
  bool begun = false;
  std::vector<Vector> owed = {};  // N s, what it has given to the points of this rank in substeps since; may be empty

  Vector offset_at(double t) const { return offset + (t - time) * velocity; }

  // To the time t, at which a step of dt (s) begins: the velocity is then that without what is given at t. Collective.
  void advance(double t, double dt, const Body& body);
  // It has given this impulse (N s) to the points of all ranks at `time`. Adds its work and that of the force on it.
  void push_back(const Vector& impulse, const Body& body, ImpulseWork& work);

  double kinetic_energy() const {  // J, at `time`
    return 0.5 * mass * mid_steps.conserved_square(mid_steps.velocity(before, velocity), velocity);
  }

  void serialize(Archive& archive, const std::string& name, int owned);  // at the group of all owned points

  // N s, at `time`: of the force, and of what was given in substeps before.
  Vector force_impulse = Vector::Zero(), owed_impulse = Vector::Zero();
};

// Collective. The sum of a vector a point of this rank over all ranks, the same to the last bit on any number of them.
Vector sum_of_points(const Body& body, const std::vector<Vector>& values);

}  // namespace strut
