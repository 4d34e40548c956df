#include "topology/mirror_planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iterator>

namespace strut {

std::vector<Mirror> planes_through(const Domain& domain, int i) {
  std::vector<Mirror> planes;
  std::ranges::copy_if(domain.mirrors, std::back_inserter(planes), [&](const Mirror& mirror) {
    return mirror.body == domain.body_of(i) && mirror.holds(domain.reference(i), domain.cloud.spacings[i]);
  });
  return planes;
}

int coincident_images(const Domain& domain, int i) {
  const std::vector<Mirror> planes = planes_through(domain, i);
  std::vector<Tensor> turns{Tensor::Identity()};
  for (std::size_t n = 0; n < turns.size(); ++n) {
    for (const Mirror& plane : planes) {
      const Tensor turn = Reflection::by(plane).turn * turns[n];
      const auto is_it = [&turn](const Tensor& other) { return (other - turn).norm() < 1e-6; };  // round-off is 1e-16
      if (std::none_of(turns.begin(), turns.end(), is_it)) turns.push_back(turn);
    }
  }
  return static_cast<int>(turns.size());
}

namespace {

bool has_parallel(const std::vector<Mirror>& mirrors, const Mirror& mirror) {
  return std::ranges::any_of(mirrors, [&](const Mirror& other) {
    return &other != &mirror && other.body == mirror.body && other.normal.cross(mirror.normal).norm() < 1e-9;
  });
}

// Marks the images behind a plane. For a point on the plane, a position beside it decides where its image belongs.
std::vector<char> images_behind(const Domain& domain, const Mirror& mirror) {
  std::vector<char> behind(domain.sites.size(), 0);
  for (const ImagePoint& image : domain.halo.images()) {
    const Vector original = image.by.turn.transpose() * (domain.reference(image.ghost) - image.by.shift);
    const Vector inside = original + 1e-3 * domain.horizon(image.ghost) * mirror.normal;
    behind[image.ghost] = mirror.distance(image.by(inside)) < 0;
  }
  return behind;
}

// The force of the images behind one of two parallel planes, along its normal, N.
Vector across(const Domain& domain, const Mirror& mirror, const MirroredForces& sums) {
  return mirror.normal.dot(sums.of_images(mirror.body, images_behind(domain, mirror))) * mirror.normal;
}

// The vector of least length whose product with Σ n⊗n is nearest to the force.
Vector least_solution(const Tensor& of_normals, const Vector& force) {
  constexpr double dependent = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Tensor> axes(of_normals);
  Vector result = Vector::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vector axis = axes.eigenvectors().col(c);
    if (axes.eigenvalues()[c] > dependent * axes.eigenvalues()[2])
      result += axis.dot(force) / axes.eigenvalues()[c] * axis;
  }
  return result;
}

// Adds up the forces of the planes of a body. A plane that has a parallel one gets the force of the images behind it.
// The rest of the force on the body is distributed over the other planes, along their normals, with the least sum of
// squares.
void add(const Domain& domain, int body, const MirroredForces& sums, std::vector<Vector>& forces) {
  const std::vector<Mirror>& mirrors = domain.mirrors;
  Vector rest = sums.on_body(body);
  std::vector<std::size_t> others;
  Tensor of_normals = Tensor::Zero();
  for (std::size_t m = 0; m < mirrors.size(); ++m) {
    if (mirrors[m].body != body) continue;
    if (has_parallel(mirrors, mirrors[m])) {
      forces[m] = across(domain, mirrors[m], sums);
      rest -= forces[m];
    } else {
      others.push_back(m);
      of_normals += mirrors[m].normal * mirrors[m].normal.transpose();
    }
  }
  if (others.empty()) return;
  const Vector shared = least_solution(of_normals, rest);
  for (const std::size_t m : others) forces[m] = mirrors[m].normal.dot(shared) * mirrors[m].normal;
}

}  // namespace

std::vector<Vector> mirror_reactions(const Domain& domain, const MirroredForces& sums) {
  const std::vector<Mirror>& mirrors = domain.mirrors;
  std::vector<Vector> forces(mirrors.size(), Vector::Zero());
  for (std::size_t m = 0; m < mirrors.size(); ++m) {
    if (m == 0 || mirrors[m - 1].body != mirrors[m].body) add(domain, mirrors[m].body, sums, forces);  // by bodies
  }
  return forces;
}

}  // namespace strut
