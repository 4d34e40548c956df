// The derivative of a cell's stresses by its deformation gradients (quadratic correspondence), with the coupling of the
// integration points by their shared volume.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/formulation/shared_volume.hpp"
#include "mechanics/formulation/tangent.hpp"

namespace strut {

// δP at an integration point for δF by the elastic moduli, without the geometric stiffness: J C:sym(δF F⁻¹) F⁻ᵀ.
inline Tensor elastic_change(const MaterialPoint& point, const materials::Moduli& moduli, const Tensor& dF) {
  const Tensor inverse_F = point.deformation_gradient.inverse();
  const Symmetric D = symmetric_part(dF * inverse_F);
  const Symmetric stress = 2 * moduli.shear * D + spherical((moduli.bulk - 2 * moduli.shear / 3) * trace(D));
  return point.deformation_gradient.determinant() * to_tensor(stress) * inverse_F.transpose();
}

// The tangent of the cell of block.points[k].
class CellTangent {
 public:
  // `tangents`: of the integration points (point_tangents), or null for the elastic moduli.
  CellTangent(const Body& body, const MaterialBlock& block, int k, const std::vector<PointTangent>* tangents)
      : body_(body), block_(block), k_(k), tangents_(tangents) {
    if (block.flowed[k] || block.shares_volume) shared_.emplace(block, k);
  }

  // δP at the integration points of the cell, for δF there.
  CellTensors change(CellTensors dF) const {
    if (shared_) shared_->share_gradients(dF);
    CellTensors dP;
    for (int q = 0; q < 4; ++q) {
      const std::size_t index = block_.index(k_, q);
      dP[q] = tangents_ ? (*tangents_)[body_.owned() + block_.first_integration_point + index].times(dF[q])
                        : elastic_change(block_.cells[index], block_.moduli(index), dF[q]);
    }
    if (shared_) shared_->share_stresses(dP);
    return dP;
  }

 private:
  const Body& body_;
  const MaterialBlock& block_;
  int k_;
  const std::vector<PointTangent>* tangents_;
  std::optional<SharedVolume> shared_;
};

}  // namespace strut
