#include "contact/search/skin_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strut::contact {

namespace {

// The largest fraction of points that may be faster than the usual speed, and limits of a skin distance relative to the
// usual one: a wider one has more partners, and slow points may become faster.
constexpr double fast_fraction = 0.005, narrowest = 0.4, widest = 4;

// Searches this many steps apart cost little: no skin distance is larger than this interval requires.
constexpr double steps_between = 32;

// A frame consists of the points with partners if these are at least this fraction of all, so that it is not a fragment
// that flies off; else of one in `sampling` of all points.
constexpr double fewest = 0.01;
constexpr std::size_t sampling = 16;

// Collective. Mean of the vectors of(k) over the frame.
template <class Of>
Vector mean(const Communicator& communicator, const Frame& frame, const Of& of) {
  double sums[4] = {};
  for (const int k : frame) {
    const Vector v = of(k);
    for (int c = 0; c < 3; ++c) sums[c] += v[c];
    ++sums[3];
  }
  communicator.sum(sums);
  return Vector(sums[0], sums[1], sums[2]) / std::max(1.0, sums[3]);
}

// Collective. A speed that at most fast_fraction of the points exceed, found in steps of a factor 2^(1/4) down from the
// largest.
double usual_speed(const std::vector<double>& speeds, const Communicator& communicator) {
  double fastest[] = {0};
  for (const double v : speeds) fastest[0] = std::max(fastest[0], v);
  communicator.max(fastest);
  std::array<double, 64> counts{};  // by 4 log₂(largest/speed)
  for (const double v : speeds) {
    const double quarters = v > 0 ? 4 * std::log2(fastest[0] / v) : counts.size();  // NaN for infinite speeds
    ++counts[quarters > 0 ? static_cast<std::size_t>(std::min(quarters, counts.size() - 1.0)) : 0];
  }
  communicator.sum(counts);
  double all = 0, faster = 0, speed = fastest[0];
  for (const double count : counts) all += count;
  for (const double count : counts) {
    faster += count;
    if (faster > fast_fraction * all) break;
    speed *= std::exp2(-0.25);
  }
  return speed;
}

}  // namespace

Frame frame_of(const Kinematics& kinematics, const BlockPair& blocks, const Pairs& pairs) {
  double counts[] = {static_cast<double>(pairs.owned.size()), static_cast<double>(blocks.points.size())};
  kinematics.domain.communicator.sum(counts);
  Frame frame;
  if (counts[0] < fewest * counts[1]) {
    for (std::size_t k = 0; k < blocks.points.size(); k += sampling) frame.push_back(static_cast<int>(k));
    return frame;
  }
  for (const int i : pairs.owned) {
    const auto place = std::ranges::lower_bound(blocks.points, i);
    frame.push_back(static_cast<int>(place - blocks.points.begin()));
  }
  return frame;
}

Vector mean_velocity(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame) {
  return mean(kinematics.domain.communicator, frame, [&](int k) { return kinematics.velocities[blocks.points[k]]; });
}

SkinDistances skin_distances_by_speed(const Kinematics& kinematics, const BlockPair& blocks,
                                      const Vector& mean_velocity, double usual, double dt) {
  std::vector<double> speeds;
  speeds.reserve(blocks.points.size());
  for (const int i : blocks.points) speeds.push_back((kinematics.velocities[i] - mean_velocity).norm());
  const double speed = std::max(usual_speed(speeds, kinematics.domain.communicator),
                                dt > 0 ? usual / (steps_between * dt) : std::numeric_limits<double>::infinity());
  SkinDistances skins;
  double largest[] = {usual};
  for (const double v : speeds) {
    const double part = dt > 0 ? std::min(std::max(narrowest, v / speed), widest) : 1;  // the narrowest for NaN
    skins.of.push_back(static_cast<float>(part * usual));
    largest[0] = std::max<double>(largest[0], skins.of.back());
  }
  kinematics.domain.communicator.max(largest);
  skins.largest = largest[0];
  return skins;
}

double largest_use(const Kinematics& kinematics, const BlockPair& blocks, const Vector& mean_velocity,
                   const SkinDistances& skins) {
  double most = 0;  // squared
  for (std::size_t k = 0; k < skins.of.size(); ++k) {
    const double skin = skins.of[k];
    most = std::max(most, (kinematics.velocities[blocks.points[k]] - mean_velocity).squaredNorm() / (skin * skin));
  }
  return std::sqrt(most);
}

double part_used(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame,
                 std::span<const Vector> places, const SkinDistances& skins) {
  const auto displacement = [&](std::size_t k) -> Vector {
    return kinematics.domain.current(blocks.points[k]) - places[k];
  };
  const Vector together = mean(kinematics.domain.communicator, frame, displacement);
  double most[] = {0};
  for (std::size_t k = 0; k < places.size(); ++k) {
    most[0] = std::max(most[0], (displacement(k) - together).norm() / skins.of[k]);
  }
  kinematics.domain.communicator.max(most);
  return most[0];
}

}  // namespace strut::contact
