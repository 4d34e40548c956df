#include "integrators/quasi_static/tangent_factor.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <optional>

#include "integrators/quasi_static/block_factors.hpp"
#include "mechanics/point_stiffness.hpp"

namespace strut {

namespace {

// Neighbors up to the middle of an edge of the cube around a point count as near.
constexpr double reach = 1.5;  // spacings

// Transverse stiffness: springs along bonds alone would let chains of points buckle freely.
constexpr double across = 0.1;  // of the spring's stiffness along its bond

// Lower limit of the shear modulus of flowing material over its elastic one; the bulk modulus stays. Limits of 0.1 to
// 0.3 need the fewest iterations for a bar in flow.
constexpr double smallest_fraction = 0.1;

// Grounding stiffness, relative to a point's own springs, for parts without any constraint (a body that slides between
// plates, a loose piece); without it the coarsest grid and the factors are singular.
constexpr double to_ground = 1e-5;

// Data of the ends of a spring, for owned points and ghosts.
struct End {
  double number;     // global number of the point
  double stiffness;  // 15 μ/Σ V |ξ|² over near neighbors, Pa/m⁵ (isotropic springs of shear modulus μ)
  double spacing;    // m
  Tensor free_projection;
};

void reflect(const Reflection& by, End& end) {
  end.free_projection = (by.turn * end.free_projection * by.turn.transpose()).eval();
}

bool near(const End& a, const End& b, const Vector& xi) { return xi.norm() <= 0.5 * reach * (a.spacing + b.spacing); }

// The shear modulus of the isotropic tensor with the same two traces.
double shear_modulus(const PointTangent& tangent) {
  double bulk = 0;
  for (const int i : {0, 4, 8}) {
    for (const int j : {0, 4, 8}) bulk += tangent.by_gradient(i, j) / 9;
  }
  return (tangent.by_gradient.trace() - 3 * bulk) / 10;
}

double spread(const Body& body, const std::vector<End>& ends, int i) {
  double sum = 0;
  body.domain.families.for_each(i, [&](int j) {
    const Vector xi = body.domain.reference(j) - body.domain.reference(i);
    if (near(ends[i], ends[j], xi)) sum += body.domain.volume(j) * xi.squaredNorm();
  });
  return sum;
}

std::vector<End> ends_of(Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                         std::int64_t first) {
  std::vector<End> ends(body.domain.sites.size());
  for (int i = 0; i < body.owned(); ++i) {
    ends[i] = {static_cast<double>(first + i), 0, body.domain.cloud.spacings[i], held.free_projection(i)};
  }
  Halo& halo = body.domain.halo;
  halo.exchange(ends);
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const int i = block.points[k];
      const double elastic = block.moduli(block.index(k, 0)).shear;
      const double now = block.is_ordinary() ? elastic : shear_modulus(tangents[i]);
      ends[i].stiffness = 15 * std::max(now, smallest_fraction * elastic) / std::max(spread(body, ends, i), 1e-300);
    }
  }
  halo.exchange(ends);
  return ends;
}

// Adds a block to the last row at this column; all images of a point have the column of their original.
void add(std::int64_t column, const Tensor& block, BlockRows& rows) {
  const auto begin = rows.columns.begin() + static_cast<std::ptrdiff_t>(rows.start.back());
  const auto same = std::find(begin, rows.columns.end(), column);
  if (same != rows.columns.end()) {
    rows.blocks[same - rows.columns.begin()] += block;
  } else {
    rows.columns.push_back(column), rows.blocks.push_back(block);
  }
}

}  // namespace

