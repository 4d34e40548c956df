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
    if (block.shares_volume && materials::law_follows_stretch(block.material.law)) {
      mean_.emplace(block, k);
    } else if (block.flowed[k] || block.shares_volume) {
      shared_.emplace(block, k);
    }
  }

  // δP at the integration points of the cell, for δF there.
  CellTensors change(CellTensors dF) const {
    if (mean_) return mean_->change(dF, [this](int q, const Tensor& by) { return change_at(q, by); });
    if (shared_) shared_->share_gradients(dF);
    CellTensors dP;
    for (int q = 0; q < 4; ++q) dP[q] = change_at(q, dF[q]);
    if (shared_) shared_->share_stresses(dP);
    return dP;
  }

 private:
  Tensor change_at(int q, const Tensor& dF) const {
    const std::size_t index = block_.index(k_, q);
    if (tangents_) return (*tangents_)[body_.owned() + block_.first_integration_point + index].times(dF);
    const MaterialPoint point = block_.cells[index];
    return elastic_change(mean_ ? mean_->at_mean(point, q) : point, block_.moduli(index), dF);
  }

  const Body& body_;
  const MaterialBlock& block_;
  int k_;
  const std::vector<PointTangent>* tangents_;
  std::optional<SharedVolume> shared_;
  std::optional<MeanVolumeTangent> mean_;
};

}  // namespace strut
