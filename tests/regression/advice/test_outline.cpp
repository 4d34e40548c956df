// The lines of a run about its scene before it begins: they reveal wrong units, and count the pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "regression/stretched.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

std::string described(const deck::Deck& deck, const Communicator& world) {
  const Scene scene = set_up(deck, world);
  return describe_scene(scene, advice(deck, scene));
}

std::string told_of(const Parts& parts) {
  const RunFolder folder;
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  return described(deck, folder.world);
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

// A wall at rest takes 1/n of the kinetic energy of an elastic bar of n layers.
TEST(Outline, TellsWhatAToolTakesFromAThrownBody) {
  Parts parts;
  parts.conditions =
      along("flight", "Initial Velocity", "all", "z", "-20") + plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1");
  expect_told(told_of(parts), {"the tool 'wall' stops the layer of points of 'bar' that meets it at once: about "
                               "17 % of the kinetic energy"});
  parts.conditions = changed(parts.conditions, "-20", "20");
  EXPECT_EQ(told_of(parts).find("stops the layer"), std::string::npos);
}

TEST(Outline, CountsPieces) {
  const RunFolder folder;
  Parts parts;
  parts.mesh_type = "Text File";
  parts.mesh_file = "points.txt";
  folder.write("points.txt", cubes(1, Vector(0, 0, 0), 3, 3, 3, 1e-3) + cubes(1, Vector(0, 0, 9e-3), 3, 3, 3, 1e-3) +
                                 cubes(1, Vector(0, 0, 20e-3), 3, 3, 3, 1e-3));
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  expect_told(described(deck, folder.world), {"3 connected pieces;"});
}

TEST(Improbable, ModuliInMegapascalAreWarnedOf) {
  Parts parts = flying();
  parts.materials = changed(copper(), "117e9", "117e3");
  expect_told(told_of(parts),
              {"WARNING: block 'bar' has a wave speed of 4.586 m/s; solids have 100 to 20,000", "moduli in Pa"});
}

TEST(Improbable, SoftSpringsOfElastomersAreWarnedOf) {
  for (const std::string coefficient : {"0.01", "0.2", ""}) {
    Parts parts = flying();
    parts.materials = section("copper", key("Material Model", "Hyperelastic") + key("Density", "1100") +
                                            key("Bulk Modulus", "5e6") + key("Shear Modulus", "1e6") +
                                            (coefficient.empty() ? "" : key("Stabilization Coefficient", coefficient)));
    const bool warned =
        told_of(parts).find("Stabilization Coefficient of 0.01; the default is 0.3") != std::string::npos;
    EXPECT_EQ(warned, coefficient == "0.01");
  }
}

// At nodes 20 plateaus over E, for a plateau of E/300.
TEST(Improbable, SoftSpringsOfFoamsAreWarnedOf) {
  for (const std::string coefficient : {"0.01", "0.05", ""}) {
    Parts parts = flying();
    parts.points = "Nodes";
    parts.materials = section("copper", key("Material Model", "Metal Foam Correspondence") + key("Density", "150") +
                                            key("Young's Modulus", "300e6") + key("Poisson's Ratio", "0") +
                                            key("Alpha", "2") + key("Plateau Stress", "1e6") +
                                            key("Linear Hardening", "0") + key("Locking Stress", "2e6") +
                                            key("Locking Exponent", "8") + key("Densification Strain", "1") +
                                            (coefficient.empty() ? "" : key("Stabilization Coefficient", coefficient)));
    const bool warned =
        told_of(parts).find("Stabilization Coefficient of 0.01; the default is 0.067") != std::string::npos;
    EXPECT_EQ(warned, coefficient == "0.01");
  }
}

// In 10 ms the elastomer keeps 0.05 of its shear modulus, in 1 µs nearly all of it. The coefficient that fits is the
// default of neo-Hooke with what is left, 4·0.05 MPa, in units of the fast moduli, 20 MPa + 4/3 MPa, within the limits.
TEST(Improbable, SpringsThatDoNotRelaxWithTheirElastomerAreWarnedOf) {
  const auto told = [](const std::string& more, const char* until) {
    Parts parts = flying();
    parts.materials = section("copper", key("Material Model", "Hyperelastic") + key("Density", "1100") +
                                            key("Bulk Modulus", "20e6") + key("Shear Modulus", "1e6") + more +
                                            section("Relaxation", key("Fractions", "0.95") + key("Times", "1e-4")));
    parts.times = key("Final Time", until);
    return told_of(parts);
  };
  const std::string not_relax = "the springs of its stabilization do not relax", soft = "the default is";
  expect_told(told("", "1e-2"),
              {"block 'bar': its elastomer relaxes to 0.05 of its shear modulus in the run, but " + not_relax,
               "a Stabilization Coefficient of 0.0094"});
  EXPECT_EQ(told("", "1e-6").find(not_relax), std::string::npos) << "too short";
  const std::string fitting = told(key("Stabilization Coefficient", "0.0094"), "1e-2");
  EXPECT_EQ(fitting.find(not_relax), std::string::npos) << fitting;
  EXPECT_EQ(fitting.find(soft), std::string::npos) << fitting;
  expect_told(told(key("Stabilization Coefficient", "0.0094"), "1e-6"), {soft});
  EXPECT_EQ(told(key("Formulation", "Quadratic Correspondence"), "1e-2").find(not_relax), std::string::npos);
}

// A rubber with a small bulk modulus has 32 m/s; with its moduli in kPa it would have 1.
TEST(Improbable, SoftRubberIsProbable) {
  for (const bool in_pascal : {true, false}) {
    Parts parts = flying();
    parts.materials = section("copper", key("Material Model", "Hyperelastic") + key("Density", "1100") +
                                            key("Bulk Modulus", in_pascal ? "1e6" : "1e3") +
                                            key("Shear Modulus", in_pascal ? "1e5" : "1e2"));
    const bool warned = told_of(parts).find("m/s; elastomers have 10 to 20,000") != std::string::npos;
    EXPECT_EQ(warned, !in_pascal);
  }
}

TEST(Improbable, DensityInGramsPerCubicCentimeterIsWarnedOf) {
  Parts parts = flying();
  parts.materials = changed(copper(), "8930", "8.93");
  expect_told(told_of(parts), {"WARNING: block 'bar' has a density of 8.93 kg/m³; solids have 10 to 30,000",
                               "2.7 g/cm³ are 2700", "WARNING: block 'bar' has a wave speed of 1.45e+05 m/s"});
}

// A metal yields at some 1e-3 of its modulus; 400 where 400e6 were meant, and 400e9, do not.
TEST(Improbable, YieldStressIsComparedWithTheModulus) {
  Parts parts = flying();
  for (const auto& [yield, told] : {std::pair("400e9", "yields at 3.419 of its Young's modulus"),
                                    std::pair("400", "yields at 3.419e-09 of its Young's modulus")}) {
    parts.materials = copper(key("Yield Stress", yield));
    expect_told(told_of(parts), {told, "are both in Pa (50 MPa are 50e6)?"});
  }
  for (const char* yield : {"400e6", "0.09e11"}) {
    parts.materials = copper(key("Yield Stress", yield));
    EXPECT_EQ(told_of(parts).find("WARNING"), std::string::npos) << yield;
  }
}

// Copper melts at 1356 K and softens from 293 K on.
TEST(Improbable, InitialTemperaturesOfAMeltOrInCelsiusAreWarnedOf) {
  const std::string softening = section("Softening", key("Type", "Johnson-Cook") + key("Reference Temperature", "293") +
                                                         key("Melting Temperature", "1356") + key("Exponent", "1"));
  const auto told_at = [&](const std::string& temperature, const std::string& failure = "") {
    Parts parts = flying();
    parts.materials = copper(key("Yield Stress", "400e6") + softening);
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                        key("Initial Temperature", temperature) + failure);
    return told_of(parts);
  };
  for (const char* hot : {"2000", "1356"})
    expect_told(told_at(hot), {std::string("WARNING: block 'bar' has an Initial Temperature of ") + hot +
                               " K, at which its metal is molten: its flow stress is 0 Pa; is it in K?"});
  expect_told(told_at("20"),
              {"WARNING: block 'bar' has an Initial Temperature of 20 K, which is -253.1 °C: is it in K"});
  expect_told(told_at("200"), {"200 K, below the Reference Temperature of 293 K at which its softening begins"});
  for (const char* usual : {"293", "273.15", "718", "1200"})
    EXPECT_EQ(told_at(usual).find("WARNING"), std::string::npos) << usual;
}

