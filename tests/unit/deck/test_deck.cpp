// Decks that are right: every key into the structs, and every default.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "deck/changes.hpp"
#include "deck_under_test.hpp"

namespace strut::deck {
namespace {

std::string with_hardening(const std::string& parameters) {
  return changed(small_deck, R"(value="50e6"/>)",
                 R"(value="50e6"/><ParameterList name="Hardening">)" + parameters + "</ParameterList>");
}

materials::FlowStress flow(const Deck& deck) { return std::get<materials::J2>(deck.materials.front().law).flow; }

TEST(Deck, ReadsPoints) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  EXPECT_EQ(deck.file, folder / "deck.xml");
  EXPECT_EQ(deck.discretization.type, MeshType::text);
  EXPECT_EQ(deck.discretization.mesh, folder / "bar.txt");
  EXPECT_EQ(deck.discretization.influence, Influence::cubic_decay);
  EXPECT_EQ(deck.discretization.degenerate, DegeneratePoints::drop);
  ASSERT_EQ(deck.node_sets.size(), 1u);
  EXPECT_EQ(deck.node_sets[0].name, "low");
  EXPECT_NE(deck.node_sets[0].where(0, 0, 0.5e-3, 0), 0);
  EXPECT_EQ(deck.node_sets[0].where(0, 0, 2e-3, 0), 0);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Deck, ReadsFormulationAndBondsAcrossVoids) {
  const DeckFolder folder;
  EXPECT_EQ(folder.read(full_deck).materials[0].formulation, Formulation::correspondence);
  EXPECT_FALSE(folder.read(full_deck).blocks[0].across_voids.has_value());
  const std::string cells =
      replaced(replaced(full_deck, R"("Stabilization Coefficient" type="double" value="0.05"/>)",
                        R"("Formulation" type="string" value="Quadratic Correspondence"/>)"),
               R"(<Parameter name="Material" )",
               R"(<Parameter name="Bonds Across Voids" type="bool" value="false"/> <Parameter name="Material" )");
  const Deck deck = folder.read(cells);
  EXPECT_EQ(deck.materials[0].formulation, Formulation::quadratic);
  EXPECT_EQ(residual_of(deck.materials[0].stabilization), ResidualKind::none);
  EXPECT_EQ(deck.blocks[0].across_voids, std::optional(false));
}

TEST(Deck, TellsOfACoefficientBesideNoStabilization) {
  const DeckFolder folder;
  const std::string
      none = R"(<Parameter name="Stabilization" type="string" value="None"/>)",
      note = "Materials > steel > Stabilization Coefficient has no effect: Stabilization 'None' has no springs";
  const auto notes = [&](const std::string& more) { return folder.read(changed(full_deck, none, none + more)).notes; };
  EXPECT_EQ(
      std::ranges::count(notes(R"(<Parameter name="Stabilization Coefficient" type="double" value="0.1"/>)"), note), 1);
  EXPECT_EQ(std::ranges::count(notes(""), note), 0);
}

TEST(Deck, ReadsMaterials) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  ASSERT_EQ(deck.materials.size(), 2u);
  const Material& copper = deck.materials[0];
  EXPECT_EQ(copper.name, "copper");
  EXPECT_EQ(copper.density, 8960);
  EXPECT_EQ(residual_of(copper.stabilization), ResidualKind::both_gradients);
  EXPECT_EQ(copper.stabilization_coefficient, 0.05);
  const auto& j2 = std::get<materials::J2>(copper.law);
  EXPECT_DOUBLE_EQ(j2.bulk, 110e9 / (3 * (1 - 2 * 0.296)));
  EXPECT_DOUBLE_EQ(j2.shear, 110e9 / (2 * 1.296));
  EXPECT_EQ(j2.flow.yield_stress, 50e6);
  EXPECT_EQ(std::get<materials::PowerHardening>(j2.flow.hardening).reference_strain, 0.00218);
  EXPECT_EQ(std::get<materials::PowerHardening>(j2.flow.hardening).exponent, 0.1);
  EXPECT_EQ(std::get<materials::JohnsonCookRate>(j2.flow.rate).reference_rate, 2);
  EXPECT_EQ(std::get<materials::JohnsonCookRate>(j2.flow.rate).coefficient, 0.03);
  EXPECT_EQ(std::get<materials::Elastic>(deck.materials[1].law).bulk, 160e9);
  EXPECT_EQ(std::get<materials::Elastic>(deck.materials[1].law).shear, 80e9);
  EXPECT_EQ(residual_of(deck.materials[1].stabilization), ResidualKind::none);
  EXPECT_EQ(deck.materials[1].formulation, Formulation::correspondence);
}

// full_deck with more in its copper, and in the block of it.
std::string hot_deck(const std::string& more, const std::string& in_block = "") {
  const std::string material = R"(<Parameter name="Stabilization Coefficient" type="double" value="0.05"/>)";
  const std::string block = R"(<Parameter name="Material" type="string" value="copper"/>)";
  return changed(changed(full_deck, material, material + more), block, block + in_block);
}

const std::string softening = R"(<ParameterList name="Softening">
    <Parameter name="Type" type="string" value="Johnson-Cook"/>
    <Parameter name="Reference Temperature" type="double" value="294"/>
    <Parameter name="Melting Temperature" type="double" value="1356"/>
    <Parameter name="Exponent" type="double" value="1.09"/>
  </ParameterList>)";
const std::string heating = R"(<ParameterList name="Heating">
    <Parameter name="Specific Heat" type="double" value="383"/></ParameterList>)";
const std::string warm = R"(<Parameter name="Initial Temperature" type="double" value="718"/>)";

TEST(Deck, ReadsMetalsThatHeat) {
  const DeckFolder folder;
  const Deck deck = folder.read(hot_deck(softening + heating, warm));
  const auto& metal = std::get<materials::ThermalJ2>(deck.materials[0].law);
  EXPECT_EQ(metal.heating.capacity, 8960 * 383.0);
  EXPECT_EQ(metal.heating.taylor_quinney, 0.9);
  const auto& flow = std::get<materials::SoftenedFlow>(metal.flow);
  EXPECT_EQ(flow.cold.yield_stress, 50e6);
  const auto& theta = std::get<materials::JohnsonCookSoftening>(flow.softening);
  EXPECT_EQ(theta.reference, 294);
  EXPECT_EQ(theta.melting, 1356);
  EXPECT_EQ(theta.exponent, 1.09);
  EXPECT_EQ(deck.blocks[0].initial_temperature, std::optional(718.0));
  EXPECT_FALSE(deck.blocks[1].initial_temperature.has_value());
}

