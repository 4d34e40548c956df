#include "topology/mirror.hpp"

#include <algorithm>

#include "base/errors.hpp"

namespace strut {

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

}  // namespace

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

const std::vector<int>& Images::of_body(int body) const {
  static const std::vector<int> none;
  return static_cast<std::size_t>(body) < of_body_.size() ? of_body_[body] : none;
}

}  // namespace strut