// Copper of 90 MPa, whatever further keys say, at the temperature of the start.
std::string told_of_copper(const std::string& keys, const std::string& of_block = "",
                           const std::string& sections = "") {
  Parts parts = flying();
  parts.materials = copper(key("Yield Stress", "90e6") + keys);
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") + of_block);
  const RunFolder folder;
  const std::string text = changed(parts.text(), "<ParameterList>\n", "<ParameterList>\n" + sections);
  return described(deck::read(folder.write("deck.xml", text), folder.world), folder.world);
}

// T* = (293 - 25)/(1083 - 25) = 0.2533: θ = 0.7467.
TEST(Improbable, TemperaturesOfAMaterialInCelsiusAreWarnedOf) {
  const auto softening = [](const std::string& from, const std::string& to) {
    return section("Softening", key("Type", "Johnson-Cook") + key("Reference Temperature", from) +
                                    key("Melting Temperature", to) + key("Exponent", "1"));
  };
  expect_told(
      told_of_copper(softening("25", "1083")),
      {"softens from a Reference Temperature of 25 K on, which is -248.1 °C", "293 K it has 0.7467 of its flow"});
  EXPECT_EQ(told_of_copper(softening("298", "1356")).find("WARNING"), std::string::npos);
  expect_told(told_of_copper(softening("293", "327")),
              {"has a Melting Temperature of 327 K; metals have more than 400"});
  const std::string slope = key("Shear Modulus Slope", "4e-4");
  expect_told(told_of_copper(slope + key("Shear Modulus Temperature", "20")),
              {"Shear Modulus Temperature of 20 K, which"});
  EXPECT_EQ(told_of_copper(slope).find("WARNING"), std::string::npos);
  expect_told(told_of_copper(key("Shear Modulus Slope", "4e-3"), key("Initial Temperature", "800")),
              {"has a tenth of its shear modulus at 800 K"});
  const auto failing = [&](const std::string& from, const std::string& to) {
    return told_of_copper(
        softening("298", "1356"), key("Damage Model", "f"),
        section("Damage Models",
                section("f", key("Damage Model", "Johnson-Cook") + key("D1", "0.54") + key("D2", "4.89") +
                                 key("D3", "-3.03") + key("D5", "1.12") + key("Reference Temperature", from) +
                                 key("Melting Temperature", to))));
  };
  expect_told(failing("298", "933"),
              {"Melting Temperature of 1356 K, and D5 of its Damage Model acts between 298 and 933"});
  EXPECT_EQ(failing("298", "1356").find("D5"), std::string::npos);
}

