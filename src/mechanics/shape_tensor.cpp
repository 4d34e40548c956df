#include "mechanics/shape_tensor.hpp"

#include <Eigen/Eigenvalues>

#include "mechanics/kernels/bonds.hpp"

namespace strut {

Tensor shape_tensor(const Body& body, int i) {
  Tensor K = Tensor::Zero();
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), weight,
                [&](int, double w, const auto& xi, double) {
                  const Vector bond(xi.c[0], xi.c[1], xi.c[2]);
                  K += w * bond * bond.transpose();
                });
  });
  return K;
}

Symmetric inverse_of(const Tensor& K) {
  constexpr double flattest = 1e-8;  // round-off leaves some 1e-16 for an exact plane
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(K, Eigen::EigenvaluesOnly);
  const bool spans = eigen.eigenvalues()[0] > flattest * eigen.eigenvalues()[2];
  return spans ? symmetric_part(K.inverse()) : Symmetric(Symmetric::Zero());
}

}  // namespace strut
