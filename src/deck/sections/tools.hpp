// Planes and rigid tools among the boundary conditions: the keys of each shape and their reading.
#pragma once

#include "deck/forward.hpp"
#include "deck/keys.hpp"
#include "deck/sections/condition.hpp"

namespace strut::deck {

Section symmetry_plane_section();
void read_plane(const Values& values, Condition& condition, Problems& problems);

Section rigid_plane_section();
void read_rigid_plane(const Values& values, Condition& condition, Problems& problems);

Section rigid_cylinder_section();
void read_rigid_cylinder(const Values& values, Condition& condition, Problems& problems);

Section rigid_box_section();
void read_rigid_box(const Values& values, Condition& condition, Problems& problems);

// Of any length but zero; says so where it is zero.
Vector read_direction(const Values& values, const VectorKey& key, Problems& problems);

}  // namespace strut::deck
