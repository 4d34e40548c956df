#include "mechanics/fracture/broken_family.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/math/rotation.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

Tensor shape_tensor(const Body& body, int i) {
  Tensor K = Tensor::Zero();
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{body.domain.families, i}, body.domain.sites.data(), weight,
                [&](int, double w, const auto& xi, double) {
                  const Vector bond(xi.c[0], xi.c[1], xi.c[2]);
                  K += w * bond * bond.transpose();
                });
  });
  return K;
}

Symmetric inverse_of(const Tensor& K) {
  constexpr double flattest = 1e-8;  // round-off leaves some 1e-16 of an exact plane
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(K, Eigen::EigenvaluesOnly);
  const bool spans = eigen.eigenvalues()[0] > flattest * eigen.eigenvalues()[2];
  return spans ? symmetric_part(K.inverse()) : Symmetric(Symmetric::Zero());
}

namespace {

// The plastic part of its state stays.
void release(MaterialPoint& point) {
  point.deformation_gradient = Tensor::Identity();
  point.rotation = Rotation();
  point.stress.setZero();
  point.stabilization = 0;
}

void refit_cell(Body& body, MaterialBlock& block, int k, double most) {
  if (body.fits->refit(body, block.points[k], most)) return;
  for (int q = 0; q < block.places_a_point(); ++q) release(block.cells[block.place(k, q)]);
}

void refit_shape(Body& body, MaterialBlock& block, int k, double most) {
  const int i = block.points[k];
  const Symmetric inverse = inverse_of(shape_tensor(body, i));
  const bool holds = trace(inverse) > 0 && body.domain.volume(i) * trace(inverse) <= most;
  body.shape_inverse.set(i, holds ? inverse : Symmetric(Symmetric::Zero()));
  bonds::with_influence(body.influence, [&](auto weight) {
    const bonds::OfPoint family{body.domain.families, i};
    body.first_moment.set(i, bonds::first_moment(family, body.domain.sites.data(), weight));
  });
  if (!holds) release(body.points[i]);
}

// F of the places at the start of a step, by the family that is left.
Tensor gradient_at_start(const Body& body, int i, const StepEnd& start) {
  Tensor N = Tensor::Zero();
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{body.domain.families, i}, body.domain.sites.data(), weight,
                [&](int j, double w, const auto& xi, double) {
                  N += w * (start.place(j) - start.place(i)) * Vector(xi.c[0], xi.c[1], xi.c[2]).transpose();
                });
  });
  return N * to_tensor(body.shape_inverse[i]);
}

// The part of a jump ΔF that stress follows: to the least of W + λ P:ΔF + ½ λ² ΔF:C:ΔF for λ from 0 to 1.
double part_that_releases(const MaterialPoint& point, const materials::Moduli& moduli, const Tensor& jump) {
  const Tensor& F = point.deformation_gradient;
  const Tensor R = point.rotation.tensor();
  const Tensor P = F.determinant() * R * to_tensor(point.stress) * R.transpose() * F.inverse().transpose();
  const Tensor strain = 0.5 * (R.transpose() * jump + jump.transpose() * R);
  const double trace = strain.trace(), falls = -P.cwiseProduct(jump).sum();
  const double curvature =
      (moduli.bulk - 2 * moduli.shear / 3) * trace * trace + 2 * moduli.shear * strain.squaredNorm();
  return falls > 0 ? std::min(1.0, falls / curvature) : 0;
}

// So that the step goes on from the gradient that the bonds left have at its start, less the part of the jump that
// stress is to follow.
void set_start(MaterialPoint& point, const materials::Moduli& moduli, const Tensor& refitted) {
  const Tensor jump = refitted - point.deformation_gradient;
  const Tensor start = refitted - part_that_releases(point, moduli, jump) * jump;
  if (!(start.determinant() > 0)) return;  // the step tells of it
  point.deformation_gradient = start;
  point.rotation = Rotation(polar_rotation(start));
}

}  // namespace

double steepness(const Body& body, int i) {
  const bool is_cell = body.block_of(i).is_quadratic();
  return body.domain.volume(i) * (is_cell ? (*body.fits)[i].steepness : trace(body.shape_inverse[i]));
}

void refit(Body& body, MaterialBlock& block, int k, double most) {
  if (block.is_ordinary()) return;
  block.is_quadratic() ? refit_cell(body, block, k, most) : refit_shape(body, block, k, most);
}

void refit_in_step(Body& body, MaterialBlock& block, int k, double most, const StepEnd& start) {
  const int i = block.points[k];
  refit(body, block, k, most);
  if (block.is_ordinary()) return;
  if (!block.is_quadratic()) {
    if (trace(body.shape_inverse[i]) > 0) set_start(body.points[i], block.moduli(k), gradient_at_start(body, i, start));
    return;
  }
  if (!(*body.fits)[i].carries_stress()) return;
  for (int q = 0; q < block.places_a_point(); ++q) {
    const std::size_t place = block.place(k, q);
    set_start(block.cells[place], block.moduli(place),
              body.fits->gradient_at(body, i, q, [&start](int j) { return start.place(j); }));
  }
}

}  // namespace strut
