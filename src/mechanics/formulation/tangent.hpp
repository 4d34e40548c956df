// What an implicit step needs of mechanics besides forces: the state that it starts from, to come back to, and how the
// stress of each point changes with its deformation gradient.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// All of a body that a step changes, as it was when it was taken.
class Committed {
 public:
  explicit Committed(const Body& body) { take(body); }
  void take(const Body& body);
  void restore(Body& body) const;            // places too
  void restore_materials(Body& body) const;  // all but the places: what a trial of other places starts from

  const MaterialPoint& point(int i) const { return points_[i]; }
  MaterialPoint cell(std::size_t block, std::size_t place) const { return cells_[block][place]; }
  const small::Tiles& state(std::size_t block) const { return states_[block]; }
  Vector place(int i) const { return places_[i].head<3>().matrix(); }

 private:
  std::vector<Eigen::Array4d> places_;
  std::vector<MaterialPoint> points_;
  std::vector<small::Tiles> states_;  // of blocks
  std::vector<CellPoints> cells_;
  std::vector<std::vector<ViscousPoint>> viscous_;
};

// ∂P/∂F of a point, Pa. Entry (i, j) of a tensor is number 3 j + i: columns one after the other.
struct PointTangent {
  Eigen::Matrix<double, 9, 9> by_gradient;

  Tensor times(const Tensor& dF) const {
    Tensor dP;
    Eigen::Map<Eigen::Matrix<double, 9, 1>>(dP.data()) =
        by_gradient * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dF.data());
    return dP;
  }
};

// Of every owned point, at the end of a step over dt (s, > 0) from `start`: consistent with the law's own step. With
// F = R U, P = J R σ U⁻¹ (docs/theory.md, Correspondence peridynamics) and the unrotated stress σ a function of U
// alone, δF = R (δΩ U + δU) gives
//   [(tr U) I − U] δω = axial(Rᵀ δF − (Rᵀ δF)ᵀ),  δΩ = [δω×],
//   δP = R [ δΩ Q + tr(U⁻¹ δU) Q + J (∂σ/∂U : δU) U⁻¹ − Q δU U⁻¹ ],  Q = J σ U⁻¹.
// Of ordinary points and failed ones: zero. By quadratic correspondence the mean over the cell; after the points follow
// the law points of the cells, that of block.cells[p] at owned + block.first_law_point + p.
std::vector<PointTangent> point_tangents(const Body& body, const Committed& start, double dt);

}  // namespace strut
