#include "mechanics/mechanics.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <sstream>

#include "base/timing.hpp"
#include "mechanics/formulation/correspondence.hpp"
#include "mechanics/formulation/quadratic_cell.hpp"
#include "mechanics/formulation/shared_volume.hpp"
#include "mechanics/formulation/tangent.hpp"
#include "mechanics/kernels/ordinary_bonds.hpp"

namespace strut {

namespace {

using small::Lanes;

constexpr int site_stride = sizeof(Site) / sizeof(double);

double* places(std::vector<Site>& sites) { return sites.data()->current.data(); }

// Runs `interior` while the halo of `data` is under way, then `boundary`.
template <class Interior, class Boundary>
void behind_exchange(Halo& halo, double* data, int stride, int width, Interior&& interior, Boundary&& boundary) {
  static Teuchos::Time& waiting = phase("Halo exchange");
  {
    const Timed timed(waiting);
    halo.start(data, stride, width);
  }
  interior();
  {
    const Timed timed(waiting);
    halo.finish(data, stride, width);
  }
  boundary();
}

// Runs work(part) for the points that need no ghost of `states` while its exchange is under way, then for the others.
template <class State, class Work>
void behind_exchange(Halo& halo, std::vector<State>& states, const Work& work) {
  constexpr int width = sizeof(State) / sizeof(double);
  behind_exchange(
      halo, reinterpret_cast<double*>(states.data()), width, width, [&] { work(Part::interior); },
      [&] { work(Part::boundary); });
}

// Which bodies a pass is over: forces need only those that are strained, a tangent is of all.
enum class Bodies { all, deforming };

bool is_due(const MaterialBlock& block, Bodies bodies) { return bodies == Bodies::all || !block.in_rigid_motion; }

// Calls work(block, groups of its points) for a part of the points; on lattices, sums over which are of all points at
// once, after the exchange, for all in the second part. `sweep`: calls a sweep of sums over a lattice with what takes
// them.
template <class AnyBody, class Sweep, class Work>
void over_blocks(AnyBody& body, Bodies bodies, Part part, const Sweep& sweep, const Work& work) {
  for (auto& block : body.blocks) {
    if (block.lattice < 0 && is_due(block, bodies)) work(block, LaneGroups(body, block, part));
  }
  if (part == Part::interior) return;
  for (std::size_t l = 0; l < body.lattice_sums.size(); ++l) {
    const auto is_on_it = [&](const MaterialBlock& b) { return b.lattice == static_cast<int>(l) && is_due(b, bodies); };
    if (std::none_of(body.blocks.begin(), body.blocks.end(), is_on_it)) continue;
    sweep(*body.lattice_sums[l], [&](const LatticeSums::Chunk& chunk) {
      for (auto& block : body.blocks) {
        if (is_on_it(block)) work(block, LaneGroups(block, chunk));
      }
    });
  }
}

// Calls work(group, ω).
template <class Work>
void over_groups(const Body& body, const LaneGroups& groups, const Work& work) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) { work(groups[g], weight); });
  });
}

bool all_move_rigidly(const Body& body) {
  return std::all_of(body.blocks.begin(), body.blocks.end(), [](const MaterialBlock& b) { return b.in_rigid_motion; });
}

template <class Weight>
Lanes residual_energies(const Body& body, const LaneGroup& group, const Site* places,
                        const std::vector<ForceState>& gradients, Weight weight) {
  if (group.cluster) return bonds::residual_energy(bonds::OfCluster{*group.cluster}, places, gradients.data(), weight);
  Lanes energies = Lanes::Zero();
  for (int l = 0; l < group.count; ++l) {
    const bonds::OfPoint family{body.domain.families, group.i[l]};
    energies[l] = bonds::residual_energy(family, places, gradients.data(), weight);
  }
  return energies;
}

