#include "mechanics/mechanics.hpp"

#include <sstream>

#include "base/timing.hpp"
#include "mechanics/bonds.hpp"
#include "mechanics/stress.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

constexpr int site_stride = sizeof(Site) / sizeof(double);
constexpr int force_width = sizeof(ForceState) / sizeof(double);

double* places(std::vector<Site>& sites) { return sites.data()->current.data(); }
double* states(std::vector<ForceState>& forces) { return forces.data()->column[0].data(); }

void add_force(const Body& body, const std::vector<Site>& sites, const std::vector<ForceState>& force_states, int begin,
               int end, std::vector<Vector>& result) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(begin, end, [&, weight](int i) {
      result[i] = bonds::force(body.domain.families, sites.data(), force_states.data(), i, weight);
    });
  });
}

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

void exchange_forces(const Body& body, Halo& halo, const std::vector<Site>& sites, std::vector<ForceState>& forces,
                     std::vector<Vector>& result) {
  static Teuchos::Time& timer = phase("Force");
  const auto over = [&](int begin, int end) {
    const Timed timed(timer);
    add_force(body, sites, forces, begin, end, result);
  };
  behind_exchange(
      halo, states(forces), force_width, force_width, [&] { over(0, body.domain.interior); },
      [&] { over(body.domain.interior, body.owned()); });
}

// The force state of the tangent at one point, for δF: δP = J C:sym(δF F⁻¹) F⁻ᵀ.
ForceState tangent_state(const MaterialPoint& point, const materials::Moduli& moduli, const Tensor& dF) {
  const Tensor inverse_F = point.deformation_gradient.inverse();
  const double J = point.deformation_gradient.determinant();
  const Symmetric D = symmetric_part(dF * inverse_F);
  const Symmetric stress = 2 * moduli.shear * D + spherical((moduli.bulk - 2 * moduli.shear / 3) * trace(D));
  const Tensor A =
      J * to_tensor(stress) * inverse_F.transpose() * to_tensor(point.shape_inverse) - point.stabilization * dF;
  return packed(A, point.stabilization);
}

void set_tangent_states(const Body& body, const std::vector<Site>& directions, Part part,
                        std::vector<ForceState>& result) {
  for (const MaterialBlock& block : body.blocks) {
    const auto moduli = std::visit([](const auto& law) { return law.moduli(); }, block.material.law);
    const auto [begin, end] = range(block, part);
    bonds::with_influence(body.influence, [&, begin = begin, end = end](auto weight) {
      for_each_point(begin, end, [&, weight](int k) {
        const int i = block.points[k];
        const MaterialPoint& point = body.points[i];
        const Tensor N = bonds::gather<false>(body.domain.families, directions.data(), i, weight).moment;
        result[i] = tangent_state(point, moduli, N * to_tensor(point.shape_inverse));
      });
    });
  }
}

}  // namespace

StepReport advance_stress_and_force(Body& body, double dt, bool with_energy) {
  static Teuchos::Time& timer = phase("Deformation and stress");
  StepReport report;
  const auto over = [&](Part part) {
    const Timed timed(timer);
    advance_stress(body, dt, with_energy, part, report);
  };
  behind_exchange(
      body.domain.halo, places(body.sites), site_stride, 3, [&] { over(Part::interior); },
      [&] { over(Part::boundary); });
  exchange_forces(body, body.domain.halo, body.sites, body.force_states, body.force_density);
  return report;
}

void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions, std::vector<ForceState>& scratch,
                   std::vector<Vector>& result) {
  behind_exchange(
      halo, places(directions), site_stride, 3, [&] { set_tangent_states(body, directions, Part::interior, scratch); },
      [&] { set_tangent_states(body, directions, Part::boundary, scratch); });
  behind_exchange(
      halo, states(scratch), force_width, force_width,
      [&] { add_force(body, directions, scratch, 0, body.domain.interior, result); },
      [&] { add_force(body, directions, scratch, body.domain.interior, body.owned(), result); });
  for_each_point(0, body.owned(), [&](int i) { result[i] /= -body.density[i]; });
}

Energies stored_energies(const Body& body) {
  Energies sum;
  for (const MaterialBlock& block : body.blocks) {
    const auto add = [&]<class L>(const L& law) {
      for (std::size_t k = 0; k < block.points.size(); ++k) {
        const int i = block.points[k];
        const double volume = body.domain.volumes[i];
        std::array<double, materials::state_size<L>> columns{};
        for (std::size_t c = 0; c < columns.size(); ++c) columns[c] = block.state[c * block.points.size() + k];
        const double J = body.points[i].deformation_gradient.determinant();
        sum.elastic += J * law.elastic_energy(body.points[i].stress) * volume;
        sum.dissipated += law.dissipation(materials::from_columns<L>(columns)) * volume;
      }
    };
    std::visit(add, block.material.law);
  }
  sum.stabilization =
      total(0, body.owned(), [&](int i) { return body.stabilization_work[i] * body.domain.volumes[i]; });
  double values[] = {sum.elastic, sum.dissipated, sum.stabilization};
  body.domain.communicator.sum(values);
  return {values[0], values[1], values[2]};
}

std::string describe(const Failure& failure, const Body& body) {
  const int i = failure.point;
  const PointCloud& cloud = body.domain.cloud;
  const auto place = [](const Vector& x) {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    return text.str();
  };
  std::ostringstream text;
  text << "element " << cloud.element_ids[i] << " of block " << cloud.block_names[cloud.blocks[i]]
       << ", reference position " << place(cloud.positions[i]) << " m, now at " << place(body.current(i)) << " m: ";
  if (failure.kind == Failure::Kind::inverted) {
    text << "the deformation gradient has no positive determinant (the point is turned inside out, or its place is not "
            "a number). Likely causes: a step above the stable one, too little stabilisation, a load too sudden";
  } else {
    text << "the material law found no stress. Likely causes: a strain increment that is not finite or far too large "
            "for one step, material constants of the wrong unit";
  }
  return text.str();
}

}  // namespace strut
