// Decks in Peridigm's dialect: what is put into our spelling, what is told, and what is refused by name. That they run,
// and give what our spelling gives: tests/regression/deck/test_peridigm.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "deck/yaml.hpp"
#include "deck_under_test.hpp"

namespace strut::deck {
namespace {

// Ours in the test's own layout; `old` and `replacement` put a part of it into the dialect.
Deck with(const DeckFolder& folder, const std::string& old, const std::string& replacement) {
  return folder.read(changed(small_deck, old, replacement));
}

const std::string poisson = R"(<Parameter name="Poisson's Ratio" type="double" value="0.296"/>)";
const std::string horizon = R"(<Parameter name="Horizon" type="double" value="0.0065"/>)";

std::string key(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}

bool told(const Deck& deck, const std::string& note) {
  return std::find(deck.notes.begin(), deck.notes.end(), note) != deck.notes.end();
}

TEST(DeckOfPeridigm, HourglassCoefficients) {
  const DeckFolder folder;
  const Deck none = with(folder, poisson, poisson + key("Hourglass Coefficient", "double", "0.0"));
  EXPECT_EQ(residual_of(none.materials[0].stabilization), ResidualKind::none);
  EXPECT_TRUE(
      std::ranges::none_of(none.notes, [](const std::string& note) { return note.find("Hourglass") != note.npos; }));
  const Deck some = with(folder, poisson, poisson + key("Hourglass Coefficient", "double", "0.02"));
  EXPECT_EQ(residual_of(some.materials[0].stabilization), ResidualKind::own_gradient);
  EXPECT_EQ(some.materials[0].stabilization_coefficient, 0.005);
  EXPECT_TRUE(
      told(some,
           "Materials > copper > Hourglass Coefficient is taken as Stabilization 'Silling' with the "
           "coefficient 0.005, which acts on the whole difference, not only along the bond as Peridigm's: "
           "displacements of its deck PredictorFromPreviousSolver and stresses differ by 2 %, plastic strains where "
           "flow begins by 40 %, others may by more"));
}

// A key that only its decks have makes a deck one of Peridigm's: there, and not in ours, notes say what means another
// thing.
TEST(DeckOfPeridigm, DifferencesAreToldInItsDecksAlone) {
  const DeckFolder folder;
  const std::string two_blocks =
      R"(<ParameterList name="Blocks">)" +
      list("one", key("Block Names", "string", "block_1") + key("Material", "string", "copper") +
                      key("Horizon", "double", "0.0065") + key("Damage Model", "string", "brittle")) +
      list("two", key("Block Names", "string", "block_2") + key("Material", "string", "copper") +
                      key("Horizon", "double", "0.007"));
  const std::string damage = list("Damage Models", list("brittle", key("Damage Model", "string", "Critical Stretch") +
                                                                       key("Critical Stretch", "double", "0.01")));
  const std::string text = changed(small_deck, R"(<ParameterList name="Discretization">)",
                                   damage + R"(<ParameterList name="Discretization">)");
  const std::size_t from = text.find(R"(<ParameterList name="Blocks">)"), to = text.find("</ParameterList>", from);
  std::string ours = text;
  ours.replace(from, text.find("</ParameterList>", to + 1) - from, two_blocks);
  const auto mentions = [](const Deck& deck, const std::string& words) {
    return std::ranges::any_of(deck.notes,
                               [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  const std::string theirs =
      changed(ours, R"(<Parameter name="Input Mesh File")",
              key("Omit Bonds Between Blocks", "string", "None") + R"(<Parameter name="Input Mesh File")");
  for (const char* words :
       {"bonds to blocks without one", "points of two of them are neighbors below the mean of both"}) {
    EXPECT_TRUE(mentions(folder.read(theirs), words)) << words;
    EXPECT_FALSE(mentions(folder.read(ours), words)) << words;
  }
}

TEST(DeckOfPeridigm, IsotropicHardeningWithoutAFlaw) {
  const DeckFolder folder;
  const std::string keys =
      key("Hardening Modulus", "double", "2e9") + key("Enable Flaw", "bool", "false") + key("Flaw Size", "double", "1");
  const std::string text = changed(small_deck, "Elastic Plastic Correspondence", "Isotropic Hardening Correspondence");
  const Deck deck = folder.read(changed(text, poisson, poisson + keys));
  const auto flow = std::get<materials::J2>(deck.materials[0].law).flow;
  EXPECT_EQ(std::get<materials::LinearHardening>(flow.hardening).modulus, 2e9);
}

TEST(DeckOfPeridigm, HorizonOfAllBlocksAndDefaultBlocks) {
  const DeckFolder folder;
  const std::string rest = list("rest", key("Block Names", "string", "Default") + key("Material", "string", "copper"));
  std::string text = changed(small_deck, horizon, "");
  text = changed(text, R"(value="all"/>)", R"(value="block_1"/>)");
  text = changed(text, R"(<ParameterList name="Blocks">)", R"(<ParameterList name="Blocks">)" + rest);
  text = changed(text, R"(<Parameter name="Input Mesh File")", horizon + R"(<Parameter name="Input Mesh File")");
  const Deck deck = folder.read(text);
  ASSERT_EQ(deck.blocks.size(), 2u);
  EXPECT_EQ(deck.blocks[0].block_names, std::vector<std::string>{"default"});
  EXPECT_EQ(deck.blocks[0].horizon, 0.0065);
  EXPECT_EQ(deck.blocks[1].horizon, 0.0065);
}

TEST(DeckOfPeridigm, OmittedBondsMakeBodies) {
  const DeckFolder folder;
  std::string text = changed(small_deck, R"(value="all"/>)", R"(value="block_1 block_2"/>)");
  text = changed(text, R"(<Parameter name="Input Mesh File")",
                 key("Omit Bonds Between Blocks", "string", "All") + R"(<Parameter name="Input Mesh File")");
  const Deck deck = folder.read(text);
  ASSERT_EQ(deck.blocks.size(), 2u);
  for (const Block& block : deck.blocks) EXPECT_TRUE(block.separate_body);
  EXPECT_EQ(deck.blocks[1].block_names, std::vector<std::string>{"block_2"});
}

TEST(DeckOfPeridigm, Grid) {
  const DeckFolder folder;
  std::string generator;
  for (const std::string axis : {"X", "Y", "Z"}) {
    generator += key(axis + " Origin", "double", "-1.0") + key(axis + " Length", "double", "4.0") +
                 key("Number Points " + axis, "int", axis == "X" ? "8" : "2");
  }
  const std::string old = R"(<Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="bar.txt"/>)";
  const std::string grid = key("Type", "string", "PdQuickGrid") + list("TensorProduct3DMeshGenerator", generator);
  const Deck deck = with(folder, old, grid + key("NeighborhoodType", "string", "Spherical"));
  EXPECT_EQ(deck.discretization.type, MeshType::grid);
  EXPECT_EQ(deck.discretization.grid.origin, Vector(-1, -1, -1));
  EXPECT_EQ(deck.discretization.grid.length, Vector(4, 4, 4));
  EXPECT_EQ(deck.discretization.grid.points, (std::array<int, 3>{8, 2, 2}));
  EXPECT_EQ(
      folder.error(changed(small_deck, old, grid)),
      "deck.xml: 1 problem\n  Discretization > NeighborhoodType: missing; expected 'Spherical', or 'Box' for what "
      "Peridigm takes without this key");
  EXPECT_FALSE(deck.discretization.grid.boxes);
  const std::string theirs =
      changed(changed(small_deck, old, grid), poisson, poisson + key("Disable Plasticity", "bool", "false"));
  const Deck boxes = folder.read(theirs);
  EXPECT_TRUE(boxes.discretization.grid.boxes);
  EXPECT_TRUE(told(boxes,
                   "Discretization > NeighborhoodType is missing: families are boxes of cells, as in Peridigm, not "
                   "the points within the horizon"));
}

TEST(DeckOfPeridigm, SetsOfPointsByNumber) {
  const DeckFolder folder;
  folder.write("set.txt", "\xef\xbb\xbf# the left face\n4 1\n1 7\n");
  const std::string condition =
      list("push", key("Type", "string", "Initial_Velocity") + key("Node Set", "string", "Left Node Set") +
                       key("Coordinate", "string", "X") + key("Value", "double", "1.0")) +
      list("fly", key("Type", "string", "Initial Velocity") + key("Node Set", "string", "Full Domain") +
                      key("Coordinate", "string", "y") + key("Value", "string", "2.0"));
  const std::string sets = key("Left Node Set", "string", "set.txt") + key("Node Set Two", "string", "3 2");
  const Deck deck = with(folder, R"(<ParameterList name="Solver">)",
                         list("Boundary Conditions", sets + condition) + R"(<ParameterList name="Solver">)");
  ASSERT_EQ(deck.node_sets.size(), 2u);
  EXPECT_EQ(deck.node_sets[0].numbers, (std::vector<std::int64_t>{1, 4, 7}));
  EXPECT_EQ(deck.node_sets[1].numbers, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(std::get<InitialVelocity>(deck.conditions[0].kind).components, std::vector{0});
  EXPECT_EQ(deck.conditions[1].node_set, "all");
}

TEST(DeckOfPeridigm, EquilibriaByNox) {
  const DeckFolder folder;
  const std::string end = R"(<Parameter name="Final Time" type="double" value="2e-4"/>)";
  const std::string nox = list("NOXQuasiStatic", key("Number of Load Steps", "int", "3") +
                                                     key("Max Age Of Prec", "int", "100") + list("Line Search", ""));
  const Deck deck = with(folder, end, end + key("Peridigm Preconditioner", "string", "None") + nox);
  ASSERT_TRUE(deck.solver.quasi_static);
  EXPECT_EQ(deck.solver.quasi_static->load_steps, 3);
  EXPECT_EQ(deck.notes,
            (std::vector<std::string>{
                "Solver > NOXQuasiStatic is taken as QuasiStatic, of all its keys Number of Load Steps: "
                "equilibria are found in another way",
                "Materials > copper integrates the rate of deformation at the middle of a step, Peridigm at its end: "
                "stresses differ by half a step's strain, relative to the strain",
                "Solver > Peridigm Preconditioner has no effect here: equilibria are found in another way"}));
}

TEST(DeckOfPeridigm, NamesOfInteractions) {
  const DeckFolder folder;
  const auto partners_of = [&](const std::string& name) {
    return folder.read(changed(full_deck, "General Contact", name)).interactions[1].partners;
  };
  EXPECT_EQ(partners_of("General Contact"), Partners::others);
  EXPECT_EQ(partners_of("Self Contact"), Partners::itself);
  EXPECT_EQ(partners_of("everything"), Partners::any);
}

std::string output(const std::string& name, const std::string& frequency, const std::vector<std::string>& variables) {
  std::string wanted;
  for (const std::string& one : variables) wanted += key(one, "bool", "true");
  return list(name, key("Output File Type", "string", "ExodusII") + key("Output Filename", "string", "bar") +
                        key("Output Frequency", "int", frequency) + list("Output Variables", wanted));
}

std::string highest_stress() {
  return list(
      "Compute Class Parameters",
      list("stress", key("Compute Class", "string", "Block_Data") + key("Calculation Type", "string", "Maximum") +
                         key("Block", "string", "block_1") + key("Variable", "string", "Von_Mises_Stress") +
                         key("Output Label", "string", "Highest_Stress")));
}

TEST(DeckOfPeridigm, OutputsBecomeFieldsAndHistory) {
  const DeckFolder folder;
  const std::string outputs =
      highest_stress() +
      output("Output1", "100", {"Displacement", "ID", "Cauchy_StressXX", "Cauchy_StressXY", "Damage"}) +
      output("Output2", "10", {"Global_Kinetic_Energy", "Global_Angular_Momentum", "Highest_Stress"});
  const Deck deck = with(folder, R"(<ParameterList name="Solver">)", outputs + R"(<ParameterList name="Solver">)");
  EXPECT_EQ(deck.output.file, "bar.e");
  EXPECT_EQ(deck.output.frequency, 100);
  EXPECT_EQ(deck.output.variables, (std::vector<std::string>{"Displacement", "Element_Id", "Cauchy_Stress", "Damage"}));
  EXPECT_EQ(deck.history.file, "bar.csv");
  EXPECT_EQ(deck.history.frequency, 10);
  EXPECT_EQ(deck.history.variables, std::vector<std::string>{"Max_Von_Mises_Stress(block_1)"});
  for (const std::string note :
       {"Output2 > Output Variables > Global_Kinetic_Energy goes into History: Kinetic_Energy, by the velocities "
        "half a step before and after: less than Peridigm's by ½ m (½ a Δt)², and below zero where they turn round",
        "Output2 > Output Variables > Global_Angular_Momentum is not written: there is no such number here",
        "Output2 > Output Variables > Highest_Stress goes into History: Max_Von_Mises_Stress(block_1)"}) {
    EXPECT_TRUE(told(deck, note)) << note;
  }
}

TEST(DeckOfPeridigm, OutputsWithoutVariablesTakeThoseOfOthers) {
  const DeckFolder folder;
  const std::string none = list("Output", key("Output Filename", "string", "bar"));
  for (const std::string& outputs :
       {none + output("Output2", "10", {"Displacement"}), output("Output1", "10", {"Displacement"}) + none}) {
    const Deck deck = with(folder, R"(<ParameterList name="Solver">)", outputs + R"(<ParameterList name="Solver">)");
    EXPECT_EQ(deck.output.variables, std::vector<std::string>{"Displacement"});
  }
}

TEST(DeckOfPeridigm, KeysWithoutEffectAreTold) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  for (const std::string note :
       {"Blocks have horizons of their own: points of two of them are neighbors below the mean of "
        "both, and feel each other's forces; in Peridigm each takes those within its own horizon, which reaches half "
        "the difference of both farther, or less far. Points are neighbors here up to 1.0001 horizons",
        "Contact > Models > touch > Contact Radius is the distance from which points push each "
        "other; those of two bodies that start nearer do so from that distance on, in Peridigm "
        "from the radius on, so that they push at once, as hard as here after an approach by the difference of both; "
        "those of one body that start nearer than 1/0.9 of it push from 0.9 of their first distance on",
        "Verbose has no effect here: the program says what it does at all times",
        "Contact > Search Radius has no effect here: the program finds out when to search",
        "Contact > Search Frequency has no effect here: the program finds out when to search"}) {
    EXPECT_TRUE(told(deck, note)) << note;
  }
}

// Everything that is not here is named, in one error.
TEST(DeckOfPeridigm, WhatIsMissingIsNamed) {
  const DeckFolder folder;
  std::string text = changed(small_deck, R"("Elastic Plastic Correspondence")", R"("Elastic")");
  text = changed(text, R"(<Parameter name="Yield Stress" type="double" value="50e6"/>)",
                 key("Apply Shear Correction Factor", "bool", "true"));
  text = changed(text, horizon, horizon + key("Damage Model", "string", "crack"));
  text = changed(text, R"(<Parameter name="Final Time" type="double" value="2e-4"/>)",
                 key("Final Time", "double", "2e-4") + list("Implicit", key("Fixed dt", "double", "1.0")));
  const std::string heat = list("heat", key("Type", "string", "Thermal Flux"));
  text = changed(text, R"(<ParameterList name="Solver">)",
                 list("Damage Models", list("brittle", key("Damage Model", "string", "Interface Aware"))) +
                     list("Boundary Conditions", heat) + output("Output1", "1", {"Velocity"}) +
                     output("Output2", "1", {"Displacement"}) + R"(<ParameterList name="Solver">)");
  const std::string error = folder.error(text);
  EXPECT_TRUE(error.starts_with("deck.xml: 4 problems\n")) << error;
  for (const std::string named :
       {"Boundary Conditions > heat > Type: 'Thermal Flux': no heat flows here",
        "Solver > Implicit: implicit dynamics (Newmark's method) is not there; there are 'Verlet', and 'QuasiStatic' "
        "for "
        "loads without inertia",
        "Blocks > foam > Damage Model: 'crack' is not defined; expected the name of a section of Damage Models: "
        "brittle",
        "Damage Models > brittle > Damage Model: 'Interface Aware': bonds across an interface"}) {
    EXPECT_NE(error.find("\n  " + named), std::string::npos) << named << "\nin " << error;
  }
}

// Keys, conditions and sections that hang on something missing do not make further problems.
TEST(DeckOfPeridigm, WhatIsMissingIsNamedOnce) {
  const DeckFolder folder;
  std::string text = changed(small_deck, R"("Elastic Plastic Correspondence")", R"("Pals")");
  text = changed(text, poisson, poisson + key("Deviatoric Influence Function", "string", "One"));
  text = changed(text, R"(<Parameter name="Final Time" type="double" value="2e-4"/>)",
                 key("Final Time", "double", "2e-4") + list("QuasiStatic", key("Number of Load Steps", "int", "1")));
  text = changed(text, R"(<ParameterList name="Solver">)",
                 list("Boundary Conditions",
                      list("hot", key("Type", "string", "Thermal Flux") + key("Node Set", "string", "set"))) +
                     list("Interfaces", "") + R"(<ParameterList name="Solver">)");
  const std::string error = folder.error(text);
  EXPECT_TRUE(error.starts_with("deck.xml: 3 problems\n")) << error;
  for (const char* named :
       {"Interfaces: unknown section; there are no interfaces", "Materials > copper > Material Model: 'Pals': ",
        "Boundary Conditions > hot > Type: 'Thermal Flux': no heat flows here"}) {
    EXPECT_NE(error.find(std::string("\n  ") + named), std::string::npos) << named << "\nin " << error;
  }
}

// Keys that depend on missing features (fluxes, flaws, friction in time, horizons in space) are no problems of their
// own.
TEST(DeckOfPeridigm, WhatHangsOnSomethingMissingIsNoProblemOfItsOwn) {
  const DeckFolder folder;
  std::string text = changed(small_deck, R"("Elastic Plastic Correspondence")", R"("Diffusion")");
  text = changed(text, horizon, key("Horizon", "string", "0.006 + 0.1*x"));
  const std::string friction = "if (t > 1) { value = 1; } else { value = 0; }";
  const std::string contact =
      list("Contact", list("Models", list("touch", key("Contact Model", "string", "Time-Dependent Short Range Force") +
                                                       key("Contact Radius", "double", "2e-3") +
                                                       key("Spring Constant", "double", "1e9") +
                                                       key("Friction Coefficient", "string", friction))) +
                          list("Interactions", list("General Contact", key("Contact Model", "string", "touch"))));
  text = changed(text, R"(<Parameter name="Final Time" type="double" value="2e-4"/>)",
                 key("Final Time", "double", "2e-4") + key("Solve For Temperature", "bool", "true") +
                     list("ImplicitDiffusion", key("Number of Load Steps", "int", "1")));
  text = changed(text, R"(<ParameterList name="Solver">)",
                 key("Multiphysics", "bool", "true") + contact +
                     output("Output1", "1", {"Flux_Divergence", "Velocity"}) + R"(<ParameterList name="Solver">)");
  const std::string error = folder.error(text);
  EXPECT_TRUE(error.starts_with("deck.xml: 4 problems\n")) << error;
  for (const char* named :
       {"Materials > copper > Material Model: 'Diffusion': no heat and no species flow here",
        "Solver > ImplicitDiffusion: no heat and no species flow here",
        "Blocks > foam > Horizon: '0.006 + 0.1*x': a horizon that varies within a block is a number of spacings",
        "Contact > Models > touch > Contact Model: 'Time-Dependent Short Range Force': a friction that changes"}) {
    EXPECT_NE(error.find(std::string("\n  ") + named), std::string::npos) << named << "\nin " << error;
  }
}

// Only in its decks: in ours each of them is an error.
TEST(DeckOfPeridigm, BracesAndDoubleKeysAreReadAsItDoes) {
  const DeckFolder folder;
  const std::string conditions =
      list("Boundary Conditions", list("push", key("Type", "string", "Initial Velocity") +
                                                   key("Coordinate", "string", "x") + key("Coordinate", "string", "z") +
                                                   key("Value", "string", "if (x &gt; 1) \\{ value = 2; \\}")));
  const std::string ours =
      changed(small_deck, R"(<ParameterList name="Solver">)", conditions + R"(<ParameterList name="Solver">)");
  const std::string error = folder.error(ours);
  EXPECT_NE(error.find("push > Coordinate: given 2 times"), std::string::npos) << error;
  EXPECT_NE(error.find("push > Value: "), std::string::npos) << error;
  const Deck deck = folder.read(changed(ours, poisson, poisson + key("Disable Plasticity", "bool", "false")));
  const auto& push = std::get<InitialVelocity>(deck.conditions[0].kind);
  EXPECT_EQ(push.components, std::vector{2});
  EXPECT_EQ(push.value(3, 0, 0, 0), 2);
  EXPECT_TRUE(told(deck,
                   "Boundary Conditions > push > Coordinate is given more than once: the last one counts, as in "
                   "Peridigm"));
}

TEST(DeckOfPeridigm, DisabledPlasticityIsElastic) {
  const DeckFolder folder;
  const std::string text = changed(small_deck, R"("Elastic Plastic Correspondence")", R"("Elastic Plastic")");
  EXPECT_NE(folder.error(text).find("'Elastic Plastic': ordinary state-based plasticity is not there"),
            std::string::npos);
  const Deck deck = folder.read(changed(text, poisson, poisson + key("Disable Plasticity", "bool", "true")));
  EXPECT_EQ(deck.materials[0].formulation, Formulation::ordinary);
}

// Peridigm's bonds break by their whole stretch, unless the damage model has the coefficient, too.
TEST(DeckOfPeridigm, ExpansionOfBondsThatBreakIsToldWhereItDiffers) {
  const DeckFolder folder;
  const std::string alpha = key("Thermal Expansion Coefficient", "double", "2e-5"),
                    other = key("Thermal Expansion Coefficient", "double", "1e-5"),
                    discretization = R"(<ParameterList name="Discretization">)";
  const auto told_of = [&](const std::string& of_material, const std::string& of_model, const std::string& own) {
    const std::string model =
        list("Damage Models", list("brittle", key("Damage Model", "string", "Critical Stretch") +
                                                  key("Critical Stretch", "double", "0.01") + of_model));
    const Deck deck = folder.read(
        changed(changed(small_deck, poisson, poisson + of_material + own), discretization, model + discretization));
    for (const std::string& note : deck.notes) {
      if (note.starts_with("Damage Models > brittle > Thermal")) return note.substr(note.find("in Peridigm"));
    }
    return std::string();
  };
  const std::string theirs = key("Disable Plasticity", "bool", "false");
  EXPECT_EQ(told_of(alpha, "", theirs), "in Peridigm the whole counts");
  EXPECT_EQ(told_of(alpha, other, theirs), "in Peridigm beyond 1e-05 ΔT");
  EXPECT_EQ(told_of(alpha, alpha, theirs), "");
  EXPECT_EQ(told_of("", "", theirs), "");
  EXPECT_EQ(told_of(alpha, "", ""), "");
}

// Peridigm adds up increments: with the value v(t) points are at v(t) − v(0).
TEST(DeckOfPeridigm, DisplacementsAreTakenFromTheirStart) {
  const DeckFolder folder;
  const auto conditions = [&](const std::string& value) {
    return list("Boundary Conditions",
                list("pull", key("Type", "string", "Prescribed Displacement") + key("Coordinate", "string", "x") +
                                 key("Value", "string", value)));
  };
  const auto value = [&](const std::string& text, bool theirs) {
    const std::string deck =
        changed(small_deck, R"(<ParameterList name="Solver">)", conditions(text) + R"(<ParameterList name="Solver">)");
    const std::string own = key("Disable Plasticity", "bool", "false");
    return std::get<PrescribedMotion>(
               folder.read(theirs ? changed(deck, poisson, poisson + own) : deck).conditions[0].kind)
        .value;
  };
  EXPECT_EQ(value("x*exp(t)", true)(2, 0, 0, 0), 0);
  EXPECT_EQ(value("x*exp(t)", true)(2, 0, 0, 1), 2 * std::exp(1.0) - 2);
  EXPECT_EQ(value("x*exp(t)", false)(2, 0, 0, 0), 2);
  EXPECT_EQ(value("0.5", true)(2, 0, 0, 1), 0.5);  // never changes: taken whole
  EXPECT_EQ(value("x*t", true).text(), "x*t");     // nothing to take off
  const std::string goes_on = list("Start From", key("Checkpoint", "string", "first.restart"));
  const std::string deck = changed(small_deck, R"(<ParameterList name="Solver">)",
                                   goes_on + conditions("0.5 + t") + R"(<ParameterList name="Solver">)");
  const auto motion = folder.read(changed(deck, poisson, poisson + key("Disable Plasticity", "bool", "false")));
  EXPECT_EQ(std::get<PrescribedMotion>(motion.conditions[0].kind).value.text(), "0.5 + t");  // points have it already
}

TEST(DeckOfPeridigm, SecondFilesOfFieldsAndLoadSteps) {
  const DeckFolder folder;
  const std::string end = R"(<Parameter name="Final Time" type="double" value="2e-4"/>)";
  std::string text = changed(
      small_deck, end,
      list("QuasiStatic",
           key("Time Steps", "string", "0.0 0.1 0.5 1.0") +
               list("Adaptive Load-Stepping", key("Maximum Load Step", "double", "1") + list("Switch to Verlet", ""))));
  text = changed(text, R"(<ParameterList name="Solver">)",
                 output("Output1", "20", {"Displacement", "Lambda"}) +
                     output("Output2", "5", {"Velocity", "Displacement"}) + R"(<ParameterList name="Solver">)");
  const Deck deck = folder.read(text);
  EXPECT_EQ(deck.output.variables, (std::vector<std::string>{"Displacement", "Velocity"}));
  EXPECT_EQ(deck.output.frequency, 5);
  EXPECT_EQ(deck.solver.quasi_static->load_steps, 10);
  EXPECT_EQ(deck.solver.final_time, 1);
  EXPECT_TRUE(told(deck,
                   "Solver > QuasiStatic > Adaptive Load-Stepping has no effect here: a load step that finds no "
                   "equilibrium is cut in halves, and none grows; the run does not go on by Verlet: where Peridigm "
                   "does, its points vibrate about the equilibria that are found here"));
  EXPECT_TRUE(told(deck,
                   "Output1 > Output Variables > Lambda is not written: there is no such field here; there is "
                   "Equivalent_Plastic_Strain"));
}

TEST(DeckOfPeridigm, SumsAndNearestPointsAreColumns) {
  const DeckFolder folder;
  const std::string classes =
      list("sum", key("Compute Class", "string", "Block_Data") + key("Calculation Type", "string", "Sum") +
                      key("Block", "string", "block_1") + key("Variable", "string", "Force") +
                      key("Output Label", "string", "Pull")) +
      list("gauge", key("Compute Class", "string", "Nearest_Point_Data") + key("X", "double", "0.1") +
                        key("Y", "double", "0.2") + key("Z", "double", "0.3") + key("Variable", "string", "Volume") +
                        key("Output Label", "string", "Gauge"));
  const Deck deck = with(folder, R"(<ParameterList name="Solver">)",
                         list("Compute Class Parameters", classes) + output("Output", "1", {"Pull", "Gauge"}) +
                             R"(<ParameterList name="Solver">)");
  EXPECT_EQ(deck.history.variables, (std::vector<std::string>{"Sum_Force_X(block_1)", "Sum_Force_Y(block_1)",
                                                              "Sum_Force_Z(block_1)", "Mean_Volume(Gauge Node Set)"}));
  ASSERT_EQ(deck.node_sets.size(), 1u);
  EXPECT_EQ(deck.node_sets[0].nearest, Vector(0.1, 0.2, 0.3));
}

TEST(DeckOfPeridigm, OtherFormsOfADeckAreRefused) {
  const DeckFolder folder;
  const std::string what =
      ": this is neither XML nor a form of YAML that is read; expected <ParameterList>s, or 'Key: value' and indented "
      "sections (quoted keys, '<<' and sections after '-' are not read, nor Peridigm's text with aprepro's {…})";
  EXPECT_EQ(folder.error("Discretization\n   Type \"Exodus\"\n"), "deck.xml: 1 problem\n  line 2 column 4" + what);
  EXPECT_EQ(folder.error("Peridigm:\n  Solver:\n    Final Time: 1\n    Final Time: 2\n"),
            "deck.xml: 1 problem\n  line 5 column 1: Parameter \"Final Time\" is given twice; expected once");
  EXPECT_EQ(folder.error("Peridigm:\n  Solver:\n\tFinal Time: 1\n"),
            "deck.xml: 1 problem\n  line 3: indented by a tab; expected spaces, as YAML has them");
  for (const char* value : {"bottom#1", "1000.0#kg", "'load#2'", "\"load #2\"", "table(t, 'a#1.csv')"}) {
    EXPECT_EQ(
        folder.error("Peridigm:\n  Solver: # times\n    Final Time: " + std::string(value) + "\n"),
        "deck.xml: 1 problem\n  line 3: a '#' within a word or in quotes, which begins a comment here; expected a "
        "blank before a comment, and names without '#'");
  }
  EXPECT_EQ(folder.error(std::string(200, '[')),
            "deck.xml: 1 problem\n  YAML: more than a hundred levels; expected few");
}

// ---- Fracture ------------------------------------------------------------------------------------------------------

const char* const fracturing = R"(Peridigm:
  Discretization:
    Type: "PdQuickGrid"
    NeighborhoodType: "Spherical"
    TensorProduct3DMeshGenerator:
      Type: "PdQuickGrid"
      X Origin: 0.0
      Y Origin: 0.0
      Z Origin: 0.0
      X Length: 1.0
      Y Length: 1.0
      Z Length: 1.0
      Number Points X: 4
      Number Points Y: 4
      Number Points Z: 4
    Bond Filters:
      notch:
        Type: "Disk"
        Center_X: 0.5
        Center_Y: 0.5
        Center_Z: 0.5
        Normal_X: 0.0
        Normal_Y: 0.0
        Normal_Z: 2.0
        Radius: 0.2
  Materials:
    glass: {Material Model: "Elastic", Density: 2440.0, Bulk Modulus: 40.0e9, Shear Modulus: 30.0e9}
  Damage Models:
    brittle: {Damage Model: "Critical Stretch", Critical Stretch: 0.001}
    growing: {Damage Model: "Time Dependent Critical Stretch", Time Dependent Critical Stretch: "0.001 + t"}
  Blocks:
    all of it: {Block Names: "all", Material: "glass", Damage Model: "growing", Horizon: 0.8}
  Solver:
    Final Time: 1.0e-5
    Verlet: {Safety Factor: 0.7}
)";

// Its bottom vector (1 4 0) of a plane across y: the part in the plane is (1 0 0), of length 1.
TEST(DeckOfPeridigm, SkewRectanglesAreTheirPartInThePlane) {
  const DeckFolder folder;
  const std::string crack = R"(Type: "Rectangular_Plane"
        Lower_Left_Corner_X: 0.0
        Lower_Left_Corner_Y: 0.5
        Lower_Left_Corner_Z: 0.0
        Bottom_Unit_Vector_X: 2.0
        Bottom_Unit_Vector_Y: 4.0
        Bottom_Unit_Vector_Z: 0.0
        Bottom_Length: 0.5
        Side_Length: 1.0
        Normal_X: 0.0
        Normal_Y: 1.0
        Normal_Z: 0.0)";
  const std::string text = changed(fracturing, "Shear Modulus: 30.0e9", "Shear Modulus: 30.0e9, Enable Flaw: false");
  const std::size_t from = text.find("Type: \"Disk\""), to = text.find("Radius: 0.2");
  const Deck deck = folder.read(text.substr(0, from) + crack + text.substr(to + std::string("Radius: 0.2").size()));
  const RectangularCrack rectangle = std::get<RectangularCrack>(deck.discretization.cracks[0]);
  EXPECT_EQ(rectangle.along, Vector::UnitX());
  EXPECT_EQ(rectangle.length, 0.25);  // in units of the given vector's part, 2
  EXPECT_EQ(rectangle.width, 0.5);
}

TEST(DeckOfPeridigm, NeedlemansLawIsAHardeningAndARate) {
  const DeckFolder folder;
  std::string text =
      changed(small_deck, R"("Elastic Plastic Correspondence")", R"("Viscoplastic Needleman Correspondence")");
  text =
      changed(text, R"(<Parameter name="Yield Stress" type="double" value="50e6"/>)",
              key("Yield Stress", "double", "460e6") + key("Strain Hardening Exponent", "double", "0.1") +
                  key("Rate Hardening Exponent", "double", "0.01") + key("Reference Strain Rate", "double", "0.001") +
                  key("Reference Strain 0", "double", "0.00218") + key("Reference Strain 1", "double", "0.436"));
  const Deck deck = folder.read(text);
  const materials::FlowStress flow = std::get<materials::J2>(deck.materials[0].law).flow;
  const auto& hardening = std::get<materials::NeedlemanHardening>(flow.hardening);
  EXPECT_EQ(hardening.reference_strain, 0.00218);
  EXPECT_EQ(hardening.exponent, 0.1);
  EXPECT_EQ(hardening.softening_strain, 0.436);
  const auto& rate = std::get<materials::NeedlemanRate>(flow.rate);
  EXPECT_EQ(rate.reference_rate, 0.001);
  EXPECT_EQ(rate.exponent, 0.01);
  EXPECT_TRUE(told(deck,
                   "Materials > copper > Reference Strain Rate is the slowest rate that counts: below it the flow "
                   "stress is that of this rate, in Peridigm it falls on; above it the law is the same, but "
                   "Peridigm looks for the flow at other strains than it then takes"));
}

TEST(DeckOfPeridigm, SolversFollowEachOther) {
  const DeckFolder folder;
  const auto two = [](const std::string& first, const std::string& second) {
    return changed(fracturing, "  Solver:\n    Final Time: 1.0e-5\n    Verlet: {Safety Factor: 0.7}\n",
                   "  Solver1:\n    Final Time: 1.0\n    " + first +
                       "\n  Solver2:\n    Initial Time: 1.0\n    Final Time: 2.5\n    " + second + "\n");
  };
  const std::string slow = "QuasiStatic: {Number of Load Steps: 2}",
                    slower = "NOXQuasiStatic: {Number of Load Steps: 1}";
  const std::string without = ", Damage Model: \"growing\"";
  const Deck one = folder.read(changed(two(slow, slower), without, ""));
  EXPECT_FALSE(one.next_solver);
  EXPECT_EQ(one.solver.final_time, 2.5);
  EXPECT_EQ(one.solver.quasi_static->load_steps, 5);  // of 0.5 s: 0, 0.5, 1 and 2.5 s are among their ends
  const Deck both = folder.read(two(slow, "Verlet: {Fixed dt: 0.5}"));
  ASSERT_TRUE(both.next_solver);
  EXPECT_EQ(both.solver.final_time, 1);
  EXPECT_EQ(both.next_solver->initial_time, 1);
  EXPECT_EQ(both.next_solver->fixed_dt, 0.5);
  EXPECT_TRUE(both.next_solver->keeps_velocities);
  EXPECT_NE(
      folder.error(two("Verlet: {Fixed dt: 0.5}", slow)).find("expected explicit steps (Verlet) after equilibria"),
      std::string::npos);
}

// "Solver 2" is a section of ours: it makes no deck one of Peridigm's, and points begin its steps as it says.
TEST(DeckOfPeridigm, OurSecondSolverKeepsItsMeaning) {
  const DeckFolder folder;
  const auto two = [](const std::string& first, const std::string& second, const std::string& keys) {
    const std::string steps = list("QuasiStatic", ""), old = key("Final Time", "double", "2e-4");
    return changed(
        small_deck, "<ParameterList name=\"Solver\">\n    " + old + "  </ParameterList>\n",
        list(first, key("Final Time", "double", "1") + steps) + list(second, key("Final Time", "double", "2") + keys));
  };
  for (const bool keeps : {false, true}) {
    const std::string keep = key("Keep Velocities", "bool", keeps ? "true" : "false");
    const Deck deck = folder.read(two("Solver", "Solver 2", keep));
    EXPECT_FALSE(deck.from_peridigm);
    ASSERT_TRUE(deck.next_solver);
    EXPECT_EQ(deck.next_solver->keeps_velocities, keeps);
    EXPECT_TRUE(deck.notes.empty());
  }
  EXPECT_FALSE(folder.read(two("Solver", "Solver 2", "")).next_solver->keeps_velocities);
  EXPECT_NE(folder.error(two("Solver", "Solver 2", key("Wall Time", "double", "60")))
                .find("Solver 2 > Wall Time: given; expected none"),
            std::string::npos);
  const std::string early =
      changed(two("Solver", "Solver 2", ""), key("Final Time", "double", "2"), key("Final Time", "double", "0.5"));
  EXPECT_NE(folder.error(early).find("Solver 2 > Final Time: '0.5'; expected > the Final Time of Solver (1), in s"),
            std::string::npos);
  EXPECT_NE(folder.error(two("Solver", "Solver", "")).find("Solver: given 2 times; expected once"), std::string::npos);
  EXPECT_TRUE(
      folder.read(two("Solver1", "Solver 2", key("Initial Time", "double", "1") + list("Verlet", ""))).from_peridigm);
}

// Its sections may be the outermost keys, too; the places of errors are those of the text.
TEST(DeckOfPeridigm, YamlNeedsNoKeyAroundAll) {
  const DeckFolder folder;
  const std::string around = std::string(fracturing).substr(0, std::string(fracturing).find('\n') + 1);
  std::string bare;
  std::istringstream lines(std::string(fracturing).substr(around.size()));
  for (std::string line; std::getline(lines, line);) bare += line.substr(std::min<std::size_t>(2, line.size())) + "\n";
  const std::string whole = folder.error(fracturing);
  EXPECT_EQ(folder.error(bare), whole);
  EXPECT_EQ(folder.error("# a deck\n---\n" + bare), whole);
  EXPECT_EQ(folder.error("Solver:\n  Final Time: 1\n  Final Time: 2\nOutput:\n  A: 1\n"),
            "deck.xml: 1 problem\n  line 4 column 1: Parameter \"Final Time\" is given twice; expected once");
}

// "Peridigm:" around all says whose deck it is, though nothing else does.
TEST(DeckOfPeridigm, TheOutermostKeyOfYamlSaysWhoseDeckItIs) {
  const DeckFolder folder;
  const std::string named = fracturing, other = changed(named, "Peridigm:", "Glass:");
  EXPECT_TRUE(folder.read(named).from_peridigm);
  EXPECT_FALSE(folder.read(other).from_peridigm);
}

TEST(DeckOfPeridigm, YamlIsReadAsXml) {
  const DeckFolder folder;
  const Deck deck = folder.read(fracturing);
  EXPECT_EQ(deck.materials[0].density, 2440);
  ASSERT_EQ(deck.damage_models.size(), 2u);
  EXPECT_EQ((*deck.damage_models[0].model.critical_stretch)(0, 0, 0, 7), 0.001);
  EXPECT_EQ((*deck.damage_models[1].model.critical_stretch)(0, 0, 0, 7), 7.001);
  EXPECT_EQ(deck.blocks[0].damage_model, 1);
  ASSERT_EQ(deck.discretization.cracks.size(), 1u);
  const DiskCrack disk = std::get<DiskCrack>(deck.discretization.cracks[0]);
  EXPECT_EQ(disk.normal, Vector::UnitZ());
  EXPECT_EQ(disk.radius, 0.2);
  const std::string in_lines = changed(fracturing, R"({Material Model: "Elastic", Density: 2440.0, )",
                                       "\n      Material Model: >\n        Elastic\n      Density: 2440.0\n      ");
  EXPECT_EQ(
      folder.read(changed(changed(in_lines, ", Shear", "\n      Shear"), "30.0e9}", "30.0e9")).materials[0].density,
      2440);
}

// Values need no quotes for '>' and '|', which begin texts only at the end of a line, and these stay as they are.
TEST(DeckOfPeridigm, PlainValuesOfYamlMayCompare) {
  Problems problems;
  const auto sets = parse_yaml(
      "Sets:\n  a: z > 5e-3  # a > b\n  b: (z >= 1) || (x < 2)\n"
      "  c: {Young's: x > 1, e: \"p: q > r\"}\n  d: [x > 1, 'y', z <= 2]\n  g:\n    - x > -1  # a\n    - \"y\"\n"
      "Text: |\n  f: g > h\nOther: >\n  i: j > k\nLast: table(t, 'a.csv') > 1\n",
      problems);
  ASSERT_TRUE(sets && problems.empty()) << problems.text("");
  std::map<std::string, std::string> values;
  const auto keep = [&](const List& of) {
    for (const Parameter& one : of.parameters) values[one.name] = one.value;
  };
  keep(*sets);
  keep(sets->lists.at(0));
  keep(sets->lists.at(0).lists.at(0));
  EXPECT_FALSE(parse_yaml("Sets:\n  a: z > 1: 2\n", problems)) << "as in YAML";
  const std::map<std::string, std::string> expected = {
      {"a", "z > 5e-3"},    {"b", "(z >= 1) || (x < 2)"}, {"d", "{x > 1, y, z <= 2}"},
      {"g", "{x > -1, y}"}, {"Young's", "x > 1"},         {"e", "p: q > r"},
      {"Text", "f: g > h"}, {"Other", "i: j > k"},        {"Last", "table(t, 'a.csv') > 1"}};
  EXPECT_EQ(values, expected);
}

// PeriLab's lists of points begin with a line that names their column.
TEST(DeckOfPeriLab, ItsSetsOfPointsAreRead) {
  const DeckFolder folder;
  folder.write("ns.txt", "header: global_id\n1\n2\n11\n3000000000\n");  // more than an int holds
  const std::string conditions =
      list("Boundary Conditions",
           key("Node Set 1", "string", "ns.txt") +
               list("fly", key("Type", "string", "Initial Velocity") + key("Node Set", "string", "Node Set 1") +
                               key("Coordinate", "string", "x") + key("Value", "string", "1")));
  const Deck deck = folder.read(
      changed(small_deck, R"(<ParameterList name="Solver">)", conditions + R"(<ParameterList name="Solver">)"));
  ASSERT_EQ(deck.node_sets.size(), 1u);
  EXPECT_EQ(deck.node_sets[0].numbers, (std::vector<std::int64_t>{1, 2, 11, 3000000000}));
}

TEST(DeckOfPeridigm, ThoseOfOthersAreNamedInOneLine) {
  const DeckFolder folder;
  EXPECT_EQ(folder.error("PeriLab:\n  Models:\n    A: 1\n  Outputs:\n    B: 1\n  Blocks:\n    C: 1\n"),
            "deck.xml: 1 problem\n  Models, Outputs: this is a deck of PeriLab, whose words inputs/from-perilab.md "
            "translates; its lists of points and sets can be read as they are");
  EXPECT_EQ(folder.error("{\"num_cells\": {\"value\": [4, 4, 4]}, \"horizon\": {\"value\": 0.1}}"),
            "deck.xml: 1 problem\n  num_cells: this is an input of CabanaPD, whose words inputs/from-cabanapd.md "
            "translates");
}

TEST(DeckOfPeridigm, DamageThatIsNotKnownIsRefused) {
  const DeckFolder folder;
  const auto refused = [&](const std::string& old, const std::string& by, const std::string& problem) {
    const std::string error = folder.error(changed(fracturing, old, by));
    EXPECT_NE(error.find("\n  " + problem), std::string::npos) << problem << "\nin " << error;
  };
  refused("\"growing\", Horizon", "\"growin\", Horizon",
          "Blocks > all of it > Damage Model: 'growin' is not defined (did you mean 'growing'?)");
  refused("0.001 + t", "0.001 + x", "Damage Models > growing > Time Dependent Critical Stretch: '0.001 + x'; expected");
  refused("Critical Stretch: 0.001}", "Critical Stretch: 0.001, Fracture Energy: 10.0}",
          "Damage Models > brittle: 'Critical Stretch' and 'Fracture Energy' are both given");
  refused("Critical Stretch: 0.001}", "Critical Stretch: -0.001}", "Damage Models > brittle > Critical Stretch: ");
  refused("Normal_Z: 2.0", "Normal_Z: 0.0",
          "Discretization > Bond Filters > notch > Normal_X: the vector has no length");
  refused("Radius: 0.2", "Radius: 0.0", "Discretization > Bond Filters > notch > Radius: ");
  EXPECT_NO_THROW(folder.read(changed(fracturing, "\"Elastic\"", "\"Elastic Correspondence\"")));  // mean gradient
  const std::string still =
      changed(fracturing, "Verlet: {Safety Factor: 0.7}", "QuasiStatic: {Number of Load Steps: 1}");
  EXPECT_NE(folder.error(still).find("Blocks > all of it > Damage Model: bonds cannot break with Solver > QuasiStatic"),
            std::string::npos);
  const std::string breaking = changed(still, "Damage Model: \"growing\"", "Damage Model: \"brittle\"");
  EXPECT_NO_THROW(folder.read(breaking));
  const std::string warmed =
      breaking +
      "  Boundary Conditions:\n    warmth: {Type: \"Prescribed Temperature\", Node Set: \"all\", Value: \"300\"}\n";
  EXPECT_NE(folder.error(warmed).find("Boundary Conditions > warmth > Type: given beside a Damage Model"),
            std::string::npos)
      << folder.error(warmed);
}

// A block of a second material, without a Damage Model, in the same deck.
std::string beside(const std::string& deck, const std::string& material, const std::string& more = "") {
  const std::string first = "    glass:";
  const std::string with =
      changed(deck, first,
              "    soft: {Density: 1100.0, Bulk Modulus: 5.0e6, Shear Modulus: 1.0e6, " + material + "}\n" + first);
  return changed(changed(with, "\"all\"", "\"block_1\""), "  Blocks:\n",
                 "  Blocks:\n    pad: {Block Names: \"block_7\", Material: \"soft\", Horizon: 0.1" + more + "}\n");
}

// Bonds break by the Damage Model of the other end, too; in equilibria each round of breaks ages all blocks.
TEST(DeckOfPeridigm, BlocksWithoutADamageModelLoseBondsToThoseThatHaveOne) {
  const DeckFolder folder;
  const std::string rubber = "Material Model: \"Hyperelastic\"", own = ", Separate Body: true";
  const auto refused = [&](const std::string& text, const std::string& problem) {
    const std::string error = folder.error(text);
    EXPECT_NE(error.find("\n  " + problem), std::string::npos) << problem << "\nin " << error;
  };
  refused(beside(fracturing, rubber),
          "Blocks > pad > Material: bonds of material 'soft' cannot break by the Damage Model of another block of the "
          "body: the stress of a Hyperelastic point");
  EXPECT_NO_THROW(folder.read(beside(fracturing, rubber, own)));
  const std::string still =
      changed(changed(fracturing, "Verlet: {Safety Factor: 0.7}", "QuasiStatic: {Number of Load Steps: 1}"),
              "Damage Model: \"growing\"", "Damage Model: \"brittle\"");
  EXPECT_NO_THROW(folder.read(beside(still, rubber, own)));  // its stress is that of its stretch, whenever
  refused(beside(still, rubber + ", Relaxation: {Fractions: [0.5], Times: [1.0]}", own),
          "Blocks > pad > Material: 'soft' beside a block with a Damage Model: where");
  refused(beside(still, "Material Model: \"Elastic Plastic Correspondence\", Yield Stress: 1.0e5"),
          "Blocks > pad > Material: 'soft' beside a block with a Damage Model: where");
  EXPECT_NO_THROW(folder.read(beside(still, "Material Model: \"Elastic\"")));
}

// Ours, in the same deck.
TEST(DeckOfPeridigm, BondEnergiesAreThoseOfOrdinarySolids) {
  const DeckFolder folder;
  const std::string stretch = "\"Critical Stretch\", Critical Stretch: 0.001";
  const auto with = [&](const std::string& model) { return changed(fracturing, stretch, model); };
  ASSERT_NE(with("x"), fracturing);
  const DamageModel given = folder.read(with("\"Bond Energy\", Critical Bond Energy: 3.0e9")).damage_models[0].model;
  EXPECT_EQ(given.critical_bond_energy, 3e9);
  EXPECT_EQ(given.fracture_energy, 0);
  EXPECT_FALSE(given.critical_stretch);
  const DamageModel from = folder.read(with("\"Bond Energy\", Fracture Energy: 4.0")).damage_models[0].model;
  EXPECT_TRUE(from.critical_bond_energy);
  EXPECT_EQ(from.fracture_energy, 4);
  const auto refused = [&](const std::string& text, const std::string& problem) {
    const std::string error = folder.error(text);
    EXPECT_NE(error.find("\n  " + problem), std::string::npos) << problem << "\nin " << error;
  };
  refused(with("\"Bond Energy\""),
          "Damage Models > brittle > Critical Bond Energy: missing; expected a real number > 0, in J/m⁶, or 'Fracture "
          "Energy' in its place");
  refused(with("\"Bond Energy\", Fracture Energy: 4.0, Critical Bond Energy: 1.0"),
          "Damage Models > brittle: 'Critical Bond Energy' and 'Fracture Energy' are both given");
  const std::string growing = "\"Time Dependent Critical Stretch\", Time Dependent Critical Stretch: \"0.001 + t\"";
  const std::string all = changed(fracturing, growing, "\"Bond Energy\", Fracture Energy: 4.0");
  refused(changed(all, "\"Elastic\"", "\"Elastic Correspondence\", Stabilization: \"Silling\""),
          "Blocks > all of it > Damage Model: bonds of material 'glass' cannot break by Damage Model 'Bond Energy'");
}

// Metals whose points fail: ours, in the same deck.
TEST(DeckOfPeridigm, PointsThatFailAreThoseOfMetals) {
  const DeckFolder folder;
  const std::string glass = "Material Model: \"Elastic\",", growing =
                                                                "\"Time Dependent Critical Stretch\", Time "
                                                                "Dependent Critical Stretch: \"0.001 + t\"";
  const auto with = [&](const std::string& material, const std::string& model) {
    return changed(changed(fracturing, glass, material), growing, model);
  };
  const std::string metal =
      "Material Model: \"Elastic Plastic Correspondence\", Formulation: \"Quadratic "
      "Correspondence\", Yield Stress: 2.0e8,";
  const Deck deck = folder.read(with(metal, "\"Johnson-Cook\", D1: 0.5, D2: 4.9, D3: -3.0, D4: 0.01"));
  const auto& ductility = deck.damage_models[1].model.ductility;
  ASSERT_TRUE(ductility);
  const auto& criterion = std::get<materials::JohnsonCookFailure>(ductility->criterion);
  EXPECT_EQ(criterion.constants[2], -3);
  EXPECT_EQ(criterion.reference_rate, 1);
  EXPECT_EQ(ductility->fracture_energy, 0);
  const auto refused = [&](const std::string& text, const std::string& problem) {
    const std::string error = folder.error(text);
    EXPECT_NE(error.find("\n  " + problem), std::string::npos) << problem << "\nin " << error;
  };
  refused(with(glass, "\"Plastic Strain\", Failure Strain: 0.2"),
          "Blocks > all of it > Damage Model: points of material 'glass' cannot fail by model 'growing': expected the "
          "Material Model 'Elastic Plastic Correspondence'");
  refused(with(metal, "\"Plastic Strain\", Failure Stain: 0.2"),
          "Damage Models > growing > Failure Stain: unknown key");
  refused(with(metal, "\"Cockcroft-Latham\", Critical Work: 0.0"), "Damage Models > growing > Critical Work: ");
  refused(with(metal, "\"Johnson-Cook\", D1: -0.5, D2: 0.4, D3: -3.0"),
          "Damage Models > growing > D1: D1 + D2 is not positive");
  refused(with(metal, "\"Johnson-Cook\", D1: 0.5, D2: 4.9, D3: -3.0, D5: 1.1"),
          "Damage Models > growing > Melting Temperature: missing; with D5");
  refused(with(metal, "\"Johnson-Cook\", D1: 0.5, D2: 4.9, D3: -3.0, D5: 1.1, Melting Temperature: 1356"),
          "Blocks > all of it > Damage Model: 'growing' has D5, but material 'glass' does not know its temperature");
  refused(with(metal, "\"Johnson-Cook\", D1: 0.5, D2: 0.4, D3: 3.0"), "Damage Models > growing > D3: ");
  const std::string slow = changed(with(metal, "\"Plastic Strain\", Failure Strain: 0.2"),
                                   "Verlet: {Safety Factor: 0.7}", "QuasiStatic: {Number of Load Steps: 1}");
  refused(slow,
          "Blocks > all of it > Damage Model: bonds of metal that fails cannot break with Solver > QuasiStatic; ");
  EXPECT_EQ(folder.error(slow).find("Critical Stretch"), std::string::npos) << folder.error(slow);
}

// Solids whose stress falls before bonds break: ours, in the same deck.
TEST(DeckOfPeridigm, GradualCracksAreThoseOfElasticCorrespondence) {
  const DeckFolder folder;
  const std::string cohesive =
      changed(fracturing,
              "\"Time Dependent Critical Stretch\", Time Dependent Critical Stretch: \"0.001 + "
              "t\"",
              "\"Cohesive Crack\", Fracture Energy: 4.0");
  const auto of = [&](const std::string& material) { return changed(cohesive, "\"Elastic\"", material); };
  const std::string quadratic = of("\"Elastic Correspondence\", Formulation: \"Quadratic Correspondence\"");
  EXPECT_TRUE(folder.read(quadratic).damage_models[1].model.is_gradual);
  EXPECT_TRUE(folder.read(of("\"Elastic Correspondence\"")).damage_models[1].model.is_gradual);
  for (const std::string& other : {cohesive, of("\"Elastic Correspondence\", Stabilization: Silling")}) {
    EXPECT_NE(folder.error(other).find("Blocks > all of it > Damage Model: material 'glass' cannot crack by model "
                                       "'growing': expected the Material Model 'Elastic Correspondence' with "
                                       "Stabilization 'Mean Gradient' or Formulation 'Quadratic Correspondence'"),
              std::string::npos);
  }
  const std::string equilibria = "QuasiStatic: {Number of Load Steps: 1}";
  const std::string both =
      changed(quadratic, "Verlet: {Safety Factor: 0.7}",
              equilibria + "\n  Solver 2:\n    Final Time: 2.0e-5\n    Verlet: {Safety Factor: 0.7}");
  EXPECT_NO_THROW(folder.read(both));
  EXPECT_NO_THROW(folder.read(changed(quadratic, "Verlet: {Safety Factor: 0.7}", equilibria)));
  const std::string unknown = changed(both, "Damage Model: \"growing\"", "Damage Model: \"grown\"");
  EXPECT_NE(folder.error(unknown).find("Blocks > all of it > Damage Model: 'grown'"), std::string::npos)
      << folder.error(unknown);
}

}  // namespace
}  // namespace strut::deck