// The stabilization by the mean gradient. Its energy is ½ Σ V_i V_j ω C_ij |z|²; with z = η − ½ (F_i + F_j) ξ its force
// is Σ ω V_j C_ij z, which begins the sum in `result`, and by way of both F it takes ½ M K⁻¹ from A. `u`: of y, or of
// the field that stands in its place for a tangent. `energy`: of each point; none if empty.
void add_residual(const Body& body, Bodies bodies, const Displacements& u, Part part, ForceStates& states,
                  std::vector<Vector>& result, std::span<double> energy) {
  const auto add = [&](const LaneGroup& group, auto weight) {
    const bonds::Residual<Lanes> sums = residuals(group, u.sites, states.gradients, weight);
    for (int l = 0; l < group.count; ++l) {
      const int i = group.i[l];
      take_residual(states.tensors[i], at(sums.moment, l), body.shape_inverse[i]);
      result[i] = at(sums.force, l);
    }
    if (energy.empty()) return;
    const Lanes energies = residual_energies(body, group, u.sites, states.gradients, weight);
    for (int l = 0; l < group.count; ++l) energy[group.i[l]] = energies[l];
  };
  over_blocks(
      body, bodies, part,
      [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.residuals(u, states.gradients, take); },
      [&](const MaterialBlock& block, const LaneGroups& groups) {
        if (!block.has_mean_gradient()) return;
        over_groups(body, groups, [&](const LaneGroup& group, auto weight) { add(group, weight); });
      });
}

// The force on every point, summed over the formulations that its block feels. `u`: of y, or of the field that stands
// in its place for a tangent; `extension_of`: a family, of a bond between ordinary points; `result`: on lattices with
// the pulls that the moments of u have left there.
template <class ExtensionOf>
struct ForceSum {
  const Body& body;
  Bodies bodies;
  Displacements u;
  ExtensionOf extension_of;
  ForceStates& states;
  std::vector<Vector>& result;

  void correspondence(Part part) const {
    const bool with_springs = body.has_springs();
    const auto sweep = [this](LatticeSums& sums, const LatticeSums::Take& take) {
      sums.forces(u, states.tensors, take);
    };
    over_blocks(body, bodies, part, sweep, [&](const MaterialBlock& block, const LaneGroups& groups) {
      if (!block.feels_correspondence) return;
      const Begun begun = block.has_mean_gradient()            ? Begun::sum
                          : with_springs && block.lattice >= 0 ? Begun::pull
                                                               : Begun::nothing;
      over_groups(body, groups, [&](const LaneGroup& group, auto weight) {
        add(group, forces(group, u, states.tensors, with_springs, weight), begun);
      });
    });
  }

  void ordinary(Part part) const {
    for (const MaterialBlock& block : body.blocks) {
      if (!is_due(block, bodies) || !block.feels_ordinary) continue;
      over_groups(body, LaneGroups(body, block, part), [&](const LaneGroup& group, auto weight) {
        const bonds::OfCluster family{*group.cluster};
        add(group,
            bonds::ordinary_force(family, body.domain.sites.data(), states.scalars.data(), weight,
                                  extension_of(family)),
            block.feels_correspondence ? Begun::sum : Begun::nothing);
      });
    }
  }

  void quadratic(Part part) const {
    for (const MaterialBlock& block : body.blocks) {
      if (!is_due(block, bodies) || !block.feels_quadratic) continue;
      const Begun begun = block.feels_correspondence || block.feels_ordinary ? Begun::sum : Begun::nothing;
      over_groups(body, LaneGroups(body, block, part), [&](const LaneGroup& group, auto weight) {
        const bonds::OfCluster family{*group.cluster};
        add(group,
            bonds::quadratic_far_force(family, body.domain.sites.data(), body.fits->multipliers(),
                                       states.quadratics.data(), weight),
            begun);
        if (!block.is_quadratic()) return;
        for (int l = 0; l < group.count; ++l) {
          const int i = group.i[l];
          result[i] += bonds::quadratic_own_force(states.quadratics[i], (*body.fits)[i]);
        }
      });
    }
  }

