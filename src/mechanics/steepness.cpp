#include "mechanics/steepness.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/bonds.hpp"
#include "topology/mirror_planes.hpp"

namespace strut {

Tensor shape_tensor(const Body& body, int i) {
  Tensor K = Tensor::Zero();
  over_family(body, i, [&](int, double w, const Vector& xi) { K += w * xi * xi.transpose(); });
  return K;
}

Symmetric inverse_of(const Tensor& K) {
  constexpr double flattest = 1e-8;  // round-off leaves some 1e-16 for an exact plane
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(K, Eigen::EigenvaluesOnly);
  const bool spans = eigen.eigenvalues()[0] > flattest * eigen.eigenvalues()[2];
  return spans ? symmetric_part(K.inverse()) : Symmetric(Symmetric::Zero());
}

double steepness(const Body& body, int i) {
  const bool is_cell = body.block_of(i).is_quadratic();
  return body.domain.volume(i) * (is_cell ? body.fits->steepness(i) : trace(body.shape_inverse[i]));
}

double flatness(const Domain& domain, int i) {
  const double volume = coincident_images(domain, i) * domain.volume(i);
  return std::pow(volume, 5.0 / 3) * family_spread(domain, i).inverse().trace();
}

}  // namespace strut
