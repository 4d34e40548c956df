// By correspondence, from the places of the points to the force state of each: F, rotation, law, first Piola–Kirchhoff
// stress.
#include "mechanics/stress.hpp"

#include <bit>

#include "base/rotation.hpp"

// What is not inlined into the loop over groups passes its lanes through memory. Checking builds (debug, asan) go
// without: it would take the compiler many minutes.
#ifdef NDEBUG
#define STRUT_INLINE_ALL __attribute__((flatten))
#else
#define STRUT_INLINE_ALL
#endif

namespace strut {

namespace {

void keep(double& kept, double value) {
  if (kept != value) kept = value;  // below yield nothing changes: memory need not be written
}

// ---- Points side by side -------------------------------------------------------------------------------------------

using small::Lanes, small::lanes_of;
using LaneTensor = small::Tensor3<Lanes>;
using LaneSymmetric = small::Symmetric3<Lanes>;
constexpr int width = Group::width;

// A group and its points.
struct Members : Group {
  std::array<MaterialPoint*, width> points;

  Members(const Group& group, Body& body, bool are_all) : Group(group) {
    for (int l = 0; l < width; ++l) {
      points[l] = &body.points[i[l]];
      if (are_all) fetch_ahead(body.points.data(), i[l]);
    }
  }
};

// Number by number: transposed as in `numbers_of` they take a tenth longer here, where they come from memory anyway.
LaneTensor tensors(const Members& g, Tensor MaterialPoint::*field) {
  LaneTensor t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.c[i][j] = lanes_of([&](int l) { return (g.points[l]->*field)(i, j); });
  }
  return t;
}

LaneTensor rotations(const Members& g) {
  LaneTensor R;
  for (int c = 0; c < 6; ++c) R.c[c % 3][c / 3] = lanes_of([&](int l) { return g.points[l]->rotation.number(c); });
  complete(R);
  return R;
}

LaneSymmetric symmetrics(const Members& g, Symmetric MaterialPoint::*field) {
  LaneSymmetric s;
  for (int c = 0; c < 6; ++c) s[c] = lanes_of([&](int l) { return (g.points[l]->*field)[c]; });
  return s;
}

LaneSymmetric shape_inverses(const Members& g, const Body& body) {
  LaneSymmetric s;
  for (int c = 0; c < 6; ++c) s[c] = lanes_of([&](int l) { return body.shape_inverse[g.i[l]][c]; });
  return s;
}

// The same numbers as laws take them.
materials::SymmetricOf<small::RawLanes> raw(const LaneSymmetric& s) {
  materials::SymmetricOf<small::RawLanes> result;
  for (int c = 0; c < 6; ++c) result[c] = small::raw(s[c]);
  return result;
}

// The unrotated rate of deformation, d dt = Rᵀ D R dt = sym(ΔU U_mid⁻¹): exact up to the midpoint rule, because F is
// linear in y and the velocity constant over the step, and zero to round-off for a rigid motion.
LaneSymmetric strain_rate(const Members& g, const LaneSymmetric& stretch, const Lanes& dt) {
  const LaneTensor R = rotations(g), F = tensors(g, &MaterialPoint::deformation_gradient);
  const LaneSymmetric old = small::symmetric_part(small::transposed_product(R, F));
  LaneSymmetric difference, middle;
  for (int c = 0; c < 6; ++c) {
    difference.c[c] = (stretch[c] - old[c]) / dt;
    middle.c[c] = 0.5 * (stretch[c] + old[c]);
  }
  return small::symmetric_part(small::product(small::full(difference), small::full(small::inverse(middle))));
}

// A = P K⁻¹ − C F, P = J R τ Rᵀ F⁻ᵀ = J R τ U⁻¹; times the share of the step. `stress`: τ, Pa.
LaneTensor force_states(const LaneSymmetric& stress, const Lanes& C, const Polar<Lanes>& polar,
                        const LaneSymmetric& inverse_stretch, const LaneTensor& F, const LaneSymmetric& shape_inverse,
                        const Lanes& J, const Lanes& share) {
  LaneTensor A = small::product(small::full(stress), small::full(inverse_stretch));
  A = small::product(small::product(polar.rotation, A), small::full(shape_inverse));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) A.c[i][j] = share * (J * A.c[i][j] - C * F.c[i][j]);
  }
  return A;
}

