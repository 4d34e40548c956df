// Bonds that break, and what they dissipate.
//
// A bond breaks for both of its ends in the same step: the criterion is symmetric to the last bit, so the ranks of both
// ends decide alike without a message. It is looked at where the motion since the last look may have sufficed: of each
// cluster of points it is known by how much the bond nearest to its limit would have to grow, and two points move apart
// by no more than the velocities around them allow (Travel). Where no bond may break anywhere, nothing else is done in
// a step. What bonds hold changes with the breaks of others, too: where such a point is met, it is looked at.
//
// The energy dissipated by a break is what is missing in the balance of the points whose bonds broke: with the work w
// of a point's force states along the step's motion of its family, before the break and after it,
//   D = ½ (w + w') − (E' − E).
// The kinetic energy of central differences changes by −½ Σ (w + w') over all points, so this is exact.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "mechanics/body.hpp"
#include "mechanics/fracture/bond_energies.hpp"
#include "mechanics/fracture/point_account.hpp"
#include "mechanics/fracture/travel.hpp"

namespace strut {

enum class Part;

// Whether point i, or a ghost, has failed.
inline bool has_failed(const ForceStates& states, std::size_t i) {
  return (!states.tensors.empty() && states.tensors[i].failed() > 0) ||
         (!states.quadratics.empty() && states.quadratics[i].failed > 0);
}

class Fracture {
 public:
  // Collective. Of a body whose families are whole.
  explicit Fracture(Body& body);

  // Collective. Before owned points move over a step of dt (s) with these velocities (m/s). Without this no bond breaks
  // in the stress update that follows.
  void start_step(const Body& body, std::span<const Vector> velocities, double dt);
  // In the stress update at the end of a step, for the points that need no ghost, and, once ghosts are current, for the
  // others: breaks bonds before their stress is updated, and counts afterwards what that has dissipated.
  void break_bonds(Body& body, Part part, double time, double dt);
  void count_dissipation(Body& body, Part part);
  // Once the sum of forces has exchanged what they read: the same of points with springs on both ends' gradients.
  void count_springs(Body& body);
  void finish_step() { is_looked_at_ = false; }

  bool may_break(std::size_t block) const { return may_break_[block]; }  // or one that it is bonded to
  // 1 − Σ V_j over the bonds that are left / the same over all that there were; 0 of a point without bonds.
  double damage(const Body& body, int i) const;
  double energy() const;                                     // dissipated so far at this rank's points, J
  double dissipated(int i) const { return dissipated_[i]; }  // at one of them, J
  std::int64_t broken() const { return broken_; }            // bonds so far, both ends counted, of this rank's points

  double bytes() const;

  void serialize(Archive& archive, Body& body);  // collective

 private:
  // A cluster with points whose bonds break in this step, as they were before.
  struct Affected {
    std::size_t block;
    int cluster, first;  // first: the place of its first point in the block's
    unsigned members;    // a bit for each of these points
    std::array<PointAccount, Cluster::width> before;
    std::vector<std::vector<int>> families;  // of the members, where they have springs on both ends' gradients
  };
  struct Stretches;

  void set_limits(const Body& body, double time);
  void set_which(const Body& body);
  void take_failed(const Body& body);
  void look_around(const Body& body, const std::vector<char>& points);
  void soften_springs(Body& body, Part part);
  void set_shortest(const Body& body);
  void set_most_steepness(const Body& body);
  void keep_start(const Body& body);
  void look_at_all(const Body& body);
  bool is_at_limit(const Body& body, const MaterialBlock& block, int cluster);
  bool holds_energy(const Body& body, const MaterialBlock& block) const;
  unsigned bonds_to_cut(const Body& body, const MaterialBlock& block, const Cluster& cluster,
                        std::vector<std::uint8_t>& gone) const;
  void cut(Body& body, MaterialBlock& block, int cluster, double dt);
  void count(const Body& body, const Affected& one);
  void restore(Body& body, const std::vector<double>& bits, int words);

  std::vector<char> may_break_;                 // of blocks
  std::vector<char> may_fail_;                  // of blocks: their points may fail, and lose their bonds then
  std::vector<int> block_of_;                   // of owned points and ghosts
  std::vector<double> limits_;                  // (1 + s_c)² of owned points and ghosts; infinite without
  bool by_time_ = false;                        // they change
  BondEnergies energies_;                       // what bonds hold, where that has a limit
  bool is_looked_at_ = false;                   // a bond may break in this step
  std::vector<Vector> start_;                   // places at the start of such a step, of owned points and ghosts, m
  std::vector<GradientState> start_gradients_;  // the same of what springs read
  std::vector<double> shortest_;                // |ξ| of clusters, m
  std::vector<double> due_;                     // the travel at which one of their bonds may have come to break, m
  Travel travel_;
  std::vector<double> whole_volume_;    // Σ V_j over the family at first, of owned points, m³
  std::vector<double> whole_springs_;   // C of owned points at first, Pa/m⁵
  std::vector<double> most_steepness_;  // of owned points that carry stress, 1/m²
  std::vector<double> dissipated_;      // by owned points, J
  std::vector<double> released_;        // 1 of owned points that carry no stress any more
  std::vector<Affected> affected_;
  std::int64_t broken_ = 0;
};

}  // namespace strut