// Cells beside a gradual crack bear no shear: faces that meet again give way.
TEST(Cracks, FacesOfGradualOnesThatMayTouchAreWarnedOf) {
  const auto told_with = [](const std::string& model, const std::string& contact) {
    Parts parts = flying();
    parts.materials = changed(copper(), "Elastic Correspondence\"/>\n",
                              "Elastic Correspondence\"/>\n" + key("Formulation", "Quadratic Correspondence"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                        key("Damage Model", "breaks"));
    parts.damage = section("breaks", key("Damage Model", model) + key("Fracture Energy", "100"));
    if (!contact.empty()) {
      parts.contact = section("Models", section("m", key("Contact Model", "Surface"))) +
                      section("Interactions", section(contact, key("Contact Model", "m")));
    }
    const RunFolder folder;
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string warning = "the cells beside such a crack bear pressure, but a thousandth of their shear";
  expect_told(told_with("Cohesive Crack", "Self Contact"), {"block 'bar' has contact", warning});
  EXPECT_EQ(told_with("Cohesive Crack", "").find(warning), std::string::npos);
  expect_told(told_with("Critical Stretch", "Self Contact"), {"stress falls before bonds break", warning});
}

// One critical stretch takes another energy than is given where cracks open between two layers.
TEST(Cracks, OfAFractureEnergyAreGradualWherePointsCanSoften) {
  const auto told = [](const std::string& of_material, const std::string& factor) {
    Parts parts = flying();
    parts.materials = changed(copper(), "Elastic Correspondence\"/>\n", "Elastic Correspondence\"/>\n" + of_material);
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Horizon Factor", factor) + key("Damage Model", "breaks"));
    parts.damage = section("breaks", key("Damage Model", "Critical Stretch") + key("Fracture Energy", "100"));
    const RunFolder folder;
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string gradual = "stress falls before bonds break", warning = "take 0.4 to 0.95 of the Fracture Energy";
  expect_told(told("", "1.75"), {gradual});
  expect_told(told(key("Formulation", "Quadratic Correspondence"), "1.75"), {gradual});
  for (const std::string& text : {told("", "3.015"), told(key("Stabilization", "Silling"), "3.015")}) {
    EXPECT_EQ(text.find(gradual), std::string::npos);
    EXPECT_EQ(text.find(warning), std::string::npos);
  }
  expect_told(told(key("Stabilization", "Silling"), "1.75"), {warning});
}

TEST(Improbable, ExpansionFrictionAndWeightInOtherUnitsAreWarnedOf) {
  const auto expands = [](const std::string& by) { return told_of_copper(key("Thermal Expansion Coefficient", by)); };
  expect_told(expands("16.5e-3"), {"has a Thermal Expansion Coefficient of 0.0165 1/K; solids have less than 1e-3"});
  EXPECT_EQ(expands("300e-6").find("solids have less"), std::string::npos);
  const auto told = [](const std::string& friction, const std::string& load) {
    Parts parts;
    parts.conditions = along("weight", "Body Force", "all", "z", load) +
                       section("floor", key("Type", "Rigid Plane") + key("Point", "0 0 0") + key("Normal", "0 0 1") +
                                            key("Friction Coefficient", friction));
    return told_of(parts);
  };
  expect_told(told("20", "-9.81"),
              {"WARNING: a Friction Coefficient is 20; of solids it is 0 to 2",
               "weight > Value is -9.81 N/m³, a force per volume: the weight of 1 m³ of block 'bar' is 87603.3 N"});
  EXPECT_EQ(told("2", "-87603").find("WARNING"), std::string::npos);
}

TEST(Improbable, HeatsAndHardeningInOtherUnitsAreWarnedOf) {
  const auto heating = [](const std::string& heat) { return section("Heating", key("Specific Heat", heat)); };
  expect_told(told_of_copper(heating("0.383")), {"has a Specific Heat of 0.383 J/(kg K)"});
  EXPECT_EQ(told_of_copper(heating("383")).find("WARNING"), std::string::npos);
  const auto hardening = [](const std::string& modulus) {
    return section("Hardening", key("Type", "Linear") + key("Hardening Modulus", modulus));
  };
  expect_told(told_of_copper(hardening("900")), {"hardens by 1e-05 of its yield stress until a plastic strain of 1"});
  for (const char* usual : {"0", "90e6"})
    EXPECT_EQ(told_of_copper(hardening(usual)).find("WARNING"), std::string::npos) << usual;
}

// 8930 kg/m³ times the squares of 3940 and 6000 m/s are 138.6 and 321.5 GPa; K of the elastic constants is 130 GPa.
TEST(Improbable, BulkModuliThatDifferAreWarnedOf) {
  const auto equation = [](const std::string& speed) {
    return section("Equation of State", key("Type", "Mie-Gruneisen") + key("Sound Speed", speed) +
                                            key("Hugoniot Slope", "1.49") + key("Gruneisen Parameter", "2"));
  };
  expect_told(told_of_copper(equation("6000")),
              {"Equation of State has a bulk modulus of 3.215e+11 Pa, the elastic constants one of 1.3e+11 Pa"});
  EXPECT_EQ(told_of_copper(equation("3940")).find("WARNING"), std::string::npos);
}

// The bar is 4 x 4 x 6 mm.
TEST(WithoutEffect, CracksModelsAndSetsThatChangeNothingAreToldOf) {
  const auto disk = [](const std::string& z) {
    std::string keys = key("Type", "Disk") + key("Radius", "1") + key("Center_Z", z);
    for (const char* zero : {"Normal_X", "Normal_Y", "Center_X", "Center_Y"}) keys += key(zero, "0");
    return section("crack" + z, keys + key("Normal_Z", "1"));
  };
  const auto told_with = [&](const std::string& cracks, const std::string& set) {
    Parts parts = flying();
    parts.node_sets = key("part", set);
    parts.materials += changed(parts.materials, "\"copper\"", "\"spare\"");
    const RunFolder folder;
    const std::string models = section(
        "Damage Models", section("tears", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.1")));
    std::string text = changed(parts.text(), "<ParameterList>\n", "<ParameterList>\n" + models);
    text = changed(text, "<ParameterList name=\"Discretization\">",
                   "<ParameterList name=\"Discretization\">" + section("Bond Filters", cracks));
    return described(deck::read(folder.write("deck.xml", text), folder.world), folder.world);
  };
  const std::string told = told_with(disk("3e-3") + disk("3"), "z &lt; 3");
  expect_told(told, {"Materials > spare: no section of Blocks names it: it has no effect",
                     "Damage Models > tears: no section of Blocks names it",
                     "the crack around (0, 0, 3) m cuts no bond", "Node Sets > part: holds all points"});
  EXPECT_EQ(told.find("(0, 0, 0.003) m cuts"), std::string::npos) << told;
  EXPECT_EQ(told_with(disk("3e-3"), "z &lt; 3e-3").find("holds all"), std::string::npos);
}

TEST(Temperatures, BelowZeroAreToldOf) {
  const auto told = [](const std::string& value) {
    Parts parts;
    parts.materials = changed(parts.materials, "Density",
                              "Thermal Expansion Coefficient\" type=\"double\" "
                              "value=\"1e-5\"/>\n<Parameter name=\"Density");
    parts.conditions =
        section("cooling", key("Type", "Prescribed Temperature") + key("Node Set", "all") + key("Value", value));
    return told_of(parts);
  };
  expect_told(told("293 - 1e8*t"), {"WARNING: Boundary Conditions > cooling > Value is -207 K: is it in K"});
  EXPECT_EQ(told("293 - 1e7*t").find("is it in K"), std::string::npos);
}

// Each number stands at two of 96 elements: found on any number of ranks.
TEST(DoubledNumbers, AreToldOf) {
  const RunFolder folder;
  const deck::Deck deck = deck::read(folder.write("deck.xml", flying().text()), folder.world);
  const auto warnings = [&](std::int64_t alike) {
    deck::Problems problems;
    PointCloud cloud = mesh_of(deck, folder.world, problems);
    for (std::int64_t& number : cloud.element_ids) number = 7 + (number - 1) / alike;
    return advice(deck, set_up(deck, std::move(cloud), folder.world)).warnings;
  };
  expect_told(warnings(2), {"gives the number 7 to more than one element, and so on, 48 times in all"});
  EXPECT_EQ(warnings(1).find("more than one element"), std::string::npos);
}

std::string told_of_cubes(double spacing, const std::string& final_time) {
  const RunFolder folder;
  Parts parts = flying();
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.times = key("Final Time", final_time);
  parts.blocks.clear();
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "2.01"));
  folder.write("points.txt", cubes(1, Vector::Zero(), 4, 4, 6, spacing));
  return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
}

// 5 spacings between the outermost points; waves go 4586 m/s, in 5 µs 0.0229 m.
TEST(Improbable, MillimetersThatAreTakenForMetersAreWarnedOf) {
  expect_told(told_of_cubes(1, "5e-6"), {"WARNING: the bodies are 5 m long, and in the 5e-06 s of the run a wave goes "
                                         "0.02293 m: are lengths of the mesh in m, not in mm?"});
  expect_told(told_of_cubes(1e3, "1"), {"WARNING: the bodies are 5000 m long: are lengths of the mesh in m?"});
  expect_told(told_of_cubes(1e-9, "1e-14"), {"WARNING: the bodies are 5e-09 m long"});
  for (const auto& [spacing, time] : {std::pair(1e-3, "5e-6"), std::pair(1.0, "5e-3")})
    EXPECT_EQ(told_of_cubes(spacing, time).find("WARNING"), std::string::npos) << spacing;
}

// 96 m³ of copper: in equilibria, and where waves cross the body a thousand times.
TEST(Improbable, MillimetersThatAreTakenForMetersAreWarnedOfInSlowRuns) {
  const std::string told = "5 m long and weigh 8.573e+05 kg: are lengths of the mesh in m, not in mm?";
  expect_told(told_of_cubes(1, "1"), {told});
  EXPECT_EQ(told_of_cubes(1e-3, "1e-3").find("WARNING"), std::string::npos);
}

TEST(Improbable, SpeedsAboveTheWaveSpeedAreWarnedOf) {
  Parts parts = flying();
  for (const auto& [speed, warned] : {std::pair("-4500", false), std::pair("-4700", true)}) {
    parts.conditions =
        along("flight", "Initial Velocity", "all", "z", speed) + plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
    const std::string told = told_of(parts);
    EXPECT_EQ(told.find("more than the wave speed of 4586 m/s") != std::string::npos, warned) << told;
  }
}

// In an elastic cube whose halves part at a tenth of the wave speed the balance of energy is off by a tenth (measured,
// by either sign); metal flows, viscosity takes what rings, and a fixed step does not fall.
TEST(LargeElasticStrains, AreToldOf) {
  const auto tells = [](const Parts& of) { return told_of(of).find("of its wave speed apart") != std::string::npos; };
  Parts parts = flying();
  EXPECT_FALSE(tells(parts)) << "a hundredth";
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-458.6*z/5e-3");
  EXPECT_TRUE(tells(parts));
  Parts flows = parts, viscous = parts, fixed = parts;
  flows.materials = copper(key("Yield Stress", "1e8"));
  viscous.materials =
      changed(copper(), key("Density", "8930"), key("Density", "8930") + key("Linear Viscosity", "0.1"));
  fixed.verlet = key("Fixed dt", "1e-8");
  EXPECT_FALSE(tells(flows));
  EXPECT_FALSE(tells(viscous));
  EXPECT_FALSE(tells(fixed));
}

// K > 5/3 G is a Poisson's ratio above 1/4.
TEST(BreaksUnderPressure, AreToldOfWhereTheyMayGiveEnergy) {
  const std::string by_energy = key("Damage Model", "Bond Energy") + key("Fracture Energy", "1e5"),
                    by_stretch = key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.01");
  const auto tells = [](const std::string& model, const std::string& ratio, const std::string& damage,
                        const std::string& words) {
    Parts parts;
    parts.materials = section("copper", key("Material Model", model) + key("Density", "8930") +
                                            key("Young's Modulus", "117e9") + key("Poisson's Ratio", ratio));
    parts.damage = section("tough", damage);
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                        key("Damage Model", "tough"));
    return told_of(parts).find(words + " under pressure may give some energy") != std::string::npos;
  };
  EXPECT_TRUE(tells("Elastic", "0.3", by_energy, "several that break in one step"));
  EXPECT_FALSE(tells("Elastic", "0.25", by_energy, ""));
  EXPECT_FALSE(tells("Elastic", "0.2", by_energy, ""));
  EXPECT_TRUE(tells("Elastic", "0.3", by_stretch, "some that break"));
  EXPECT_FALSE(tells("Elastic", "0.25", by_stretch, ""));
  EXPECT_FALSE(tells("Elastic Correspondence", "0.3", by_stretch, ""));
}

TEST(CriticalStretch, InPercentIsToldOf) {
  const auto tells = [](const std::string& value) {
    Parts parts;
    parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", value));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                        key("Damage Model", "brittle"));
    const std::string sentence = "brittle > Critical Stretch: 2, so bonds break at 3 times their length";
    return told_of(parts).find(sentence) != std::string::npos;
  };
  EXPECT_TRUE(tells("2"));
  EXPECT_FALSE(tells("0.02"));
}

// 4 x 4 points of the lowest layer have their centers 0.5 mm above z = 0, of the next 1.5 mm.
TEST(Tools, ThatAreInsideOfABodyAtTheStartAreToldOf) {
  Parts parts;
  parts.conditions = plane("floor", "Rigid Plane", "all", "0 0 1.7e-3", "0 0 1");
  expect_told(told_of(parts), {"WARNING: 32 points are inside of the tool 'floor' at the start, up to 0.0012 m deep"});
  parts.conditions = plane("floor", "Rigid Plane", "all", "0 0 0.4e-3", "0 0 1");  // inside of cells alone
  expect_told(told_of(parts), {"WARNING: the tool 'floor' stands in the cells of 16 points at the start, up to 0.0004 "
                               "m deep: bodies are taken as cut off there"});
  parts.conditions = plane("floor", "Rigid Plane", "all", "0 0 0.01e-3", "0 0 1");
  EXPECT_EQ(told_of(parts).find("WARNING"), std::string::npos);
}

// A tool that the checkpoint does not know cuts the cells of the body as it has become.
TEST(Tools, ThatAreNewInALaterRunAreToldOf) {
  const RunFolder folder;
  Parts parts;
  parts.times = key("Final Time", "1e-8");
  const auto told = [&](const std::string& name, const std::string& more) {
    const std::string restart = section("Restart", key("Filename", (folder / (name + ".restart")).string()));
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(
        folder.write(name + ".xml", changed(parts.text(), "<ParameterList>\n", "<ParameterList>\n" + restart + more)),
        folder.world, Start::anew));
    return testing::internal::GetCapturedStdout();
  };
  told("first", "");
  parts.times = key("Initial Time", "1e-8") + key("Final Time", "2e-8");
  parts.conditions = plane("floor", "Rigid Plane", "all", "0 0 0.4e-3", "0 0 1");
  const std::string said =
      told("second", section("Start From", key("Checkpoint", (folder / "first.restart").string())));
  if (folder.world.rank() == 0)
    expect_told(said, {"the tool 'floor' stands in the cells of 16 points at the start, up to 0.0004"});
}

// The reaches of tetrahedra are estimates, larger than from the center to a face.
TEST(Tools, ThatTouchTetrahedraStandInNone) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { io::write_mesh(folder / "tetrahedra.g", in_tetrahedra(Lattice().mesh())); });
  Parts parts;
  parts.mesh_file = "tetrahedra.g";
  parts.conditions = plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  EXPECT_EQ(described(deck, folder.world).find("stands in the cells"), std::string::npos);
}

