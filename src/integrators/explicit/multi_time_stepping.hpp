// Multi-time-stepping: points whose stress limits the time step take smaller steps of their own.
//
// The stress of a point acts on its family by impulses: one per step Δt for most points; for a stiff point one every
// Δt/2^h, for which its stress follows the motion (impulse multiple time stepping, r-RESPA: Tuckerman, Berne & Martyna
// 1992). So momenta are conserved as without substeps. Contact acts once per step, and loads as loads.hpp says.
#pragma once

#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "integrators/explicit/time_step_levels.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

class MultiTimeStepping {
 public:
  // Collective. Chooses the time-step level of each point (body.time_levels) from its frequency bound, for the least
  // cost; none if that saves little. Rescales the forces of points whose level changes: their impulse now lasts for
  // half of the old and half of the new own step. Call it between advance_stress and sum_forces. Returns the largest
  // product of frequency bound and fraction of the step of any point on this rank, 1/s. `safety_factor`: step over
  // stable step. The present step stays, unless another is much better.
  double choose(Body& body, double safety_factor, const PresentStep& present, const ActedOn& acted_on);
  // Collective. The same, but ends all substeps: level 0 for all points.
  double drop(Body& body, const PresentStep& present);

  // Marks of owned points that contact must not push, because points with several substeps are too close. Empty: there
  // are no such points.
  const std::vector<std::uint8_t>& exposed() const { return exposed_; }

  // Result of the last choice: whether the step must be chosen anew, and for which frequency bound.
  bool anew() const { return anew_; }
  double bound() const { return bound_; }

  // A step has 2^level_count() substeps. Times of level m come every Δt/2^m.
  int level_count() const { return static_cast<int>(levels_.size()); }

  // Stress updates of a point in a step, the mean over all points of all ranks.
  double updates_a_point() const { return updates_; }

  // Time-step levels of the motion of the owned points: that of the stiffest point that moves each one. Empty: no
  // substeps.
  const std::vector<std::uint8_t>& motion_levels() const { return motion_levels_; }

  // Owned points that move at times of this level (1 … level_count()), ascending.
  const std::vector<int>& moved(int level) const { return levels_[level - 1].moved; }

  // Collective. Saves or restores the choice, after serialize() of the body left the archive at all owned points.
  void serialize(Archive& archive, Body& body);

  // Collective. At a time of this level, `dt` (s) after the last one: updates the stresses of the points of this level
  // and above, and sets body.force_density of the moved points to the force of these stresses, for an impulse over dt.
  // `time`: now, s.
  StepReport forces(Body& body, int level, double dt, double time);

 private:
  static double fastest_of(Body& body);

  // The points and lists for the times of one level.
  struct Level {
    std::vector<SelectedPoints> stressed;  // of each block: points of this level and above
    std::vector<int> moved;
    ClusterLists sources;  // of the moved points: the stressed points in their families
    // For points on lattices: Σ ω V ξ by differences of positions, as in the lists of far ends, minus that by whole
    // cells (Body::first_moment).
    std::vector<std::pair<int, Vector>> moment_errors;
    Halo halo;
  };
  template <class S>
  void add_residuals(std::size_t kind, Body& body, Level& now, int level) const;
  void make_levels(Body& body);
  static void set_moment_errors(const Body& body, Level& level);
  Level make_level(const Body& body, const std::vector<std::uint8_t>& motion_levels, int level) const;

  std::vector<Level> levels_;
  std::vector<std::uint8_t> motion_levels_, exposed_;
  double updates_ = 1, bound_ = 0;
  bool anew_ = false;
};

}  // namespace strut