 private:
  enum class Begun { nothing, sum, pull };  // what `result` holds so far

  void add(const LaneGroup& group, const small::Vector3<Lanes>& force, Begun begun) const {
    for (int l = 0; l < group.count; ++l) {
      const int i = group.i[l];
      Vector& sum = result[i];
      if (begun == Begun::nothing) {
        sum = at(force, l);
      } else {
        sum = at(force, l) + (begun == Begun::sum ? 1 : states.tensors[i].column[0][3]) * sum;
      }
    }
  }
};

// Each formulation behind the exchange of its states. `timed`: what lives as long as a sum.
template <class ExtensionOf, class Timed>
void add_up(Halo& halo, const ForceSum<ExtensionOf>& sum, const Timed& timed) {
  const auto behind = [&]<class State>(std::vector<State>& states, void (ForceSum<ExtensionOf>::*over)(Part) const) {
    if (states.empty()) return;
    const auto run = [&](Part part) {
      [[maybe_unused]] const auto time = timed();
      (sum.*over)(part);
    };
    behind_exchange(halo, states, run);
  };
  behind(sum.states.tensors, &ForceSum<ExtensionOf>::correspondence);
  behind(sum.states.scalars, &ForceSum<ExtensionOf>::ordinary);
  behind(sum.states.quadratics, &ForceSum<ExtensionOf>::quadratic);
}

// δP at a law point, for δF: J C:sym(δF F⁻¹) F⁻ᵀ.
Tensor elastic_change(const MaterialPoint& point, const materials::Moduli& moduli, const Tensor& dF) {
  const Tensor inverse_F = point.deformation_gradient.inverse();
  const Symmetric D = symmetric_part(dF * inverse_F);
  const Symmetric stress = 2 * moduli.shear * D + spherical((moduli.bulk - 2 * moduli.shear / 3) * trace(D));
  return point.deformation_gradient.determinant() * to_tensor(stress) * inverse_F.transpose();
}

// The force state of the tangent at one point, for δF. A point that is stepped alone by a
// `share` of the step is as stiff to it as one of share² the stiffness is to the whole. C: of its springs.
ForceState tangent_state(const MaterialPoint& point, const Symmetric& shape_inverse, double C,
                         const materials::Moduli& moduli, const Tensor& dF, double share) {
  const Tensor A = elastic_change(point, moduli, dF) * to_tensor(shape_inverse) - C * dF;
  return bonds::packed(share * share * A, share * share * C);
}

// The same with ∂P/∂F as it is.
ForceState tangent_state(const Symmetric& shape_inverse, double C, const PointTangent& tangent, const Tensor& dF) {
  return bonds::packed(tangent.times(dF) * to_tensor(shape_inverse) - C * dF, C);
}

// The moduli of a law point as it is now.
materials::Moduli moduli_at(const MaterialBlock& block, std::size_t place) {
  return std::visit([&]<class L>(const L& law) { return materials::moduli_of(law, block.state_of<L>(place)); },
                    block.material.law);
}

// δP at the places of the cell of block.points[k], for δF there.
CellTensors change_of_cell(const Body& body, const MaterialBlock& block, int k, CellTensors dF,
                           const std::vector<PointTangent>* tangents) {
  std::optional<SharedVolume> shared;
  if (block.flowed[k]) shared.emplace(block, k);
  if (shared) shared->share_gradients(dF);
  CellTensors dP;
  for (int q = 0; q < 4; ++q) {
    const std::size_t place = block.place(k, q);
    dP[q] = tangents ? (*tangents)[body.owned() + block.first_law_point + place].times(dF[q])
                     : elastic_change(block.cells[place], moduli_at(block, place), dF[q]);
  }
  if (shared) shared->share_stresses(dP);
  return dP;
}