// All that the update of one block needs.
template <class L, class Weight>
struct Update {
  Body& body;
  MaterialBlock& block;
  const L& law;
  Weight weight;
  StressPass pass;
  WorstFailure& failure;

  // Stress and state of one point.
  void advance_law(const Members& g, int l, const LaneSymmetric& rates, const LaneSymmetric& stretches, double dt,
                   double J) const {
    Symmetric rate, stretch;
    for (int c = 0; c < 6; ++c) rate[c] = rates.c[c][l], stretch[c] = stretches.c[c][l];
    typename L::State state = block.state_of<L>(g.k[l]);
    const auto [stress, converged] = law.step({rate, dt, J, stretch}, g.points[l]->stress, state);
    if (!converged) return failure.report(g.k[l], Failure::Kind::no_stress);
    g.points[l]->stress = stress;
    const auto columns = materials::to_columns<L>(state);
    for (std::size_t c = 0; c < columns.size(); ++c) keep(block.state_at(c, g.k[l]), columns[c]);
  }

  // Stress and state of the points of a group at once.
  LaneSymmetric advance_side_by_side(const Members& g, const LaneSymmetric& rates, const LaneSymmetric& stretches,
                                     const Lanes& dt, const Lanes& J) const {
    using State = typename L::template StateOf<small::RawLanes>;
    constexpr std::size_t columns = materials::state_size<L>;
    std::array<small::RawLanes, columns> numbers;
    for (std::size_t c = 0; c < columns; ++c) {
      numbers[c] = small::raw(lanes_of([&](int l) { return block.state_at(c, g.k[l]); }));
    }
    State state;
    if constexpr (columns > 0) state = std::bit_cast<State>(numbers);
    LaneSymmetric result = symmetrics(g, &MaterialPoint::stress);
    const auto [stress, converged] =
        law.step({raw(rates), small::raw(dt), small::raw(J), raw(stretches)}, raw(result), state);
    if constexpr (columns > 0) numbers = std::bit_cast<decltype(numbers)>(state);
    for (int c = 0; c < 6; ++c) result[c] = small::lanes(converged ? stress[c] : small::raw(result[c]));
    for (int l = 0; l < g.count; ++l) {
      if (!(J[l] > 0)) continue;
      if (!converged[l]) {
        failure.report(g.k[l], Failure::Kind::no_stress);
        continue;
      }
      for (int c = 0; c < 6; ++c) g.points[l]->stress[c] = result[c][l];
      for (std::size_t c = 0; c < columns; ++c) keep(block.state_at(c, g.k[l]), numbers[c][l]);
    }
    return result;
  }

  // The stresses of a group at the end of the step.
  LaneSymmetric advance_laws(const Members& g, const LaneSymmetric& rates, const LaneSymmetric& stretches,
                             const Lanes& dt, const Lanes& J) const {
    if constexpr (materials::takes_lanes<L>) {
      return advance_side_by_side(g, rates, stretches, dt, J);
    } else {
      for (int l = 0; l < g.count; ++l) {
        if (J[l] > 0) advance_law(g, l, rates, stretches, dt[l], J[l]);
      }
      return symmetrics(g, &MaterialPoint::stress);
    }
  }

