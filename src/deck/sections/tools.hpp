// Planes and rigid tools among the boundary conditions: the keys of each shape and their reading.
#pragma once

#include "conditions/prototype.hpp"
#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

std::vector<Case<ConditionPrototype, Problems&>> planes_and_tools();

Vector unit_vector(const Vector& direction);  // for any length; zero for zero

// A direction of unit length; reports a zero vector.
Vector read_direction(const Values& values, const VectorKey& key, Problems& problems);

}  // namespace strut::deck
