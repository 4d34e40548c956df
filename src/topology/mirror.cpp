#include "topology/mirror.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "topology/cloud.hpp"

namespace strut {

double Mirror::distance(const Vector& X) const { return normal.dot(X - on); }

bool Mirror::holds(const Vector& X, double spacing) const { return std::abs(distance(X)) < on_plane * spacing; }

Reflection Reflection::by(const Mirror& mirror) {
  const Vector& n = mirror.normal;
  return {Tensor::Identity() - 2 * n * n.transpose(), 2 * n.dot(mirror.on) * n};
}

Vector Reflection::operator()(const Vector& X) const { return turn * X + shift; }

Reflection Reflection::after(const Reflection& first) const { return {turn * first.turn, turn * first.shift + shift}; }

Reflection Reflection::stretched(const Vector& stretch) const {
  return {turn, shift + period.cwiseProduct(stretch - Vector::Ones()), period};
}

namespace {

// Upper limit: a larger number is no pattern that fills space.
constexpr std::size_t most_images = 200;

bool is_same(const Reflection& a, const Reflection& b, double size) {
  return (a.turn - b.turn).norm() < 1e-9 && (a.shift - b.shift).norm() < 1e-9 * size;
}

Eigen::AlignedBox3d image_of(const Eigen::AlignedBox3d& box, const Reflection& reflection) {
  Eigen::AlignedBox3d image;
  for (int c = 0; c < 8; ++c) image.extend(reflection(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c))));
  return image;
}

// The images, each made from a neighboring one, as long as they are within reach of the box; first the box itself.
std::vector<Reflection> images_of(const std::vector<Mirror>& mirrors, const Eigen::AlignedBox3d& box, double reach) {
  std::vector<Reflection> all{{}};
  const double size = box.sizes().norm() + reach + box.center().norm();
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (const Mirror& mirror : mirrors) {
      const Reflection next = all[n].after(Reflection::by(mirror));
      const auto is_next = [&](const Reflection& one) { return is_same(one, next, size); };
      if (std::any_of(all.begin(), all.end(), is_next)) continue;
      if (box.exteriorDistance(image_of(box, next)) <= reach) all.push_back(next);
    }
    if (all.size() <= most_images) continue;
    throw Error("symmetry planes meet at an angle that is not 180°/n, so that the mirror images of a body overlap");
  }
  return all;
}

// A number below 2⁴⁰ (Images::bits) for a position: shared nodes at one position and of one seam have one, others
// almost certainly another.
std::int64_t number_at(const Vector& X, double period, std::int64_t seam) {
  constexpr double resolution = 1e-7;  // of the period; with an offset that no mesh has
  auto hash = static_cast<std::uint64_t>(seam);
  for (int c = 0; c < 3; ++c) {
    hash += static_cast<std::uint64_t>(std::llround(X[c] / (resolution * period) + 0.2718281828));
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;  // splitmix64
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  }
  static_assert(of_place == std::int64_t{1} << (Images::bits - 1));
  return (static_cast<std::int64_t>(hash) & (of_place - 1)) | of_place;
}

}  // namespace

std::int64_t shared_node_at(const Vector& X, std::int64_t number, const std::vector<Mirror>& planes, double spacing,
                            std::int64_t seam) {
  const bool repeats = std::ranges::any_of(planes, [](const Mirror& plane) { return plane.period > 0; });
  std::int64_t bits = 0;
  Vector lower = X;  // its image on lower sides
  double period = 0;
  for (const Mirror& plane : planes) {
    if (!plane.holds(X, spacing)) continue;
    period = std::max(period, plane.period);
    const bool is_lower = plane.period > 0 && plane.normal.sum() > 0;
    if (repeats) lower += ((is_lower ? 0 : plane.period) - plane.distance(X)) * plane.normal;
    bits |= std::int64_t{1} << (first_plane_bit + plane.bit + (is_lower ? lower_side : 0));
  }
  return (period > 0 ? number_at(lower, period, seam) : number) | bits;
}

Images::Images(const std::vector<Mirror>& mirrors, const std::vector<Eigen::AlignedBox3d>& boxes, double reach) {
  for (std::size_t b = 0; b < mirrors.size(); ++b) {
    const int body = mirrors[b].body;
    of_body_.resize(std::max<std::size_t>(of_body_.size(), body + 1));
    if (!of_body_[body].empty() || boxes[b].isEmpty()) continue;
    std::vector<Mirror> own;
    std::copy_if(mirrors.begin(), mirrors.end(), std::back_inserter(own),
                 [body](const Mirror& mirror) { return mirror.body == body; });
    const std::vector<Reflection> images = images_of(own, boxes[b], reach);
    for (std::size_t n = 1; n < images.size(); ++n) {
      of_body_[body].push_back(static_cast<int>(all_.size()));
      all_.push_back(images[n]);
    }
  }
}

Images::Images(const std::vector<Period>& periods, double reach) {
  for (const Period& period : periods) {
    const int count = static_cast<int>(all_.size()), most = static_cast<int>(std::floor(reach / period.length)) + 1;
    for (int n = -most; n <= most; ++n) {
      const Vector by = n * period.length * Vector::Unit(period.axis);
      for (int k = 0; n != 0 && k < count; ++k) {
        all_.push_back({Tensor::Identity(), all_[k].shift + by, all_[k].period + by});
      }
    }
  }
  for (int n = 1; n < count(); ++n) of_all_.push_back(n);
}

const std::vector<int>& Images::of_body(int body) const {
  return static_cast<std::size_t>(body) < of_body_.size() ? of_body_[body] : of_all_;
}

}  // namespace strut
