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
#include <optional>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "fracture/bond_energies.hpp"
#include "fracture/point_account.hpp"
#include "fracture/travel.hpp"
#include "mechanics/bond_breaking.hpp"

namespace strut {

class Fracture : public BondBreaking {
 public:
  // Collective. Of a body whose families are whole: its fields of damage begin, its blocks get their critical values.
  explicit Fracture(Body& body);

  // Collective. Before owned points move over a step of dt (s) with these velocities (m/s). Without this no bond breaks
  // in the stress update that follows.
  void start_step(const Body& body, std::span<const Vector> velocities, double dt);
  // In the stress update at the end of a step, for the points that need no ghost, and, once ghosts are current, for the
  // others: breaks bonds before their stress is updated, and counts afterwards what that has dissipated.
  void break_bonds(Body& body, Part part, double time, double dt) override;
  void count_dissipation(Body& body, Part part) override;
  // Once the sum of forces has exchanged what they read: the same of points with springs on both ends' gradients.
  void count_springs(Body& body) override;
  void finish_step() override { is_looked_at_ = false; }

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
  void count(Body& body, const Affected& one);
  void restore(Body& body, const std::vector<double>& bits, int words);

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
  std::vector<Affected> affected_;
};

// Where bonds of the body may break.
std::optional<Fracture> fracture_of(Body& body);

// Bonds of this rank's points that have broken so far, both ends counted.
std::int64_t broken_bonds(const Body& body);

}  // namespace strut
