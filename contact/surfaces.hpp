// Contact between the surfaces of two blocks (laws/surface.hpp). Each point at a surface feels for the other body: it
// has the energy A E(g), with half of its share of the surface, A, and the overlap g = (ρ(y) − threshold)/slope at its
// place. The force on every point is the derivative of the sum of these energies, so forces are central, equal and
// opposite, and what a contact has stored it gives back. With a_i = A_i p(g_i)/slope_i and η = y_j − y_i
//   f_i = Σ_j (a_i V_j W'_i + a_j V_i W'_j) η/|η|.
//
// Friction is a spring from each such point to the patch that it feels. It acts at one place, where both surfaces are:
// there the point's own neighborhood (couples.hpp) and the patch take it, as a force and a couple (patch.hpp). It
// yields at μ times the normal force (Coulomb): what sticks does not creep. In equilibria the place is the point
// itself, and the spring follows the mean of the patch's points instead of the patch as it turns: pressed and dragged
// surfaces turn between their points, which as slip would be a compliance of its own.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "contact/forces.hpp"
#include "contact/patch.hpp"

namespace strut::contact {

// What a point of a body knows of itself.
struct SurfacePoint {
  double reach = 0;      // from how far it sees another body, m
  double threshold = 0;  // ρ from which it touches
  double slope = 0;      // of ρ with the distance there, 1/m
  double depth = 0;      // below the surface of its body, m
  double area = 0;       // half of its share of the surface, m²: the other body's points have the other half
  double spacing = 0;    // m
  double volume = 0;     // m³
  bool is_at_surface = false;
};

// By how much points have moved: `of` them, velocities (m/s) or ways (m), times so much. A trial starts where the last
// commit was; else one step follows the other.
struct Sliding {
  std::span<const Vector> of;
  double times = 1;
  bool is_trial = false;
};

class Surfaces {
 public:
  // Collective. Of two blocks where they stand at first. Bodies whose surfaces overlap from the start do not press each
  // other by that: it is added to the threshold.
  Surfaces(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law);

  // After a search.
  void take(const BlockPair& blocks, Pairs& pairs);

  // As forces.hpp has them for pairs of points. `penetration`: the overlap in spacings of the point.
  ForceResult add_normal_forces(const Kinematics& kinematics, const SurfaceLaw& law, Pairs& pairs,
                                std::vector<Vector>& force_density);
  void for_each_normal_force(const Pairs& pairs, const std::function<void(std::size_t, Vector)>& visit) const;
  // Collective but in a trial. `friction`: on pairs.owned, N, beside that of `couples`, which has taken pairs.owned.
  void add_friction(const Kinematics& kinematics, const Sliding& sliding, const SurfaceLaw& law, double coefficient,
                    Pairs& pairs, Couples& couples, std::vector<Vector>& force_density, std::vector<Vector>& friction);
  // What the last trial has come to is where the next ones start. Before that: the work of friction since the last
  // time, by the mean of the forces at both ends, J; `way`: of owned points since then, m.
  void commit(const std::vector<Vector>& friction);
  std::vector<Vector> committed_friction() const;  // on the owned points of the last search, N
  double friction_work(const Pairs& pairs, const std::vector<Vector>& friction, std::span<const Vector> way) const;

  void add_stiffness(Pairs& pairs, std::span<const Vector> field, std::span<Vector> result) const;
  void add_springs(const Pairs& pairs, std::span<Tensor> springs) const;

  // The stretch of the springs of friction at the start of the last step or trial, and the friction there. `name`: of
  // this pair of blocks.
  void serialize(Archive& archive, const std::string& name, const Domain& domain, const BlockPair& blocks);

 private:
  // What the partners of a point must know of how it feels.
  struct Facing {
    double reach = 0;
    double push = 0;       // a, N m
    double stiffness = 0;  // A p'/slope², N m: of the energy's second derivative by ρ
    double to_come = 0;    // the same if the overlap grows on as in the last step
    double spread = 0;     // Σ |∂ρ/∂y|/√m over all points that it depends on, 1/(m √kg)

    bool touches() const { return to_come > 0; }
  };
  struct Felt;
  // How friction at a point follows its motion.
  struct Grip {
    Vector along = Vector::Zero();   // the direction of the force
    Vector normal = Vector::Zero();  // of the surface
    double spring = 0;               // N/m, along the surface; of what slides across its direction only
    double by_share = 0;             // N: the force of what slides, by the change of ρ
    Patch patch;                     // that it feels, seen from the point
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
  void take_broken(const Domain& domain, const Pairs& pairs);
  void note_touching();
  void advance_travel(const Pairs& pairs);
  Felt feel(const Pairs& pairs, std::size_t k) const;
  Facing facing(const SurfaceLaw& law, const SurfacePoint& point, const Felt& felt, double mass, double& overlap) const;
  ForceResult feel_all(const SurfaceLaw& law, const Pairs& pairs);
  void subtract_start(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law);

  std::vector<SurfacePoint> points_;          // of blocks.points
  std::vector<double> volumes_;               // of blocks.points: V of ρ, m³ (own_surface.hpp)
  std::vector<double> overlaps_;              // of blocks.points, as of the last forces, m
  std::vector<Vector> slips_, slips_before_;  // of blocks.points: the springs of friction; a step before, m
  std::vector<Vector> friction_before_;       // of blocks.points, N: as of the last commit
  std::vector<Grip> grips_;                   // of pairs.owned, of a trial
  std::vector<int> places_;                   // of pairs.owned in blocks.points
  std::vector<double> due_;                   // of pairs.owned: the travel at which one may come to touch, m
  std::vector<double> smallest_reach_;        // of pairs.owned, for any partner, m
  std::vector<Vector> seen_;                  // where pairs.sites were, m
  double travel_ = 0;                         // since the search, m
  std::vector<Facing> facing_;                // of pairs.sites, as of the last forces
  std::vector<char> touches_;                 // of pairs.sites: what is asked of every partner, close together
  bool any_touches_ = false;                  // of pairs.sites
  std::vector<Vector> gradient_;              // ∂ρ/∂y of pairs.owned by its own place, 1/m
};

// ---- Loops over the partners that points see, or that see them

// From how far a point sees another: within a body, if they were near each other, from a share of that distance only.
inline double reach_between(double reach, const Site& here, const Site& there, bool one_body) {
  if (!one_body) return reach;
  const double apart2 = (there.reference - here.reference).head<3>().matrix().squaredNorm();
  return reference_share * reference_share * apart2 < reach * reach ? reference_share * std::sqrt(apart2) : reach;
}

template <class Record>
void exchange_records(const Pairs& pairs, std::vector<Record>& records) {
  if (pairs.halo) pairs.halo->exchange<unchanged>(records);
}

// Calls visit(partner, η, |η|², reach) for the partners that pairs.owned[k] sees.
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

// The same of the partners that touch and see pairs.owned[k].
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

// Calls visit(facing, ∂ρ/∂y) for the ρ of all points that touch and depend on the place y of pairs.owned[k]: its own,
// and those of partners.
template <class Visit>
void Surfaces::over_gradients(const Pairs& pairs, std::size_t k, const Visit& visit) const {
  visit(facing_[k], gradient_[k]);
  const double volume = pairs.sites[k].volume();
  over_feeling(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
    visit(facing_[partner], Vector(-volume * Smoothing(reach).slope_over_distance(distance2) * eta));
  });
}

}  // namespace strut::contact
