// The variant of all conditions.
#pragma once

#include <type_traits>
#include <variant>

#include "conditions/body_force.hpp"
#include "conditions/condition_type.hpp"
#include "conditions/non_reflecting_end.hpp"
#include "conditions/prescribed_motion.hpp"
#include "conditions/rigid_tool.hpp"
#include "conditions/symmetry_plane.hpp"

namespace strut {

using Condition = std::variant<BodyForce, NonReflectingEnd, PrescribedMotion, SymmetryPlane, RigidTool>;

// Checks each alternative by itself, so that the compiler names the one that lacks something.
template <class Type>
struct Complete : std::true_type {
  static_assert(ConditionType<Type>, "this type does not state all that a condition must: condition_type.hpp");
};

template <class... Types>
consteval bool all_complete(std::type_identity<std::variant<Types...>>) {
  return (Complete<Types>::value && ...);
}
static_assert(all_complete(std::type_identity<Condition>()));

}  // namespace strut