TEST(Deck, ReadsAnEquationOfState) {
  const DeckFolder folder;
  const Deck deck = folder.read(hot_deck(R"(<ParameterList name="Equation of State">
    <Parameter name="Type" type="string" value="Mie-Gruneisen"/>
    <Parameter name="Sound Speed" type="double" value="3940"/>
    <Parameter name="Hugoniot Slope" type="double" value="1.49"/>
    <Parameter name="Gruneisen Parameter" type="double" value="1.96"/></ParameterList>)"));
  const auto& metal = std::get<materials::ShockJ2>(deck.materials[0].law);
  EXPECT_EQ(std::get<materials::MieGruneisen>(metal.equation).density, 8960);
  EXPECT_DOUBLE_EQ(metal.metal.bulk, 8960 * 3940.0 * 3940.0);
  EXPECT_EQ(metal.metal.heating.capacity, 0);
}

TEST(Deck, TellsWhatDoesNotGoWithATemperature) {
  const DeckFolder folder;
  const auto refused = [&folder](const std::string& deck, const std::string& message) {
    const std::string error = folder.error(deck);
    EXPECT_NE(error.find(message), std::string::npos) << message << "\nin " << error;
  };
  refused(hot_deck("", warm),
          "Blocks > foam > Initial Temperature: given, but material 'copper' does not depend on it");
  refused(hot_deck(changed(softening, "1356", "200")),
          "Softening > Melting Temperature: expected more than the Reference Temperature");
  refused(hot_deck(R"(<ParameterList name="Heating"/>)"), "Heating > Specific Heat: missing");
  const std::string zerilli = R"(<ParameterList name="Flow Stress">
    <Parameter name="Type" type="string" value="Zerilli-Armstrong"/>
    <Parameter name="Athermal Stress" type="double" value="65e6"/>
    <Parameter name="Thermal Stress" type="double" value="890e6"/>
    <Parameter name="Thermal Exponent" type="double" value="0.5"/>
    <Parameter name="Softening" type="double" value="0.0028"/>
    <Parameter name="Rate Softening" type="double" value="0.000115"/></ParameterList>)";
  refused(hot_deck(zerilli), "copper > Yield Stress: given, but Flow Stress has the Type 'Zerilli-Armstrong'");
  refused(hot_deck(zerilli), "copper > Hardening: given, but Flow Stress has the Type 'Zerilli-Armstrong'");
}

TEST(Deck, ReadsContact) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  ASSERT_EQ(deck.contact_models.size(), 1u);
  const auto& law = std::get<contact::PenaltyLaw>(std::get<contact::PairLaw>(deck.contact_models[0].model.law));
  EXPECT_EQ(law.radius, 2e-3);
  EXPECT_EQ(law.penalty, 1e12);
  EXPECT_EQ(deck.contact_models[0].model.friction, 0.3);
  ASSERT_EQ(deck.interactions.size(), 2u);
  EXPECT_EQ(deck.interactions[0].first_block, "block_2");
  EXPECT_EQ(deck.interactions[0].second_block, "block_1");
  EXPECT_EQ(deck.interactions[1].first_block, "");
}

TEST(Deck, ReadsHertz) {
  const DeckFolder folder;
  const std::string law = changed(full_deck, R"(value="Short Range Force")", R"(value="Hertz")");
  const Deck deck = folder.read(changed(law, R"("Spring Constant" type="double" value="1.0e12")",
                                        R"("Effective Modulus" type="double" value="60e9")"));
  const auto& hertz = std::get<contact::HertzLaw>(std::get<contact::PairLaw>(deck.contact_models[0].model.law));
  EXPECT_EQ(hertz.radius, 2e-3);
  EXPECT_EQ(hertz.effective_modulus, 60e9);
  EXPECT_EQ(deck.contact_models[0].model.friction, 0.3);
}

TEST(Deck, ReadsOrdinaryMaterials) {
  const DeckFolder folder;
  const std::string stabilization = R"(<Parameter name="Stabilization" type="string" value="None"/>)";
  const Deck deck = folder.read(
      changed(changed(full_deck, R"(value="Elastic Correspondence")", R"(value="Elastic")"), stabilization, ""));
  EXPECT_EQ(deck.materials[0].formulation, Formulation::correspondence);
  EXPECT_EQ(deck.materials[1].formulation, Formulation::ordinary);
  EXPECT_EQ(std::get<materials::Elastic>(deck.materials[1].law).bulk, 160e9);
  EXPECT_EQ(coefficient_of(deck.materials[1].stabilization), 0);
}

TEST(Deck, ReadsBlocks) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  ASSERT_EQ(deck.blocks.size(), 2u);
  EXPECT_EQ(deck.blocks[0].name, "foam");
  EXPECT_EQ(deck.blocks[0].block_names, (std::vector<std::string>{"block_1", "block_3"}));
  EXPECT_EQ(deck.blocks[0].material, 0);
  EXPECT_EQ(deck.blocks[0].horizon, 0.0065);
  EXPECT_FALSE(deck.blocks[0].horizon_factor);
  EXPECT_EQ(deck.blocks[1].material, 1);
}

TEST(Deck, ReadsPointsAndHorizonFactor) {
  const DeckFolder folder;
  EXPECT_EQ(folder.read(small_deck).discretization.points, Points::elements);
  std::string text =
      changed(small_deck, R"("Horizon" type="double" value="0.0065")", R"("Horizon Factor" type="double" value="1.5")");
  text = changed(text, R"(<Parameter name="Input Mesh File")",
                 R"(<Parameter name="Points" type="string" value="Nodes"/> <Parameter name="Input Mesh File")");
  const Deck deck = folder.read(text);
  EXPECT_EQ(deck.discretization.points, Points::nodes);
  EXPECT_EQ(deck.blocks[0].horizon_factor, 1.5);
  EXPECT_FALSE(deck.blocks[0].horizon);
}

TEST(Deck, ReadsConditions) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  ASSERT_EQ(deck.conditions.size(), 3u);
  const Condition &trajectory = deck.conditions[0], &pull = deck.conditions[1], &wall = deck.conditions[2];
  EXPECT_EQ(trajectory.name, "flight");
  EXPECT_EQ(trajectory.node_set, "all");
  const InitialVelocity& velocity = std::get<InitialVelocity>(trajectory.kind);
  EXPECT_EQ(velocity.components, std::vector{2});
  EXPECT_EQ(velocity.value(1, 2, 3, 4), -50);
  EXPECT_EQ(pull.node_set, "low");
  const PrescribedMotion& displacement = std::get<PrescribedMotion>(pull.kind);
  EXPECT_FALSE(displacement.is_velocity);
  EXPECT_EQ(displacement.components, std::vector{1});
  EXPECT_DOUBLE_EQ(displacement.value(0, 2, 0, 3), 6e-3);
  const HalfSpace& half = std::get<HalfSpace>(std::get<RigidTool>(wall.kind).shape);
  EXPECT_EQ(half.point, Vector(0, 0, -1e-3));
  EXPECT_EQ(half.normal, Vector(0, 0, 1)) << "of unit length, whatever that in the deck";
}

