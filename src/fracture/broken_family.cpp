#include "fracture/broken_family.hpp"

#include <algorithm>

#include "base/math/rotation.hpp"
#include "fracture/separation.hpp"
#include "materials/tangent.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/bonds.hpp"
#include "mechanics/steepness.hpp"

namespace strut {

namespace {

// Resets the point; its plastic state variables stay.
void release(MaterialPoint& point) {
  point.deformation_gradient = Tensor::Identity();
  point.rotation = Rotation();
  point.stress.setZero();
  point.stabilization = 0;
}

bool refit_shape(Body& body, MaterialBlock& block, int k, double most) {
  const int i = block.points[k];
  const Symmetric inverse = inverse_of(shape_tensor(body, i));
  const bool holds = trace(inverse) > 0 && body.domain.volume(i) * trace(inverse) <= most;
  body.shape_inverse->set(i, holds ? inverse : Symmetric(Symmetric::Zero()));
  bonds::with_influence(body.influence, [&](auto weight) {
    const bonds::OfPoint family{{i}, body.domain.families};
    body.first_moment->set(i, bonds::first_moment(family, body.domain.sites.data(), weight));
  });
  return holds;
}

// F from the positions at the start of a step, over the family that is left.
Tensor gradient_at_start(const Body& body, int i, const StepEnd& start) {
  Tensor N = Tensor::Zero();
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    N += w * (start.position(j) - start.position(i)) * xi.transpose();
  });
  return N * to_tensor(body.shape_inverse[i]);
}

// Returns the λ between 0 and 1 of least energy. `falls`: initial slope of the decrease; jump: Δε, curvature Δε:C:Δε.
double part_to_least(const materials::Moduli& moduli, double falls, const Tensor& jump) {
  const double trace = jump.trace();
  const double curvature = (moduli.bulk - 2 * moduli.shear / 3) * trace * trace + 2 * moduli.shear * jump.squaredNorm();
  return falls > 0 ? std::min(1.0, falls / curvature) : 0;
}

Tensor symmetric(const Tensor& t) { return 0.5 * (t + t.transpose()); }

// Advances the stress of an integration point from one stretch to another, and keeps it while the stretch jumps to a
// third. No viscosity acts, because no point moves.
void follow(MaterialBlock& block, std::size_t index, MaterialPoint& point, const Tensor& from, const Tensor& to,
            const Tensor& jumped, double dt) {
  const auto step = [&]<class L>(const L& law) {
    typename L::State state = block.state_of<L>(index);
    if (from != to) {
      const auto along = materials::step_between(symmetric_part(from), symmetric_part(to), dt);
      const auto [stress, converged] = law.step(along, point.stress, state);
      if constexpr (requires { state.time; }) state.time = block.state_of<L>(index).time;  // that step follows
      if (converged) point.stress = stress;
    }
    if constexpr (requires { law.move_stress(to, jumped, state); }) law.move_stress(to, jumped, state);
    const auto columns = materials::to_columns<L>(state);
    for (std::size_t c = 0; c < columns.size(); ++c) block.state->at(index, c) = columns[c];
  };
  std::visit(step, block.material.law);
}

// Makes the step start from the stretch and rotation that the intact bonds have at its start; the stress follows
// its part of the jump. Returns false if the volume changes too much: then the intact bonds do not determine a
// gradient.
bool set_start(MaterialBlock& block, std::size_t index, MaterialPoint& point, const Tensor& refitted, double dt) {
  constexpr double most = 2;  // factor by which the volume may grow or shrink
  const double before = point.deformation_gradient.determinant(), after = refitted.determinant();
  if (!(after > before / most && after < before * most)) return false;
  const Tensor R = polar_rotation(refitted), stretch = symmetric(R.transpose() * refitted),
               old = symmetric(point.rotation.tensor().transpose() * point.deformation_gradient), jump = stretch - old;
  const Tensor strain = symmetric(2 * jump * (old + stretch).inverse());  // as in stress_update.hpp
  const double falls = -before * to_tensor(point.stress).cwiseProduct(strain).sum();
  follow(block, index, point, old, old + part_to_least(block.moduli(index), falls, strain) * jump, stretch, dt);
  point.deformation_gradient = refitted;
  point.rotation = Rotation(R);
  return true;
}

bool set_start_of_cell(Body& body, MaterialBlock& block, int k, const StepEnd& start) {
  bool holds = true;
  for (int q = 0; q < block.points_per_cell(); ++q) {
    const std::size_t index = block.index(k, q);
    const auto position_of = [&start](int j) { return start.position(j); };
    const Tensor F = body.fits->gradient_at(body, block.points[k], q, position_of);
    MaterialPoint point = block.cells[index];
    holds = holds && set_start(block, index, point, F, start.dt);
    block.cells->set(index, point);
  }
  return holds;
}

}  // namespace

double part_that_releases(const materials::Moduli& moduli, const Tensor& strain, const Tensor& jump) {
  const double lame = moduli.bulk - 2 * moduli.shear / 3;
  const double grows = lame * strain.trace() * jump.trace() + 2 * moduli.shear * strain.cwiseProduct(jump).sum();
  return part_to_least(moduli, -grows, jump);
}

bool refit(Body& body, MaterialBlock& block, int k, double most) {
  if (block.is_ordinary()) return true;
  if (!block.is_quadratic()) return refit_shape(body, block, k, most);
  return body.fits->refit(body, block.points[k], block.flowed[k] == 1, most);
}

bool refit_in_step(Body& body, MaterialBlock& block, int k, double most, const StepEnd& start) {
  if (!refit(body, block, k, most)) return false;
  if (block.is_ordinary()) return true;
  if (block.is_quadratic()) return set_start_of_cell(body, block, k, start);
  const int i = block.points[k];
  return set_start(block, k, body.points[i], gradient_at_start(body, i, start), start.dt);
}

void release(Body& body, MaterialBlock& block, int k) {
  const int i = block.points[k];
  if (block.is_quadratic()) {
    body.fits->drop(i);
    for (int q = 0; q < block.points_per_cell(); ++q) block.cells->set(block.index(k, q), MaterialPoint());
  } else {
    body.shape_inverse->set(i, Symmetric::Zero());
    release(body.points[i]);
  }
}

}  // namespace strut