BlockRows preconditioner_matrix(Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                                const std::vector<Tensor>& extra, std::int64_t first) {
  const std::vector<End> ends = ends_of(body, tangents, held, first);
  std::vector<const Reflection*> reflections(body.domain.sites.size());  // of images
  for (const ImagePoint& image : body.domain.halo.images()) reflections[image.ghost] = &image.by;
  BlockRows rows;
  for (int i = 0; i < body.owned(); ++i) {
    Tensor diagonal = Tensor::Zero();
    if (!extra.empty()) diagonal = 0.5 * (extra[i] + extra[i].transpose());  // Chebyshev's smoother requires symmetry
    const std::size_t at = rows.columns.size();
    rows.columns.push_back(first + i), rows.blocks.emplace_back(Tensor::Zero());
    rows.elsewhere.emplace_back(Tensor::Zero());
    body.domain.families.for_each(i, [&](int j) {
      const Vector xi = body.domain.reference(j) - body.domain.reference(i);
      if (!near(ends[i], ends[j], xi)) return;
      const Vector e =
          (body.domain.sites[j].current - body.domain.sites[i].current).head<3>().matrix().stableNormalized();
      const double k = body.domain.volume(i) * body.domain.volume(j) * (ends[i].stiffness + ends[j].stiffness);
      const Tensor spring = k * ((1 - across) * e * e.transpose() + across * Tensor::Identity());
      diagonal += spring;
      const auto column = static_cast<std::int64_t>(ends[j].number);
      if (column < first || column >= first + body.owned()) rows.elsewhere.back() += spring;
      const Tensor coupling = -(held.free_projection(i) * spring * ends[j].free_projection);
      add(column, reflections[j] ? Tensor(coupling * reflections[j]->turn) : coupling, rows);
    });
    diagonal *= 1 + to_ground;
    const Tensor& free_projection = held.free_projection(i);
    const double scale = diagonal.trace() > 0 ? diagonal.trace() / 3 : 1;
    rows.blocks[at] += free_projection * diagonal * free_projection + scale * (Tensor::Identity() - free_projection);
    rows.start.push_back(rows.columns.size());
  }
  return rows;
}

std::vector<Field> rigid_motions(const Body& body) {
  double sums[] = {0, 0, 0, static_cast<double>(body.owned())};
  for (int i = 0; i < body.owned(); ++i) {
    for (int c = 0; c < 3; ++c) sums[c] += body.current(i)[c];
  }
  body.domain.communicator.sum(sums);
  const Vector middle = Vector(sums[0], sums[1], sums[2]) / sums[3];
  std::vector<Field> motions(6, Field(body.owned()));
  for (int i = 0; i < body.owned(); ++i) {
    for (int c = 0; c < 3; ++c) {
      motions[c][i] = Vector::Unit(c);
      motions[3 + c][i] = Vector::Unit(c).cross(body.current(i) - middle);
    }
  }
  return motions;
}

namespace {

using Sparse = Eigen::SparseMatrix<double>;  // by columns, lower triangle

// Limit of the operations of a factorization per point: as long as some sixty products with factors take, or two
// hundred without. Struts 2 to 3 cells thick need 3e5 to 5e5.
constexpr double most_operations = 1e6;

// Cost of a product, with one application of the factors: as long as this many operations per point.
constexpr double operations_of_product = 16000;

// Pairs of coupled points on a rank; larger matrices are not ordered (some gigabytes, and up to ten seconds).
constexpr std::size_t most_coupled = 10'000'000;

// Maps images of points to the owned points.
class Originals {
 public:
  struct Original {
    int point;  // −1: owned by another rank
    Tensor turn;
  };

  explicit Originals(const Body& body) : owned_(body.owned()) {
    of_ghosts_.resize(body.domain.sites.size() - owned_, {-1, Tensor::Identity()});
    for (const ImagePoint& image : body.domain.halo.images()) {
      of_ghosts_[image.ghost - owned_] = {image.original, image.by.turn};
    }
  }
  Original of(int i) const { return i < owned_ ? Original{i, Tensor::Identity()} : of_ghosts_[i - owned_]; }

 private:
  int owned_;
  std::vector<Original> of_ghosts_;
};

// For each owned point, itself first, then all owned points that are in one family with it. Empty if there are too
// many.
std::vector<std::vector<int>> coupled_points(const Body& body, const Originals& originals) {
  std::vector<std::vector<int>> coupled(body.owned());
  std::vector<int> seen_by(body.owned(), -1);
  std::size_t pairs = 0;
  for (int i = 0; i < body.owned(); ++i) {
    const auto take = [&](int near) {
      const int j = originals.of(near).point;
      if (j >= 0 && seen_by[j] != i) seen_by[j] = i, coupled[i].push_back(j);
    };
    take(i);
    body.domain.families.for_each(i, take);
    for (std::size_t n = 0, near = coupled[i].size(); n < near; ++n) {
      body.domain.families.for_each(coupled[i][n], take);
    }
    pairs += coupled[i].size();
    if (pairs > most_coupled) return {};
  }
  return coupled;
}

// A matrix with the pattern of the coupled points.
Sparse pattern_of(const std::vector<std::vector<int>>& coupled) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < coupled.size(); ++i) {
    for (const int j : coupled[i]) entries.emplace_back(static_cast<int>(i), j, 1);
  }
  Sparse pattern(static_cast<int>(coupled.size()), static_cast<int>(coupled.size()));
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

}  // namespace