TEST(Deck, ReadsEveryTypeOfCondition) {
  const DeckFolder folder;
  const auto first = [&](const std::string& type) {
    return folder.read(changed(full_deck, "Initial Velocity", type)).conditions[0].kind;
  };
  EXPECT_EQ(std::get<InitialVelocity>(first("Initial Velocity")).components, std::vector{2});
  EXPECT_FALSE(std::get<PrescribedMotion>(first("Prescribed Displacement")).is_velocity);
  EXPECT_TRUE(std::get<PrescribedMotion>(first("Prescribed Velocity")).is_velocity);
  EXPECT_EQ(std::get<BodyForce>(first("Body Force")).components, std::vector{2});
  EXPECT_EQ(std::get<BodyForce>(first("Body Force")).value(1, 2, 3, 4), -50);
  const Deck deck = folder.read(changed(full_deck, "Rigid Plane", "Symmetry Plane"));
  EXPECT_EQ(std::get<SymmetryPlane>(deck.conditions[2].kind).normal, Vector(0, 0, 1));
}

// In any order; each once.
TEST(Deck, ReadsSeveralCoordinates) {
  const DeckFolder folder;
  const auto first = [&](const std::string& coordinates) {
    const std::string text = changed(full_deck, R"(value="z")", "value=\"" + coordinates + "\"");
    return std::get<InitialVelocity>(folder.read(text).conditions[0].kind).components;
  };
  EXPECT_EQ(first("x"), std::vector{0});
  EXPECT_EQ(first("yz"), (std::vector{1, 2}));
  EXPECT_EQ(first("zx"), (std::vector{0, 2}));
  EXPECT_EQ(first("xyz"), (std::vector{0, 1, 2}));
  EXPECT_EQ(first("zyx"), (std::vector{0, 1, 2}));
  const Deck deck = folder.read(changed(full_deck, R"(value="y")", R"(value="xyz")"));
  EXPECT_EQ(std::get<PrescribedMotion>(deck.conditions[1].kind).components, (std::vector{0, 1, 2}));
  const std::string loads =
      changed(changed(full_deck, "Initial Velocity", "Body Force"), R"(value="z")", R"(value="xy")");
  EXPECT_EQ(std::get<BodyForce>(folder.read(loads).conditions[0].kind).components, (std::vector{0, 1}));
}

TEST(Deck, ReadsTools) {
  const DeckFolder folder;
  const auto tool = [&](const std::string& shape) {
    return std::get<RigidTool>(folder.read(changed(full_deck, wall_shape, shape)).conditions[2].kind);
  };
  EXPECT_FALSE(tool(wall_shape).travel[0]) << "without travel it stays";
  const RigidTool roll = tool(R"("Rigid Cylinder"/>
      <Parameter name="Point" type="string" value="0 0 -1e-3"/> <Parameter name="Axis" type="string" value="0 2 0"/>
      <Parameter name="Radius" type="double" value="0.5"/> <Parameter name="Travel Y" type="string" value="3*t"/>
      <Parameter name="Friction Coefficient" type="double" value="0.1"/>)");
  const Cylinder& cylinder = std::get<Cylinder>(roll.shape);
  EXPECT_EQ(cylinder.point, Vector(0, 0, -1e-3));
  EXPECT_EQ(cylinder.axis, Vector(0, 1, 0));
  EXPECT_EQ(cylinder.radius, 0.5);
  EXPECT_EQ(roll.friction, 0.1);
  EXPECT_FALSE(roll.travel[0] || roll.travel[2]);
  EXPECT_EQ(roll.travel[1].value()(0, 0, 0, 2), 6);
  const RigidTool block = tool(R"("Rigid Box"/>
      <Parameter name="Lower Corner" type="string" value="0 -1 2"/>
      <Parameter name="Upper Corner" type="string" value="1 0 3"/> <Parameter name="Travel Z" type="double" value="4"/>)");
  const Box& box = std::get<Box>(block.shape);
  EXPECT_EQ(box.lower, Vector(0, -1, 2));
  EXPECT_EQ(box.upper, Vector(1, 0, 3));
  EXPECT_EQ(block.friction, 0);
  EXPECT_EQ(block.travel[2].value()(0, 0, 0, 2), 4);
}

TEST(Deck, ReadsSolverOutputAndHistory) {
  const DeckFolder folder;
  const Deck deck = folder.read(full_deck);
  EXPECT_EQ(deck.solver.initial_time, 1e-4);
  EXPECT_EQ(deck.solver.final_time, 3e-4);
  EXPECT_EQ(deck.solver.wall_time, 3600);
  EXPECT_EQ(deck.solver.fixed_dt, 1e-8);
  EXPECT_EQ(deck.solver.rebalance, 1.5);
  EXPECT_TRUE(deck.output.enabled);
  EXPECT_EQ(deck.output.file, "bar.e");
  EXPECT_EQ(deck.output.frequency, 100);
  EXPECT_FALSE(deck.output.interval);
  EXPECT_EQ(deck.output.variables, (std::vector<std::string>{"Displacement", "Von_Mises_Stress"}));
  EXPECT_TRUE(deck.history.enabled);
  EXPECT_EQ(deck.history.file, "bar.csv");
  EXPECT_FALSE(deck.history.frequency);
  EXPECT_EQ(deck.history.interval, 1e-6);
  EXPECT_EQ(deck.history.variables, std::vector<std::string>{"Max_Displacement"});
}

TEST(Deck, HasDefaults) {
  const DeckFolder folder;
  const Deck deck = folder.read(small_deck);
  EXPECT_EQ(deck.discretization.influence, Influence::one);
  EXPECT_EQ(deck.discretization.degenerate, DegeneratePoints::error);
  EXPECT_TRUE(deck.node_sets.empty());
  EXPECT_TRUE(deck.conditions.empty());
  EXPECT_EQ(residual_of(deck.materials[0].stabilization), ResidualKind::both_gradients);
  EXPECT_FALSE(deck.materials[0].stabilization_coefficient);
  EXPECT_TRUE(std::holds_alternative<materials::NoHardening>(flow(deck).hardening));
  EXPECT_TRUE(std::holds_alternative<materials::NoRate>(flow(deck).rate));
  EXPECT_EQ(deck.solver.initial_time, 0);
  EXPECT_FALSE(deck.solver.wall_time);
  EXPECT_FALSE(deck.solver.fixed_dt);
  EXPECT_EQ(deck.solver.safety_factor, 0.8);
  EXPECT_EQ(deck.solver.rebalance, 1.3);
  EXPECT_FALSE(deck.solver.quasi_static);
  EXPECT_FALSE(deck.solver.verbose);
  EXPECT_FALSE(deck.output.enabled);
  EXPECT_FALSE(deck.history.enabled);
  EXPECT_TRUE(deck.restart.enabled);
  EXPECT_FALSE(deck.restart.kept_at_end);  // nothing is left when the run is over
}

