// Correspondence as a textbook has it: the oracle of the bench, for speed and for results. Families are vectors of
// vectors, each field is a vector, K is summed anew in each evaluation (Silling et al. 2007), R comes from a singular
// value decomposition, and every bond sees both force states. Elastic and J2 laws of materials/.
#pragma once

#include <functional>
#include <vector>

#include "mechanics/body.hpp"

namespace strut {

class Textbook {
 public:
  explicit Textbook(const Body& body) : body_(body) {
    const int n = body.owned();
    families_.resize(n);
    for (int i = 0; i < n; ++i) body.domain.families.for_each(i, [&](int j) { families_[i].push_back(j); });
    F_.assign(n, Tensor::Identity());
    R_ = F_;
    stress_.assign(n, Symmetric::Zero());
    A_.assign(n, Tensor::Zero());
  }

  // Force densities at the body's current places; of one block, one rank.
  template <class L>
  std::vector<Vector> forces(const L& law, std::vector<typename L::State>& states, double dt) {
    for (int i = 0; i < body_.owned(); ++i) advance(i, law, states[i], dt);
    std::vector<Vector> result(body_.owned(), Vector::Zero());
    for (int i = 0; i < body_.owned(); ++i) {
      for (const int j : families_[i]) {
        result[i] += (force_state(i, j) - force_state(j, i)) * body_.domain.volume(j);
      }
    }
    return result;
  }

 private:
  Vector xi(int i, int j) const { return body_.domain.reference(j) - body_.domain.reference(i); }
  Vector eta(int i, int j) const { return body_.current(j) - body_.current(i); }

  template <class L>
  void advance(int i, const L& law, typename L::State& state, double dt) {
    Tensor K = Tensor::Zero(), N = Tensor::Zero();
    for (const int j : families_[i]) {
      const double w = influence_(xi(i, j).norm()) * body_.domain.volume(j);
      K += w * xi(i, j) * xi(i, j).transpose();
      N += w * eta(i, j) * xi(i, j).transpose();
    }
    const Tensor inverse_K = K.inverse(), F = N * inverse_K;
    const Eigen::JacobiSVD<Tensor> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Tensor R = svd.matrixU() * svd.matrixV().transpose(), U = R.transpose() * F, old = R_[i].transpose() * F_[i];
    const Symmetric rate = symmetric_part((U - old) / dt * (0.5 * (U + old)).inverse());
    stress_[i] = law.step({rate, dt, F.determinant(), symmetric_part(U)}, stress_[i], state).stress;
    const Tensor cauchy = R * to_tensor(stress_[i]) * R.transpose();
    A_[i] = F.determinant() * cauchy * F.inverse().transpose() * inverse_K;
    F_[i] = F;
    R_[i] = R;
  }

  // T⟨ξ⟩ of the bond from i to j, with Silling's stabilization.
  Vector force_state(int i, int j) const {
    const double w = influence_(xi(i, j).norm());
    return w * (A_[i] * xi(i, j) + body_.points[i].stabilization * (eta(i, j) - F_[i] * xi(i, j)));
  }

  const Body& body_;
  std::function<double(double)> influence_ = [](double) { return 1.0; };
  std::vector<std::vector<int>> families_;
  std::vector<Tensor> F_, R_, A_;
  std::vector<Symmetric> stress_;
};

}  // namespace strut