  // The viscous pressure of points that shrink at the rates of one step; what it takes from them is added up.
  // `stiffness`: M/(3ρ), of failed points 0.
  Lanes viscous_pressure(const Members& g, const LaneSymmetric& rates, const LaneSymmetric& inverse_stretch,
                         const Lanes& stiffness, const Lanes& J, const Lanes& dt) const {
    const auto [linear, quadratic] = block.material.viscosity;
    const Lanes speed2 = 3 * stiffness * J, steepness2 = small::square(inverse_stretch) / 3;
    Lanes q = Lanes::Zero();
    for (int l = 0; l < g.count; ++l) {
      if (!(J[l] > 0) || !(stiffness[l] > 0)) continue;
      const double D = rates.c[0][l] + rates.c[1][l] + rates.c[2][l], c = std::sqrt(speed2[l]);
      const double length = std::cbrt(body.domain.volume(g.i[l])) / std::sqrt(steepness2[l]);
      const double jump = length * std::max(0.0, -D), by_speed = linear * c + quadratic * quadratic * jump;
      q[l] = block.material.density / J[l] * jump * by_speed;
      ViscousPoint& point = block.viscous[g.k[l]];
      point.work += 0.5 * (point.pressure + J[l] * q[l]) * -D * dt[l];
      point.pressure = J[l] * q[l];
      point.damping = jump > 0 ? by_speed / c : 0;
    }
    return q;
  }

  // A failed point goes on as a mass. F and R stay as they were.
  void store_failed(const Members& g, int l) const {
    MaterialPoint& point = *g.points[l];
    point.stabilization = 0;
    drop_forces(g, l);
  }

  void drop_forces(const Members& g, int l) const {
    const MaterialPoint& point = *g.points[l];
    const int i = g.i[l];
    body.force_states.tensors[i] = bonds::packed(Tensor::Zero(), 0);
    if (block.has_mean_gradient()) {
      body.force_states.gradients[i] = bonds::packed(point.deformation_gradient, 0, body.share(i, pass.order));
    }
  }

  // M/(3ρ) of the points of a group, m²/s²; 0 of those that have failed.
  Lanes stiffness_of(const Members& g) const {
    Lanes modulus = Lanes::Constant(law.moduli().longitudinal());
    if constexpr (materials::has_changing_moduli<L>) {
      for (int l = 0; l < width; ++l) modulus[l] = law.moduli(block.state_of<L>(g.k[l])).longitudinal();
    }
    return modulus / (3 * block.material.density);
  }

  void store_point(const Members& g, int l, const Polar<Lanes>& polar, const LaneTensor& F, const LaneTensor& A,
                   double C, double share) const {
    MaterialPoint& point = *g.points[l];
    point.rotation = Rotation(at(polar.rotation, l));
    point.deformation_gradient = at(F, l);
    body.force_states.tensors[g.i[l]] = bonds::packed(at(A, l), share * C);
    if (block.has_mean_gradient()) {
      body.force_states.gradients[g.i[l]] = bonds::packed(point.deformation_gradient, point.stabilization, share);
    }
  }

  // F of the points of a group; on lattices the pull of their springs is put aside for the forces.
  LaneTensor deformation_gradient(const Members& g, const LaneSymmetric& shape_inverse) const {
    const LaneTensor N = moments(g, {body.domain.sites.data()}, weight, &body.force_density);
    LaneTensor F = small::product(N, small::full(shape_inverse));
    if (!g.bundle) {
      for (int i = 0; i < 3; ++i) F.c[i][i] += 1;
    }
    return F;
  }

  // Each further update squares what the first one left.
  Polar<Lanes> polar_of(const Members& g, const LaneTensor& F) const {
    Polar<Lanes> polar = polar_update(rotations(g), F);
    for (int n = 0; pass.of_any_size && n < 3; ++n) polar = polar_update(polar.rotation, F);
    return polar;
  }

