// The data that an implicit step needs of mechanics besides forces: a copy of the state that it starts from, and the
// derivative of each point's stress by its deformation gradient.
#pragma once

#include <vector>

#include "mechanics/body.hpp"

namespace strut {

// A copy of the state from which the trials of a load step start: positions, F, R, stress, states of the laws,
// viscosity, thermal expansion and fracture energy. Forces, force states and ordinary points are computed anew.
class Committed {
 public:
  explicit Committed(const Body& body) { take(body); }
  void take(const Body& body);
  void restore(Body& body) const;            // positions too
  void restore_materials(Body& body) const;  // all but the positions: the start of a trial at other positions

  const MaterialPoint& point(int i) const { return points_[i]; }
  MaterialPoint cell(std::size_t block, std::size_t index) const { return cells_[block][index]; }
  const small::Tiles& state(std::size_t block) const { return states_[block]; }
  Vector position(int i) const { return places_[i].head<3>().matrix(); }

 private:
  std::vector<Eigen::Array4d> places_;
  std::vector<MaterialPoint> points_;
  std::vector<small::Tiles> states_;  // of blocks
  std::vector<CellPoints> cells_;
  std::vector<std::vector<ViscousPoint>> viscous_;
  std::vector<PointExpansion> expansion_;
  std::vector<double> fracture_energy_;
};

// ∂P/∂F of a point, Pa. Entry (i, j) of a tensor has the number 3 j + i: columns one after the other.
struct PointTangent {
  Eigen::Matrix<double, 9, 9> by_gradient;

  Tensor times(const Tensor& dF) const;
};

// ∂P/∂F of every owned point at the end of a step over dt (s, > 0) from `start`, consistent with the law's own step.
// With F = R U, P = J R σ U⁻¹ (docs/theory.md, Correspondence peridynamics) and an unrotated stress σ that depends on U
// alone, δF = R (δΩ U + δU) gives
//   [(tr U) I − U] δω = axial(Rᵀ δF − (Rᵀ δF)ᵀ),  δΩ = [δω×],
//   δP = R [ δΩ Q + tr(U⁻¹ δU) Q + J (∂σ/∂U : δU) U⁻¹ − Q δU U⁻¹ ],  Q = J σ U⁻¹.
// Where the points of a cell share their volume (MeanVolume), σ, U and F are those of the mean volume.
// It is zero for ordinary and failed points. By quadratic correspondence it is the mean over the cell; after the points
// follow the integration points of the cells, that of block.cells[p] at owned + block.first_integration_point + p.
std::vector<PointTangent> point_tangents(const Body& body, const Committed& start, double dt);

}  // namespace strut
