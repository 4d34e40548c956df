// Linear systems of springs whose solution is known: also where a rank owns one point only, whose aggregate has fewer
// unknowns than rigid motions and makes the coarsest grid singular.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel/communicator.hpp"
#include "integrators/quasi_static/krylov.hpp"

namespace strut {
namespace {

constexpr int side = 8, points = side * side * side;

Eigen::Vector3d place(int i) { return {double(i % side), double(i / side % side), double(i / (side * side))}; }
bool is_held(int i) { return i < side * side; }

// The last rank owns the last `last` points, the first one the others.
struct Springs {
  explicit Springs(int last) {
    const int owned_by_first = world.size() == 1 ? points : points - last;
    const bool is_first = world.rank() == 0, is_last = world.rank() == world.size() - 1;
    begin = is_first ? 0 : owned_by_first;
    end = is_first ? owned_by_first : is_last ? points : owned_by_first;
    krylov.emplace(world.teuchos(), end - begin);
    for (int i = begin; i < end; ++i) add_row(i);
  }

  // Springs to the neighbors within 1.8 spacings, along and half as stiff across; the lowest layer is held by some
  // more.
  void add_row(int i) {
    rows.columns.push_back(i);
    rows.blocks.emplace_back((is_held(i) ? 1.0 : 0.0) * Eigen::Matrix3d::Identity());
    const std::size_t own = rows.blocks.size() - 1;
    for (int j = 0; j < points; ++j) {
      const Eigen::Vector3d xi = place(j) - place(i);
      if (j == i || xi.norm() > 1.8) continue;
      const Eigen::Matrix3d spring = 0.5 * (Eigen::Matrix3d::Identity() + xi * xi.transpose() / xi.squaredNorm());
      rows.blocks[own] += spring;
      rows.columns.push_back(j);
      rows.blocks.push_back(-spring);
    }
    rows.start.push_back(rows.blocks.size());
  }

  std::vector<Field> rigid_motions() const {
    std::vector<Field> all(6, Field(end - begin, Eigen::Vector3d::Zero()));
    for (int i = begin; i < end; ++i) {
      for (int c = 0; c < 3; ++c) {
        all[c][i - begin][c] = 1;
        all[3 + c][i - begin] = Eigen::Vector3d::Unit(c).cross(place(i));
      }
    }
    return all;
  }

  // The columns of these rows stand on other ranks, too: a field is gathered whole.
  void multiply(const Field& in, Field& out) const {
    std::vector<double> whole(3 * points, 0.0);
    for (int i = begin; i < end; ++i) {
      for (int c = 0; c < 3; ++c) whole[3 * i + c] = in[i - begin][c];
    }
    world.sum(whole);
    for (int i = begin; i < end; ++i) {
      out[i - begin].setZero();
      for (std::size_t e = rows.start[i - begin]; e < rows.start[i - begin + 1]; ++e)
        out[i - begin] += rows.blocks[e] * Eigen::Vector3d::Map(whole.data() + 3 * rows.columns[e]);
    }
  }

  Communicator world;
  int begin, end;
  BlockRows rows;
  std::optional<Krylov> krylov;
};

// The solution is chosen; the residual is asked for to 1e-10 and the matrix has a condition of some hundreds.
TEST(Krylov, FindsTheSolutionWhereARankOwnsOnePoint) {
  for (const int last : {points / 2, 1}) {
    Springs springs(last);
    const std::string trouble = springs.krylov->precondition(springs.rows, springs.rigid_motions());
    const bool is_alone = springs.world.size() > 1 && last == 1;
    EXPECT_EQ(trouble.find("coarsest grid is smoothed instead") != std::string::npos, is_alone) << trouble;
    EXPECT_TRUE(springs.krylov->is_preconditioned());
    Field wanted(springs.end - springs.begin), right = wanted, found;
    for (int i = springs.begin; i < springs.end; ++i)
      wanted[i - springs.begin] = Eigen::Vector3d(std::sin(i), std::cos(2 * i), 1);
    springs.multiply(wanted, right);
    const auto outcome = springs.krylov->solve([&](const Field& in, Field& out) { springs.multiply(in, out); }, right,
                                               Krylov::Measure::residual, 1e-10, 500, found);
    EXPECT_TRUE(outcome.converged);
    EXPECT_LT(outcome.iterations, 40);  // 16 to 21 measured
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_LT((found[i] - wanted[i]).norm(), 1e-6);
  }
}

// Eigenvalues are estimated from random vectors: a run that is resumed must find what one finds that goes on.
TEST(Krylov, MakesThePreconditionerThatItMadeBefore) {
  Springs springs(points / 2);
  const Field right(springs.end - springs.begin, Eigen::Vector3d(1, -2, 3));
  const auto found = [&] {
    EXPECT_EQ(springs.krylov->precondition(springs.rows, springs.rigid_motions()), "");
    Field x;
    springs.krylov->solve([&](const Field& in, Field& out) { springs.multiply(in, out); }, right,
                          Krylov::Measure::residual, 1e-2, 500, x);
    return x;
  };
  const Field first = found(), second = found();
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i], second[i]) << i;
}

// The system is then its diagonal, and there is no hierarchy and nothing to tell.
TEST(Krylov, NeedsNoPreconditionerWhereNoPointDependsOnAnother) {
  Springs springs(points / 2);
  for (std::size_t i = 0; i + 1 < springs.rows.start.size(); ++i) {
    for (std::size_t e = springs.rows.start[i] + 1; e < springs.rows.start[i + 1]; ++e)
      springs.rows.blocks[e].setZero();
    springs.rows.blocks[springs.rows.start[i]] = 3 * Eigen::Matrix3d::Identity();
  }
  EXPECT_EQ(springs.krylov->precondition(springs.rows, springs.rigid_motions()), "");
  EXPECT_FALSE(springs.krylov->is_preconditioned());
  const Field right(springs.end - springs.begin, Eigen::Vector3d(3, 6, 9));
  Field found;
  const auto outcome = springs.krylov->solve([&](const Field& in, Field& out) { springs.multiply(in, out); }, right,
                                             Krylov::Measure::residual, 1e-10, 500, found);
  EXPECT_TRUE(outcome.converged);
  for (const auto& x : found) EXPECT_LT((x - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace strut
