// The tangent of thin bodies, factorized: the factors undo the product that is applied without a matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "integrators/quasi_static/block_factors.hpp"
#include "integrators/quasi_static/tangent_factor.hpp"
#include "verification/loading.hpp"

namespace strut {
namespace {

// An unsymmetric matrix of blocks, with a symmetric pattern at random and a diagonal that outweighs the rest.
TEST(BlockFactors, SolveUnsymmetricSystems) {
  constexpr int size = 40;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> number(-1, 1);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(3 * size, 3 * size);
  std::vector<Eigen::Triplet<double>> lower;
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (i - j > 1 && number(engine) < 0.8) continue;
      lower.emplace_back(i, j, 1);
      for (int n = 0; n < 9; ++n) {
        whole(3 * i + n / 3, 3 * j + n % 3) = number(engine);
        whole(3 * j + n % 3, 3 * i + n / 3) = number(engine);
      }
    }
    whole.block<3, 3>(3 * i, 3 * i) += 20 * Eigen::Matrix3d::Identity();
  }
  Eigen::SparseMatrix<double> pattern(size, size);
  pattern.setFromTriplets(lower.begin(), lower.end());
  BlockFactors factors(pattern);
  factors.clear();
  for (const auto& entry : lower) {
    const int i = entry.row(), j = entry.col();
    factors.add(i, j, whole.block<3, 3>(3 * i, 3 * j));
    if (i != j) factors.add(j, i, whole.block<3, 3>(3 * j, 3 * i));
  }
  ASSERT_TRUE(factors.factorize());
  Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(3 * size, [&](Eigen::Index) { return number(engine); });
  const Eigen::VectorXd right = whole * x;
  Field found(size);
  for (int i = 0; i < size; ++i) found[i] = right.segment<3>(3 * i);
  factors.solve(found);
  // Round-off of some 40 operations a number, at a condition below 2.
  for (int i = 0; i < size; ++i) EXPECT_LT((found[i] - x.segment<3>(3 * i)).norm(), 1e-13);
}

struct Case {
  const char* name;
  Formulation formulation;
  Stabilization stabilization;
  bool is_exact;  // where its stiffness is the sum over points
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Factor : public ::testing::TestWithParam<Case> {};

// A strut of 3 × 3 × 12 cells, held at one end, bent until it flows.
Vector bent(const Vector& X) { return {X[0] + 5 * X[2] * X[2], X[1] * (1 + 2 * X[2]), 0.98 * X[2] + 3 * X[0] * X[1]}; }

Field wavy(const Body& body) {
  Field field(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    const Vector X = body.domain.reference(i) / spacing;
    field[i] = Vector(std::sin(2 * X[1]), std::cos(X[0] + 3 * X[2]), std::sin(X[0] * X[1]));
  }
  return field;
}

TEST_P(Factor, UndoesTheTangent) {
  Communicator world;
  LatticeSpec spec = lattice_of({3, 3, 12}, elastic_plastic());
  spec.material.formulation = GetParam().formulation;
  spec.material.stabilization = GetParam().stabilization;
  Loaded loaded(spec);
  for (int c = 0; c < 3; ++c) loaded.move(layer(loaded.body, spec, 2, false), c, "0");
  Body& body = loaded.body;
  Equilibrium equilibrium(body, loaded.conditions, {});
  equilibrium.begin(0, 1);
  deform(body, bent);
  ASSERT_FALSE(equilibrium.evaluate().failed);
  equilibrium.linearize();
  const Constraints& held = equilibrium.constraints();

  Krylov krylov(world.teuchos(), body.owned());
  const std::vector<Tensor> none(body.owned(), Tensor::Zero());
  const BlockRows near = preconditioner_matrix(body, equilibrium.tangents(), held, none, krylov.first());
  TangentFactor factor(body);
  ASSERT_TRUE(factor.is_worthwhile());
  ASSERT_TRUE(factor.factorize(body, equilibrium.tangents(), held, none, near));

  const auto product = [&](const Field& in, Field& out) {
    equilibrium.apply(in, out);
    held.remove(out);
  };
  Field x = wavy(body), right(body.owned()), found(body.owned());
  held.remove(x);
  product(x, right);
  krylov.precondition_by([&](const Field& in, Field& out) { factor.solve(in, out), held.remove(out); });
  const Krylov::Outcome outcome = krylov.solve(product, right, Krylov::Measure::residual, 1e-10, 100, found);
  EXPECT_TRUE(outcome.converged);
  // The ground holds each point with 1e-5 of its near springs: each product leaves some 1e-4 of the error. Else the
  // other rank is unknown (one of two ends of the strut, 52 products), or springs on the gradients of both ends differ.
  EXPECT_LE(outcome.iterations, world.size() == 1 && GetParam().is_exact ? 6 : 70);
}

INSTANTIATE_TEST_SUITE_P(
    Formulations, Factor,
    ::testing::Values(Case{"quadratic", Formulation::quadratic, NoStabilization(), true},
                      Case{"silling", Formulation::correspondence, SillingStabilization{0.05}, true},
                      Case{"mean_gradient", Formulation::correspondence, MeanGradientStabilization{0.05}, false}),
    [](const auto& info) { return std::string(info.param.name); });

// A cube fills in too much.
TEST(Factor, IsLeftToThinBodies) {
  EXPECT_FALSE(TangentFactor(Loaded(lattice_of({14, 14, 14}, elastic_plastic())).body).is_worthwhile());
}

}  // namespace
}  // namespace strut
