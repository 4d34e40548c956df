#include "mechanics/mechanics.hpp"

#include <algorithm>
#include <span>
#include <sstream>

#include "base/timing.hpp"
#include "mechanics/lattice_sums.hpp"
#include "mechanics/ordinary_bonds.hpp"
#include "mechanics/stress.hpp"
#include "mechanics/tangent.hpp"

namespace strut {

namespace {

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
enum class Bodies { all, disturbed };

bool is_due(const MaterialBlock& block, Bodies bodies) { return bodies == Bodies::all || !block.undisturbed; }

// What the points of lattices gain from the sums over them, in the part that comes after an exchange.
template <class Add>
void over_lattices(const Body& body, Bodies bodies, Part part, const Add& add) {
  if (part == Part::interior) return;
  for (std::size_t l = 0; l < body.lattice_sums.size(); ++l) {
    const auto is_due_on_it = [&](const MaterialBlock& b) {
      return b.lattice == static_cast<int>(l) && is_due(b, bodies);
    };
    if (std::any_of(body.blocks.begin(), body.blocks.end(), is_due_on_it)) add(*body.lattice_sums[l]);
  }
}

bool all_undisturbed(const Body& body) {
  return std::all_of(body.blocks.begin(), body.blocks.end(), [](const MaterialBlock& b) { return b.undisturbed; });
}

// The stabilisation by the mean gradient. Its energy is ½ Σ V_i V_j ω C_ij |z|²; with z = η − ½ (F_i + F_j) ξ its force
// is Σ ω V_j C_ij z, which begins the sum in `result`, and by way of both F it takes ½ M K⁻¹ from A. `places`: y, or
// the field that stands in its place for a tangent. `energy`: of each point, added to; none if empty.
void add_residual(const Body& body, Bodies bodies, const std::vector<Site>& places, const Displacements& u, Part part,
                  ForceStates& states, std::vector<Vector>& result, std::span<double> energy) {
  over_lattices(body, bodies, part, [&](LatticeSums& sums) { sums.add_residuals(body, u, states.gradients); });
  for (const MaterialBlock& block : body.blocks) {
    if (!is_due(block, bodies) || !(block.material.mean_stabilization > 0)) continue;
    const auto [begin, end] = range(block, part);
    bonds::with_influence(body.influence, [&, begin = begin, end = end](auto weight) {
      for_each_point(begin, end, [&, weight](int k) {
        const int i = block.points[k];
        bonds::Residual sums;
        if (block.lattice < 0 || !energy.empty()) {
          sums = bonds::residual(body.domain.families, places.data(), states.gradients.data(), i, weight);
        }
        if (!energy.empty()) energy[i] += sums.energy;
        if (block.lattice >= 0) {
          const LatticeSums& on_lattice = *body.lattice_sums[block.lattice];
          sums.force = on_lattice.residual_force(i), sums.moment = on_lattice.residual_moment(i);
        }
        take_residual(states.tensors[i], sums.moment, body.points[i]);
        result[i] = sums.force;
      });
    });
  }
}

// The force on every point, summed over the formulations that its block feels. `places`: y, or the field that stands in
// its place for a tangent; `extension`: of a bond between ordinary points.
template <class Extension>
struct ForceSum {
  const Body& body;
  Bodies bodies;
  const std::vector<Site>& places;
  Displacements u;
  Extension extension;
  ForceStates& states;
  std::vector<Vector>& result;

  void correspondence(Part part) const {
    over_lattices(body, bodies, part, [this](LatticeSums& sums) { sums.add_forces(body, u, states.tensors); });
    over_points(part, &MaterialBlock::feels_correspondence, [this](const MaterialBlock& block, int i, auto weight) {
      const Vector force = block.lattice < 0
                               ? bonds::force(body.domain.families, places.data(), states.tensors.data(), i, weight)
                               : body.lattice_sums[block.lattice]->force(i, u, states.tensors[i]);
      result[i] = block.material.mean_stabilization > 0 ? result[i] + force : force;
    });
  }

  void ordinary(Part part) const {
    over_points(part, &MaterialBlock::feels_ordinary, [this](const MaterialBlock& block, int i, auto weight) {
      const Vector force =
          bonds::ordinary_force(body.domain.families, body.sites.data(), states.scalars.data(), i, weight, extension);
      result[i] = block.feels_correspondence ? result[i] + force : force;
    });
  }

