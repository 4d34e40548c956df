// The fits of all cells of a rank (quadratic_fit.hpp).
#pragma once

#include <array>
#include <bit>
#include <functional>
#include <vector>

#include "mechanics/body.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"

namespace strut {

// True if the neighbors of an owned point span space well enough for a deformation gradient over its cell.
bool spans_cell(const Domain& domain, int i);

class QuadraticFits {
 public:
  // Collective. Fits all owned points of the blocks by quadratic correspondence, without correction: μ = 0.
  explicit QuadraticFits(const Body& body);
  // Sets sums and steepness of the fits, once μ is known and added to them.
  void complete(const Body& body);

  // Refits an owned point after bonds of it broke; its μ and those of its neighbors stay. `flows`: its metal has
  // flowed. Returns false, and the point carries no stress, if the intact bonds do not span space or only with a
  // steepness times volume above `most` (1/m²).
  bool refit(const Body& body, int i, bool flows, double most);
  // Refits an owned point that carries stress and whose metal has flowed, to its intact bonds.
  void refit_in_flow(const Body& body, int i);
  void drop(int i) { set(i, {}); }  // the point carries no stress from now on

  // Weights of the family of an owned point that carries stress in F at integration point q: calls visit(j, g) with
  // F = Σ (y_j − y_i) ⊗ g, g in 1/m.
  void for_each_weight(const Body& body, int i, int q, const std::function<void(int j, const Vector& g)>& visit) const;
  // F at integration point q, for points at position(j).
  Tensor gradient_at(const Body& body, int i, int q, const std::function<Vector(int j)>& position) const;

  QuadraticFit operator[](int i) const {
    std::array<double, QuadraticFit::size> numbers;
    for (int n = 0; n < QuadraticFit::size; ++n) numbers[n] = fits_.at(number_[i], n);
    return std::bit_cast<QuadraticFit>(numbers);
  }
  bool carries_stress(int i) const { return steepness(i) > 0; }
  double steepness(int i) const { return fits_.at(number_[i], QuadraticFit::size - 1); }
  // The tiles of all fits, with the numbers in the order of QuadraticFit, and the index of a point in them.
  const small::Tiles& tiles() const { return fits_; }
  std::size_t index(int i) const { return number_[i]; }
  // μ of owned points and ghosts; zero for other formulations.
  const Eigen::Array4d* multipliers() const { return multipliers_.data(); }
  double bytes() const;

 private:
  friend class ConsistencyCorrection;
  void set(int i, const QuadraticFit& fit) {
    const auto numbers = std::bit_cast<std::array<double, QuadraticFit::size>>(fit);
    for (int n = 0; n < QuadraticFit::size; ++n) fits_.at(number_[i], n) = numbers[n];
  }

  template <class Set>
  void change_all(const Set& set_numbers);
  void set_sums_of_all(const Body& body);

  std::vector<int> number_;  // of owned points, the index in fits_; −1 for other formulations
  small::Tiles fits_;        // in the order of the blocks' cells (MaterialBlock::slot_of_cell), block after block
  std::vector<double> penalties_in_flow_;  // of owned points: the least penalty once the metal has flowed
  std::vector<Eigen::Array4d> multipliers_;
};

// Collective. The correction by which the forces of a uniform stress equal its tractions on the surface: finds μ of all
// points whose surfaces are known, corrects their fits by the trend of μ, and completes them.
void make_consistent(Body& body, QuadraticFits& fits);

// ---- The onset of plastic flow in cells ----
//
// While a cell is elastic, its fit has the smallest penalty on H, which makes the stiffness accurate. In plastic flow,
// strain localizes in a hinge, which so steep a fit hinders: a strut three cells thick would bear 16 % too much
// (tests/reference, bench_limit_load). So from the first flow on the fit has a larger penalty.
//
// Cells whose pressure is near their flow stress keep the elastic fit. μ is that of elastic fits: beside others a
// uniform stress causes forces, which grow with the pressure without limit while the resistance to them does not. An
// uneven mesh below a pressed face took the force of a dense block to a sixth.

// If block.points[k] has flowed for the first time, its integration points share their change of volume from now on
// (shared_volume.hpp), and its motion is fitted anew unless it is confined. They go on from the gradients of the new
// fit at the present positions; their stress stays. Returns true if flow began.
bool begin_flow(Body& body, MaterialBlock& block, int k);

// The same for all owned cells; returns true if any cell began to flow. Ghosts must be at their present positions. The
// stress update of an explicit step calls the function above for each cell; an equilibrium calls this one when it
// commits a load step.
bool begin_flow(Body& body);

// Refits the cells that have flowed, after a body has been restored from a checkpoint.
void refit_flowed(Body& body);

}  // namespace strut
