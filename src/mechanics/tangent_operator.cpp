#include "mechanics/force_sum.hpp"
#include "mechanics/formulation/cell_tangent.hpp"
#include "mechanics/formulation/quadratic_cell.hpp"
#include "mechanics/formulation/tangent.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

namespace {

using small::Lanes;

// The force state of the tangent at one point, for δF. `step_fraction`: length of the point's own step over that of the
// whole step; the stiffness is scaled by its square, because such a point limits its own step as a point of that
// stiffness limits the whole step. `C`: of the springs on its own gradient, Pa/m⁵.
ForceState tangent_state(const MaterialPoint& point, const Symmetric& shape_inverse, double C,
                         const materials::Moduli& moduli, const Tensor& dF, double step_fraction) {
  const Tensor A = elastic_change(point, moduli, dF) * to_tensor(shape_inverse) - C * dF;
  return bonds::force_state(step_fraction * step_fraction * A, step_fraction * step_fraction * C);
}

// The same with a given ∂P/∂F.
ForceState tangent_state(const Symmetric& shape_inverse, double C, const PointTangent& tangent, const Tensor& dF) {
  return bonds::force_state(tangent.times(dF) * to_tensor(shape_inverse) - C * dF, C);
}

// Sets the states of cells for a change of their motion, `field`. `tangents`: of integration points; null: elastic.
template <class Weight>
void set_tangent_cells(const Body& body, const MaterialBlock& block, const LaneGroup& group, const Site* field,
                       Weight weight, const std::vector<PointTangent>* tangents, std::vector<QuadraticState>& result) {
  QuadraticCells cells(group, *body.fits, body.domain.sites);
  cells.take(bonds::quadratic_gather(bonds::OfCluster{*group.cluster}, field, body.fits->multipliers(), weight, {}));
  std::array<small::Tensor3<Lanes>, 4> dF, dP;
  for (int q = 0; q < 4; ++q) dF[q] = cells.gradient_at(q), dP[q] = bonds::zero_tensor<Lanes>();
  for (int l = 0; l < group.count; ++l) {
    CellTensors changes;
    for (int q = 0; q < 4; ++q) changes[q] = at(dF[q], l);
    changes = CellTangent(body, block, group.k[l], tangents).change(changes);
    for (int q = 0; q < 4; ++q) {
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) dP[q].c[r][c][l] = changes[q](r, c);
      }
    }
  }
  for (int q = 0; q < 4; ++q) cells.add_stress(q, dP[q]);
  const Lanes squared_fraction =
      small::lanes_of([&](int l) { return body.step_fraction(group.i[l]) * body.step_fraction(group.i[l]); });
  cells.store(group, squared_fraction, [&](int l) -> QuadraticState& { return result[group.i[l]]; });
}

// Sets δt of ordinary points: t is linear in the extensions, so the law itself applies to their changes.
template <class Weight>
void set_tangent_scalars(const Body& body, const MaterialBlock& block, const LaneGroup& group, const Site* field,
                         Weight weight, std::vector<ScalarState>& result) {
  const bonds::OfCluster family{*group.cluster};
  const Lanes moment = bonds::extensions(family, body.domain.sites.data(), weight, bonds::OfField(family, field));
  for (int l = 0; l < group.count; ++l) {
    const double m = block.ordinary[group.k[l]].weighted_volume;
    result[group.i[l]] = scalar_state(block.moduli(group.k[l]), 3 * moment[l] / m, m);
  }
}

// `pull`: Σ ω V (v_j − v_i) of the field.
void set_tangent_state(const Body& body, const MaterialBlock& block, int k, const Tensor& moment, const Vector& pull,
                       const std::vector<PointTangent>* tangents, ForceStates& states, std::vector<Vector>& result) {
  const int i = block.points[k];
  const MaterialPoint& point = body.points[i];
  const Symmetric& shape_inverse = body.shape_inverse[i];
  const Tensor dF = moment * to_tensor(shape_inverse);
  const double step_fraction = body.step_fraction(i), C = block.own_springs_of(point);
  const ForceState state = tangents ? tangent_state(shape_inverse, C, (*tangents)[i], dF)
                                    : tangent_state(point, shape_inverse, C, block.moduli(k), dF, step_fraction);
  states.tensors[i] = state;
  result[i] = bonds::tensor_of(state) * body.first_moment[i] + state.stiffness() * pull;
  if (block.has_springs(ResidualKind::both_gradients)) {
    states.gradients[i] =
        bonds::gradient_state(dF, point.stabilization, step_fraction * step_fraction, block.material.stabilization);
  }
}

// Sets the states of the points for a change of their positions, `field`, and in `result` what their own states give.
struct TangentStates {
  const Body& body;
  Displacements field;
  const std::vector<PointTangent>* tangents;
  ForceStates& states;
  std::vector<Vector>& result;
  bool with_springs = body.has_springs(ResidualKind::own_gradient);  // evaluated once, not for each group

  void operator()(Part part) const {
    const auto sweep = [this](LatticeSums& sums, const LatticeSums::Take& take) { sums.moments(field, take); };
    over_blocks(body, Bodies::all, part, sweep, [&](const MaterialBlock& block, const LaneGroups& groups) {
      over_groups(body, groups, [&](const LaneGroup& group, auto weight) { set(block, group, weight); });
    });
  }

 private:
  template <class Weight>
  void set(const MaterialBlock& block, const LaneGroup& group, Weight weight) const {
    if (block.is_ordinary()) {
      set_tangent_scalars(body, block, group, field.sites, weight, states.scalars);
      for (int l = 0; l < group.count; ++l) result[group.i[l]].setZero();
    } else if (block.is_quadratic()) {
      set_tangent_cells(body, block, group, field.sites, weight, tangents, states.quadratics);
      for (int l = 0; l < group.count; ++l) {
        const int i = group.i[l];
        result[i] = bonds::quadratic_own_force(states.quadratics[i], (*body.fits)[i]);
      }
    } else {
      const auto [dN, pull] = moments(group, field, with_springs, weight);
      for (int l = 0; l < group.count; ++l) {
        set_tangent_state(body, block, group.k[l], at(dN, l), at(pull, l), tangents, states, result);
      }
    }
  }
};

}  // namespace

void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result) {
  const Displacements field{directions.data(), true};
  const TangentStates set_states{body, field, tangents, scratch, result};
  behind_exchange_of<reflect_direction>(halo, directions, set_states);
  if (!scratch.gradients.empty()) {
    const ResidualSum sum{body, Bodies::all, field, scratch, result, {}};
    behind_exchange(halo, scratch.gradients, [&](Part part) { sum(part); });
  }
  const auto change_of = [&](const auto& family) { return bonds::OfField(family, directions.data()); };
  add_up(halo, ForceSum{body, Bodies::all, field, change_of, scratch, result},
         [] { return 0; });  // the estimate of the time step has a timer of its own
  for_each_point(0, body.owned(), [&](int i) { result[i] *= -1; });
}

}  // namespace strut