 private:
  template <class Work>
  void over_points(Part part, bool MaterialBlock::*feels, const Work& work) const {
    for (const MaterialBlock& block : body.blocks) {
      if (!is_due(block, bodies) || !(block.*feels)) continue;
      const auto [begin, end] = range(block, part);
      bonds::with_influence(body.influence, [&, begin = begin, end = end](auto weight) {
        for_each_point(begin, end, [&, weight](int k) { work(block, block.points[k], weight); });
      });
    }
  }
};

// Each formulation behind the exchange of its states. `timed`: what lives as long as a sum.
template <class Extension, class Timed>
void add_up(Halo& halo, const ForceSum<Extension>& sum, const Timed& timed) {
  const auto behind = [&]<class State>(std::vector<State>& states, void (ForceSum<Extension>::*over)(Part) const) {
    if (states.empty()) return;
    const auto run = [&](Part part) {
      [[maybe_unused]] const auto time = timed();
      (sum.*over)(part);
    };
    behind_exchange(halo, states, run);
  };
  behind(sum.states.tensors, &ForceSum<Extension>::correspondence);
  behind(sum.states.scalars, &ForceSum<Extension>::ordinary);
}

// The force state of the tangent at one point, for δF: δP = J C:sym(δF F⁻¹) F⁻ᵀ. A point that is stepped alone by a
// `share` of the step is as stiff to it as one of share² the stiffness is to the whole.
ForceState tangent_state(const MaterialPoint& point, const materials::Moduli& moduli, const Tensor& dF, double share) {
  const Tensor inverse_F = point.deformation_gradient.inverse();
  const double J = point.deformation_gradient.determinant();
  const Symmetric D = symmetric_part(dF * inverse_F);
  const Symmetric stress = 2 * moduli.shear * D + spherical((moduli.bulk - 2 * moduli.shear / 3) * trace(D));
  const Tensor A =
      J * to_tensor(stress) * inverse_F.transpose() * to_tensor(point.shape_inverse) - point.stabilization * dF;
  return bonds::packed(share * share * A, share * share * point.stabilization);
}

// δt of an ordinary point: t is linear in the extensions, so it is the law itself of their changes.
template <class Weight>
ScalarState tangent_state(const Body& body, const std::vector<Site>& directions, const MaterialBlock& block, int k,
                          const materials::Moduli& moduli, Weight weight) {
  const double m = block.ordinary[k].weighted_volume;
  const bonds::OfField change{directions.data()};
  const double moment =
      bonds::extensions<false>(body.domain.families, body.sites.data(), block.points[k], weight, change).moment;
  return scalar_state(moduli, 3 * moment / m, m);
}

// δF of a point along a field.
template <class Weight>
Tensor change_of_gradient(const Body& body, const MaterialBlock& block, const std::vector<Site>& directions, int i,
                          Weight weight) {
  const Tensor N = block.lattice < 0 ? bonds::gather(body.domain.families, directions.data(), i, weight)
                                     : body.lattice_sums[block.lattice]->moment(i, {directions.data(), true});
  return N * to_tensor(body.points[i].shape_inverse);
}

// The same with ∂P/∂F as it is.
ForceState tangent_state(const MaterialPoint& point, const PointTangent& tangent, const Tensor& dF) {
  const Tensor A = tangent.times(dF) * to_tensor(point.shape_inverse) - point.stabilization * dF;
  return bonds::packed(A, point.stabilization);
}

void set_tangent_states(const Body& body, const std::vector<Site>& directions,
                        const std::vector<PointTangent>* tangents, Part part, ForceStates& result) {
  over_lattices(body, Bodies::all, part, [&](LatticeSums& sums) { sums.add_moments(body, {directions.data(), true}); });
  for (const MaterialBlock& block : body.blocks) {
    const auto [begin, end] = range(block, part);
    bonds::with_influence(body.influence, [&, begin = begin, end = end](auto weight) {
      for_each_point(begin, end, [&, weight](int k) {
        const int i = block.points[k];
        const materials::Moduli moduli = block.moduli(k);
        if (block.is_ordinary()) {
          result.scalars[i] = tangent_state(body, directions, block, k, moduli, weight);
          return;
        }
        const MaterialPoint& point = body.points[i];
        const Tensor dF = change_of_gradient(body, block, directions, i, weight);
        const double share = body.share(i);
        result.tensors[i] =
            tangents ? tangent_state(point, (*tangents)[i], dF) : tangent_state(point, moduli, dF, share);
        if (block.material.mean_stabilization > 0) {
          result.gradients[i] = bonds::packed(dF, point.mean_stabilization, share * share);
        }
      });
    });
  }
}

}  // namespace

namespace {

StepReport advance(Body& body, const StressPass& pass, bool with_views) {
  static Teuchos::Time& deforming = phase("Deformation and stress");
  StepReport report;
  const Displacements u{body.sites.data()};
  const auto over = [&](Part part) {
    const Timed timed(deforming);
    over_lattices(body, Bodies::disturbed, part, [&](LatticeSums& sums) { sums.add_moments(body, u); });
    for (MaterialBlock& block : body.blocks) {
      if (block.undisturbed) {
        report.pace = std::max(report.pace, block.resting_pace);
      } else if (block.is_ordinary()) {
        advance_ordinary(body, block, with_views, part, report);
      } else {
        advance_stress(body, block, pass, part, report);
      }
    }
    if (!with_views) return;
    over_lattices(body, Bodies::disturbed, part, [&](LatticeSums& sums) { sums.add_squares(body, u); });
    for (const MaterialBlock& block : body.blocks) {
      if (!block.undisturbed && !block.is_ordinary()) view_residuals(body, block, part);
    }
  };
  if (all_undisturbed(body)) {
    over(Part::interior);
    return report;
  }
  behind_exchange(
      body.domain.halo, places(body.sites), site_stride, 3, [&] { over(Part::interior); },
      [&] { over(Part::boundary); });
  return report;
}

}  // namespace

StepReport advance_stress(Body& body, double dt, bool with_views) { return advance(body, {dt}, with_views); }

void sum_forces(Body& body, bool with_views) {
  static Teuchos::Time& stabilizing = phase("Stabilisation");
  static Teuchos::Time& summing = phase("Force");
  for (const MaterialBlock& block : body.blocks) {
    if (!block.undisturbed) continue;
    for (const int i : block.points) body.force_density[i].setZero();
  }
  if (all_undisturbed(body)) return;
  const Displacements u{body.sites.data()};
  if (!body.force_states.gradients.empty()) {
    const std::span<double> energy = with_views ? std::span(body.stabilization_work) : std::span<double>();
    behind_exchange(body.domain.halo, body.force_states.gradients, [&](Part part) {
      const Timed timed(stabilizing);
      add_residual(body, Bodies::disturbed, body.sites, u, part, body.force_states, body.force_density, energy);
    });
  }
  add_up(body.domain.halo,
         ForceSum<bonds::OfPlaces>{body, Bodies::disturbed, body.sites, u, {}, body.force_states, body.force_density},
         [] { return Timed(summing); });
}

StepReport advance_stress_and_force(Body& body, double dt, bool with_views) {
  const StepReport report = advance_stress(body, dt, with_views);
  sum_forces(body, with_views);
  return report;
}

StepReport advance_by_any_step(Body& body, double dt, bool with_views) {
  const StepReport report = advance(body, {.dt = dt, .of_any_size = true}, with_views);
  sum_forces(body, with_views);
  return report;
}

double largest_pace(const Body& body, const MaterialBlock& block) {
  const auto of_point = [&](int k) { return pace(body, block, k) * body.share(block.points[k]); };
  return largest(0, static_cast<int>(block.points.size()), 0, of_point);
}

double pace(const Body& body, const MaterialBlock& block, int k) {
  const int i = block.points[k];
  const MaterialPoint& point = body.points[i];
  const Tensor& F = point.deformation_gradient;
  const double steepness = block.is_ordinary() ? 3 : F.determinant() * F.inverse().squaredNorm();
  const double modulus = block.moduli(k).longitudinal();
  return std::sqrt(modulus / body.density[i] * body.domain.volumes[i] * trace(point.shape_inverse) / 3 * steepness);
}

void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result) {
  const auto set_states = [&](Part part) { set_tangent_states(body, directions, tangents, part, scratch); };
  behind_exchange(
      halo, places(directions), site_stride, 3, [&] { set_states(Part::interior); },
      [&] { set_states(Part::boundary); });
  if (!scratch.gradients.empty()) {
    behind_exchange(halo, scratch.gradients, [&](Part part) {
      add_residual(body, Bodies::all, directions, {directions.data(), true}, part, scratch, result, {});
    });
  }
  add_up(halo,
         ForceSum<bonds::OfField>{
             body, Bodies::all, directions, {directions.data(), true}, {directions.data()}, scratch, result},
         [] { return 0; });  // the estimate of the step has a time of its own
  for_each_point(0, body.owned(), [&](int i) { result[i] *= -1; });
}

