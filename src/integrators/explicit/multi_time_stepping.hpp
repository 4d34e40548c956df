// Multi-time-stepping: points whose stress limits the time step take smaller steps of their own.
//
// The stress of a point moves its family by impulses: of most points one a step Δt, of a stiff one one every Δt/2^h, to
// which its stress follows the motion (impulse multiple time stepping, r-RESPA: Tuckerman, Berne & Martyna 1992). So
// momenta are conserved as before. Contact and loads act once a step.
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
  // Collective. Chooses the time-step level of each point (body.time_levels), by its frequency bound:
  // what costs least; none where that saves little. The forces of the points whose time-step levels change are scaled
  // accordingly, so that their impulse ends the last interval and begins the next: between advance_stress and
  // sum_forces. Returns the largest frequency bound of a point of this rank, as a part of its step. `safety_factor`:
  // the step will be such a part of the stable one. The present step stays as it is, unless another is much better.
  double choose(Body& body, double safety_factor, const PresentStep& present, const ActedOn& acted_on);

  // Whether an owned point is too near to such of several substeps for contact to push it. Empty: no point is.
  const std::vector<std::uint8_t>& exposed() const { return exposed_; }

  // Of the last choice: whether the step is to be chosen anew, and for which frequency bound.
  bool anew() const { return anew_; }
  double bound() const { return bound_; }

  // A step has 2^level_count() substeps. Times of level m come every Δt/2^m.
  int level_count() const { return static_cast<int>(levels_.size()); }

  // In a step, the mean of all points of all ranks.
  double updates_a_point() const { return updates_; }

  // Of owned points: the time-step levels of their motion, as that of the stiffest point that moves them.
  // Empty: of none.
  const std::vector<std::uint8_t>& motion_levels() const { return motion_levels_; }

  // Owned points that move at times of this level (1 … level_count()), in ascending order.
  const std::vector<int>& moved(int level) const { return levels_[level - 1].moved; }

  // Collective. The choice, after serialize() of the body: it leaves the archive at the group of all owned points.
  void serialize(Archive& archive, Body& body);

  // Collective. At a time of this level, `dt` after the last: the stresses of the points that are due, and in
  // body.force_density of the moved points the force of these stresses, for an impulse of length dt.
  StepReport forces(Body& body, int level, double dt);

 private:
  // What happens at times of one level.
  struct Level {
    std::vector<SelectedPoints> stressed;  // of each block: those that are due
    std::vector<int> moved;
    ClusterLists sources;  // of the moved points: the stressed points of their families
    // Of points on lattices: Σ ω V ξ by differences of places, as the far ends of lists have it, less that by whole
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
