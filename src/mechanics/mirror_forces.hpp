// The forces of symmetry planes and of periodic sides: those that the images of points on the other side exert on a
// body.
#pragma once

#include <functional>

#include "base/archive.hpp"
#include "mechanics/body.hpp"

namespace strut {

// The force through the sides of each of domain.periods, along its axis, tension positive, N: the change of the bonds'
// energy with the period. Calls visit(owned point, number of the period, the point's part). Parameters, and when to
// call it: as mirror_forces.
void for_each_period_force(const Body& body, int level, const std::vector<int>* moved,
                           const std::function<void(int, std::size_t, double)>& visit);

// Number of a domain's sides (mirrors, or periods), and the index of a side's condition in the deck.
inline std::size_t side_count(const Domain& domain) { return domain.mirrors.size() + domain.periods.size(); }
inline int number_of_side(const Domain& domain, std::size_t side) {
  return domain.periods.empty() ? domain.mirrors[side].number : domain.periods[side].number;
}

// This rank's part of the force of each side, N: of domain.periods if there are any, as above, else of
// domain.mirrors along their normals. Call it after a sum of forces, before force_density changes. In a substep of
// `level`, only the forces on `moved` are current, and only points with a time-step level of at least `level` act.
std::vector<Vector> mirror_forces(const Body& body, int level = 0, const std::vector<int>* moved = nullptr);

void serialize_mirror_forces(Archive& archive, std::vector<Vector>& forces);

}  // namespace strut