std::string told_of_tool(const std::string& type, const std::string& keys, const std::string& more = "",
                         const std::string& final_time = "5e-6") {
  Parts parts;
  parts.conditions = section("tool", key("Type", type) + keys) + more;
  parts.times = key("Final Time", final_time);
  return told_of(parts);
}

std::string box(const std::string& lower, const std::string& upper) {
  return key("Lower Corner", lower) + key("Upper Corner", upper) + key("Travel Z", "-10*t");
}

// The bar's upper face is at z = 6 mm, its points 1 mm apart: 1.5 mm is the limit.
TEST(Tools, ThatAreThinnerThanPointsAreApartAreWarnedOf) {
  const auto is_thin = [](const std::string& told) { return told.find("tools stop points only") != std::string::npos; };
  expect_told(
      told_of_tool("Rigid Box", box("1.95e-3 -1 6e-3", "2.05e-3 1 9e-3")),
      {"WARNING: the tool 'tool' is 0.0001 m wide along x, less than 1.5 spacings of block 'bar' (0.001 m each), "
       "which it can reach: tools stop points only, and this one passes between them; expected 0.0015 m or more"});
  EXPECT_TRUE(is_thin(told_of_tool("Rigid Box", box("-1 1.95e-3 6e-3", "1 3.4e-3 9e-3"))));
  EXPECT_FALSE(is_thin(told_of_tool("Rigid Box", box("-1 1.95e-3 6e-3", "1 3.46e-3 9e-3")))) << "thick enough";
  EXPECT_FALSE(is_thin(told_of_tool("Rigid Box", box("-1 -1 6e-3", "1 1 6.1e-3")))) << "a plate comes by its face";
  EXPECT_FALSE(is_thin(told_of_tool("Rigid Box", box("3.4e-3 -1 6e-3", "9e-3 1 9e-3")))) << "an edge of a thick one";
  EXPECT_FALSE(is_thin(told_of_tool("Rigid Box", box("1.95e-3 -1 16e-3", "2.05e-3 1 19e-3")))) << "it stays away";
  const auto roll = [](const std::string& radius) {
    return key("Point", "2e-3 0 7e-3") + key("Axis", "1 2 0") + key("Radius", radius);
  };
  expect_told(told_of_tool("Rigid Cylinder", roll("0.74e-3")), {"the tool 'tool' is 0.00148 m in diameter, less than"});
  EXPECT_FALSE(is_thin(told_of_tool("Rigid Cylinder", roll("0.76e-3"))));
}

