// The motion of a rigid tool with a mass under the reactions of the points, by central differences as for the points.
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

// The tool does not rotate. Its motion is the same on all ranks; impulses from points are those of each rank.
struct FreeMotion {
  double mass = 0;                   // kg
  Vector velocity = Vector::Zero();  // m/s, over the step that begins at `time`; at the start the initial velocity
  std::array<std::optional<Function>, 3> force = {};  // along x, y, z, of t only, N

  Vector before = Vector::Zero();  // m/s, over the step before
  Vector offset = Vector::Zero();  // m, displacement at `time`
  double time = 0, step = 0;       // s; the step that begins at `time`
  MidSteps mid_steps;
  bool begun = false;
  std::vector<Vector> pending =
      {};  // N s, pending impulses: given to this rank's points in substeps since; may be empty

  Vector offset_at(double t) const { return offset + (t - time) * velocity; }

  // Collective. Advances to time t, at which a step of dt (s) begins; the velocity excludes the impulses given at t.
  void advance(double t, double dt, const Body& body);
  // Reacts to the impulse (N s) given to the points of all ranks at `time`. Adds its work and that of the tool's force.
  void push_back(const Vector& impulse, const Body& body, ImpulseWork& work);

  double kinetic_energy() const {  // J, at `time`
    return 0.5 * mass * mid_steps.conserved_square(mid_steps.velocity(before, velocity), velocity);
  }

  void serialize(Archive& archive, const std::string& name, int owned);  // at the group of all owned points

  // N s, at `time`: of the force, and the pending impulse of the substeps before.
  Vector force_impulse = Vector::Zero(), pending_sum = Vector::Zero();
};

// Collective. The sum over all ranks of one vector per point, the same to the last bit on any number of ranks.
Vector sum_of_points(const Body& body, const std::vector<Vector>& values);

}  // namespace strut
