#include "integrators/quasi_static/preconditioner_matrix.hpp"

#include <algorithm>

namespace strut {

namespace {

// Neighbors up to the middle of an edge of the cube around a point count as near.
constexpr double reach = 1.5;  // spacings

// Transverse stiffness: springs along bonds alone would let chains of points buckle freely.
constexpr double across = 0.1;  // of the spring's stiffness along its bond

// Lower limit of the shear modulus of flowing material, relative to the elastic one; the bulk modulus stays. With 0.1
// to 0.3 a bar in flow takes the fewest iterations.
constexpr double smallest_share = 0.1;

// Grounding stiffness, relative to a point's own springs, for parts without any constraint (a body that slides between
// plates, a loose piece); without it the coarsest grid is singular.
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
      const double elastic = block.moduli(block.place(k, 0)).shear;
      const double now = block.is_ordinary() ? elastic : shear_modulus(tangents[i]);
      ends[i].stiffness = 15 * std::max(now, smallest_share * elastic) / std::max(spread(body, ends, i), 1e-300);
    }
  }
  halo.exchange(ends);
  return ends;
}

// Adds the block at (row, column) to the last row; several images of a point share one column.
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

}  // namespace strut