namespace {

template <class L>
void add_energies(const Body& body, const MaterialBlock& block, const L& law, Energies& sum) {
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const int i = block.points[k];
    const double volume = body.domain.volumes[i];
    const double J = body.points[i].deformation_gradient.determinant();
    const auto state = block.state_of<L>(k);
    sum.elastic += J * law.elastic_energy(body.points[i].stress, state) * volume;
    sum.dissipated += law.dissipation(state) * volume;
    if (!block.viscous.empty()) sum.dissipated += block.viscous[k].work * volume;
  }
}

void add_ordinary_energies(const Body& body, const MaterialBlock& block, Energies& sum) {
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    sum.elastic += block.ordinary[k].energy * body.domain.volumes[block.points[k]];
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
  sum.stabilization =
      total(0, body.owned(), [&](int i) { return body.stabilization_work[i] * body.domain.volumes[i]; });
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
       << ", reference position " << place(cloud.positions[i]) << " m, now at " << place(body.current(i)) << " m";
  return text.str();
}

std::string describe(const Failure& failure, const Body& body) {
  std::ostringstream text;
  text << locate(body, failure.point) << ": ";
  switch (failure.kind) {
    case Failure::Kind::inverted:
      text << "the deformation gradient has no positive determinant (the point is turned inside out). Likely causes: a "
              "step above the stable one, too little stabilisation, a load too sudden";
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
