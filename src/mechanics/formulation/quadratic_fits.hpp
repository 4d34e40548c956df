// The fits of all cells of a rank (quadratic_fit.hpp).
#pragma once

#include <array>
#include <bit>
#include <functional>
#include <vector>

#include "mechanics/body.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"

namespace strut {

// Whether the neighbors of an owned point span space well enough for a deformation gradient over its cell.
bool spans_cell(const Domain& domain, int i);

class QuadraticFits {
 public:
  // Collective. Of all owned points of the blocks by quadratic correspondence, without correction: μ = 0.
  explicit QuadraticFits(const Body& body);
  // Once μ is found, and the fits have what it adds to them: their sums and steepness.
  void complete(const Body& body);

  // Fits an owned point that has lost bonds anew; its μ and those of its neighbors stay. `flows`: whether its metal has
  // flowed. False where the bonds that are left do not span space, or only with a steepness times volume (1/m²) above
  // `most`: the point carries no stress.
  bool refit(const Body& body, int i, bool flows, double most);
  // Fits an owned point that carries stress and whose metal has flowed anew, to the bonds that it has.
  void refit_in_flow(const Body& body, int i);
  void drop(int i) { set(i, {}); }  // it carries no stress

  // What the family of an owned point that carries stress gives to F at a place of its cell: calls visit(j, g) with
  // F = Σ (y_j − y_i) ⊗ g, g in 1/m.
  void for_each_weight(const Body& body, int i, int q, const std::function<void(int j, const Vector& g)>& visit) const;
  // F at such a place, of points at place(j).
  Tensor gradient_at(const Body& body, int i, int q, const std::function<Vector(int j)>& place) const;

  QuadraticFit operator[](int i) const {
    std::array<double, QuadraticFit::size> numbers;
    for (int n = 0; n < QuadraticFit::size; ++n) numbers[n] = fits_.at(number_[i], n);
    return std::bit_cast<QuadraticFit>(numbers);
  }
  bool carries_stress(int i) const { return steepness(i) > 0; }
  double steepness(int i) const { return fits_.at(number_[i], QuadraticFit::size - 1); }
  // In tiles, as QuadraticFit has its numbers, and where a point's are.
  const small::Tiles& tiles() const { return fits_; }
  std::size_t place(int i) const { return number_[i]; }
  // μ of owned points and ghosts, zero of other formulations.
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

  std::vector<int> number_;  // of owned points, in fits_; −1 of other formulations
  small::Tiles fits_;        // as the cells of blocks (MaterialBlock::slot_of_cell), one block after the other
  std::vector<double> penalties_in_flow_;  // of owned points: the least that a cell has once its metal has flowed
  std::vector<Eigen::Array4d> multipliers_;
};

}  // namespace strut
