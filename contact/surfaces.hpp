// Contact between the surfaces of two blocks (laws/surface.hpp). Each point at a surface has the energy A E(g): A is
// half of its area of the surface, g = (ρ(y) − threshold)/slope the overlap at its position. The force on every point
// is the derivative of the sum of these energies, so forces are central, equal and opposite, and contact returns the
// energy that it stores. With a_i = A_i p(g_i)/slope_i and η = y_j − y_i
//   f_i = Σ_j (a_i V_j W'_i + a_j V_i W'_j) η/|η|.
//
// Friction is a spring from each such point to the patch of the other body that it feels. It acts at one position,
// between both surfaces, on the point's own neighborhood and on the patch, as a force and a couple
// (couples.hpp). It yields at μ times the normal force (Coulomb), so sticking points do not creep. In equilibria it
// acts at the point itself, and the spring follows the mean motion of the patch's points instead of the rotating patch:
// pressed and sheared surfaces rotate between their points, which as slip would be an additional compliance.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "contact/forces.hpp"

namespace strut::contact {

// Constants of a point of a body.
struct SurfacePoint {
  double reach = 0;      // largest distance at which it sees another body, m
  double threshold = 0;  // ρ at which it touches
  double slope = 0;      // −dρ/d(distance) at this ρ, 1/m
  double depth = 0;      // below the surface of its body, m
  double area = 0;       // half of its area of the surface, m²: the other body's points have the other half
  double spacing = 0;    // m
  double volume = 0;     // m³
  bool is_at_surface = false;
  double at_start = 0;  // overlap at the start, m: the threshold includes it
};

// A point of a body whose bonds have broken. Material seen at the break gives no pressure, since that would
// be energy out of nothing; `excess` falls as these points move apart.
struct BrokenPoint {
  double excess = 0;        // added to the threshold
  bool is_exposed = false;  // it is at a surface
};

// Motion of the points: `of` are velocities (m/s) or displacement increments (m), to be multiplied by `times`. A trial
// starts from the last commit; else steps follow each other.
struct Sliding {
  std::span<const Vector> of;
  double times = 1;
  bool is_trial = false;
};

class Surfaces {
 public:
  // Collective. The blocks must be at their initial positions. Bodies whose surfaces overlap at the start do not press
  // each other thereby: the overlap is added to the threshold.
  Surfaces(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law);

  // The largest overlap at the start of this rank's points, in spacings.
  double overlap_at_start() const;

  // Call it after a search. `before`, `now`: numbers of broken bonds of blocks.points at the previous search and at
  // this one; empty if no bonds may break, `before` also at the first search.
  void take(const Domain& domain, const BlockPair& blocks, const BrokenCounts& before, const BrokenCounts& now,
            Pairs& pairs);

  // As in forces.hpp for pairs of points. `penetration`: the overlap in spacings of the point. `is_trial`: a
  // trial of an equilibrium, perhaps discarded.
  ForceResult add_normal_forces(const Kinematics& kinematics, const SurfaceLaw& law, bool is_trial, Pairs& pairs,
                                std::vector<Vector>& force_density);
  void for_each_normal_force(const Pairs& pairs, const std::function<void(std::size_t, Vector)>& visit) const;
  Vector normal_force_through_sides(const Pairs& pairs) const;  // as in forces.hpp
  // Collective except in a trial. `friction`: on pairs.owned, N, without that of `couples`, which has pairs.owned.
  void add_friction(const Kinematics& kinematics, const Sliding& sliding, const SurfaceLaw& law, double coefficient,
                    Pairs& pairs, Couples& couples, std::vector<Vector>& force_density, std::vector<Vector>& friction);
  // commit makes the state of the last trial the start of the next ones. friction_work, before it: work of friction
  // since the last commit, by the mean of the forces at both ends, J; `increments`: displacements of owned points since
  // that commit, m.
  void commit(const std::vector<Vector>& friction);
  std::vector<Vector> committed_friction() const;  // on the owned points of the last search, N
  double friction_work(const Pairs& pairs, const std::vector<Vector>& friction,
                       std::span<const Vector> increments) const;

  void add_stiffness(Pairs& pairs, std::span<const Vector> field, std::span<Vector> result) const;
  void add_springs(const Pairs& pairs, std::span<Tensor> springs) const;

  // Columns of blocks.points: stretch of the friction springs at the start of the last step or trial, friction at the
  // last commit; if bonds may break, the data of BrokenPoint.
  void serialize(Archive& archive, bool may_break);
  // A column: the ρ at which points touch. It depends on the initial positions, which another run's mesh may not have.
  void serialize_start(Archive& archive);

 private:
  // Contact state of a point, as its partners need it.
  struct Facing {
    double reach = 0;
    double push = 0;       // a, N m
    double stiffness = 0;  // A p'/slope², N m: of the energy's second derivative by ρ
    double to_come = 0;    // stiffness if the overlap grows on as in the last step
    double spread = 0;     // Σ |∂ρ/∂y|/√m over all points that it depends on, 1/(m √kg)

    bool touches() const { return to_come > 0; }
  };
  struct Felt;
  // Friction tangent: how the friction on a point changes with its motion.
  struct FrictionTangent {
    Vector along = Vector::Zero();   // direction of the force
    Vector normal = Vector::Zero();  // normal of the surface
    double spring = 0;               // N/m, along the surface; while sliding, only across the direction of sliding
    double by_fraction = 0;          // N: change of the sliding force with ρ
    Patch patch;                     // the patch that the point feels, relative to the point
    bool slides = false;
  };

