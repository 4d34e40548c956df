// By quadratic correspondence, from the places of the points to the states of their bonds: F at four places of each
// cell, rotation, law and first Piola–Kirchhoff stress there.
//
// The law sees F̄_q = α_q F_q with α_q = (J̄/J_q)^⅓, J̄ the mean of J_q = det F_q over the cell: one volume a cell, or
// four conditions on the motion of one point would lock it where the material flows without change of volume (the F-bar
// method: de Souza Neto et al., Int. J. Solids Struct. 33, 1996). With p_q = P̄_q : F̄_q/3 and p their mean, the exact
// derivative of the energy is P_q = α_q P̄_q + (p/J̄ − p_q/J_q) cof F_q.
#include "mechanics/law_points.hpp"
#include "mechanics/quadratic_cell.hpp"

namespace strut {

namespace {

LaneTensor scaled(const LaneTensor& t, const Lanes& factor) {
  LaneTensor result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.c[i][j] = factor * t.c[i][j];
  }
  return result;
}

LaneTensor sum(const LaneTensor& a, const LaneTensor& b) {
  LaneTensor result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.c[i][j] = a.c[i][j] + b.c[i][j];
  }
  return result;
}

Lanes double_dot(const LaneTensor& a, const LaneTensor& b) {
  Lanes dot = Lanes::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) dot += a.c[i][j] * b.c[i][j];
  }
  return dot;
}

// J F⁻ᵀ.
LaneTensor cofactor(const LaneTensor& F) {
  LaneTensor result;
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int c = (j + 1) % 3, d = (j + 2) % 3;
      result.c[i][j] = F.c[a][c] * F.c[b][d] - F.c[a][d] * F.c[b][c];
    }
  }
  return result;
}

// Newton's iteration, from the tangent at 1: to round-off between 1/3 and 3.
Lanes cube_root(const Lanes& x) {
  Lanes root = 1 + (x - 1) / 3;
  for (int n = 0; n < 5; ++n) root = (2 * root + x / (root * root)) / 3;
  return root;
}

// All that the update of one block needs.
template <class L, class Weight>
struct Update {
  LawUpdate<L> law;
  Weight weight;

  Body& body() const { return law.body; }
  MaterialBlock& block() const { return law.block; }

  LawPoints places(const Group& group, int q) const {
    LawPoints g{{}, {}, group};
    for (int l = 0; l < Group::width; ++l) {
      g.places[l] = static_cast<int>(block().place(group.k[l], q));
      g.points[l] = &block().cells[g.places[l]];
    }
    return g;
  }

  // The largest pace² of the points of a group.
  double advance(const Group& group) const {
    const std::vector<Site>& sites = body().domain.sites;
    QuadraticCells cells(group, *body().fits, sites);
    cells.take(
        bonds::quadratic_gather(bonds::OfBundle{*group.bundle}, sites.data(), body().fits->multipliers(), weight));
    const Lanes share = lanes_of([&](int l) { return body().share(group.i[l], law.pass.order); });
    const Lanes carries = lanes_of([&](int l) { return (*body().fits)[group.i[l]].carries_stress() ? 1.0 : 0.0; });
    std::array<LaneTensor, 4> F, P;
    std::array<Lanes, 4> J, pressure;
    Lanes mean_J = Lanes::Zero(), mean_pressure = Lanes::Zero(), smallest_J = Lanes::Constant(1);
    for (int q = 0; q < 4; ++q) {
      F[q] = cells.gradient_at(q);
      for (int i = 0; i < 3; ++i) F[q].c[i][i] += 1 - carries;  // those without stress stay undeformed
      J[q] = small::determinant(F[q]);
      mean_J += 0.25 * J[q];
      smallest_J = (J[q] > 0).select(smallest_J, J[q]);  // NaN, too
    }
    Lanes speed2 = Lanes::Zero();
    for (int q = 0; q < 4; ++q) {
      const LawPoints g = places(group, q);
      const Lanes alpha = cube_root(mean_J / J[q]);
      const Deformed now = law.advance(g, scaled(F[q], alpha), share);
      P[q] = piola_kirchhoff(now.stress, now.polar, now.inverse_stretch, now.J);
      for (int l = 0; l < group.count; ++l) {
        if (smallest_J[l] > 0 && now.stiffness[l] > 0) {
          law.store(g, l, now);
        } else {  // failed
          for (auto& row : P[q].c) row[0][l] = row[1][l] = row[2][l] = 0;
        }
      }
      pressure[q] = double_dot(P[q], now.F) / 3;
      mean_pressure += 0.25 * pressure[q];
      P[q] = scaled(P[q], alpha);
      speed2 = speed2.max(squared_speed(now));
    }
    for (int q = 0; q < 4; ++q) {
      cells.add_stress(q, sum(P[q], scaled(cofactor(F[q]), mean_pressure / mean_J - pressure[q] / J[q])));
    }
    cells.store(group, share, body().force_states.quadratics);
    return report(group, smallest_J, share * share * cells.volume() * cells.steepness() * speed2);
  }