TEST(Deck, ARestartSectionAsksForTheFileToStay) {
  const DeckFolder folder;
  const Deck deck = folder.read(changed(small_deck, R"(<ParameterList name="Solver">)",
                                        R"(<ParameterList name="Restart"/><ParameterList name="Solver">)"));
  EXPECT_TRUE(deck.restart.enabled);
  EXPECT_TRUE(deck.restart.kept_at_end);
}

Deck with_quasi_static(const DeckFolder& folder, const std::string& parameters) {
  return folder.read(changed(small_deck, R"(value="2e-4"/>)",
                             R"(value="2e-4"/><ParameterList name="QuasiStatic">)" + parameters + "</ParameterList>"));
}

TEST(Deck, ReadsQuasiStaticSolver) {
  const DeckFolder folder;
  const Deck deck = with_quasi_static(folder, R"(<Parameter name="Method" type="string" value="Dynamic Relaxation"/>
                                   <Parameter name="Number of Load Steps" type="int" value="25"/>
                                   <Parameter name="Tolerance" type="double" value="1e-4"/>
                                   <Parameter name="Maximum Solver Iterations" type="int" value="7"/>)");
  ASSERT_TRUE(deck.solver.quasi_static);
  EXPECT_FALSE(deck.solver.quasi_static->with_tangent);
  EXPECT_EQ(deck.solver.quasi_static->load_steps, 25);
  EXPECT_EQ(deck.solver.quasi_static->tolerance, 1e-4);
  EXPECT_EQ(deck.solver.quasi_static->most_iterations, 7);
}

TEST(Deck, HasDefaultsOfTheQuasiStaticSolver) {
  const DeckFolder folder;
  const Deck deck = with_quasi_static(folder, "");
  ASSERT_TRUE(deck.solver.quasi_static);
  EXPECT_TRUE(deck.solver.quasi_static->with_tangent);
  EXPECT_EQ(deck.solver.quasi_static->load_steps, 10);
  EXPECT_EQ(deck.solver.quasi_static->tolerance, 1e-6);
  EXPECT_EQ(deck.solver.quasi_static->most_iterations, 20);
}

TEST(Deck, HasDefaultIntervals) {
  const DeckFolder folder;
  const std::string output = changed(full_deck, R"(<Parameter name="Output Frequency" type="int" value="100"/>)", "");
  EXPECT_DOUBLE_EQ(folder.read(output).output.interval.value(), 1e-5);
  const std::string history = changed(full_deck, R"(<Parameter name="Interval" type="double" value="1e-6"/>)", "");
  EXPECT_DOUBLE_EQ(folder.read(history).history.interval.value(), 2e-7);
}

TEST(Deck, TellsOfAnIntervalLongerThanTheRun) {
  const DeckFolder folder;
  const std::string interval = R"(<Parameter name="Interval" type="double" value="1e-6"/>)";
  const auto told = [](const Deck& deck) {
    return std::ranges::count_if(deck.notes,
                                 [](const std::string& note) { return note.find("the run lasts") != note.npos; });
  };
  const Deck longer = folder.read(changed(full_deck, interval, replaced(interval, "1e-6", "1")));
  EXPECT_EQ(told(longer), 1);
  EXPECT_EQ(told(folder.read(full_deck)), 0);
}

TEST(Deck, TellsOfALimitOfAddedMassWithoutMassScaling) {
  const DeckFolder folder;
  const std::string step = R"(<Parameter name="Fixed dt" type="double" value="1e-8"/>)",
                    limit = R"(<Parameter name="Most Added Mass" type="double" value="0.1"/>)";
  const std::vector<std::string> notes = folder.read(changed(full_deck, step, step + limit)).notes;
  EXPECT_EQ(std::ranges::count(notes, "Solver > Verlet > Most Added Mass has no effect without Mass Scaling dt"), 1);
}

TEST(Deck, KeepsTheSuffixOfTheOutput) {
  const DeckFolder folder;
  EXPECT_EQ(folder.read(changed(full_deck, R"(value="bar"/>)", R"(value="bar.exo"/>)")).output.file, "bar.exo");
}

TEST(Deck, ReadsEveryHardening) {
  const DeckFolder folder;
  const auto hardening = [&](const std::string& type, const std::string& keys) {
    const std::string parameters = R"(<Parameter name="Type" type="string" value=")" + type + R"("/>)" + keys;
    return flow(folder.read(with_hardening(parameters))).hardening;
  };
  const auto key = [](const std::string& name, const std::string& value) {
    return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
  };
  EXPECT_TRUE(std::holds_alternative<materials::NoHardening>(hardening("None", "")));
  EXPECT_EQ(std::get<materials::LinearHardening>(hardening("Linear", key("Hardening Modulus", "1e9"))).modulus, 1e9);
  const auto ludwik =
      std::get<materials::LudwikHardening>(hardening("Ludwik", key("Modulus", "3e8") + key("Exponent", "0.31")));
  EXPECT_EQ(ludwik.modulus, 3e8);
  EXPECT_EQ(ludwik.exponent, 0.31);
  const auto voce = std::get<materials::VoceHardening>(
      hardening("Voce", key("Saturation Stress", "2e8") + key("Saturation Rate", "12")));
  EXPECT_EQ(voce.saturation, 2e8);
  EXPECT_EQ(voce.rate, 12);
}

TEST(Deck, ReadsTablesAsTextAndAsArrays) {
  const DeckFolder folder;
  const std::string type = R"(<Parameter name="Type" type="string" value="Table"/>)";
  const std::string text = R"(<Parameter name="Strains" type="string" value="0 0.1, 0.5"/>
                              <Parameter name="Stresses" type="string" value="50e6 60e6 70e6"/>)";
  const std::string arrays = R"xml(<Parameter name="Strains" type="Array(double)" value="{0, 0.1, 0.5}"/>
                                <Parameter name="Stresses" type="Array(int)" value="{50000000,60000000,70000000}"/>)xml";
  for (const std::string& keys : {text, arrays}) {
    const materials::FlowStress stress = flow(folder.read(with_hardening(type + keys)));
    EXPECT_EQ(stress.yield_stress, 50e6);
    EXPECT_EQ(std::get<materials::TableHardening>(stress.hardening).strains, (std::vector<double>{0, 0.1, 0.5}));
    EXPECT_EQ(std::get<materials::TableHardening>(stress.hardening).stresses, (std::vector<double>{50e6, 60e6, 70e6}));
  }
  const std::string no_yield = R"(<Parameter name="Yield Stress" type="double" value="50e6"/>)";
  EXPECT_EQ(flow(folder.read(changed(with_hardening(type + text), no_yield, ""))).yield_stress, 50e6);
}

TEST(Deck, ReadsThePowerLawOfRate) {
  const DeckFolder folder;
  const std::string deck = changed(changed(full_deck, "Johnson-Cook", "Power Law"), "\"Coefficient\"", "\"Exponent\"");
  const auto rate = std::get<materials::PowerRate>(flow(folder.read(deck)).rate);
  EXPECT_EQ(rate.reference_rate, 2);
  EXPECT_EQ(rate.exponent, 0.03);
}

