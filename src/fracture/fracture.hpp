// Breaks bonds, and counts the energy that this dissipates.
//
// A bond breaks for both of its ends in the same step: the criterion is symmetric to the last bit, so the ranks of both
// ends decide identically without a message. Each cluster stores the elongation that its bond nearest to the limit
// still needs, and is checked again only when its points may have moved apart by that much (Travel). While no cluster
// is due, a step does nothing else, unless points may fail, springs fade, or bonds break by energy: breaks of other
// bonds change this energy, so clusters of such points are checked.
//
// The energy dissipated by a break is the residual in the energy balance of the points whose bonds broke. With the work
// w of a point's force states along the step's motion of its family, before the break, and w' after it,
//   D = ½ (w + w') − (E' − E).
// The kinetic energy of central differences changes by −½ Σ (w + w') over all points, so the balance is exact.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "fracture/averaged_criterion.hpp"
#include "fracture/bond_energies.hpp"
#include "fracture/fitted_criterion.hpp"
#include "fracture/travel.hpp"
#include "fracture/work_balance.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// How short the steps are for the breaks in them, as sums over the ends of bonds; bonds of failed points, and those
// that a falling limit breaks, do not count.
struct BreaksInSteps {
  double ends = 0;
  double taken = 0;   // energy that these breaks take, over that which they take in short steps
  double speed2 = 0;  // squares of the rate of stretch over the critical one, 1/s²
};

class Fracture : public BondBreaking {
 public:
  // Collective. The families must be complete. Allocates the damage fields and sets the critical values of the blocks
  // at this time, s.
  explicit Fracture(Body& body, double time = 0);

  // Call it before the stress update of a step, and of an equilibrium's load step.
  void start_criteria(const Body& body) { fitted_.start(body); }
  // Collective. After it.
  void finish_criteria(Body& body) {
    fitted_.finish(body);
    averaged_.average(body);
  }
  // Collective. Call it before the points move over a step of dt (s); without this call no bond breaks in the stress
  // update that follows. `velocities`: of owned points, m/s; `stretch`: increment of the stretch of periodic sides in
  // the step, along x, y, z.
  void start_step(const Body& body, std::span<const Vector> velocities, double dt,
                  const Vector& stretch = Vector::Zero());
  // Called in the stress update at the end of a step, first for the points that need no ghost and, once ghosts are
  // current, for the others: break_bonds before their stress is updated, count_dissipation after it.
  void break_bonds(Body& body, Part part, double time, double dt) override;
  void count_dissipation(Body& body, Part part) override;
  // Called when the sum of forces has exchanged its states: counts the dissipation of springs on both ends' gradients.
  void count_springs(Body& body) override;
  void finish_step() override { is_checked_ = false; }

  // For equilibria. Call it instead of start_step before a stress update at the same positions: in this update the
  // bonds beyond their limit break, and D is the decrease of the body's stored energy.
  void start_rest(const Body& body);
  // Collective. The largest stretch of a bond over the one at which it breaks, at the present positions.
  double largest_stretch(const Body& body) const;

  BreaksInSteps breaks_in_steps(const Communicator& ranks) const;  // collective

  double bytes(const Body& body) const;  // with the memory that steps in which bonds may break add

  void serialize(Archive& archive, Body& body);  // collective; restores to a body whose bonds are whole
  void serialize_steps(Archive& archive);        // the breaks in steps

 private:
  // A cluster with points whose bonds break in this step, with its values before the break.
  struct Affected {
    std::size_t block;
    int cluster, first;  // first: index of its first point in the block
    unsigned members;    // a bit for each point whose bonds break
    std::array<BondWorkBalance, Cluster::width> before;
    std::vector<std::vector<int>> families;  // of the members, if they have springs on both ends' gradients
  };
  struct Stretches;

  static double part_of_springs(const Body& body, const MaterialBlock& block, int k);
  void set_limits(const Body& body, double time);
  bool limits_change(const Body& body) const;
  void set_which(const Body& body);
  void take_failed(const Body& body);
  void mark_for_check(const Body& body, const std::vector<char>& points);
  void soften_springs(Body& body, Part part);
  void set_shortest(const Body& body);
  void set_most_steepness(const Body& body);
  void keep_start(const Body& body);
  void mark_all_for_check(const Body& body);
  bool is_at_limit(const Body& body, const MaterialBlock& block, int cluster);
  bool holds_energy(const Body& body, const MaterialBlock& block) const;
  unsigned bonds_to_cut(const Body& body, const MaterialBlock& block, const Cluster& cluster,
                        std::vector<std::uint8_t>& gone) const;
  void count_in_steps(const Body& body, int i, int j, double load, double dt);
  void count_in_steps(const Body& body, const MaterialBlock& block, const Cluster& cluster,
                      const std::vector<std::uint8_t>& gone, double dt);
  void cut(Body& body, MaterialBlock& block, int cluster, double dt);
  void count(Body& body, const Affected& one);
  void restore(Body& body);

  std::vector<char> may_fail_;  // of blocks: their points may fail, and then lose their bonds
  std::vector<int> block_of_;   // of owned points and ghosts
  std::vector<double> limits_;  // (1 + s_c)² of owned points and ghosts; infinite without
  bool by_time_ = false;        // the deck's limits change with time
  BondEnergies energies_;       // of bonds in blocks with a critical bond energy
  FittedCriterion fitted_;
  AveragedCriterion averaged_;
  bool is_checked_ = false;                     // a bond may break in this step
  std::vector<Vector> start_;                   // positions of owned points and ghosts at the start of such a step, m
  std::vector<GradientState> start_gradients_;  // gradient states at the start of such a step
  std::vector<double> shortest_;                // shortest |ξ| of each cluster, m
  std::vector<double> next_checks_;             // travel at which a cluster must be checked next, m
  Travel travel_;
  std::vector<double> whole_volume_;    // Σ V_j over the complete family of owned points, m³
  std::vector<double> whole_springs_;   // C of owned points with complete families, Pa/m⁵
  std::vector<double> most_steepness_;  // limit of the steepness of owned points that carry stress, 1/m²
  std::vector<Affected> affected_;
  BreaksInSteps in_steps_;  // of this rank
};

// The fracture of a body from this time on, s, if its bonds may break.
std::optional<Fracture> fracture_of(Body& body, double time = 0);

// Number of bonds of this rank's points that have broken so far; both ends count.
std::int64_t broken_bonds(const Body& body);

}  // namespace strut