 private:
  // Reports points that are turned inside out at a place, and returns the largest pace² of the others.
  double report(const Group& group, const Lanes& determinant, const Lanes& pace2) const {
    double fastest = 0;
    for (int l = 0; l < group.count; ++l) {
      if (determinant[l] > 0) {
        fastest = std::max(fastest, pace2[l]);
      } else {
        const bool is_number = !std::isnan(determinant[l]);
        law.failure.report(group.k[l], is_number ? Failure::Kind::inverted : Failure::Kind::not_finite);
        body().force_states.quadratics[group.i[l]] = {};
      }
    }
    return fastest;
  }
};

template <class L, class Weight>
void advance_points(Body& body, MaterialBlock& block, const L& law, Weight weight, const StressPass& pass,
                    const Groups& groups, StepReport& report) {
  WorstFailure failure;
  const Update<L, Weight> update{{body, block, law, pass, failure}, weight};
  const auto advance_group = [&update, &groups](int g) STRUT_INLINE_ALL { return update.advance(groups[g]); };
  const double fastest = largest(0, groups.count(), 0, advance_group);
  report.pace = std::max(report.pace, std::sqrt(fastest));
  add_damping(block, pass, groups, report);
  take_worse(failure.found(block), report.failure);
}

// What a look at the body shows of a cell: F and R in its middle, and the mean of the stresses.
void view_cell(Body& body, const MaterialBlock& block, int k, const Tensor& F) {
  MaterialPoint& point = body.points[block.points[k]];
  point.deformation_gradient = F;
  const Tensor R = F.determinant() > 0 ? polar_rotation(F) : Tensor::Identity();
  point.rotation = Rotation(R);
  Tensor stress = Tensor::Zero();
  for (int q = 0; q < 4; ++q) {
    const MaterialPoint& there = block.cells[block.place(k, q)];
    const Tensor turned = R.transpose() * there.rotation.tensor();
    stress += 0.25 * turned * to_tensor(there.stress) * turned.transpose();
  }
  point.stress = symmetric_part(stress);
}

}  // namespace

void advance_quadratic(Body& body, MaterialBlock& block, const StressPass& pass, const Groups& groups,
                       StepReport& report) {
  bonds::with_influence(body.influence, [&](auto weight) {
    std::visit([&](const auto& law) { advance_points(body, block, law, weight, pass, groups, report); },
               block.material.law);
  });
}

void view_cells(Body& body, const MaterialBlock& block, const Groups& groups) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) {
      const Group group = groups[g];
      const std::vector<Site>& sites = body.domain.sites;
      QuadraticCells cells(group, *body.fits, sites);
      cells.take(
          bonds::quadratic_gather(bonds::OfBundle{*group.bundle}, sites.data(), body.fits->multipliers(), weight));
      for (int l = 0; l < group.count; ++l) {
        const bool carries = (*body.fits)[group.i[l]].carries_stress();
        view_cell(body, block, group.k[l], carries ? at(cells.gradient(), l) : Tensor(Tensor::Identity()));
      }
    });
  });
}

}  // namespace strut