// Any two of the four constants give the same material.
TEST(Deck, TakesAnyTwoElasticConstants) {
  const DeckFolder folder;
  const double K = 160e9, G = 80e9, E = 9 * K * G / (3 * K + G), nu = (3 * K - 2 * G) / (2 * (3 * K + G));
  const std::vector<std::pair<std::string, double>> constants = {
      {"Bulk Modulus", K}, {"Shear Modulus", G}, {"Young's Modulus", E}, {"Poisson's Ratio", nu}};
  const auto key = [](const std::pair<std::string, double>& one) {
    std::ostringstream text;
    text.precision(17);
    text << "name=\"" << one.first << "\" type=\"double\" value=\"" << one.second << "\"";
    return text.str();
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::string text = changed(full_deck, R"(name="Bulk Modulus" type="double" value="160e9")", key(constants[i]));
      text = changed(text, R"(name="Shear Modulus" type="double" value="80e9")", key(constants[j]));
      const auto elastic = std::get<materials::Elastic>(folder.read(text).materials[1].law);
      EXPECT_NEAR(elastic.bulk, K, 1e-12 * K) << constants[i].first << ", " << constants[j].first;
      EXPECT_NEAR(elastic.shear, G, 1e-12 * G) << constants[i].first << ", " << constants[j].first;
    }
  }
}

TEST(Deck, ReadsTheTaylorDecks) {
  const DeckFolder folder;
  folder.write("bar.g", "");
  folder.write("bar-227-fitted.g", "");
  folder.write("bar-190.g", "");
  folder.write("bar-hot.g", "");
  const std::filesystem::path inputs = std::filesystem::path(STRUT_SOURCE_DIR) / "inputs" / "taylor";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(inputs)) {
    if (entry.path().extension() != ".xml") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    EXPECT_EQ(folder.error(text.str()), "") << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

const char* const foam_keys = R"(value="Metal Foam Correspondence"/>
      <Parameter name="Plateau Stress" type="double" value="3e6"/>
      <Parameter name="Linear Hardening" type="double" value="3e6"/>
      <Parameter name="Locking Stress" type="double" value="45e6"/>
      <Parameter name="Locking Exponent" type="double" value="4"/>
)";

std::string foam_deck(const std::string& more) {
  return changed(full_deck, R"(value="Elastic Correspondence"/>)", foam_keys + more);
}

// α from ν_p, ε_D from the densities: −(9 + α²)/(3 α²) ln(ρ_f/ρ_s), 0 < ν_p.
TEST(Deck, MetalFoamFromPoissonsRatioAndDensities) {
  const DeckFolder folder;
  const Deck deck = folder.read(foam_deck(R"(<Parameter name="Plastic Poisson's Ratio" type="double" value="0.1"/>
      <Parameter name="Solid Density" type="double" value="1e5"/>)"));
  const auto& law = std::get<materials::DeshpandeFleck>(deck.materials[1].law);
  EXPECT_DOUBLE_EQ(law.alpha * law.alpha, 4.5 * 0.8 / 1.1);
  const double ratio = deck.materials[1].density / 1e5, square = law.alpha * law.alpha;
  EXPECT_NEAR(law.densification, -(9 + square) / (3 * square) * std::log(ratio), 1e-12);
}

TEST(Deck, MetalFoamNamesWhatIsMissing) {
  const DeckFolder folder;
  const std::string error = folder.error(foam_deck(R"(<Parameter name="Alpha" type="double" value="2.1"/>)"));
  EXPECT_NE(error.find("Densification Strain: missing; expected a real number > 0, or 'Solid Density' in its place"),
            std::string::npos)
      << error;
}

// In the place of the steel of full_deck; its elastic constants are the solid's.
std::string polymer_deck(const std::string& keys, const std::string& tables = "") {
  return changed(full_deck, R"(value="Elastic Correspondence"/>)",
                 R"(value="Polymer Foam Correspondence"/>)" + keys + tables);
}

const char* const polymer_keys = R"(
      <Parameter name="Relative Density" type="double" value="0.049"/>
      <Parameter name="Density Exponent" type="double" value="1.54"/>
      <Parameter name="Tension Ratio" type="double" value="0.3"/>
      <Parameter name="Uniaxial Yield Stress" type="double" value="82e3"/>
      <Parameter name="Hydrostatic Yield Stress" type="double" value="40e3"/>
)";

std::string polymer_table(const std::string& name, const std::string& strains, const std::string& stresses) {
  return "<ParameterList name=\"" + name + "\"><Parameter name=\"Strains\" type=\"string\" value=\"" + strains +
         "\"/><Parameter name=\"Stresses\" type=\"string\" value=\"" + stresses + "\"/></ParameterList>";
}

TEST(Deck, PolymerFoam) {
  const DeckFolder folder;
  const Deck deck =
      folder.read(polymer_deck(polymer_keys, polymer_table("Uniaxial Hardening", "0 0.5 1", "0 -2e3 5e3") +
                                                 polymer_table("Hydrostatic Hardening", "0 2", "0 1e3")));
  const auto& law = std::get<materials::PolymerFoam>(deck.materials[1].law);
  EXPECT_EQ(law.initial_density, 0.049);
  EXPECT_EQ(law.density_exponent, 1.54);
  EXPECT_EQ(law.tension_ratio, 0.3);
  EXPECT_EQ(law.plastic_poisson, 0);
  EXPECT_EQ(law.yield_stresses(0).uniaxial, 82e3);
  EXPECT_EQ(law.yield_stresses(0.5).uniaxial, 80e3);
  EXPECT_EQ(law.yield_stresses(3).uniaxial, 87e3);
  EXPECT_EQ(law.yield_stresses(-1).hydrostatic, 40e3);
  EXPECT_DOUBLE_EQ(law.yield_stresses(1).hydrostatic, 40.5e3);
  EXPECT_DOUBLE_EQ(law.moduli().bulk, law.solid.bulk * std::pow(0.049, 1.54));
}

TEST(Deck, PolymerFoamWithoutTablesDoesNotHarden) {
  const DeckFolder folder;
  const Deck deck = folder.read(polymer_deck(polymer_keys));
  EXPECT_EQ(std::get<materials::PolymerFoam>(deck.materials[1].law).yield_stresses(1).uniaxial, 82e3);
}

struct WrongPolymer {
  std::string what, keys, tables, problem;
};

