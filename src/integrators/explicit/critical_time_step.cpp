#include "integrators/explicit/critical_time_step.hpp"

#include <cmath>
#include <limits>

#include "base/parallel/reproducible_sum.hpp"
#include "base/timing.hpp"

namespace strut {

namespace {

using Field = std::vector<Vector>;
using StoredField = std::vector<Eigen::Vector3f>;  // single precision is far finer than an estimate's accuracy

// Least length, relative, of an image vector after its components in the basis are removed; less is round-off.
constexpr double smallest_rest = 1e-5;

// Σ m a·b over all ranks; M⁻¹K is symmetric in this product. It is the same on any number of ranks to the last bit;
// else round-off would choose among degenerate modes, and change the estimate, the step and the run.
template <class Other>
double inner(const Body& body, const Field& a, const Other& b) {
  return reproducible_sum(body.domain.communicator, body.owned(),
                          [&](int i) { return body.mass(i) * a[i].dot(b[i].template cast<double>()); });
}

// A pseudo-random direction that depends only on the draw and the point's id, not on the rank (SplitMix64).
Vector noise(int draw, std::int64_t id) {
  Vector v;
  for (int c = 0; c < 3; ++c) {
    std::uint64_t z = static_cast<std::uint64_t>(3 * id + c) + (draw + std::uint64_t{1}) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    v[c] = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53 - 0.5;
  }
  return v;
}

void set_noise(const Body& body, int draw, Field& field) {
  for (int i = 0; i < body.owned(); ++i) field[i] = noise(draw, body.domain.cloud.ids[i]);
}

// The mode found last, with enough noise to find one that was missed or that has overtaken it.
void add_noise(const Body& body, const StoredField& mode, Field& field) {
  set_noise(body, 1, field);
  const double scale = 0.1 / std::sqrt(inner(body, field, field));
  for (int i = 0; i < body.owned(); ++i) field[i] = mode[i].cast<double>() + scale * field[i];  // a mode is of length 1
}

void widen(const StoredField& stored, Field& field) {
  for (std::size_t i = 0; i < stored.size(); ++i) field[i] = stored[i].cast<double>();
}

// The body's sites with a field in place of y, as the tangent takes it.
void set_directions(const StoredField& field, std::vector<Site>& directions) {
  for (std::size_t i = 0; i < field.size(); ++i) {
    directions[i].current.head<3>() = field[i].cast<double>().array();
  }
}

// The tridiagonal matrix of the Lanczos iteration, and its basis.
struct Lanczos {
  std::vector<double> diagonal, off_diagonal;
  std::vector<StoredField> basis;
};

StoredField stored(const Field& field, double scale) {
  StoredField result;
  result.reserve(field.size());
  for (const Vector& v : field) result.push_back((scale * v).cast<float>());
  return result;
}

// Iterates from the vector in `image`, which is overwritten.
Lanczos iterate(Body& body, Field& image, int iterations) {
  std::vector<Site> directions = body.domain.sites;
  Lanczos lanczos;
  double length = std::sqrt(inner(body, image, image));
  for (int k = 0; k < iterations; ++k) {
    lanczos.basis.push_back(stored(image, 1 / length));
    set_directions(lanczos.basis.back(), directions);
    apply_tangent(body, body.domain.halo, directions, nullptr, body.force_states, image);
    for (int i = 0; i < body.owned(); ++i) image[i] /= body.density[i];
    lanczos.diagonal.push_back(inner(body, image, lanczos.basis.back()));
    // Orthogonalizes against the whole basis: it is short, and copies of converged modes would spoil the residual.
    for (const StoredField& earlier : lanczos.basis) {
      const double overlap = inner(body, image, earlier);
      for (int i = 0; i < body.owned(); ++i) image[i] -= overlap * earlier[i].cast<double>();
    }
    length = std::sqrt(inner(body, image, image));
    lanczos.off_diagonal.push_back(length);
    if (!(length > smallest_rest * std::abs(lanczos.diagonal.front()))) break;  // the basis is invariant
  }
  return lanczos;
}

// The Ritz vector Σ weights[k] basis[k].
StoredField combine(const std::vector<StoredField>& basis, const Eigen::VectorXd& weights) {
  StoredField result(basis[0].size(), Eigen::Vector3f::Zero());
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const auto weight = static_cast<float>(weights[static_cast<Eigen::Index>(k)]);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * basis[k][i];
  }
  return result;
}

}  // namespace

// Memory of basis, image and directions.
double CriticalTimeStep::bytes(const Body& body) {
  const double fields = basis_size * sizeof(Eigen::Vector3f) + sizeof(Vector);
  return fields * body.owned() + static_cast<double>(sizeof(Site) * body.domain.sites.size());
}

void CriticalTimeStep::serialize(Archive& archive, const Body& body) {
  archive.number("has_mode", found_);
  mode_.resize(body.owned(), Eigen::Vector3f::Zero());
  archive.field("mode", 3, [&](std::size_t i, int c) -> float& { return mode_[i][c]; });
}

double CriticalTimeStep::estimate(Body& body) {
  static Teuchos::Time& timer = phase("Critical time step");
  const Timed timed(timer);
  Field image(body.owned());
  // The highest mode may be confined to few points and nearly orthogonal to the noise; then a lower mode converges. It
  // is very unlikely that the noise of a second draw is orthogonal to it, too.
  const int least_cycles = found_ ? 1 : 2;
  double bound = 0;
  for (int cycle = 0; cycle < most_cycles; ++cycle) {
    if (cycle >= least_cycles) {
      widen(mode_, image);
    } else {
      found_ ? add_noise(body, mode_, image) : set_noise(body, 0, image);
    }
    mode_ = StoredField();  // frees memory for the basis
    const Lanczos lanczos = iterate(body, image, basis_size);
    const int n = static_cast<int>(lanczos.diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    const Eigen::Map<const Eigen::VectorXd> diagonal(lanczos.diagonal.data(), n),
        off_diagonal(lanczos.off_diagonal.data(), n - 1);
    ritz.computeFromTridiagonal(diagonal, off_diagonal, Eigen::ComputeEigenvectors);
    const Eigen::VectorXd weights = ritz.eigenvectors().col(n - 1);
    const double value = ritz.eigenvalues()[n - 1];
    const double residual = std::abs(lanczos.off_diagonal[n - 1] * weights[n - 1]);
    mode_ = combine(lanczos.basis, weights);
    found_ = true;
    bound = value + residual;
    if (cycle + 1 >= least_cycles && !(residual > accuracy * value)) break;
  }
  return bound > 0 ? 2 / std::sqrt(bound) : std::numeric_limits<double>::infinity();
}

}  // namespace strut
