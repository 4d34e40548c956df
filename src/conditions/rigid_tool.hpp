// Rigid tools: shapes that move along given paths or freely, and that the points of a body do not enter.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "conditions/condition_type.hpp"
#include "conditions/impulse_work.hpp"
#include "conditions/tool_shapes.hpp"

namespace strut {

struct Body;
struct Domain;
struct ImpulseWork;
struct Mirror;

// The motion of a rigid tool with a mass under the reactions of the points, by central differences as for the points.
// The tool does not rotate. Its motion is the same on all ranks; impulses from points are those of each rank.
struct FreeMotion {
  double mass = 0;                   // kg
  Vector velocity = Vector::Zero();  // m/s, over the step that begins at `time`; at the start the initial velocity
  std::array<std::optional<Function>, 3> force = {};  // along x, y, z, of t only, N
  Tensor free_directions = Tensor::Identity();        // projects on the directions in which forces move it

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

  // For each symmetry plane by which the tool is its own mirror image: keeps forces from moving the tool along the
  // normal, because the forces on its two halves cancel there. Not if a velocity or force of the deck has a component
  // along it.
  void keep_between(const std::vector<Mirror>& mirrors, const Shape& shape);

  double kinetic_energy() const {  // J, at `time`
    return 0.5 * mass * mid_steps.conserved_square(mid_steps.velocity(before, velocity), velocity);
  }

  void serialize(Archive& archive, const std::string& name, int owned);  // at the group of all owned points

  // N s, at `time`: of the force, and the pending impulse of the substeps before.
  Vector force_impulse = Vector::Zero(), pending_sum = Vector::Zero();
};

// Collective. The sum over all ranks of one vector per point, the same to the last bit on any number of ranks.
Vector sum_of_points(const Body& body, const std::vector<Vector>& values);

enum class BodyAt { mesh, present };

// A tool with its points, which meet it where their cells end. A point that would enter it is stopped at its surface,
// and may leave at any time. While it is stopped, Coulomb friction takes up to `friction` times the impulse of the tool
// from its sliding along the tool.
struct RigidTool {
  std::vector<int> points = {};
  Shape shape;                                         // at zero travel
  std::array<std::optional<Function>, 3> travel = {};  // along x, y, z, functions of t only, m; nullopt: no travel
  double friction = 0;
  int reaction_index = no_reaction;
  // For a tool with a mass, instead of `travel`; shared with its parts for substeps, which only record the impulses
  // that they give.
  std::shared_ptr<FreeMotion> free = {};
  bool in_whole_steps = true;
  // Reach of the cells of all owned points, m. Null: the tool meets the points themselves.
  std::shared_ptr<std::vector<double>> reaches = {};
  // True if it has met a point of this rank; shared with its parts for substeps and its copies.
  std::shared_ptr<bool> touched = std::make_shared<bool>(false);

  // Its travel at time t (s), m. A position y sees its surface as y − offset(t) sees `shape`.
  Vector offset(double t) const;
  // This place y − offset(t), or that of an image of it through the periodic sides, which is nearest to the tool.
  Vector nearest_image(const Domain& domain, Vector place) const;
  // Its surface, for one kind S of shape or for any, as the cell of point i meets it from the position y − offset(t).
  template <class S>
  Surface met_by(int i, const S& kind, const Vector& place) const {
    Surface at = surface(kind, place);
    if (reaches) at.gap -= (*reaches)[i];
    return at;
  }
  // Sets the reaches, from the tool at time t (s) and the body as it was read or as it is: cells that would overlap the
  // tool then end at its surface. Nodes have no reach, because nodes at a surface lie on it.
  void set_reaches(double t, const Body& body, BodyAt at);
  // Save or restore the reaches, and a free motion, too; the archive must be at the group of all owned points.
  void serialize_reaches(Archive& archive, const std::string& name);
  void serialize(Archive& archive, const std::string& name, int owned);

  static constexpr Stage stage = Stage::tools;
  static constexpr double Work::*ledger_entry = &Work::tools;
  static constexpr InEquilibria in_equilibria = InEquilibria::tool;

  std::vector<Function> values_at_points() const;  // functions of the time alone
  RigidTool on(std::vector<int> all, int index, const Body&) const {
    return {std::move(all), shape, travel, friction, index, free ? std::make_shared<FreeMotion>(*free) : nullptr};
  }

  void change_velocities(VelocityUpdate& update);  // collective if it has a mass
  std::optional<RigidTool> in_substeps(const MovingPoints& moving) const;
  static constexpr bool acts_at_start = false;

 private:
  void fly(VelocityUpdate& update);
};

}  // namespace strut
