// How far points may go before the next search.
#pragma once

#include "contact/search/pairs.hpp"

namespace strut::contact {

// How far each of blocks.points may go, beside a motion that all of them share, before pairs are searched for again, m.
struct SkinDistances {
  std::vector<float> of;
  double largest = 0;  // over all ranks; those of far points are larger
};

// What moves with the mean of some points uses up no skin distance. These points, as indices of blocks.points.
using Frame = std::vector<int>;

// Collective. Points that have partners: the skin distances of those that are near each other should be small. While
// these are very few, some of all: any motion that is the same on all ranks will do.
Frame frame_of(const Kinematics& kinematics, const BlockPair& blocks, const Pairs& pairs);

// Collective. Of the frame, m/s.
Vector mean_velocity(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame);

// Collective. Skin distances for points that go on as they do, in proportion to their speed beside the frame: `usual`
// (m) for a speed that few exceed, so that these do not decide when the next search is due, and within limits.
// `dt`: of a step, s; 0 if that is not known, and all skin distances are the usual one.
SkinDistances skin_distances_by_speed(const Kinematics& kinematics, const BlockPair& blocks,
                                      const Vector& mean_velocity, double usual, double dt);

// The largest part of its skin distance that a point of this rank uses in a second, 1/s.
double largest_use(const Kinematics& kinematics, const BlockPair& blocks, const Vector& mean_velocity,
                   const SkinDistances& skins);

// Collective. The largest part of its skin distance that any point has used on its way from `places`,
// beside the frame's.
double part_used(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame,
                 std::span<const Vector> places, const SkinDistances& skins);

}  // namespace strut::contact