  // The largest pace² of the points of a group.
  double advance(const Group& group) const {
    const Members g(group, body, pass.order == 0);
    const LaneSymmetric shape_inverse = shape_inverses(g, body);
    const LaneTensor F = deformation_gradient(g, shape_inverse);
    const Lanes J = small::determinant(F);
    const Polar<Lanes> polar = polar_of(g, F);
    const Lanes share = lanes_of([&](int l) { return body.share(g.i[l], pass.order); });
    const LaneSymmetric inverse_stretch = small::inverse(polar.stretch);
    Lanes stiffness = stiffness_of(g), viscous = Lanes::Zero();
    LaneSymmetric stress;
    if (pass.dt > 0) {
      const Lanes dt = pass.dt * share;
      const LaneSymmetric rates = strain_rate(g, polar.stretch, dt);
      stress = advance_laws(g, rates, polar.stretch, dt, J);
      if constexpr (materials::has_changing_moduli<L>) stiffness = stiffness_of(g);
      if (!block.viscous.empty()) viscous = viscous_pressure(g, rates, inverse_stretch, stiffness, J, dt);
    } else {
      stress = symmetrics(g, &MaterialPoint::stress);
    }
    const Lanes C = lanes_of([&](int l) { return block.springs_of(*g.points[l]); });
    for (int c = 0; c < 3; ++c) stress[c] -= viscous;
    const LaneTensor A = force_states(stress, C, polar, inverse_stretch, F, shape_inverse, J, share);
    const Lanes volume = lanes_of([&](int l) { return body.domain.volume(g.i[l]); });
    const Lanes pace2 = stiffness * share * share * J * volume * small::square(inverse_stretch) *
                        (shape_inverse.c[0] + shape_inverse.c[1] + shape_inverse.c[2]);
    double fastest = 0;
    for (int l = 0; l < g.count; ++l) {
      if (!(stiffness[l] > 0)) {  // has failed
        store_failed(g, l);
        continue;
      }
      if (!(J[l] > 0)) {  // NaN too
        failure.report(g.k[l], std::isnan(J[l]) ? Failure::Kind::not_finite : Failure::Kind::inverted);
        drop_forces(g, l);
        continue;
      }
      store_point(g, l, polar, F, A, C[l], share[l]);
      fastest = std::max(fastest, pace2[l]);
    }
    return fastest;
  }
};

template <class L, class Weight>
void advance_points(Body& body, MaterialBlock& block, const L& law, Weight weight, const StressPass& pass,
                    const Groups& groups, StepReport& report) {
  WorstFailure failure;
  const Update<L, Weight> update{body, block, law, weight, pass, failure};
  const auto advance_group = [&update, &groups](int g) STRUT_INLINE_ALL { return update.advance(groups[g]); };
  const double fastest = largest(0, groups.count(), 0, advance_group);
  report.pace = std::max(report.pace, std::sqrt(fastest));
  if (!block.viscous.empty() && pass.order == 0) {  // a whole step asks for it
    const auto damping = [&block, &groups](int g) {
      const Group group = groups[g];
      double most = 0;
      for (const int k : group.k) most = std::max(most, block.viscous[k].damping);
      return most;
    };
    report.damping = largest(0, groups.count(), report.damping, damping);
  }
  take_worse(failure.found(block), report.failure);
}

}  // namespace

void advance_stress(Body& body, MaterialBlock& block, const StressPass& pass, const Groups& groups,
                    StepReport& report) {
  bonds::with_influence(body.influence, [&](auto weight) {
    std::visit([&](const auto& law) { advance_points(body, block, law, weight, pass, groups, report); },
               block.material.law);
  });
}

namespace {

// Of each point of a group.
template <class Weight>
Lanes squared_residuals(const Body& body, const Group& group, Weight weight) {
  if (group.bundle) {
    return bonds::squared_residual(bonds::OfBundle{*group.bundle}, body.domain.sites.data(), body.points.data(),
                                   weight);
  }
  Lanes result = Lanes::Zero();
  for (int l = 0; l < group.count; ++l) {
    const int i = group.i[l];
    result[l] = group.chunk->squared_residual(i, {body.domain.sites.data()}, body.points[i].deformation_gradient,
                                              body.shape_inverse[i]);
  }
  return result;
}

}  // namespace

void view_residuals(Body& body, const Groups& groups) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) {
      const Group group = groups[g];
      const Lanes squares = squared_residuals(body, group, weight);
      for (int l = 0; l < group.count; ++l) body.residual[group.i[l]] = squares[l];
    });
  });
}

}  // namespace strut
