// Planes and rigid tools among the boundary conditions: the keys of each shape and their reading.
#pragma once

#include "conditions/prototype.hpp"
#include "deck/forward.hpp"
#include "deck/keys.hpp"

namespace strut::deck {

Section symmetry_plane_section();
ConditionPrototype read_symmetry_plane(const Values& values, Problems& problems);

Section rigid_plane_section();
ConditionPrototype read_rigid_plane(const Values& values, Problems& problems);

Section rigid_cylinder_section();
ConditionPrototype read_rigid_cylinder(const Values& values, Problems& problems);

Section rigid_box_section();
ConditionPrototype read_rigid_box(const Values& values, Problems& problems);

Vector unit_vector(const Vector& direction);  // for any length; zero for zero

// A direction of unit length; reports a zero vector.
Vector read_direction(const Values& values, const VectorKey& key, Problems& problems);

}  // namespace strut::deck