  template <class Visit>
  void over_felt(const Pairs& pairs, std::size_t k, const Visit& visit) const;
  template <class Visit>
  void over_feeling(const Pairs& pairs, std::size_t k, const Visit& visit) const;
  template <class Visit>
  void over_gradients(const Pairs& pairs, std::size_t k, const Visit& visit) const;
  Patch felt_patch(const Pairs& pairs, std::size_t k, const Vector& place) const;
  template <class MotionOf>
  Vector slip_of(const Pairs& pairs, std::size_t k, const Patch& patch, const Vector& place, bool turns,
                 const MotionOf& motion) const;
  Vector between_surfaces(std::size_t k) const;
  void set_smallest_reaches(const Pairs& pairs);
  void set_volumes(Pairs& pairs) const;
  double excess_of(std::size_t k) const { return broken_.empty() ? 0 : broken_[places_[k]].excess; }
  void expose_broken(const Domain& domain, const Pairs& pairs);
  void see_through_breaks(const Domain& domain, const BlockPair& blocks, const BrokenCounts& before,
                          const BrokenCounts& now, const Pairs& pairs);
  void note_touching();
  void advance_travel(const Pairs& pairs);
  Felt feel(const Pairs& pairs, std::size_t k, std::span<const std::int64_t> unseen = {}) const;
  Facing facing(const SurfaceLaw& law, const SurfacePoint& point, const Felt& felt, double threshold, double mass,
                double& overlap) const;
  ForceResult feel_all(const SurfaceLaw& law, bool is_trial, const Pairs& pairs);
  void subtract_start(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law);

  std::vector<SurfacePoint> points_;          // of blocks.points
  std::vector<BrokenPoint> broken_;           // of blocks.points; empty while no bond may break
  std::vector<double> volumes_;               // of blocks.points: V of ρ, m³ (own_surface.hpp)
  std::vector<double> overlaps_;              // of blocks.points, as of the last forces, m
  std::vector<Vector> slips_, slips_before_;  // of blocks.points: stretch of the friction springs; a step before, m
  std::vector<Vector> friction_before_;       // of blocks.points, N: at the last commit
  std::vector<FrictionTangent> friction_tangents_;  // of pairs.owned, in a trial
  std::vector<int> places_;                         // of pairs.owned in blocks.points
  std::vector<double> next_checks_;                 // of pairs.owned: the travel at which the point may touch, m
  std::vector<double> smallest_reach_;              // of pairs.owned, for any partner, m
  std::vector<Vector> seen_;                        // last positions of pairs.sites, m
  double travel_ = 0;                               // since the search, m
  std::vector<Facing> facing_;                      // of pairs.sites, at the last forces
  std::vector<char> touches_;                       // of pairs.sites: touches(), compact because every partner reads it
  bool any_touches_ = false;                        // any of pairs.sites
  std::vector<Vector> gradient_;                    // ∂ρ/∂y of pairs.owned by their own positions, 1/m
};

// ---- Loops over the partners that points see, or that see them

// Distance at which a point sees another: within a body at most a fraction of their reference distance.
inline double reach_between(double reach, const Site& here, const Site& there, bool one_body) {
  if (!one_body) return reach;
  const double apart2 = (there.reference - here.reference).head<3>().matrix().squaredNorm();
  return reference_fraction * reference_fraction * apart2 < reach * reach ? reference_fraction * std::sqrt(apart2)
                                                                          : reach;
}

template <class Record>
void exchange_records(const Pairs& pairs, std::vector<Record>& records) {
  if (pairs.halo) pairs.halo->exchange<unchanged>(records);
}

// Calls visit(partner, η, |η|², reach) for each partner that pairs.owned[k] sees.
template <class Visit>
void Surfaces::over_felt(const Pairs& pairs, std::size_t k, const Visit& visit) const {
  const Site& here = pairs.sites[k];
  const double reach = points_[places_[k]].reach;
  for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
    const Site& there = pairs.sites[pairs.partners[p]];
    const Vector eta = (there.current - here.current).head<3>().matrix();
    const double distance2 = eta.squaredNorm();
    if (!(distance2 < reach * reach)) continue;
    const double seen = reach_between(reach, here, there, pairs.one_body);
    if (distance2 < seen * seen) visit(pairs.partners[p], eta, distance2, seen);
  }
}

// The same for the partners that touch and see pairs.owned[k].
template <class Visit>
void Surfaces::over_feeling(const Pairs& pairs, std::size_t k, const Visit& visit) const {
  const Site& here = pairs.sites[k];
  for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
    const int partner = pairs.partners[p];
    if (!touches_[partner]) continue;
    const Site& there = pairs.sites[partner];
    const Vector eta = (there.current - here.current).head<3>().matrix();
    const double reach = reach_between(facing_[partner].reach, here, there, pairs.one_body);
    const double distance2 = eta.squaredNorm();
    if (distance2 < reach * reach) visit(partner, eta, distance2, reach);
  }
}

// Calls visit(facing, ∂ρ/∂y) for the ρ of all touching points that depends on the position y of pairs.owned[k]: its
// own, and those of partners.
template <class Visit>
void Surfaces::over_gradients(const Pairs& pairs, std::size_t k, const Visit& visit) const {
  visit(facing_[k], gradient_[k]);
  const double volume = pairs.sites[k].volume();
  over_feeling(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
    visit(facing_[partner], Vector(-volume * Smoothing(reach).slope_over_distance(distance2) * eta));
  });
}

}  // namespace strut::contact