// By hand: 82 + 60 ε against 3 × 40 is equal at ε = 38/60; 82 − 100 ε is 0 at 0.82; with ν_p = 0.25 ε_a = 2 ε_v.
TEST(Deck, PolymerFoamNamesWhatIsWrong) {
  const DeckFolder folder;
  const std::string nu = R"(<Parameter name="Plastic Poisson's Ratio" type="double" value="0.25"/>)";
  const std::string no_ellipse =
      " Pa, reaches three times the hydrostatic one, 40000 Pa, where no ellipse goes through both; expected less than "
      "that, in Pa, at every strain";
  const std::vector<WrongPolymer> cases = {
      {"between knots", "", polymer_table("Uniaxial Hardening", "0 1", "0 60e3"),
       "Materials > steel: at the volumetric plastic strain 0.633333 the uniaxial yield stress, 120000" + no_ellipse},
      {"by the axial strain", nu, polymer_table("Uniaxial Hardening", "0 1", "0 60e3"),
       "Materials > steel: at the volumetric plastic strain 0.316667 the uniaxial yield stress, 120000" + no_ellipse},
      {"beyond the shorter table", "",
       polymer_table("Uniaxial Hardening", "0 1 4", "0 20e3 50e3") +
           polymer_table("Hydrostatic Hardening", "0 0.5", "0 0"),
       "Materials > steel: at the volumetric plastic strain 2.8 the uniaxial yield stress, 120000" + no_ellipse},
      {"softens to nothing", "", polymer_table("Uniaxial Hardening", "0 1", "0 -100e3"),
       "Materials > steel: the uniaxial yield stress falls to 0 at the axial plastic strain 0.82; expected more than "
       "0, "
       "in Pa"},
      {"a total stress", "", polymer_table("Hydrostatic Hardening", "0 1", "40e3 50e3"),
       "Materials > steel > Hydrostatic Hardening > Stresses: the first is 40000; expected 0, in Pa: what is added by "
       "hardening"},
      {"unequal", "", polymer_table("Hydrostatic Hardening", "0 1 2", "0 50e3"),
       "Materials > steel > Hydrostatic Hardening > Strains: 3 strains for 2 stresses; expected as many"},
      {"falling", "", polymer_table("Uniaxial Hardening", "0 1 0.5", "0 1 2"),
       "Materials > steel > Uniaxial Hardening > Strains: 0.5 follows 1; expected rising strains"},
      {"incompressible flow", R"(<Parameter name="Plastic Poisson's Ratio" type="double" value="0.5"/>)", "",
       "Materials > steel > Plastic Poisson's Ratio: '0.5'; expected a real number in [0, 0.5)"},
  };
  for (const WrongPolymer& one : cases) {
    EXPECT_EQ(folder.error(polymer_deck(polymer_keys + one.keys, one.tables)), "deck.xml: 1 problem\n  " + one.problem)
        << one.what;
  }
  EXPECT_EQ(
      folder.error(changed(polymer_deck(polymer_keys), R"(value="40e3")", R"(value="27e3")")),
      "deck.xml: 1 problem\n  Materials > steel: at the volumetric plastic strain 0 the uniaxial yield stress, 82000 "
      "Pa, reaches three times the hydrostatic one, 27000 Pa, where no ellipse goes through both; expected less "
      "than that, in Pa, at every strain");
  EXPECT_EQ(folder.error(changed(polymer_deck(polymer_keys), R"(name="Tension Ratio" type="double" value="0.3")",
                                 R"(name="Tension Ratio" type="double" value="0")")),
            "deck.xml: 1 problem\n  Materials > steel > Tension Ratio: '0'; expected a real number > 0");
}

// Whatever squares the numbers have: none, or infinite ones.
TEST(Deck, DirectionsHaveUnitLengthHoweverTheyAreGiven) {
  const DeckFolder folder;
  const std::string along_z = R"x("Normal" type="Array(int)" value="{0, 0, 2}")x";
  for (const std::string length : {"1e-300", "5e-324", "1e300", "3e-170"}) {
    const Deck deck =
        folder.read(changed(full_deck, along_z, R"("Normal" type="string" value="0 -)" + length + " " + length + "\""));
    const auto& tool = std::get<RigidTool>(deck.conditions[2].kind);
    EXPECT_NEAR((std::get<HalfSpace>(tool.shape).normal - Vector(0, -std::sqrt(0.5), std::sqrt(0.5))).norm(), 0, 1e-15)
        << length;
  }
}

// A key that is wrong does not hide those of the mesh: the struct is there, and so are the problems.
TEST(Deck, ProblemsCanBeCollectedInsteadOfThrown) {
  const DeckFolder folder;
  folder.write("deck.xml", changed(full_deck, R"(type="int" value="8960")", R"(type="int" value="-8960")"));
  Problems problems;
  const Deck deck = deck::read(folder / "deck.xml", folder.world(), problems);
  EXPECT_EQ(problems.lines(),
            std::vector<std::string>{"Materials > copper > Density: '-8960'; expected a real number > 0, in kg/m³"});
  EXPECT_TRUE(problems.about("Materials"));
  EXPECT_FALSE(problems.about("Mater"));
  EXPECT_EQ(deck.blocks.size(), 2u);
}

// Tables in files stand beside the deck; its text then has their numbers, on all ranks and in checkpoints.
TEST(Deck, ReadsTablesInFiles) {
  const DeckFolder folder;
  const std::string with_file = changed(full_deck, "1e-3*y*t", "y*table(t, 'pull.csv')");
  folder.write("pull.csv", "s,m\n0,0\n1e-4,2\n");
  folder.write("deck.xml", with_file);
  const Deck deck = deck::read(folder / "deck.xml", folder.world());
  const auto pulled = [](const Deck& one) { return std::get<PrescribedMotion>(one.conditions[1].kind).value; };
  EXPECT_DOUBLE_EQ(pulled(deck)(0, 3, 0, 5e-5), 3);

  folder.write("pull.csv", "s,m\n0,0\n1e-4,3\n");
  const Deck other = deck::read(folder / "deck.xml", folder.world());
  EXPECT_EQ(changes(deck.text, other.text).refused,
            std::vector<std::string>{"Boundary Conditions > pull > Value: y*table(t,0,0,1e-04,2) before, "
                                     "y*table(t,0,0,1e-04,3) now"});
}

TEST(Deck, TablesInFilesAreRefusedByTheirKeyFileAndLine) {
  const DeckFolder folder;
  const auto problems_with = [&](const std::string& table) {
    folder.write("pull.csv", table);
    folder.write("deck.xml", changed(full_deck, "1e-3*y*t", "y*table(t, 'pull.csv')"));
    Problems problems;
    deck::read(folder / "deck.xml", folder.world(), problems);
    return problems.lines();
  };
  const std::string where = "Boundary Conditions > pull > Value: " + (folder / "pull.csv").string();
  EXPECT_EQ(problems_with("0,0\n0,1\n"),
            std::vector<std::string>{where + ", line 2: 0 after 0; expected places that rise"});
  EXPECT_EQ(problems_with("#"),
            std::vector<std::string>{where + " has no row; expected two numbers, the place (the time, "
                                             "s) and the value"});
}

// ---- Differences between two decks ----------------------------------------------------------------------------------

