// Symmetry planes and periodic sides: bodies of which only a part is computed. The rest consists of images of the
// points: ghosts whose values are the reflected or shifted values of their originals.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"

namespace strut {

// Nodes nearer to a plane than this, in spacings, count as on it: coordinates in single precision, and normals of three
// digits, are a little off.
constexpr double on_plane = 0.01;

// A plane behind which a body continues as its mirror image.
struct Mirror {
  Vector on = Vector::Zero(), normal = Vector::UnitX();  // m; of unit length
  int body = 0;                                          // BlockBonds::body
  int number = 0;                                        // index in the deck of its condition
  int bit = 0;                                           // bit of `shared_nodes` for nodes on it (cloud.hpp)
  double period = 0;                                     // m, of a periodic side: to the other one; 0: a mirror

  double distance(const Vector& X) const;             // m, negative behind the normal
  bool holds(const Vector& X, double spacing) const;  // true if a node is on it
};

// Two sides, normal to an axis, behind which all bodies go on as they are behind the other side.
struct Period {
  int axis = 0;
  double length = 0;    // m, from one side to the other, in the reference state
  int number = 0;       // index in the deck of its condition
  Function stretch{1};  // of the time: present over reference distance of the sides
};

// The number of a shared node (cloud.hpp) at X, with the bits of the mirrors that it lies on. On periodic sides, shared
// nodes that are images of each other have one number, which has the bit `of_place`; those on an upper side have its
// bit, those on a lower one the bit that is `lower_side` higher. `spacing`: in m. `seam`: tells shared nodes at one
// place of a side from each other; 0 where there is one only.
std::int64_t shared_node_at(const Vector& X, std::int64_t number, const std::vector<Mirror>& planes, double spacing,
                            std::int64_t seam = 0);
constexpr int lower_side = 3;
constexpr std::int64_t of_place = std::int64_t{1} << 39;  // below Images::bits, and in no number of a mesh

// Maps a point to its image: a product of reflections or a sum of periods, X → turn X + shift.
struct Reflection {
  Tensor turn = Tensor::Identity();
  Vector shift = Vector::Zero();   // m, in the reference state
  Vector period = Vector::Zero();  // m, the part of the shift that stretches with the periods

  static Reflection by(const Mirror& mirror);
  Vector operator()(const Vector& X) const;
  Reflection after(const Reflection& first) const;
  // The same map for present positions, where the periods along x, y, z are stretched.
  Reflection stretched(const Vector& stretch) const;
};

// The images of bodies. Image 0 is the body itself.
class Images {
 public:
  Images() = default;
  // Makes those within `reach` (m) of their body, whose box is boxes[b] for the body of mirrors[b]. Throws Error if the
  // mirrors of a body make too many images, because they do not meet at 180°/n.
  Images(const std::vector<Mirror>& mirrors, const std::vector<Eigen::AlignedBox3d>& boxes, double reach);

  // The images of all bodies by these periods, as far as they may be within `reach` (m).
  Images(const std::vector<Period>& periods, double reach);

  // Numbers of the images of a body, ascending, without the body itself.
  const std::vector<int>& of_body(int body) const;
  const Reflection& operator[](int image) const { return all_[image]; }
  int count() const { return static_cast<int>(all_.size()); }

  // The ids of images are larger than those of all points.
  static constexpr int bits = 40;
  static std::int64_t id(std::int64_t original, int image) {
    return original + (static_cast<std::int64_t>(image) << bits);
  }
  static std::int64_t original(std::int64_t id) { return id & ((std::int64_t{1} << bits) - 1); }
  static int image(std::int64_t id) { return static_cast<int>(id >> bits); }

 private:
  std::vector<Reflection> all_{{}};
  std::vector<std::vector<int>> of_body_;
  std::vector<int> of_all_;  // of each body, by periods
};

}  // namespace strut
