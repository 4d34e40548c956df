// Computes rotations, stretches and stresses from deformation gradients, for several integration points at once, one
// per SIMD lane. A point by correspondence is its own integration point; a cell by quadratic correspondence has four.
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "base/math/rotation.hpp"
#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/kernels/group_tile.hpp"

namespace strut {

using small::Lanes, small::lanes_of;
using LaneTensor = small::Tensor3<Lanes>;
using LaneVector = small::Vector3<Lanes>;
using LaneSymmetric = small::Symmetric3<Lanes>;

// 1 in the lanes of a group that have a point.
inline Lanes present(const LaneGroup& group) {
  return lanes_of([&](int l) { return l < group.count ? 1.0 : 0.0; });
}

// The points' own steps as fractions of the step of a level.
inline Lanes step_fractions(const Body& body, const LaneGroup& group, int level) {
  if (body.time_levels.empty()) return Lanes::Ones();
  return lanes_of([&](int l) { return body.step_fraction(group.i[l], level); });
}

// Stretch, R and stress of integration points by correspondence. They are read number by number: the transposition of
// `numbers_of` takes a tenth longer here, where the numbers come from memory anyway.
struct PointRecords {
  std::array<MaterialPoint*, LaneGroup::width> points;

  LaneSymmetric stretches() const {
    LaneTensor F;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) F.c[i][j] = lanes_of([&](int l) { return points[l]->deformation_gradient(i, j); });
    }
    return small::symmetric_part(small::transposed_product(rotations(), F));
  }
  LaneTensor rotations() const {
    LaneTensor R;
    for (int c = 0; c < 6; ++c) R.c[c % 3][c / 3] = lanes_of([&](int l) { return points[l]->rotation.number(c); });
    complete(R);
    return R;
  }
  LaneSymmetric stresses() const {
    LaneSymmetric s;
    for (int c = 0; c < 6; ++c) s[c] = lanes_of([&](int l) { return points[l]->stress[c]; });
    return s;
  }
  // Sets the stresses in the lanes where `which` is positive.
  void set_stresses(const LaneSymmetric& s, const Lanes& which) const {
    for (int l = 0; l < LaneGroup::width; ++l) {
      for (int c = 0; which[l] > 0 && c < 6; ++c) points[l]->stress[c] = s[c][l];
    }
  }
};

// The same for integration point q of cells, in a tile.
struct PointTile {
  TileRow* rows;  // in the layout of CellPoints

  LaneSymmetric stretches() const {
    LaneSymmetric U;
    for (int c = 0; c < 6; ++c) U[c] = small::lanes(rows[c]);
    return U;
  }
  LaneTensor rotations() const {
    LaneTensor R;
    for (int c = 0; c < 6; ++c) R.c[c % 3][c / 3] = small::lanes(rows[CellPoints::rotation + c]);
    complete(R);
    return R;
  }
  LaneSymmetric stresses() const {
    LaneSymmetric s;
    for (int c = 0; c < 6; ++c) s[c] = small::lanes(rows[CellPoints::stress + c]);
    return s;
  }
  void set_stresses(const LaneSymmetric& s, const Lanes& which) const {
    for (int c = 0; c < 6; ++c) set(CellPoints::stress + c, s[c], which);
  }
  void set_motion(const Polar<Lanes>& motion, const Lanes& which) const {
    for (int c = 0; c < 6; ++c) {
      set(c, motion.stretch[c], which);
      set(CellPoints::rotation + c, motion.rotation.c[c % 3][c / 3], which);
    }
  }

 private:
  void set(int n, const Lanes& number, const Lanes& which) const {
    auto row = small::lanes(rows[n]);
    row = small::where_positive(which, number, row);
  }
};

// The integration points of a group: one for each of its points.
template <class Numbers>
struct IntegrationPoints {
  const LaneGroup& group;
  std::array<int, LaneGroup::width> places;  // indices of their states
  Numbers numbers;
  TileRow* state;
};

// The same numbers in the type that laws take.
inline materials::SymmetricOf<small::RawLanes> raw(const LaneSymmetric& s) {
  materials::SymmetricOf<small::RawLanes> result;
  for (int c = 0; c < 6; ++c) result[c] = small::raw(s[c]);
  return result;
}

