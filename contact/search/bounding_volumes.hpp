// Bounding volumes of cells and clusters of points. A test of two volumes rules out contact of all their points, for as
// many volumes at a time as a register has lanes (clusters.hpp).
#pragma once

#include <algorithm>
#include <vector>

#include "base/math/small_tensors.hpp"
#include "contact/laws/contact_law.hpp"

namespace strut::contact {

using small::Lanes;

// Margin, so that round-off in bounding volumes and registers never rules out a pair.
inline constexpr double round_off = 1e-9;

// A column of numbers that is read several at a time, from any index.
class Column {
 public:
  void add(double value) { values_.push_back(value); }
  void close() { values_.insert(values_.end(), small::lane_count, 0.0); }  // padding for reads of full lanes
  double operator[](std::size_t i) const { return values_[i]; }
  Lanes at(std::size_t i) const { return Eigen::Map<const Lanes>(values_.data() + i); }

 private:
  std::vector<double> values_;
};

struct Columns3 {
  Column c[3];

  void add(const Vector& v) {
    for (int k = 0; k < 3; ++k) c[k].add(v[k]);
  }
  void close() {
    for (Column& column : c) column.close();
  }
  Vector operator[](std::size_t i) const { return {c[0][i], c[1][i], c[2][i]}; }
};

// Points that move rigidly except for `spread`: y = place + rotation (X − reference).
struct BoundingVolume {
  Vector place, reference;  // of its center, m
  // The largest |y − place|, |X − reference|, deviation from the rigid motion, and skin distance; m.
  double radius, size, spread, skin;
  Tensor rotation;
};

// Distances at which points may touch: r_c, and the smallest horizon (0 between bodies); m.
struct Reach {
  double radius, horizon;
  double slack() const { return round_off * radius; }
};

inline Lanes squared_length(const Lanes* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

// Bounding volumes in columns, tested several at a time.
class BoundingVolumes {
 public:
  void add(const BoundingVolume& volume);
  void close();
  int count() const { return count_; }
  BoundingVolume operator[](int n) const;
  double skin(int n) const { return skin_[n]; }
  double largest_skin() const { return largest_skin_; }

  // For the volumes from n on, one per lane: not negative if no point of the volume can touch one of `one`.
  Lanes ruled_out(int n, const BoundingVolume& one, const Reach& reach) const;

 private:
  int count_ = 0;
  Columns3 place_, reference_;
  Column radius_, size_, spread_, skin_, rotation_[9];
  double largest_skin_ = 0;
};

inline void BoundingVolumes::add(const BoundingVolume& volume) {
  place_.add(volume.place), reference_.add(volume.reference);
  radius_.add(volume.radius), size_.add(volume.size), spread_.add(volume.spread), skin_.add(volume.skin);
  for (int n = 0; n < 9; ++n) rotation_[n].add(volume.rotation.data()[n]);
  largest_skin_ = std::max(largest_skin_, volume.skin);
  ++count_;
}

inline void BoundingVolumes::close() {
  place_.close(), reference_.close();
  for (Column* column : {&radius_, &size_, &spread_, &skin_}) column->close();
  for (Column& column : rotation_) column.close();
}

inline BoundingVolume BoundingVolumes::operator[](int n) const {
  Tensor R;
  for (int k = 0; k < 9; ++k) R.data()[k] = rotation_[k][n];
  return {place_[n], reference_[n], radius_[n], size_[n], spread_[n], skin_[n], R};
}

inline Lanes BoundingVolumes::ruled_out(int n, const BoundingVolume& one, const Reach& reach) const {
  Lanes apart[3];
  for (int k = 0; k < 3; ++k) apart[k] = place_.c[k].at(n) - one.place[k];
  const Lanes skins = skin_.at(n) + one.skin, radii = radius_.at(n) + one.radius;
  const Lanes far = squared_length(apart) - (reach.radius + reach.slack() + skins + radii).square();
  if (reach.horizon == 0 || !small::lanes_below_zero(far)) return far;
  Lanes xi[3], displacement[3], turn2 = Lanes::Zero();
  for (int k = 0; k < 3; ++k) {
    xi[k] = reference_.c[k].at(n) - one.reference[k];
    displacement[k] =
        one.rotation(0, k) * apart[0] + one.rotation(1, k) * apart[1] + one.rotation(2, k) * apart[2] - xi[k];
  }
  for (int k = 0; k < 9; ++k) turn2 += (rotation_[k].at(n) - one.rotation.data()[k]).square();
  const Lanes size = size_.at(n), sizes = size + one.size, spreads = spread_.at(n) + one.spread;
  const Lanes then = squared_length(xi).sqrt(), now = squared_length(apart).sqrt();
  const Lanes all_bonded = reach.horizon - (then + sizes);
  const Lanes lengths = then + now - 2 * sizes;
  const Lanes by_place = 2 * sizes * squared_length(displacement).sqrt() / lengths.max(1e-3 * reach.horizon);
  const Lanes nearer = now - then - by_place - size * turn2.sqrt() - spreads - skins;
  const Lanes undeformed =
      (nearer + ((1 - reference_fraction) * reach.horizon - reach.slack())).min(lengths - 0.5 * reach.horizon);
  return far.max(all_bonded).max(undeformed);
}

}  // namespace strut::contact
