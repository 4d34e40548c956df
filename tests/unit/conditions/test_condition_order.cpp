// The order in which conditions act, whatever the order of the deck, and what each is in equilibria.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/errors.hpp"
#include "conditions/conditions.hpp"

namespace strut {
namespace {

const BodyForce weight{};
const NonReflectingEnd end{Vector::UnitZ(), {{3, 1, 1}, {4, 1, 1}}};
PrescribedMotion motion(const std::vector<int>& components) { return {{0, 1, 2}, components, Function(1), true, 3}; }
const SymmetryPlane cut{{1, 2}, Vector::UnitX(), 3};
const RigidTool floor{{0, 4}, HalfSpace{Vector::Zero(), Vector::UnitZ()}, {}};

// A letter for each type that is used here; others need none.
template <class Type>
std::string letter(const Type&) {
  return "?";
}
std::string letter(const BodyForce&) { return "f"; }
std::string letter(const NonReflectingEnd& end) { return "e" + std::to_string(end.drags.size()); }
std::string letter(const PrescribedMotion& motion) {
  std::string axes;
  for (const int c : motion.components) axes += "xyz"[c];
  return axes + std::to_string(motion.points.size());
}
std::string letter(const SymmetryPlane& plane) { return "p" + std::to_string(plane.points.size()); }
std::string letter(const RigidTool& tool) { return "t" + std::to_string(tool.points.size()); }

std::string in_order(const Conditions& conditions) {
  std::string all;
  conditions.visit([&](const auto& one) { all += letter(one) + " "; });
  return all;
}

Conditions all_of(const std::vector<Condition>& list) {
  Conditions conditions;
  for (const Condition& one : list) conditions.add(one);
  return conditions;
}

const Conditions everything = all_of({floor, motion({2}), cut, motion({0, 1}), end, weight});

TEST(Conditions, ActStageByStageAndInTheOrderOfTheDeckInEach) { EXPECT_EQ(in_order(everything), "f e2 z3 xy3 p2 t2 "); }

TEST(Conditions, ThatActInSubstepsKeepTheirOrderAndThePointsThatMove) {
  const std::vector<std::uint8_t> levels = {2, 0, 1, 1, 0};
  EXPECT_EQ(in_order(in_substeps(everything, {levels, 1})), "e1 z2 xy2 p1 t1 ");
  EXPECT_EQ(in_order(in_substeps(everything, {levels, 2})), "e0 z1 xy1 p0 t1 ");
}

TEST(Conditions, ThatNeedInertiaAreRefusedInEquilibria) {
  EXPECT_THROW(check_equilibria_possible(everything), Error);
  EXPECT_NO_THROW(check_equilibria_possible(all_of({weight, motion({0}), cut, floor})));
}

TEST(Conditions, ToolsAreTheOnesOfEquilibriaToo) {
  const std::vector<RigidTool> tools = tools_of(everything);
  ASSERT_EQ(tools.size(), 1u);
  EXPECT_EQ(tools[0].points, floor.points);
}

}  // namespace
}  // namespace strut