// The unrotated rate of deformation, d dt = Rᵀ D R dt = sym(ΔU U_mid⁻¹). It is exact up to the midpoint rule, because F
// is linear in y and the velocity constant over the step, and zero to round-off for a rigid motion.
inline LaneSymmetric strain_rate(const LaneSymmetric& old, const LaneSymmetric& stretch, const Lanes& dt) {
  LaneSymmetric difference, middle;
  for (int c = 0; c < 6; ++c) {
    difference.c[c] = (stretch[c] - old[c]) / dt;
    middle.c[c] = 0.5 * (stretch[c] + old[c]);
  }
  return small::symmetric_part(small::product(small::full(difference), small::full(small::inverse(middle))));
}

// The rate of the elastic stretch U/(1 + ε) of points that expand (expansion.hpp).
template <class Numbers>
__attribute__((noinline)) LaneSymmetric elastic_rate(const Body& body, const LaneGroup& group, const Numbers& old,
                                                     const LaneSymmetric& stretch, const Lanes& dt) {
  LaneSymmetric start = old.stretches(), end = stretch;
  const Lanes before = lanes_of([&](int l) { return 1 + body.expansion[group.i[l]].before; });
  const Lanes now = lanes_of([&](int l) { return 1 + body.expansion[group.i[l]].now; });
  for (int c = 0; c < 6; ++c) start.c[c] /= before, end.c[c] /= now;
  return strain_rate(start, end, dt);
}

// Each further update squares the remaining error.
inline Polar<Lanes> polar_of(const LaneTensor& old_rotation, const LaneTensor& F, bool of_any_size) {
  Polar<Lanes> polar = polar_update(old_rotation, F);
  for (int n = 0; of_any_size && n < 3; ++n) polar = polar_update(polar.rotation, F);
  return polar;
}

// P = J R τ Rᵀ F⁻ᵀ = J R τ U⁻¹. `stress`: τ, Pa.
inline LaneTensor piola_kirchhoff(const LaneSymmetric& stress, const Polar<Lanes>& polar,
                                  const LaneSymmetric& inverse_stretch, const Lanes& J) {
  LaneTensor P = small::product(polar.rotation, small::product(small::full(stress), small::full(inverse_stretch)));
  for (auto& row : P.c) {
    for (Lanes& number : row) number *= J;
  }
  return P;
}

// Integration points at the end of a step.
struct Deformed {
  LaneTensor F;
  Polar<Lanes> polar;
  LaneSymmetric inverse_stretch;
  Lanes J;               // det F; 0 for points that carry no stress
  LaneSymmetric rates;   // zero if the step has no length
  LaneSymmetric stress;  // unrotated, with the viscous pressure
  Lanes stiffness;       // M, Pa; 0 for points that have failed
};

// Calls the law of one block for several integration points, one per lane.
template <class L>
struct LawUpdate {
  Body& body;
  MaterialBlock& block;
  const L& law;
  StressPass pass;
  WorstFailure& failure;

  // Deformation gradients F at the end of the pass's step, and what follows from them without the law. `carries`: 1 for
  // points that carry stress, 0 for others, to which the law does not apply: it may have a stress at rest (plastic
  // strain, pressure).
  template <class Numbers>
  Deformed deformed(const LaneGroup& group, const Numbers& old, const LaneTensor& F, const Lanes& step_fraction,
                    const Lanes& carries) const {
    const Polar<Lanes> polar = polar_of(old.rotations(), F, pass.of_any_size);
    Deformed now{F, polar, small::inverse(polar.stretch), small::determinant(F) * carries, {}, {}, {}};
    if (pass.dt > 0 && !body.expansion.empty()) {
      now.rates = elastic_rate(body, group, old, polar.stretch, pass.dt * step_fraction);
    } else if (pass.dt > 0) {
      now.rates = strain_rate(old.stretches(), polar.stretch, pass.dt * step_fraction);
    } else {
      for (int c = 0; c < 6; ++c) now.rates.c[c].setZero();
    }
    return now;
  }

  // Advances stress and state.
  template <class Numbers>
  void set_stress(const IntegrationPoints<Numbers>& g, const Lanes& step_fraction, Deformed& now) const {
    now.stiffness = stiffness_of(g);
    if (!(pass.dt > 0)) {
      now.stress = g.numbers.stresses();
      return;
    }
    const Lanes dt = pass.dt * step_fraction;
    Viscous viscous{Lanes::Zero(), Lanes::Zero()};
    if (!block.viscous.empty()) viscous = add_viscosity(g, now, dt);
    now.stress = advance_laws(g, now, dt, viscous.work);
    if constexpr (materials::has_changing_moduli<L>) now.stiffness = stiffness_of(g);
    if (block.viscous.empty()) return;
    for (int c = 0; c < 3; ++c) now.stress[c] -= viscous.pressure;
  }

