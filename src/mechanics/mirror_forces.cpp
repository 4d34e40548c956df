#include "mechanics/mirror_forces.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <set>

#include "mechanics/image_forces.hpp"

namespace strut {

namespace {

// How many periods above its original each image is; 0 for other points.
std::vector<int> periods_above(const Domain& domain, const Period& period) {
  std::vector<int> above(domain.sites.size(), 0);
  for (const ImagePoint& image : domain.halo.images()) {
    above[image.ghost] = static_cast<int>(std::lround(image.by.period[period.axis] / period.length));
  }
  return above;
}

}  // namespace

// A bond over a side is in two families, at either side, once by an image above and once by one below.
std::vector<Vector> period_forces(const Body& body, int level, const std::vector<int>* moved) {
  const Domain& domain = body.domain;
  // Images are ghosts: points of the interior have none in their families.
  const std::vector<int> points = moving_points(body, moved, [&](int i) { return i >= domain.interior; });
  std::vector<Vector> forces;
  for (const Period& period : domain.periods) {
    const std::vector<int> above = periods_above(domain, period);
    double force = 0;
    for (const int n : std::set<int>(above.begin(), above.end())) {
      const auto picks = [&](int j) { return above[j] == n; };
      if (n != 0) force += 0.5 * n * image_force(body, points, level, picks)[period.axis];
    }
    forces.emplace_back(force * Vector::Unit(period.axis));
  }
  return forces;
}

namespace {

class MirrorForces {
 public:
  MirrorForces(const Body& body, int level, const std::vector<int>* moved)
      : body_(body), mirrors_(body.domain.mirrors), level_(level), moved_(moved) {}

  std::vector<Vector> all() const {
    std::vector<Vector> forces(mirrors_.size(), Vector::Zero());
    for (std::size_t m = 0; m < mirrors_.size(); ++m) {
      if (m == 0 || mirrors_[m - 1].body != mirrors_[m].body) add(mirrors_[m].body, forces);  // sorted by bodies
    }
    return forces;
  }

 private:
  // Bonds within a body cancel in the sum of the forces on it; the rest is the force of the planes, along their
  // normals. If two planes are parallel, the images behind each are summed separately.
  void add(int body, std::vector<Vector>& forces) const {
    Vector rest = Vector::Zero();
    for (const int i : points_of(body)) rest += body_.domain.volume(i) * body_.force_density[i];
    std::vector<std::size_t> others;
    for (std::size_t m = 0; m < mirrors_.size(); ++m) {
      if (mirrors_[m].body != body) continue;
      if (has_parallel(m)) {
        forces[m] = across(m);
        rest -= forces[m];
      } else {
        others.push_back(m);
      }
    }
    Eigen::Matrix3Xd normals(3, others.size());
    for (std::size_t n = 0; n < others.size(); ++n) {
      normals.col(static_cast<Eigen::Index>(n)) = mirrors_[others[n]].normal;
    }
    if (others.empty()) return;
    const Eigen::VectorXd along = normals.completeOrthogonalDecomposition().solve(rest);
    for (std::size_t n = 0; n < others.size(); ++n) {
      forces[others[n]] = along[static_cast<Eigen::Index>(n)] * mirrors_[others[n]].normal;
    }
  }

  bool has_parallel(std::size_t m) const {
    for (std::size_t other = 0; other < mirrors_.size(); ++other) {
      if (other == m || mirrors_[other].body != mirrors_[m].body) continue;
      if (mirrors_[other].normal.cross(mirrors_[m].normal).norm() < 1e-9) return true;
    }
    return false;
  }

  // The force of the images behind one of the planes, along its normal, N.
  Vector across(std::size_t m) const {
    const std::vector<char> behind = images_behind(mirrors_[m]);
    const auto picks = [&](int j) { return behind[j]; };
    const Vector sum = image_force(body_, points_of(mirrors_[m].body), level_, picks);
    const Vector& normal = mirrors_[m].normal;
    return normal.dot(sum) * normal;
  }

  // Marks the images behind the plane. For a point on the plane, a position beside it decides where its image belongs.
  std::vector<char> images_behind(const Mirror& mirror) const {
    std::vector<char> behind(body_.domain.sites.size(), 0);
    for (const ImagePoint& image : body_.domain.halo.images()) {
      const Vector original = image.by.turn.transpose() * (body_.domain.reference(image.ghost) - image.by.shift);
      const Vector inside = original + 1e-3 * body_.domain.horizon(image.ghost) * mirror.normal;
      behind[image.ghost] = mirror.distance(image.by(inside)) < 0;
    }
    return behind;
  }

  std::vector<int> points_of(int body) const {
    return moving_points(body_, moved_,
                         [&](int i) { return body_.domain.blocks[body_.domain.cloud.blocks[i]].body == body; });
  }

  const Body& body_;
  const std::vector<Mirror>& mirrors_;
  int level_;
  const std::vector<int>* moved_;
};

}  // namespace

std::vector<Vector> mirror_forces(const Body& body, int level, const std::vector<int>* moved) {
  return body.domain.periods.empty() ? MirrorForces(body, level, moved).all() : period_forces(body, level, moved);
}

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces) {
  for (std::size_t m = 0; m < forces.size(); ++m) {
    for (int c = 0; c < 3; ++c) archive.share("mirror_force_" + std::to_string(m) + "xyz"[c], forces[m][c]);
  }
}

}  // namespace strut