// The states of cells under a change of their motion, `field`. `tangents`: of law points, or the elastic ones.
template <class Weight>
void set_tangent_cells(const Body& body, const MaterialBlock& block, const LaneGroup& group, const Site* field,
                       Weight weight, const std::vector<PointTangent>* tangents, std::vector<QuadraticState>& result) {
  QuadraticCells cells(group, *body.fits, body.domain.sites);
  cells.take(bonds::quadratic_gather(bonds::OfCluster{*group.cluster}, field, body.fits->multipliers(), weight));
  std::array<small::Tensor3<Lanes>, 4> dF, dP;
  for (int q = 0; q < 4; ++q) dF[q] = cells.gradient_at(q), dP[q] = bonds::zero_tensor<Lanes>();
  for (int l = 0; l < group.count; ++l) {
    CellTensors changes;
    for (int q = 0; q < 4; ++q) changes[q] = at(dF[q], l);
    changes = change_of_cell(body, block, group.k[l], changes, tangents);
    for (int q = 0; q < 4; ++q) {
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) dP[q].c[r][c][l] = changes[q](r, c);
      }
    }
  }
  for (int q = 0; q < 4; ++q) cells.add_stress(q, dP[q]);
  const Lanes share = small::lanes_of([&](int l) { return body.share(group.i[l]) * body.share(group.i[l]); });
  cells.store(group, share, result);
}

// δt of ordinary points: t is linear in the extensions, so it is the law itself of their changes.
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

void set_tangent_state(const Body& body, const MaterialBlock& block, int k, const Tensor& moment,
                       const std::vector<PointTangent>* tangents, ForceStates& result) {
  const int i = block.points[k];
  const MaterialPoint& point = body.points[i];
  const Symmetric& shape_inverse = body.shape_inverse[i];
  const Tensor dF = moment * to_tensor(shape_inverse);
  const double share = body.share(i), C = block.springs_of(point);
  result.tensors[i] = tangents ? tangent_state(shape_inverse, C, (*tangents)[i], dF)
                               : tangent_state(point, shape_inverse, C, block.moduli(k), dF, share);
  if (block.has_mean_gradient()) result.gradients[i] = bonds::packed(dF, point.stabilization, share * share);
}

void set_tangent_states(const Body& body, const Displacements& field, const std::vector<PointTangent>* tangents,
                        Part part, ForceStates& result, std::vector<Vector>& pulls) {
  const auto set = [&](const MaterialBlock& block, const LaneGroup& group, auto weight) {
    if (block.is_ordinary()) return set_tangent_scalars(body, block, group, field.sites, weight, result.scalars);
    if (block.is_quadratic()) {
      return set_tangent_cells(body, block, group, field.sites, weight, tangents, result.quadratics);
    }
    const auto dN = moments(group, field, weight, &pulls);
    for (int l = 0; l < group.count; ++l) set_tangent_state(body, block, group.k[l], at(dN, l), tangents, result);
  };
  over_blocks(
      body, Bodies::all, part, [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.moments(field, take); },
      [&](const MaterialBlock& block, const LaneGroups& groups) {
        over_groups(body, groups, [&](const LaneGroup& group, auto weight) { set(block, group, weight); });
      });
}

}  // namespace

