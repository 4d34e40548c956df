// Contact of points whose bonds break while they are nearer to each other than points that touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regression/bodies.hpp"
#include "regression/checkpoints.hpp"

namespace strut::regression {
namespace {

const Lattice block{.nx = 4, .ny = 4, .nz = 8};

const std::string surface =
    section("Models", section("m", key("Contact Model", "Surface") + key("Friction Coefficient", "0.2"))) +
    section("Interactions",
            section("barbar", key("First Block", "bar") + key("Second Block", "bar") + key("Contact Model", "m")));
const std::string penalty = contact_of({{"bar", "bar"}}, "1e-3", "1e11", "0.2");
const std::string hertz =
    contact_by(key("Contact Model", "Hertz") + key("Effective Modulus", "60e9"), {{"bar", "bar"}}, "1e-3", "0.2");

// A block whose points fail while two walls crush it to 6/10 of its height.
Parts crushed(const std::string& contact, const std::string& safety_factor) {
  Parts parts;
  parts.materials = copper(key("Yield Stress", "193e6"));
  parts.damage = section("tearing", key("Damage Model", "Plastic Strain") + key("Failure Strain", "0.3"));
  parts.blocks = section("metal", key("Block Names", "bar") + key("Material", "copper") + key("Horizon", "1.75e-3") +
                                      key("Damage Model", "tearing"));
  parts.contact = contact;
  const auto wall = [](const std::string& point, const std::string& normal, const std::string& motion) {
    return key("Type", "Rigid Plane") + key("Point", point) + key("Normal", normal) +
           key("Friction Coefficient", "0.2") + motion;
  };
  parts.conditions = section("top", wall("0 0 8e-3", "0 0 -1", key("Travel Z", "-20*t"))) +
                     section("bottom", wall("0 0 0", "0 0 1", ""));
  parts.times = key("Final Time", "160e-6");
  parts.verlet = key("Safety Factor", safety_factor);
  return parts;
}

// A contact that pressed as soon as bonds break would make energy: 0.4 % of the work here between surfaces, 37 to 150 %
// between points.
void expect_balance(const std::string& contact, double safety_factor) {
  const RunFolder folder(block);
  Simulation run(folder, crushed(contact, std::to_string(safety_factor)));
  double worst = 0;
  const Ledger end = run.go([&](const Ledger& now) { worst = std::max(worst, now.balance_error); });
  EXPECT_GT(end.fracture, 0);
  EXPECT_GT(-end.contact, 0.005 * end.tools);  // the pieces rub each other
  // Measured: up to 0.9e-3 at 0.5, 1.7e-3 at 0.8. The scheme is of second order in the step; at 0.25 the blow of the
  // walls in the first step is left.
  EXPECT_LT(worst, 1e-3 * std::max(1.0, std::pow(safety_factor / 0.5, 2)));
}

TEST(PressedBreaks, AreNotThrownApart) {
  for (const std::string& contact : {surface, penalty, hertz}) {
    for (const double safety_factor : {0.8, 0.5, 0.25}) expect_balance(contact, safety_factor);
  }
}

// After a checkpoint contact knows the bonds that its last search has known as broken, no others, and the distances at
// which pressed points touch: the same bits.
TEST(PressedBreaks, GoOnAfterACheckpoint) {
  for (const std::string& contact : {surface, penalty, hertz}) {
    const RunFolder folder(block);
    const auto works = expect_same_after_checkpoints(folder, crushed(contact, "0.5"), &Ledger::contact, 50, 20);
    EXPECT_GT(works.size(), 25 * 50u);
  }
}

// The same where single bonds of a point break, a few a step: an elastic block that is crushed in no time.
TEST(PressedBreaks, OfSingleBondsGoOnAfterACheckpoint) {
  for (const std::string& contact : {surface, penalty}) {
    const RunFolder folder(block);
    Parts parts = crushed(contact, "0.5");
    parts.materials = copper();
    parts.damage = section("tearing", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.02"));
    parts.conditions = changed(parts.conditions, "-20*t", "-200*t");
    parts.times = key("Final Time", "15e-6");
    const auto works = expect_same_after_checkpoints(folder, parts, &Ledger::contact, 20, 10);
    EXPECT_GT(works.size(), 100u);
  }
}

}  // namespace
}  // namespace strut::regression
