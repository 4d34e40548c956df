// The points whose stress limits the step, stepped alone more often.
//
// The stress of a point moves its family by impulses: of most points one a step Δt, of a stiff one one every Δt/2^h, to
// which its stress follows the motion (impulse multiple time stepping, r-RESPA: Tuckerman, Berne & Martyna 1992). So
// momenta are conserved as before. Contact and loads act once a step.
#pragma once

#include "base/archive.hpp"
#include "mechanics/groups.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

class Subcycles {
 public:
  // Collective. Chooses how often the step of each point is halved (body.halvings), by its pace: what costs least; none
  // where that saves little. The forces of the points whose halvings change are halved accordingly, so that their
  // impulse ends the last interval and begins the next: between advance_stress and sum_forces.
  // Returns the largest pace of a point of this rank, as a part of its step.
  // `safety_factor`: the step will be such a part of the stable one.
  double choose(Body& body, double safety_factor);

  // A step has 2^orders() substeps. Of the times between them, those of order m come every Δt/2^m.
  int orders() const { return static_cast<int>(orders_.size()); }

  // In a step, the mean of all points of all ranks.
  double updates_a_point() const { return updates_; }

  // Of owned points: how often the step of their motion is halved, as the one of the stiffest point that moves them.
  // Empty: of none.
  const std::vector<std::uint8_t>& motions() const { return motions_; }

  // Owned points that move at times of this order (1 … orders()), in ascending order.
  const std::vector<int>& moved(int order) const { return orders_[order - 1].moved; }

  // Collective. The choice, after keep() of the body: it leaves the archive at the group of all owned points.
  void keep(Archive& archive, Body& body);

  // Collective. At a time of this order, `dt` after the last: the stresses of the points that are due, and in
  // body.force_density of the moved points the force of these stresses, for an impulse of length dt.
  StepReport forces(Body& body, int order, double dt);

 private:
  // What happens at times of one order.
  struct Order {
    std::vector<Chosen> stressed;  // of each block: those that are due
    std::vector<int> moved;
    Bundles sources;                    // of the moved points: the stressed points of their families
    std::vector<Vector> first_moments;  // Σ ω V ξ over the family of each moved point, m⁴
    Halo halo;
  };
  void add_residuals(Body& body, Order& now, int order) const;
  void make_orders(Body& body);
  Order order_of(const Body& body, const std::vector<std::uint8_t>& motions, const std::vector<double>& ids,
                 int order) const;

  std::vector<Order> orders_;
  std::vector<std::uint8_t> motions_;
  double updates_ = 1;
};

}  // namespace strut