// Point i has the number place[i].
struct TangentFactor::Matrix {
  Originals originals;
  std::vector<int> place;
  std::optional<BlockFactors> factors;

  Matrix(const Sparse& pattern, Originals all) : originals(std::move(all)), place(pattern.rows()) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(pattern, order);
    for (int n = 0; n < pattern.rows(); ++n) place[order.indices()[n]] = n;
    const Sparse ordered = order.inverse() * pattern * order;
    factors.emplace(Sparse(ordered.triangularView<Eigen::Lower>()));
  }

  void add(int i, int j, const Tensor& block) { factors->add(place[i], place[j], block); }

  // Adds this rank's part of a point's stiffness, along free directions.
  void add(const PointStiffness& stiffness, const Constraints& held) {
    for (std::size_t a = 0; a < stiffness.points.size(); ++a) {
      for (std::size_t b = 0; b < stiffness.points.size(); ++b) {
        const auto [i, of_i] = originals.of(stiffness.points[a]);
        const auto [j, of_j] = originals.of(stiffness.points[b]);
        if (i < 0 || j < 0) continue;
        const Tensor block = of_i.transpose() * stiffness.matrix.block<3, 3>(3 * a, 3 * b) * of_j;
        add(i, j, held.free_projection(i) * block * held.free_projection(j));
      }
    }
  }

  // Adds the other supports of point i: `extra`, bonds to other ranks, the ground, and a spring along held directions.
  void add_supports(int i, const Tensor& extra, const Constraints& held, const BlockRows& resembling) {
    const double spring = resembling.blocks[resembling.start[i]].trace() / 3;
    const Tensor diagonal = extra + to_ground * spring * Tensor::Identity() + resembling.elsewhere[i];
    const Tensor& free = held.free_projection(i);
    add(i, i, free * diagonal * free + spring * (Tensor::Identity() - free));
  }
};

TangentFactor::TangentFactor(const Body& body) {
  if (!have_point_stiffness(body)) return;
  Originals originals(body);
  const std::vector<std::vector<int>> coupled = coupled_points(body, originals);
  if (!coupled.empty()) matrix_ = std::make_unique<Matrix>(pattern_of(coupled), std::move(originals));
  const double too_many = 2 * most_operations;
  const double of_a_point = matrix_ ? matrix_->factors->operations() / body.owned() : body.owned() > 0 ? too_many : 0;
  const double most = body.domain.communicator.max(of_a_point);
  worthwhile_ = most <= most_operations;
  products_worth_ = most / operations_of_product;
  if (!worthwhile_) matrix_ = nullptr;
}

double TangentFactor::bytes() const { return matrix_ ? matrix_->factors->bytes() : 0; }

TangentFactor::~TangentFactor() = default;

bool TangentFactor::factorize(const Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                              const std::vector<Tensor>& extra, const BlockRows& resembling) {
  bool found = true;
  if (matrix_) {
    matrix_->factors->clear();
    PointStiffness stiffness;
    for (const MaterialBlock& block : body.blocks) {
      for (std::size_t k = 0; k < block.points.size(); ++k) {
        take_point_stiffness(body, block, static_cast<int>(k), tangents, stiffness);
        matrix_->add(stiffness, held);
      }
    }
    for (int i = 0; i < body.owned(); ++i) matrix_->add_supports(i, extra[i], held, resembling);
    found = matrix_->factors->factorize();
  }
  return !body.domain.communicator.any(!found);
}

void TangentFactor::solve(const Field& right, Field& x) const {
  if (!matrix_) return;  // a rank without points
  Field ordered(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) ordered[matrix_->place[i]] = right[i];
  matrix_->factors->solve(ordered);
  for (std::size_t i = 0; i < right.size(); ++i) x[i] = ordered[matrix_->place[i]];
}

}  // namespace strut