TEST(Changes, OfWritingAloneAreNone) {
  std::string other = changed(full_deck, R"(type="int" value="8960")", R"(type="double" value="8.96e3")");
  other =
      changed(other, "Bulk Modulus\" type=\"double\" value=\"160e9", "Bulk Modulus\" type=\"string\" value=\"1.6e11");
  other = changed(other, R"(<Parameter name="Stabilization" type="string" value="None"/>)",
                  R"(<Parameter name="Stabilization" type="string" value="None"/><!-- as before -->)");
  const std::string foam =
      other.substr(other.find("<ParameterList name=\"foam\">"),
                   other.find("<ParameterList name=\"plate\">") - other.find("<ParameterList name=\"foam\">"));
  other =
      changed(changed(other, foam, ""), "<ParameterList name=\"Blocks\">", "<ParameterList name=\"Blocks\">" + foam);
  const Changes none = changes(full_deck, other);
  EXPECT_TRUE(none.refused.empty() && none.loads.empty() && none.accepted.empty());
}

TEST(Changes, OfWhatARunIsMadeOfAreRefusedByTheirKeys) {
  const std::vector<std::array<std::string, 3>> cases = {
      {R"(type="int" value="8960")", R"(type="int" value="7000")",
       "Materials > copper > Density: 8960 before, 7000 now"},
      {R"(value="0.0065")", R"(value="0.007")", "Blocks > foam > Horizon: 0.0065 before, 0.007 now"},
      {"bar.txt", "rod.txt", "Discretization > Input Mesh File: bar.txt before, rod.txt now"},
      {"z &lt; 1e-3", "z &lt; 2e-3", "Node Sets > low: z<1e-3 before, z<2e-3 now"},
      {R"("Friction Coefficient" type="double" value="0.3")", R"("Friction Coefficient" type="double" value="0")",
       "Contact > Models > touch > Friction Coefficient: 0.3 before, 0 now"},
      {"{0, 0, 2}", "{0, 0, 3}", "Boundary Conditions > wall > Normal: 0 0 2 before, 0 0 3 now"},
      {"1e-3*y*t", "2e-3*y*t", "Boundary Conditions > pull > Value: 1e-3*y*t before, 2e-3*y*t now"},
      {R"(name="Initial Time" type="double" value="1e-4")", R"(name="Initial Time" type="double" value="0")",
       "Solver > Initial Time: 1e-04 before, 0 now"},
      {R"("Output Filename" type="string" value="bar")", R"("Output Filename" type="string" value="rod")",
       "Output > Output Filename: bar before, rod now"},
      {R"("Velocity" type="bool" value="false")", R"("Velocity" type="bool" value="true")",
       "Output > Output Variables > Velocity: nothing before, true now"}};
  for (const auto& [old, replacement, told] : cases) {
    const Changes one = changes(full_deck, changed(full_deck, old, replacement));
    EXPECT_EQ(one.refused, std::vector<std::string>{told});
    EXPECT_TRUE(one.loads.empty() && one.accepted.empty()) << told;
  }
}

// Two measured amplitudes differ somewhere in the middle.
TEST(Changes, OfLongTextsAreShownWhereTheyBegin) {
  std::string table = "table(t";
  for (int n = 0; n < 1000; ++n) table += ", " + std::to_string(n) + ", 0";
  const std::string before = changed(full_deck, "1e-3*y*t", table + ")");
  const Changes one = changes(before, changed(before, ", 500, 0, 501", ", 500, 7, 501"));
  ASSERT_EQ(one.refused.size(), 1u);
  EXPECT_LT(one.refused[0].size(), 400u);
  EXPECT_NE(one.refused[0].find("499,0,500,0,501,0"), std::string::npos) << one.refused[0];
  EXPECT_NE(one.refused[0].find("499,0,500,7,501,0"), std::string::npos) << one.refused[0];
}

TEST(Changes, AWholeSectionIsNamedOnce) {
  const std::size_t begin = full_deck.find("<ParameterList name=\"pull\">");
  std::string other = full_deck;
  other.erase(begin, full_deck.find("</ParameterList>", begin) + 16 - begin);
  EXPECT_EQ(changes(full_deck, other).refused,
            std::vector<std::string>{"Boundary Conditions > pull: a section before, nothing now"});
}

// A run names what it keeps of conditions by their numbers.
TEST(Changes, OfTheOrderOfConditionsAreRefused) {
  const std::string section = "<ParameterList name=\"Boundary Conditions\">";
  const std::size_t begin = full_deck.find("<ParameterList name=\"wall\">");
  const std::string wall = full_deck.substr(begin, full_deck.find("</ParameterList>", begin) + 16 - begin);
  const std::string other = changed(changed(full_deck, wall, ""), section, section + wall);
  EXPECT_EQ(changes(full_deck, other).refused,
            std::vector<std::string>{
                "Boundary Conditions, in their order: flight, pull, wall before, wall, flight, pull now"});
  EXPECT_TRUE(start_changes(full_deck, full_deck).same_conditions);
  EXPECT_FALSE(start_changes(full_deck, other).same_conditions);
}

// A ductile model counts from the beginning of a run what others do not look at.
TEST(Changes, OfAStartMayAddADamageModelThatIsNotDuctile) {
  const auto refused_with = [](const std::string& model, const std::string& limit) {
    const std::string horizon = R"(<Parameter name="Horizon" type="string" value="0.0065"/>)";
    const std::string blocks = R"(<ParameterList name="Blocks">)";
    std::string text =
        changed(full_deck, horizon, horizon + R"(<Parameter name="Damage Model" type="string" value="d"/>)");
    text = changed(text, blocks,
                   R"(<ParameterList name="Damage Models"><ParameterList name="d"><Parameter name="Damage Model" )"
                   R"(type="string" value=")" +
                       model + R"("/><Parameter name=")" + limit +
                       R"(" type="double" value="0.5"/></ParameterList></ParameterList>)" + blocks);
    return start_changes(full_deck, text).refused;
  };
  EXPECT_EQ(refused_with("Critical Stretch", "Critical Stretch"), std::vector<std::string>{});
  EXPECT_EQ(
      refused_with("Plastic Strain", "Failure Strain"),
      std::vector<std::string>{"Blocks > foam > Damage Model: nothing there, d here: a model 'Plastic Strain' counts "
                               "from the beginning what points have borne, which that run has not"});
}

