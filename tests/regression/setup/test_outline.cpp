// What a run says of its scene before it begins: what a slip of units changes, and how many pieces there are.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/report.hpp"

namespace strut::regression {
namespace {

std::string told_of(const Parts& parts) {
  const RunFolder folder;
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  return describe_scene(set_up(deck, folder.world));
}

Parts flying() {
  Parts parts;
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-45.86") +
                     plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
  return parts;
}

void expect_told(const std::string& told, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(told.find(part), std::string::npos) << part << " in:\n" << told;
}

// 4 x 4 x 6 cubes of 1 mm of copper: 96e-9 m³ of 8930 kg/m³. √(E (1 − ν)/((1 + ν)(1 − 2ν) ρ)) = 4585.6 m/s.
TEST(Outline, HasBoxMassWaveSpeedAndSpeeds) {
  expect_told(told_of(flying()), {"1 connected piece;", "0.003 x 0.003 x 0.005 m", "mass 0.0008573 kg",
                                  "wave speed 4586 m/s", "speeds up to 45.86 m/s apart, 0.01 of it"});
  EXPECT_EQ(told_of(flying()).find("WARNING"), std::string::npos);
}

// A tool that comes is as good as a body that flies.
TEST(Outline, SeesToolsThatMove) {
  Parts parts;
  parts.conditions = section(
      "punch", key("Type", "Rigid Plane") + key("Point", "0 0 0") + key("Normal", "0 0 1") + key("Travel Z", "-3*t"));
  expect_told(told_of(parts), {"speeds up to 3 m/s apart"});
}

TEST(Outline, CountsPieces) {
  const RunFolder folder;
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  folder.write("points.txt", cubes(1, Vector(0, 0, 0), 3, 3, 3, 1e-3) + cubes(1, Vector(0, 0, 9e-3), 3, 3, 3, 1e-3) +
                                 cubes(1, Vector(0, 0, 20e-3), 3, 3, 3, 1e-3));
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  expect_told(describe_scene(set_up(deck, folder.world)), {"3 connected pieces;"});
}

TEST(Improbable, ModuliInMegapascalAreWarnedOf) {
  Parts parts = flying();
  parts.materials = changed(copper(), "117e9", "117e3");
  expect_told(told_of(parts),
              {"WARNING: block 'bar' has a wave speed of 4.586 m/s; solids have 100 to 20,000", "moduli in Pa"});
}

TEST(Improbable, DensityInGramsPerCubicCentimeterIsWarnedOf) {
  Parts parts = flying();
  parts.materials = changed(copper(), "8930", "8.93");
  expect_told(told_of(parts), {"WARNING: block 'bar' has a density of 8.93 kg/m³; solids have 10 to 30,000",
                               "2.7 g/cm³ are 2700", "WARNING: block 'bar' has a wave speed of 1.45e+05 m/s"});
}

}  // namespace
}  // namespace strut::regression