  // Counts the work of expansion of a group; `now`: its integration points.
  template <std::size_t n>
  void count_expansion(const LaneGroup& group, const std::array<const Deformed*, n>& now) const {
    if (body.expansion.empty()) return;
    for (int l = 0; l < group.count; ++l) {
      PointExpansion& point = body.expansion[group.i[l]];
      double pull = 0;
      for (const Deformed* at : now) {
        const double trace = at->stress.c[0][l] + at->stress.c[1][l] + at->stress.c[2][l];
        if (at->J[l] > 0 && at->stiffness[l] > 0) pull -= at->J[l] * trace / (1 + point.now) / n;
      }
      point.count(pull);
    }
  }

 private:
  static constexpr std::size_t columns = materials::state_size<L>;

  template <class Numbers>
  typename L::State state_at(const IntegrationPoints<Numbers>& g, int l) const {
    std::array<double, columns> values;
    for (std::size_t c = 0; c < columns; ++c) values[c] = g.state[c].lane[l];
    return materials::from_columns<L>(values);
  }

  // Advances stress and state of one integration point.
  template <class Numbers>
  void advance_law(const IntegrationPoints<Numbers>& g, int l, const Deformed& now, double dt, double viscous_work,
                   LaneSymmetric& all) const {
    Symmetric rate, stretch, old;
    for (int c = 0; c < 6; ++c) rate[c] = now.rates.c[c][l], stretch[c] = now.polar.stretch.c[c][l], old[c] = all[c][l];
    typename L::State state = state_at(g, l);
    const auto [stress, converged] = law.step({rate, dt, now.J[l], stretch, viscous_work}, old, state);
    if (!converged) return failure.report(g.group.k[l], Failure::Kind::no_stress);
    for (int c = 0; c < 6; ++c) all[c][l] = stress[c];
    const auto values = materials::to_columns<L>(state);
    for (std::size_t c = 0; c < columns; ++c) {
      if (double& kept = g.state[c].lane[l]; kept != values[c]) kept = values[c];
    }
  }

  // Advances stress and state of the integration points of a group at once.
  template <class Numbers>
  LaneSymmetric advance_side_by_side(const IntegrationPoints<Numbers>& g, const Deformed& now, const Lanes& dt,
                                     const Lanes& viscous_work) const {
    using State = typename L::template StateOf<small::RawLanes>;
    std::array<small::RawLanes, columns> numbers;
    for (std::size_t c = 0; c < columns; ++c) numbers[c] = small::raw(small::lanes(g.state[c]));
    State state;
    if constexpr (columns > 0) state = std::bit_cast<State>(numbers);
    LaneSymmetric result = g.numbers.stresses();
    materials::PointsOfCall<L> here;
    for (int l = 0; l < g.group.count; ++l) here.add(body.domain.sites[g.group.i[l]].reference.data());
    const auto [stress, converged] =
        law.step({raw(now.rates), small::raw(dt), small::raw(now.J), raw(now.polar.stretch), small::raw(viscous_work)},
                 raw(result), state);
    for (int c = 0; c < 6; ++c) result[c] = small::lanes(converged ? stress[c] : small::raw(result[c]));
    const auto moved = small::raw(now.J) > 0 && small::raw(present(g.group)) > 0;
    if (materials::any(moved && !converged)) {
      for (int l = 0; l < g.group.count; ++l) {
        if (now.J[l] > 0 && !converged[l]) failure.report(g.group.k[l], Failure::Kind::no_stress);
      }
    }
    const auto changes = moved && converged;
    const small::RawLanes one = materials::same<small::RawLanes>(1), none{};
    g.numbers.set_stresses(result, small::lanes(changes ? one : none));
    if constexpr (columns > 0) {
      const auto after = std::bit_cast<decltype(numbers)>(state);
      for (std::size_t c = 0; c < columns; ++c) keep(g.state[c], changes ? after[c] : numbers[c], numbers[c]);
    }
    return result;
  }

  // Below yield the state does not change, and its memory need not be written.
  static void keep(TileRow& row, const small::RawLanes& after, const small::RawLanes& before) {
    if (materials::any(after != before)) small::lanes(row) = small::lanes(after);
  }