namespace {

StepReport advance(Body& body, const StressPass& pass, bool with_diagnostics) {
  static Teuchos::Time& deforming = phase("Deformation and stress");
  StepReport report;
  const Displacements u{body.domain.sites.data()};
  const auto advance = [&](MaterialBlock& block, const LaneGroups& groups) {
    if (block.is_ordinary()) return advance_ordinary(body, block, with_diagnostics, groups, report);
    if (block.is_quadratic()) return advance_quadratic(body, block, pass, groups, report);
    advance_stress(body, block, pass, groups, report);
  };
  const auto view = [&](const MaterialBlock& block, const LaneGroups& groups) {
    if (block.is_quadratic()) diagnose_cells(body, block, groups);
    if (!block.is_ordinary()) diagnose_residuals(body, groups);
  };
  const auto over = [&](Part part) {
    const Timed timed(deforming);
    over_blocks(
        body, Bodies::deforming, part, [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.moments(u, take); },
        advance);
    if (!with_diagnostics) return;
    over_blocks(
        body, Bodies::deforming, part, [&](LatticeSums& sums, const LatticeSums::Take& take) { sums.squares(u, take); },
        view);
  };
  for (const MaterialBlock& block : body.blocks) {
    if (block.in_rigid_motion) report.frequency_bound = std::max(report.frequency_bound, block.rest_frequency_bound);
  }
  if (all_move_rigidly(body)) {
    over(Part::interior);
    return report;
  }
  behind_exchange(
      body.domain.halo, places(body.domain.sites), site_stride, 3, [&] { over(Part::interior); },
      [&] { over(Part::boundary); });
  return report;
}

}  // namespace

StepReport advance_stress(Body& body, double dt, bool with_diagnostics) {
  return advance(body, {dt}, with_diagnostics);
}

void sum_forces(Body& body, bool with_diagnostics) {
  static Teuchos::Time& stabilizing = phase("Stabilization");
  static Teuchos::Time& summing = phase("Force");
  for (const MaterialBlock& block : body.blocks) {
    if (!block.in_rigid_motion) continue;
    for (const int i : block.points) body.force_density[i].setZero();
  }
  if (all_move_rigidly(body)) return;
  const Displacements u{body.domain.sites.data()};
  if (!body.force_states.gradients.empty()) {
    const std::span<double> energy = with_diagnostics ? std::span(body.mean_work) : std::span<double>();
    behind_exchange(body.domain.halo, body.force_states.gradients, [&](Part part) {
      const Timed timed(stabilizing);
      add_residual(body, Bodies::deforming, u, part, body.force_states, body.force_density, energy);
    });
  }
  const auto extension_of = [](const auto& family) { return bonds::OfPlaces(family); };
  add_up(body.domain.halo, ForceSum{body, Bodies::deforming, u, extension_of, body.force_states, body.force_density},
         [] { return Timed(summing); });
}

StepReport advance_stress_and_force(Body& body, double dt, bool with_diagnostics) {
  const StepReport report = advance_stress(body, dt, with_diagnostics);
  sum_forces(body, with_diagnostics);
  return report;
}

StepReport advance_by_any_step(Body& body, double dt, bool with_diagnostics) {
  const StepReport report = advance(body, {.dt = dt, .of_any_size = true}, with_diagnostics);
  sum_forces(body, with_diagnostics);
  return report;
}

double largest_frequency_bound(const Body& body, const MaterialBlock& block) {
  const auto of_point = [&](int k) { return frequency_bound(body, block, k) * body.share(block.points[k]); };
  return largest(0, static_cast<int>(block.points.size()), 0, of_point);
}

namespace {

double frequency_bound_of_cell(const Body& body, const MaterialBlock& block, int k) {
  const int i = block.points[k];
  double fastest2 = 0;
  for (int q = 0; q < block.places_a_point(); ++q) {
    const std::size_t place = block.place(k, q);
    const Tensor& F = block.cells[place].deformation_gradient;
    const double speed2 = moduli_at(block, place).longitudinal() / (3 * body.density[i]);
    fastest2 = std::max(fastest2, speed2 * F.determinant() * F.inverse().squaredNorm());
  }
  return std::sqrt(fastest2 * body.domain.volume(i) * (*body.fits)[i].steepness);
}

}  // namespace

double frequency_bound(const Body& body, const MaterialBlock& block, int k) {
  const int i = block.points[k];
  if (block.is_quadratic()) return frequency_bound_of_cell(body, block, k);
  const MaterialPoint& point = body.points[i];
  const Tensor& F = point.deformation_gradient;
  const double steepness = block.is_ordinary() ? 3 : F.determinant() * F.inverse().squaredNorm();
  const double modulus = block.moduli(k).longitudinal();
  return std::sqrt(modulus / body.density[i] * body.domain.volume(i) * trace(body.shape_inverse[i]) / 3 * steepness);
}