// Columns 4 mm apart along x, 1 mm along y.
TEST(Tools, ThatAreThinnerThanColumnsAreApartAreWarnedOf) {
  const Lattice lattice;
  const RunFolder folder(lattice);
  write_stretched(folder, lattice, {4, 1, 1});
  const auto told = [&](const std::string& lower, const std::string& upper) {
    Parts parts;
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "8.1e-3"));
    parts.conditions = section("tool", key("Type", "Rigid Box") + box(lower, upper));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  expect_told(told("6.3e-3 -1 6e-3", "9.7e-3 1 9e-3"),
              {"the tool 'tool' is 0.0034 m wide along x, less than 1.5 spacings of block 'bar' (0.004 m each)"});
  EXPECT_EQ(told("4e-3 -1 6e-3", "11e-3 1 9e-3").find("tools stop points only"), std::string::npos);
  EXPECT_EQ(told("-1 1.2e-3 6e-3", "1 2.8e-3 9e-3").find("tools stop points only"), std::string::npos);
}

// Nodes of tetrahedra are 1 mm apart in all directions: by the moments of their cells it would be 1.1 to 1.8 mm.
TEST(Tools, ThatAreThickerThanNodesOfTetrahedraAreApartAreNotWarnedOf) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { io::write_mesh(folder / "tetrahedra.g", in_tetrahedra(Lattice().mesh())); });
  Parts parts;
  parts.mesh_file = "tetrahedra.g", parts.points = "Nodes";
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Fracture Energy", "1e4"));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Damage Model", "brittle"));
  const auto told = [&](const std::string& upper_x) {
    parts.conditions = section("tool", key("Type", "Rigid Box") + box("1.95e-3 -1 6e-3", upper_x + " 1 9e-3"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  expect_told(told("3.44e-3"), {"less than 1.5 spacings of block 'bar' (0.001 m each)"});
  const std::string of_thick_tool = told("3.46e-3");
  EXPECT_EQ(of_thick_tool.find("tools stop points only"), std::string::npos) << of_thick_tool;
  EXPECT_EQ(of_thick_tool.find("its cells are no cubes"), std::string::npos) << of_thick_tool;
}

// The lowest cells end 2 mm above the floor, which the bar reaches at 20 µs with 100 m/s: in the 43rd of 100 uneven
// parts.
TEST(Tools, ThatAreApartFromAllPointsAreToldOf) {
  const std::string floor = key("Point", "0 0 -2e-3") + key("Normal", "0 0 1");
  const std::string flight = along("flight", "Initial Velocity", "all", "z", "-100");
  expect_told(told_of_tool("Rigid Plane", floor),
              {"WARNING: the tool 'tool' is 0.002 m from all points at the start", "touches nothing until the end"});
  const std::string flies = told_of_tool("Rigid Plane", floor, flight, "4.7e-5");
  expect_told(flies, {"the tool 'tool' is 0.002 m from all points at the start", "before about t = 1.98e-05 s"});
  EXPECT_EQ(flies.find("WARNING"), std::string::npos);
  expect_told(told_of_tool("Rigid Plane", floor, flight, "1.9e-5"), {"touches nothing until the end"});
  expect_told(told_of_tool("Rigid Plane", floor + key("Travel Z", "100*t"), "", "4.7e-5"),
              {"before about t = 1.98e-05 s"});
  EXPECT_EQ(told_of_tool("Rigid Plane", key("Point", "0 0 0") + key("Normal", "0 0 1")).find("the tool"),
            std::string::npos);
  // It hammers a hundred times, 0.05 mm deep or short of the bar.
  const auto hammers = [&](const std::string& by) {
    return told_of_tool("Rigid Plane", floor + key("Travel Z", by + "*sin(3.14159265358979*t/4.7e-7)^2"), "", "4.7e-5");
  };
  expect_told(hammers("2.05e-3"), {"before about t = "});
  expect_told(hammers("1.95e-3"), {"WARNING: the tool 'tool' is 0.002 m", "touches nothing until the end"});
  const std::string later = told_of_tool(
      "Rigid Plane", floor, along("push", "Prescribed Velocity", "top", "z", "t > 1e-5 ? -100 : 0"), "4.7e-5");
  expect_told(later, {"until the end: only loads, impacts and motions that change later may bring them together"});
  EXPECT_EQ(later.find("WARNING"), std::string::npos) << later;
}

// A tool presses the points that move with it, by more than half a spacing in equilibria up to 1 s, to 1.1 s from
// there, and on to 1.2 s: after an earlier run points are where it left them.
TEST(Tools, ThatGoOnPressingAreNotWarnedOf) {
  const RunFolder folder;
  const auto said = [&](const std::string& name, const std::string& from, const std::string& to, Start start) {
    Parts parts;
    parts.conditions = section("press", key("Type", "Rigid Plane") + key("Point", "0 0 6e-3") +
                                            key("Normal", "0 0 -1") + key("Travel Z", "-6e-4*t")) +
                       along("with it", "Prescribed Velocity", "top", "z", "-6e-4") +
                       along("foot", "Prescribed Displacement", "foot", "xyz", "0");
    parts.times = key("Initial Time", from) + key("Final Time", to);
    const std::string verlet = section("Verlet", parts.verlet);
    const std::string restart = section("Restart", key("Filename", (folder / (name + ".restart")).string()));
    const std::string first = (folder / "first.restart").string();
    const std::string text = changed(
        changed(parts.text(), verlet, section("QuasiStatic", key("Number of Load Steps", "2"))), "<ParameterList>\n",
        "<ParameterList>\n" + restart + (name == "first" ? "" : section("Start From", key("Checkpoint", first))));
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(folder.write(name + ".xml", text), folder.world, start));
    return testing::internal::GetCapturedStdout();
  };
  const auto at_rank_0 = [&](const std::string& name, const std::string& from, const std::string& to, Start start) {
    const std::string all = said(name, from, to, start);
    if (folder.world.rank() == 0) {
      EXPECT_NE(all.find("connected piece"), std::string::npos) << all;
    }
    EXPECT_EQ(all.find("the tool 'press' runs into"), std::string::npos) << all;
    EXPECT_EQ(all.find("inside of the tool 'press'"), std::string::npos) << all;
  };
  at_rank_0("first", "0", "1", Start::anew);
  at_rank_0("second", "1", "1.1", Start::anew);
  at_rank_0("second", "1", "1.2", Start::continued);
}

// Tools act last: what a condition holds along their normal is moved all the same, here by 0.1 mm and more in 10 µs.
TEST(Tools, ThatRunIntoPointsWhichConditionsHoldAreWarnedOf) {
  const auto told = [](const std::string& conditions, const std::string& travel) {
    return told_of_tool("Rigid Plane", key("Point", "0 0 0") + key("Normal", "0 0 1") + key("Travel Z", travel),
                        conditions, "1e-5");
  };
  const auto motion = [](const std::string& axes, const std::string& velocity) {
    return along("foot", "Prescribed Velocity", "foot", axes, velocity);
  };
  expect_told(told(motion("z", "-10"), "0"),
              {"WARNING: the tool 'tool' runs into 16 points that 'foot' holds along its normal"});
  expect_told(told(motion("xyz", "0"), "10*t"), {"16 points that 'foot' holds", "tools have the last word"});
  expect_told(told(plane("cut", "Symmetry Plane", "foot", "0 0 0", "0 0 1"), "10*t"), {"16 points that 'cut' holds"});
  Parts slow;
  slow.conditions = motion("xyz", "0") + section("tool", key("Type", "Rigid Plane") + key("Point", "0 0 0") +
                                                             key("Normal", "0 0 1") + key("Travel Z", "10*t"));
  slow.times = key("Final Time", "1e-5");
  const RunFolder folder;
  const std::string text = changed(slow.text(), section("Verlet", slow.verlet), section("QuasiStatic", ""));
  const deck::Deck deck = deck::read(folder.write("deck.xml", text), folder.world);
  expect_told(described(deck, folder.world), {"held points stay, so that there is no equilibrium from then on"});
  const std::string stroke = "table(t, 0, 0, 1.005e-6, 0, 1.01e-6, 1e-4, 1.015e-6, 0)";  // within a thousandth
  expect_told(told(motion("xyz", "0"), stroke), {"16 points that 'foot' holds", "by t = 1.0"});
  EXPECT_EQ(told(motion("xy", "0"), "10*t").find("last word"), std::string::npos) << "held across the normal";
  EXPECT_EQ(told(motion("z", "10"), "10*t").find("last word"), std::string::npos) << "one path";
  EXPECT_EQ(told(motion("xyz", "0"), "0").find("last word"), std::string::npos) << "it stands";
  const std::string flying_tool =
      key("Point", "0 0 0") + key("Normal", "0 0 1") + key("Mass", "1e-3") + key("Speed Z", "10");
  expect_told(told_of_tool("Rigid Plane", flying_tool, motion("xyz", "0"), "1e-5"),
              {"16 points that 'foot' holds", "what the tool loses to them depends on the time step"});
  const auto pressed = [&](const std::string& force) {
    const std::string keys =
        key("Point", "0 0 0") + key("Normal", "0 0 1") + key("Mass", "1e-3") + key("Force Z", force);
    return told_of_tool("Rigid Plane", keys, motion("xyz", "0"), "1e-5");
  };
  expect_told(pressed("1"), {"16 points that 'foot' holds"});
  EXPECT_EQ(pressed("-1").find("last word"), std::string::npos);
}

// If conditions hold all points, the bonds across the sides take the whole stretch: several times that of a free body.
TEST(Stretches, ThatHeldPointsCannotFollowAreWarnedOf) {
  const auto told = [](const std::string& stretch, const std::string& condition, const std::string& of_block = "") {
    Parts parts;
    parts.blocks = changed(parts.blocks, key("Material", "copper"), key("Material", "copper") + of_block);
    parts.conditions = section("sides", key("Type", "Periodic Sides") + key("Coordinate", "z") + key("Lower", "0") +
                                            key("Upper", "6e-3") + key("Stretch", stretch)) +
                       condition;
    return told_of(parts);
  };
  const auto hold = [](const std::string& set, const std::string& axis, const std::string& value) {
    return along("hold", "Prescribed Displacement", set, axis, value);
  };
  const std::string grows = "1 + 1e8*t*t", warning = "Stretch: conditions hold all points of the body";
  expect_told(told(grows, hold("all", "z", "0")), {"Boundary Conditions > sides > " + warning + " of block 'bar'"});
  expect_told(told(grows, hold("all", "z", "0"), key("Separate Body", "true")), {warning});
  expect_told(told(grows, plane("cut", "Symmetry Plane", "all", "0 0 0", "0 0 1")), {warning});
  for (const std::string& free : {told("1", hold("all", "z", "0")), told(grows, hold("foot", "z", "0")),
                                  told(grows, hold("all", "x", "0")), told(grows, hold("all", "z", "1e8*t*t*z"))}) {
    EXPECT_EQ(free.find(warning), std::string::npos) << free;
  }
}

TEST(Ends, ThatConditionsHoldAlongTheirNormalAreWarnedOf) {
  const auto told = [](const std::string& axes) {
    Parts parts;
    parts.conditions =
        section("open", key("Type", "Non-Reflecting End") + key("Node Set", "foot") + key("Normal", "0 0 -1")) +
        along("hold", "Prescribed Velocity", "foot", axes, "0");
    return told_of(parts);
  };
  expect_told(told("yz"), {"WARNING: 'hold' holds 16 points of the non-reflecting end 'open' along its normal"});
  EXPECT_EQ(told("xy").find("waves are reflected"), std::string::npos) << "held across the normal";
}

// A bar under its weight w, per volume, stands on 16 mm²: 16e-6 w L N stand at its foot, less the weight of half a
// layer.
TEST(Ends, ThatLetGoOfWhatStandsAtThemAreToldOf) {
  const RunFolder folder;
  Parts parts;
  const std::string weight = along("weight", "Body Force", "all", "z", "-1e8");
  const auto told = [&](const std::string& name, const std::string& solver, const std::string& more) {
    const std::string restart = section("Restart", key("Filename", (folder / (name + ".restart")).string()));
    testing::internal::CaptureStdout();
    EXPECT_TRUE(run(folder.write(name + ".xml", changed(changed(parts.text(), "<ParameterList>\n",
                                                                "<ParameterList>\n" + restart + more),
                                                        "\"Verlet\"", "\"" + solver + "\"")),
                    folder.world, Start::anew));
    return testing::internal::GetCapturedStdout();
  };
  parts.times = key("Final Time", "1"), parts.verlet = key("Number of Load Steps", "1");
  parts.conditions = weight + along("held", "Prescribed Displacement", "foot", "z", "0");
  told("stands", "QuasiStatic", "");
  parts.times = key("Final Time", "1e-8"), parts.verlet.clear();
  const std::string open =
      section("open", key("Type", "Non-Reflecting End") + key("Node Set", "foot") + key("Normal", "0 0 -1"));
  const std::string from = section("Start From", key("Checkpoint", (folder / "stands.restart").string()));
  const std::string words = "WARNING: the non-reflecting end 'open' lets go at once of about ";
  parts.conditions = weight + open;
  const std::string lets_go = told("open", "Verlet", from);
  parts.conditions = weight + changed(changed(open, "foot", "top"), "0 0 -1", "0 0 1");
  const std::string free = told("free", "Verlet", from);
  if (folder.world.rank() != 0) return;
  const std::size_t at = lets_go.find(words);
  ASSERT_NE(at, std::string::npos) << lets_go;
  EXPECT_EQ(free.find("lets go"), std::string::npos) << free;
  EXPECT_NEAR(std::stod(lets_go.substr(at + words.size())), 16e-6 * 4.5e-3 * 1e8, 0.5);
}

TEST(Ends, WhoseInertiaIsScaledAreWarnedOf) {
  const auto told = [](const std::string& step) {
    Parts parts;
    parts.conditions =
        section("open", key("Type", "Non-Reflecting End") + key("Node Set", "foot") + key("Normal", "0 0 -1"));
    parts.verlet = key("Mass Scaling dt", step) + key("Most Added Mass", "100");
    return told_of(parts);
  };
  expect_told(told("3e-7"), {"WARNING: Mass Scaling gives points of a non-reflecting end up to "});
  EXPECT_EQ(told("1e-8").find("Mass Scaling gives"), std::string::npos);
}

// A bar of four by four points of ordinary bonds, in whose E a third and more is not the material's.
TEST(ThinMembers, OfOrdinaryPointsAreToldOf) {
  const RunFolder folder(Lattice{.nx = 4, .ny = 4, .nz = 30});
  Parts parts;
  const std::string ordinary = changed(copper(), "Elastic Correspondence", "Elastic");
  parts.materials = ordinary;
  const auto told = [&] {
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  expect_told(told(), {"block 'bar': members are ", " (4 and 2 volume/surface); bars so thick were found ",
                       " % too stiff in tension by the material model 'Elastic'"});
}

// By bond energy 0.257, 0.468 of the fracture energy were seen where plates of one and two layers were cut in small
// steps; by sums over the bonds 0.257, 0.471, 0.736, and by stretch 1.164, 1.142, 1.046.
TEST(ThinMembers, WhoseCracksDissipateAnotherEnergyAreToldOf) {
  const auto told = [](int layers, const std::string& model, const Tensor& turn = Tensor::Identity()) {
    const Lattice lattice{.nx = 12, .ny = 12, .nz = layers};
    const RunFolder folder(lattice);
    write_stretched(folder, lattice, Vector::Ones(), turn);
    Parts parts;
    parts.materials = section("copper", key("Material Model", "Elastic") + key("Density", "1000") +
                                            key("Young's Modulus", "1e7") + key("Poisson's Ratio", "0.25"));
    parts.damage = section("tears", key("Damage Model", model) + key("Fracture Energy", "1000"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Horizon Factor", "3.015") + key("Damage Model", "tears"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string cut = " a flat cut from face to face dissipates ", of = " of the Fracture Energy";
  expect_told(told(1, "Bond Energy"), {"block 'bar': in plates of 1 layer" + cut + "0.26" + of});
  expect_told(told(2, "Bond Energy"), {"in plates of 2 layers" + cut + "0.47" + of});
  expect_told(told(4, "Bond Energy"), {"in plates of 4 layers" + cut + "0.74" + of});
  expect_told(told(1, "Critical Stretch"), {"in plates of 1 layer" + cut + "1.2" + of});
  expect_told(told(2, "Critical Stretch"), {"in plates of 2 layers" + cut + "1.1" + of});
  const Tensor turn = turned_by(37, {1, 2, 3});
  expect_told(told(1, "Bond Energy", turn), {"in plates of 1 layer" + cut + "0.26" + of});
  expect_told(told(2, "Bond Energy", turn), {"in plates of 2 layers" + cut + "0.47" + of});
  EXPECT_EQ(told(4, "Critical Stretch").find(cut), std::string::npos);  // 1.05
  EXPECT_EQ(told(12, "Bond Energy").find(cut), std::string::npos);
}

// Twice as high as wide, and cubes; 3 points to each side within the horizon, and as many at a surface.
TEST(OblongCells, OfOrdinaryPointsSurfacesAndCracksAreToldOf) {
  const std::string dilatation =
                        "its points are not on a cubic lattice, so the dilatation of the material model "
                        "'Elastic' counts strain along one direction ",
                    surfaces =
                        "the longest edge is 2 times the shortest): contact by surfaces begins up to 0.00074 m "
                        "early or late, and cracks take more or less than the Fracture Energy (",
                    cracks = "the longest edge is 2 times the shortest): cracks take";
  const Lattice lattice{.nx = 8, .ny = 8, .nz = 8};
  const RunFolder folder(lattice);
  const auto told = [&](const std::string& contact) {
    Parts parts;
    parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.damage = section("brittle", key("Damage Model", "Bond Energy") + key("Fracture Energy", "1e4"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Horizon Factor", "3.015") + key("Damage Model", "brittle"));
    parts.contact = contact;
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string itself = section("Models", section("m", key("Contact Model", "Surface"))) +
                             section("Interactions", section("Self Contact", key("Contact Model", "m")));
  for (const std::string& words : {dilatation, cracks, surfaces}) {
    EXPECT_EQ(told(itself).find(words), std::string::npos) << told(itself);
  }
  write_stretched(folder, lattice, {1, 1, 2});
  expect_told(told(""), {dilatation, cracks});
  expect_told(told(itself), {dilatation, surfaces});
}

TEST(OblongCells, OfTwoSizesAreToldOfWhereCracksAndContactTakeTheirConstants) {
  const RunFolder folder;
  folder.write("points.txt",
               cubes(1, Vector::Zero(), 4, 4, 4, 1e-3) + cubes(1, Vector::Constant(20e-3), 4, 4, 4, 2e-3));
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  for (const char* energy : {"Fracture Energy", "Critical Stretch"}) {
    parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key(energy, "1e-3"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Horizon Factor", "2.015") + key("Damage Model", "brittle"));
    const std::string all = described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
    EXPECT_EQ(all.find("its cells have edges of 0.001 to 0.002 m") != std::string::npos,
              energy == std::string("Fracture Energy"))
        << all;
  }
  parts.damage.clear();
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "2.015"));
  const std::string by_points =
                        key("Contact Model", "Hertz") + key("Contact Radius", "1e-3") + key("Effective Modulus", "1e9"),
                    sizes = "its cells have edges of 0.001 to 0.002 m, and its contact ";
  for (const auto& [model, words] :
       {std::pair(key("Contact Model", "Surface"), sizes + "by surfaces the constants of"),
        {by_points, sizes + "one Contact Radius: the faces of some meet 0.001 m earlier"}}) {
    parts.contact = section("Models", section("m", model)) +
                    section("Interactions", section("Self Contact", key("Contact Model", "m")));
    expect_told(described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world), {words});
  }
}

// Bars of four by four points, in which surfaces are near everywhere. Of cubes 1.63 times their stiffness was found, of
// cells 1.2, 1.5 and 2 times as long as wide 1.06, 1.39, 2.34, of sheared cubes 1.82.
TEST(OblongCells, OfThinOrdinaryBarsAreToldOfWithoutTheNumbersOfCubes) {
  const Lattice bar{.nx = 4, .ny = 4, .nz = 16};
  const RunFolder folder(bar);
  const auto told = [&](const Tensor& shape) {
    write_stretched(folder, bar, Vector::Ones(), shape);
    Parts parts;
    parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "2.015"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string cubes = "bars so thick were found", others = "(cells oblong or oblique by a factor of ";
  const Tensor turn = turned_by(37, {1, 2, 3});
  for (const Tensor& shape : {turned_by(0, {0, 0, 1}), turn}) {
    expect_told(told(shape), {cubes});
    EXPECT_EQ(told(shape).find(others), std::string::npos) << told(shape);
  }
  for (const char* factor : {"1.2", "1.5", "2"}) {
    const std::string said = told(turn * Tensor(Vector(1, 1, std::stod(factor)).asDiagonal()));
    expect_told(said, {others + factor + ")"});
    EXPECT_EQ(said.find(cubes), std::string::npos) << said;
  }
  Tensor shear = Tensor::Identity();
  shear(0, 1) = 0.5;
  expect_told(told(shear), {others});
  EXPECT_EQ(told(shear).find(cubes), std::string::npos) << told(shear);
}

// Bars of such tetrahedra were found to have 0.77 of Young's modulus, and 0.999 by their nodes.
TEST(Tetrahedra, ByTheMeanGradientAreToldOf) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { io::write_mesh(folder / "tetrahedra.g", in_tetrahedra(Lattice().mesh())); });
  const auto told = [&](const std::string& mesh, const std::string& formulation, const std::string& points) {
    Parts parts;
    parts.mesh_file = mesh, parts.points = points;
    parts.materials = changed(copper(), key("Density", "8930"), key("Density", "8930") + formulation);
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string soft = "576 points are at centers of tetrahedra, where a uniform stress is no equilibrium",
                    quadratic = key("Formulation", "Quadratic Correspondence");
  expect_told(told("tetrahedra.g", "", ""), {"WARNING: block 'bar': " + soft});
  for (const std::string& said :
       {told("tetrahedra.g", quadratic, ""), told("tetrahedra.g", "", "Nodes"), told("bar.g", "", "")}) {
    EXPECT_EQ(said.find("centers of tetrahedra"), std::string::npos) << said;
  }
}

// The sums over points of a single row, and over points beside a surface that is oblique to the axes of space, tell
// nothing of the lattice.
TEST(OblongCells, CubesOfTurnedAndThinBarsAreNone) {
  const auto told = [](const Lattice& lattice, const Vector& factors, const Tensor& turn) {
    const RunFolder folder(lattice);
    write_stretched(folder, lattice, factors, turn);
    Parts parts;
    parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "3"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const std::string cubic = "not on a cubic lattice";
  const Lattice thick{.nx = 5, .ny = 5, .nz = 12}, row{.nx = 1, .ny = 1, .nz = 12}, cube{.nx = 8, .ny = 8, .nz = 8};
  for (const double degrees : {0, 30, 45, 60}) {
    for (const Vector& axis : {Vector(0, 0, 1), Vector(1, 1, 0)}) {
      for (const Lattice& lattice : {thick, row}) {
        const std::string said = told(lattice, Vector::Ones(), turned_by(degrees, axis));
        EXPECT_EQ(said.find(cubic), std::string::npos) << degrees << " " << said;
      }
    }
  }
  expect_told(told(cube, {1, 1, 2}, turned_by(30, {1, 2, 3})), {cubic});
}

// Nodes of cells twice as long as wide: of those at a face the parts of a cell are cubes.
TEST(OblongCells, OfNodesHaveTheEdgesOfWholeCells) {
  const auto told = [](const Lattice& lattice, double length, const Tensor& turn) {
    const RunFolder folder(lattice);
    write_stretched(folder, lattice, {length, 1, 1}, turn);
    Parts parts;
    parts.points = "Nodes";
    parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Fracture Energy", "1e4"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "2") +
                                        key("Damage Model", "brittle"));
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  const Lattice cube{.nx = 3, .ny = 3, .nz = 3}, plate{.nx = 4, .ny = 4, .nz = 1};
  for (const Tensor& turn : {turned_by(0, {0, 0, 1}), turned_by(37, {1, 2, 3})}) {
    expect_told(told(cube, 2, turn), {"the longest edge is 2 times the shortest"});
    expect_told(told(cube, 1.4, turn), {"the longest edge is 1.4 times the shortest"});
  }
  expect_told(told(plate, 2, turned_by(0, {0, 0, 1})), {"its cells are no cubes"});
}

// Nodes of cubes, of which those at a surface have parts of a cell; one layer in the middle does not see past them.
TEST(OblongCells, NodesAtASurfaceOfCubesAreNone) {
  Lattice lattice{.nx = 8, .ny = 8, .nz = 4};
  const RunFolder folder(lattice);
  Parts parts;
  parts.points = "Nodes";
  parts.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  const auto told = [&] {
    return described(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
  };
  EXPECT_EQ(told().find("not on a cubic lattice"), std::string::npos) << told();
  lattice.nx = lattice.ny = lattice.nz = 8;
  write_stretched(folder, lattice, {1, 1, 2});
  expect_told(told(), {"not on a cubic lattice"});
}

// The output of rank 0. `solver`: the section of the steps.
std::string told_by_run(const std::string& conditions, const std::string& solver = "Verlet") {
  const RunFolder folder;
  Parts parts;
  parts.conditions = conditions;
  parts.times = key("Final Time", "2e-6");
  if (solver != "Verlet") parts.verlet = "";
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", changed(parts.text(), R"(name="Verlet")", "name=\"" + solver + '"')), folder.world);
  const std::string told = testing::internal::GetCapturedStdout();
  return folder.world.rank() == 0 ? told : "";
}

TEST(ClosingReport, TellsOfWhatDidNotHappen) {
  const std::string floor = plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1"),
                    far = plane("far", "Rigid Plane", "all", "0 0 -1", "0 0 1");
  const std::string still = told_by_run(floor),
                    falls = told_by_run(floor + far + along("flight", "Initial Velocity", "all", "z", "-1")),
                    held = told_by_run(along("low", "Prescribed Displacement", "foot", "xyz", "0"), "QuasiStatic");
  if (still.empty()) return;
  // The run of 2 µs is divided into equal steps, at most 0.8 of it, the deck's safety factor.
  double limit = 0, dt = 0;
  std::sscanf(falls.c_str() + falls.find("critical time step"), "critical time step %lf", &limit);
  std::sscanf(falls.c_str() + falls.find("dt = "), "dt = %lf", &dt);
  EXPECT_NEAR(dt, 2e-6 / std::ceil(2e-6 / (0.8 * limit)), 1e-9) << falls;  // three digits are told of dt
  EXPECT_NE(still.find("the tool 'floor' touched nothing\nWARNING: nothing moved"), std::string::npos) << still;
  EXPECT_NE(held.find("WARNING: nothing moved"), std::string::npos) << held;
  EXPECT_NE(falls.find("the tool 'far' touched nothing"), std::string::npos) << falls;
  EXPECT_EQ(falls.find("'floor' touched"), std::string::npos) << falls;
  EXPECT_EQ(falls.find("nothing moved"), std::string::npos) << falls;
}

}  // namespace
}  // namespace strut::regression