  // The stresses of a group at the end of the step.
  template <class Numbers>
  LaneSymmetric advance_laws(const IntegrationPoints<Numbers>& g, const Deformed& now, const Lanes& dt,
                             const Lanes& viscous_work) const {
    if constexpr (materials::takes_lanes<L>) {
      return advance_side_by_side(g, now, dt, viscous_work);
    } else {
      LaneSymmetric result = g.numbers.stresses();
      for (int l = 0; l < g.group.count; ++l) {
        if (now.J[l] > 0) advance_law(g, l, now, dt[l], viscous_work[l], result);
      }
      g.numbers.set_stresses(result, present(g.group));
      return result;
    }
  }

  struct Viscous {
    Lanes pressure, work;  // Pa; of this step, J per m³ of reference volume
  };

  // The viscous pressure of points that are compressed in this step; adds up the work that it dissipates.
  template <class Numbers>
  Viscous add_viscosity(const IntegrationPoints<Numbers>& g, const Deformed& now, const Lanes& dt) const {
    const auto [linear, quadratic] = block.material.viscosity;
    const Lanes speed2 = now.stiffness * now.J / block.material.density,
                steepness2 = small::square(now.inverse_stretch) / 3;
    Viscous viscous{Lanes::Zero(), Lanes::Zero()};
    for (int l = 0; l < g.group.count; ++l) {
      ViscousPoint& point = block.viscous[g.places[l]];
      if (!(now.J[l] > 0 && now.stiffness[l] > 0)) {
        point.damping = 0;
        continue;
      }
      const double D = now.rates.c[0][l] + now.rates.c[1][l] + now.rates.c[2][l], c = std::sqrt(speed2[l]);
      const double length = point.edge / std::sqrt(steepness2[l]);
      const double jump = length * std::max(0.0, -D), by_speed = linear * c + quadratic * quadratic * jump;
      viscous.pressure[l] = block.material.density / now.J[l] * jump * by_speed;
      const double pressure = now.J[l] * viscous.pressure[l];
      viscous.work[l] = 0.5 * (point.pressure + pressure) * -D * dt[l];
      point = {pressure, point.work + viscous.work[l], jump > 0 ? by_speed / c : 0, point.edge};
    }
    return viscous;
  }

  // M of integration points, Pa; 0 for those that have failed.
  template <class Numbers>
  Lanes stiffness_of(const IntegrationPoints<Numbers>& g) const {
    Lanes modulus = Lanes::Constant(law.moduli().longitudinal());
    if constexpr (materials::has_changing_moduli<L>) {
      for (int l = 0; l < LaneGroup::width; ++l) modulus[l] = law.moduli(state_at(g, l)).longitudinal();
    }
    return modulus;
  }
};

// An integration point's part of ω², times the density of its point: M J |U⁻¹|²/3, Pa.
inline Lanes steepened_modulus(const Deformed& now) {
  return now.stiffness * now.J * small::square(now.inverse_stretch) / 3;
}

// Reports the largest viscous damping of the points of a whole step.
inline void add_damping(const MaterialBlock& block, const StressPass& pass, const LaneGroups& groups,
                        StepReport& report) {
  if (block.viscous.empty() || pass.level > 0) return;  // only a whole step needs it
  const auto damping = [&block, &groups](int g) {
    const LaneGroup group = groups[g];
    double most = 0;
    for (const int k : group.k) {
      for (int q = 0; q < block.points_per_cell(); ++q) most = std::max(most, block.viscous[block.index(k, q)].damping);
    }
    return most;
  };
  report.damping = largest(0, groups.count(), report.damping, damping);
}

// Inlines all calls of a function: a call in the loop over groups that is not inlined passes its lanes through memory.
// Debug and sanitizer builds go without, because the compiler would take many minutes.
#ifdef NDEBUG
#define STRUT_INLINE_ALL __attribute__((flatten))
#else
#define STRUT_INLINE_ALL
#endif

// Advances a block's groups of points by `update`, which has its law and advances a group. Reports the largest
// frequency bound, the largest damping and the worst failure.
template <class Update>
void advance_groups(const Update& update, const LaneGroups& groups, StepReport& report) {
  const auto advance = [&update, &groups](int g) STRUT_INLINE_ALL { return update.advance(groups[g]); };
  report.frequency_bound = std::max(report.frequency_bound, std::sqrt(largest(0, groups.count(), 0, advance)));
  add_damping(update.law.block, update.law.pass, groups, report);
  take_worse(update.law.failure.found(update.law.block), report.failure);
}

}  // namespace strut
