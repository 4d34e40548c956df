// Skin distances: how far points may move before the next search.
#pragma once

#include "contact/search/pairs.hpp"

namespace strut::contact {

// How far each of blocks.points may move, relative to a common motion, before the next search for pairs, m.
struct SkinDistances {
  std::vector<float> of;
  double largest = 0;  // over all ranks, without the larger ones of far points
};

// Points whose mean motion is the common one, which uses up no skin distance; indices of blocks.points.
using Frame = std::vector<int>;

// Collective. The points with partners, so that points near each other need only small skin distances. If these are
// very few, a sample of all points: any motion that is the same on all ranks is valid.
Frame frame_of(const Kinematics& kinematics, const BlockPair& blocks, const Pairs& pairs);

// Collective. Mean velocity of the frame, m/s.
Vector mean_velocity(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame);

// Collective. Skin distances for points that keep their velocities, proportional to their speed relative to the frame
// and within limits: `usual` (m) for a speed that few points exceed, so that these few do not decide when the next
// search is made. `dt`: of a step, s; 0 if unknown, which gives the usual one to all.
SkinDistances skin_distances_by_speed(const Kinematics& kinematics, const BlockPair& blocks,
                                      const Vector& mean_velocity, double usual, double dt);

// The largest fraction of its skin distance that a point of this rank uses per second, 1/s.
double largest_use(const Kinematics& kinematics, const BlockPair& blocks, const Vector& mean_velocity,
                   const SkinDistances& skins);

// Collective. The largest fraction of its skin distance that any point has used since `places`, relative to the motion
// of the frame.
double part_used(const Kinematics& kinematics, const BlockPair& blocks, const Frame& frame,
                 std::span<const Vector> places, const SkinDistances& skins);

}  // namespace strut::contact
