#include "mechanics/formulation/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "materials/tangent.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

void Committed::take(const Body& body) {
  places_.resize(body.owned());
  for (int i = 0; i < body.owned(); ++i) places_[i] = body.domain.sites[i].current;
  points_ = body.points;
  expansion_ = body.expansion;
  fracture_energy_.assign(body.fracture_energy.begin(), body.fracture_energy.end());
  states_.clear(), viscous_.clear(), cells_.clear();
  for (const MaterialBlock& block : body.blocks) {
    states_.push_back(*block.state), viscous_.push_back(*block.viscous), cells_.push_back(*block.cells);
  }
}

void Committed::restore(Body& body) const {
  for (int i = 0; i < body.owned(); ++i) body.domain.sites[i].current = places_[i];
  restore_materials(body);
}

void Committed::restore_materials(Body& body) const {
  body.points = points_;
  body.expansion = expansion_;
  std::ranges::copy(fracture_energy_, body.fracture_energy.begin());
  for (std::size_t b = 0; b < states_.size(); ++b) {
    body.blocks[b].state = states_[b], body.blocks[b].viscous = viscous_[b], body.blocks[b].cells = cells_[b];
  }
}

namespace {

Tensor cross(const Vector& w) {
  Tensor W;
  W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return W;
}

// Twice the axial vector of a tensor's skew part: the w of [w×] = A − Aᵀ.
Vector twice_axial(const Tensor& A) { return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)}; }

// The state of a point at the end of the step in its unrotated frame.
struct Unrotated {
  Tensor U, inverse_U, Q, turning;  // turning: [(tr U) I − U]⁻¹
  double J;
};

Unrotated unrotated(const MaterialPoint& point) {
  const Tensor U = to_tensor(symmetric_part(point.rotation.tensor().transpose() * point.deformation_gradient));
  const Tensor inverse_U = U.inverse();
  const double J = U.determinant();
  return {U, inverse_U, J * to_tensor(point.stress) * inverse_U, (U.trace() * Tensor::Identity() - U).inverse(), J};
}

Tensor change_of_stress(const Unrotated& at, const materials::StretchTangent& by_stretch, const Tensor& dG) {
  const Tensor spin = cross(at.turning * twice_axial(dG));
  const Tensor dU = dG - spin * at.U;
  const Tensor dS = to_tensor(Symmetric(by_stretch * symmetric_part(dU)));
  return spin * at.Q + (at.inverse_U * dU).trace() * at.Q + at.J * dS * at.inverse_U - at.Q * dU * at.inverse_U;
}

PointTangent point_tangent(const MaterialPoint& point, const materials::StretchTangent& by_stretch) {
  const Unrotated at = unrotated(point);
  const Tensor R = point.rotation.tensor();
  PointTangent tangent;
  for (int n = 0; n < 9; ++n) {
    Tensor dF = Tensor::Zero();
    dF.data()[n] = 1;
    const Tensor dP = R * change_of_stress(at, by_stretch, R.transpose() * dF);
    tangent.by_gradient.col(n) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dP.data());
  }
  return tangent;
}

// The elastic stretch of a point that has expanded by ε.
Symmetric elastic_stretch(const MaterialPoint& point, double expansion) {
  return symmetric_part(point.rotation.tensor().transpose() * point.deformation_gradient) / (1 + expansion);
}

template <class L>
materials::StretchTangent by_stretch(const L& law, const MaterialPoint& old, const MaterialPoint& now,
                                     const PointExpansion& expansion, double dt, const typename L::State& state) {
  const Symmetric start = elastic_stretch(old, expansion.before);
  const materials::PointStep step = materials::step_between(start, elastic_stretch(now, expansion.now), dt);
  return materials::tangent_of(law, step, old.stress, state, start) / (1 + expansion.now);
}

// Integration point q of a cell, with the volume that its law saw.
template <class L, class Cells>
MaterialPoint as_the_law_saw(const MaterialBlock& block, int k, int q, const Cells& cell) {
  MaterialPoint point = cell(block.index(k, q));
  if (!materials::follows_stretch<L> || !block.shares_volume) return point;
  double mean = 0;
  for (int r = 0; r < 4; ++r) mean += 0.25 * cell(block.index(k, r)).deformation_gradient.determinant();
  point.deformation_gradient *= std::cbrt(mean / point.deformation_gradient.determinant());
  return point;
}

}  // namespace

Tensor PointTangent::times(const Tensor& dF) const {
  Tensor dP;
  Eigen::Map<Eigen::Matrix<double, 9, 1>>(dP.data()) =
      by_gradient * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dF.data());
  return dP;
}

std::vector<PointTangent> point_tangents(const Body& body, const Committed& start, double dt) {
  std::size_t cells = 0;
  for (const MaterialBlock& block : body.blocks) cells += block.cells->places();
  std::vector<PointTangent> tangents(body.owned() + cells, {Eigen::Matrix<double, 9, 9>::Zero()});
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    if (block.is_ordinary()) continue;
    const auto of_block = [&]<class L>(const L& law) {
      const auto at_index = [&](int i, std::size_t index, const MaterialPoint& old, const MaterialPoint& now) {
        const auto state = state_in<L>(start.state(b), index);
        const PointExpansion expansion = body.expansion.empty() ? PointExpansion() : body.expansion[i];
        return point_tangent(now, by_stretch(law, old, now, expansion, dt, state));
      };
      const auto has_failed = [&](std::size_t index) { return !(block.moduli(index).longitudinal() > 0); };
      for_each_point(0, static_cast<int>(block.points.size()), [&](int k) {
        const int i = block.points[k];
        materials::PointsOfCall<L> here;
        here.add(body.domain.sites[i].reference.data());
        if (!block.is_quadratic()) {
          if (has_failed(k)) return;
          tangents[i] = at_index(i, k, start.point(i), body.points[i]);
          return;
        }
        for (int q = 0; q < block.points_per_cell(); ++q) {
          const std::size_t index = block.index(k, q);
          if (has_failed(index)) continue;  // the other points of the cell hold
          PointTangent& tangent = tangents[body.owned() + block.first_integration_point + index];
          const auto old_cell = [&](std::size_t at) { return start.cell(b, at); };
          const auto cell = [&](std::size_t at) -> MaterialPoint { return block.cells[at]; };
          tangent = at_index(i, index, as_the_law_saw<L>(block, k, q, old_cell), as_the_law_saw<L>(block, k, q, cell));
          tangents[i].by_gradient += tangent.by_gradient / block.points_per_cell();
        }
      });
    };
    std::visit(of_block, block.material.law);
  }
  return tangents;
}

}  // namespace strut