// A Fracture Energy of Critical Stretch softens points in explicit steps, and breaks bonds at one stretch in
// equilibria.
TEST(Changes, OfAStartBetweenGradualCracksAndOthersAreRefused) {
  const auto list = [](const std::string& name, const std::string& content) {
    return "<ParameterList name=\"" + name + "\">" + content + "</ParameterList>";
  };
  const auto word = [](const std::string& name, const std::string& value) {
    return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
  };
  const auto deck_of = [&](const std::string& solver, const std::string& model, const std::string& factor = "1.75") {
    return list("B", list("Materials", list("m", word("Material Model", "Elastic Correspondence"))) +
                         list("Blocks", list("b", word("Material", "m") + word("Damage Model", "d") +
                                                      word("Horizon Factor", factor))) +
                         list("Damage Models", list("d", model)) + list("Solver", list(solver, "")));
  };
  const std::string by_energy = word("Damage Model", "Critical Stretch") + word("Fracture Energy", "5"),
                    by_stretch = word("Damage Model", "Critical Stretch") + word("Critical Stretch", "5"),
                    cohesive = word("Damage Model", "Cohesive Crack") + word("Fracture Energy", "5");
  const auto count = [](const std::string& other, const std::string& now) {
    return start_changes(other, now).refused.size();
  };
  EXPECT_EQ(count(deck_of("QuasiStatic", by_energy), deck_of("Verlet", by_energy)), 1U);
  EXPECT_EQ(count(deck_of("Verlet", by_energy), deck_of("QuasiStatic", by_energy)), 1U);
  EXPECT_EQ(count(deck_of("Verlet", by_energy), deck_of("Verlet", by_stretch)), 1U);
  EXPECT_EQ(count(deck_of("Verlet", by_energy), deck_of("Verlet", by_energy)), 0U);
  const std::string of_another = word("Damage Model", "Critical Stretch") + word("Fracture Energy", "50");
  EXPECT_EQ(count(deck_of("Verlet", by_energy), deck_of("Verlet", of_another)), 1U);
  EXPECT_EQ(count(deck_of("QuasiStatic", by_stretch), deck_of("Verlet", by_stretch)), 0U);
  EXPECT_EQ(count(deck_of("QuasiStatic", cohesive), deck_of("Verlet", cohesive)), 0U);
  EXPECT_EQ(count(deck_of("QuasiStatic", by_energy, "3.015"), deck_of("Verlet", by_energy, "3.015")), 0U);
}

// Steps may change, masses may not.
TEST(Changes, OfMassesWithinASectionOfStepsAreRefused) {
  const std::size_t begin = full_deck.find("<ParameterList name=\"Verlet\">");
  const std::size_t end = full_deck.find("</ParameterList>", begin);
  std::string without = full_deck, scaled = full_deck;
  without.erase(begin, end + 16 - begin);
  scaled.replace(begin, end - begin,
                 R"(<ParameterList name="Verlet"><Parameter name="Mass Scaling dt" type="double" value="1e-7"/>)");
  const Changes more = changes(without, scaled);
  EXPECT_EQ(more.accepted, std::vector<std::string>{"Solver > Verlet: nothing before, a section now"});
  EXPECT_EQ(more.refused, std::vector<std::string>{"Solver > Verlet > Mass Scaling dt: nothing before, 1e-07 now"});
  EXPECT_EQ(changes(scaled, without).refused,
            std::vector<std::string>{"Solver > Verlet > Mass Scaling dt: 1e-07 before, nothing now"});
  EXPECT_TRUE(changes(without, full_deck).refused.empty());
  // The wanted step over the safety factor is the critical one, for which mass is added.
  const std::string of_steps = R"(<Parameter name="Mass Scaling dt" type="double" value="1e-7"/>)";
  const std::string safer =
      changed(scaled, of_steps, of_steps + R"(<Parameter name="Safety Factor" type="double" value="0.5"/>)");
  EXPECT_EQ(changes(scaled, safer).refused,
            std::vector<std::string>{"Solver > Verlet > Safety Factor: 0.8 before, 0.5 now"});
}

// A default that is written down is none; a key that goes back to its default is one.
TEST(Changes, AreOfValuesNotOfKeys) {
  const std::string damping = R"(<Parameter name="Stabilization Coefficient" type="double" value="0.05"/>)";
  EXPECT_EQ(changes(full_deck, changed(full_deck, damping, "")).refused,
            std::vector<std::string>{"Materials > copper > Stabilization Coefficient: 0.05 before, nothing now"});
  const std::string solver = R"(<ParameterList name="Verlet">)";
  const std::string subcycling = R"(<Parameter name="Subcycling" type="bool" value="true"/>)";
  const Changes none = changes(full_deck, changed(full_deck, solver, solver + subcycling));
  EXPECT_TRUE(none.refused.empty() && none.accepted.empty());
}

TEST(Changes, OfTimesStepsAndOutputAreAcceptedAndThoseOfLoadsTold) {
  const std::vector<std::array<std::string, 3>> cases = {
      {R"(value="3e-4")", R"(value="4e-4")", "Solver > Final Time: 3e-04 before, 4e-04 now"},
      {R"("Fixed dt" type="double" value="1e-8")", R"("Fixed dt" type="double" value="5e-9")",
       "Solver > Verlet > Fixed dt: 1e-08 before, 5e-09 now"},
      {R"("Output Frequency" type="int" value="100")", R"("Output Frequency" type="int" value="10")",
       "Output > Output Frequency: 100 before, 10 now"},
      {R"("Interval" type="double" value="1e-6")", R"("Interval" type="double" value="2e-6")",
       "History > Interval: 1e-06 before, 2e-06 now"}};
  for (const auto& [old, replacement, told] : cases) {
    const Changes one = changes(full_deck, changed(full_deck, old, replacement));
    EXPECT_EQ(one.accepted, std::vector<std::string>{told});
    EXPECT_TRUE(one.refused.empty() && one.loads.empty()) << told;
  }
  const std::string pushed =
      changed(changed(full_deck, R"("Prescribed Displacement")", R"("Body Force")"), "1e-3*y*t", "5");
  EXPECT_EQ(changes(pushed, changed(pushed, R"(value="5")", R"(value="6")")).loads,
            std::vector<std::string>{"Boundary Conditions > pull > Value: 5 before, 6 now"});
}

// A history may begin or end with the new part of a run, unless it has columns that follow the run from row to row.
TEST(Changes, OfAHistoryWithForcesOrCracksAreRefusedByItsColumns) {
  const std::size_t begin = full_deck.find("<ParameterList name=\"History\">");
  std::string without = full_deck;
  without.erase(begin, full_deck.rfind("</ParameterList>") - begin);
  const Changes ends = changes(full_deck, without);
  EXPECT_EQ(ends.accepted, std::vector<std::string>{"History: a section before, nothing now"});
  EXPECT_TRUE(ends.refused.empty());
  for (const std::string column : {"Reaction_Z(wall)", "Instant_Reaction_Z(wall)", "Contact_Force_X(foam:plate)",
                                   "Instant_Contact_Force_X(foam:plate)", "Crack_Tip(notch)", "Crack_Speed(notch)"}) {
    const std::string with = changed(full_deck, "Max_Displacement", column), key = "History > Variables > " + column;
    EXPECT_EQ(changes(with, without).refused, std::vector<std::string>{key + ": true before, nothing now"});
    EXPECT_EQ(changes(without, with).refused, std::vector<std::string>{key + ": nothing before, true now"});
  }
}

}  // namespace
}  // namespace strut::deck