void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result) {
  const Displacements field{directions.data(), true};
  const auto set_states = [&](Part part) { set_tangent_states(body, field, tangents, part, scratch, result); };
  behind_exchange(
      halo, places(directions), site_stride, 3, [&] { set_states(Part::interior); },
      [&] { set_states(Part::boundary); });
  if (!scratch.gradients.empty()) {
    behind_exchange(halo, scratch.gradients,
                    [&](Part part) { add_residual(body, Bodies::all, field, part, scratch, result, {}); });
  }
  const auto change_of = [&](const auto& family) { return bonds::OfField(family, directions.data()); };
  add_up(halo, ForceSum{body, Bodies::all, field, change_of, scratch, result},
         [] { return 0; });  // the estimate of the step has a time of its own
  for_each_point(0, body.owned(), [&](int i) { result[i] *= -1; });
}

namespace {

template <class L>
void add_energies(const Body& body, const MaterialBlock& block, const L& law, Energies& sum) {
  const int places = block.places_a_point();
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const double volume = body.domain.volume(block.points[k]) / places;
    for (int q = 0; q < places; ++q) {
      const MaterialPoint& point = body.law_point(block, k, q);
      const auto state = block.state_of<L>(block.place(k, q));
      sum.elastic += point.deformation_gradient.determinant() * law.elastic_energy(point.stress, state) * volume;
      sum.dissipated += law.dissipation(state) * volume;
      if (!block.viscous.empty()) sum.dissipated += block.viscous[block.place(k, q)].work * volume;
    }
  }
}

void add_ordinary_energies(const Body& body, const MaterialBlock& block, Energies& sum) {
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    sum.elastic += block.ordinary[k].energy * body.domain.volume(block.points[k]);
  }
}

}  // namespace

Energies stored_energies(const Body& body) {
  Energies sum;
  for (const MaterialBlock& block : body.blocks) {
    if (block.is_ordinary()) {
      add_ordinary_energies(body, block, sum);
    } else {
      std::visit([&](const auto& law) { add_energies(body, block, law, sum); }, block.material.law);
    }
  }
  sum.stabilization = total(0, body.owned(), [&](int i) { return body.stabilization_work(i) * body.domain.volume(i); });
  double values[] = {sum.elastic, sum.dissipated, sum.stabilization};
  body.domain.communicator.sum(values);
  return {values[0], values[1], values[2]};
}

std::string locate(const Body& body, int i) {
  const PointCloud& cloud = body.domain.cloud;
  const auto place = [](const Vector& x) {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    return text.str();
  };
  std::ostringstream text;
  text << word(cloud.at) << " " << cloud.element_ids[i] << " of block " << cloud.block_names[cloud.blocks[i]]
       << ", reference position " << place(body.domain.reference(i)) << " m, now at " << place(body.current(i)) << " m";
  return text.str();
}

std::string describe(const Failure& failure, const Body& body) {
  std::ostringstream text;
  text << locate(body, failure.point) << ": ";
  switch (failure.kind) {
    case Failure::Kind::inverted:
      text << "the deformation gradient has no positive determinant (the point is turned inside out). Likely causes: a "
              "step above the stable one, too little stabilization, a load too sudden";
      break;
    case Failure::Kind::no_stress:
      text << "the material law found no stress. Likely causes: a strain increment that is not finite or far too large "
              "for one step, material constants of the wrong unit";
      break;
    case Failure::Kind::not_finite:
      text << "its strain is not a number (places are not, or two points met). Likely causes: a step above the stable "
              "one, a load too sudden, an expression without a value";
  }
  return text.str();
}

}  // namespace strut
