// Slow loading by a deck: what a run leaves in its files, and what one that finds no equilibrium does.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

struct Files {
  Table history;
  io::ExodusResult result;  // of rank 0
  std::string error, said;  // what the run threw
};

std::string switched_on(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += key(name, "true");
  return all;
}

// Loads run from t = 0 to 1, each step to both files.
Files files_of(Parts parts, const std::string& quasi_static, const std::vector<std::string>& reactions,
               const Lattice& lattice = {}, const std::string& points = "") {
  const RunFolder folder(lattice);
  folder.write("points.txt", points);
  parts.times = key("Final Time", "1");
  parts.verlet = quasi_static;
  parts.output = key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "1") +
                 section("Output Variables", switched_on({"Displacement", "Von_Mises_Stress"}));
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", switched_on(reactions));
  const std::string deck = changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")");
  Files files;
  testing::internal::CaptureStdout();
  try {
    run(folder.write("deck.xml", deck), folder.world);
  } catch (const Error& error) {
    files.error = error.what();
  }
  files.said = testing::internal::GetCapturedStdout();
  files.history = read_history(folder / "history.csv");
  if (folder.world.rank() == 0) files.result = io::read_result(folder / "result.e");
  return files;
}

std::string all_of_foot() {
  return along("x", "Prescribed Displacement", "foot", "x", "0") +
         along("y", "Prescribed Displacement", "foot", "y", "0") +
         along("low", "Prescribed Displacement", "foot", "z", "0");
}

// However little a plane presses a bar, it does so by its travel: as if its end were moved. What is left is the
// penetration, a hundredth of the compression of the last cell, of six.
TEST(SlowLoading, APlanePressesByItsTravel) {
  for (const std::string travel : {"-1e-8*t", "-1e-6*t", "-5e-5*t"}) {
    const auto force = [&](const std::string& press) {
      Parts parts;
      parts.conditions = all_of_foot() + press;
      return files_of(parts, key("Number of Load Steps", "1"), {"Reaction_Z(low)"})
          .history.at("Reaction_Z(low)")
          .back();
    };
    const double by_plane = force(section("press", key("Type", "Rigid Plane") + key("Point", "0 0 5.5e-3") +
                                                       key("Normal", "0 0 -1") + key("Travel Z", travel)));
    const double by_end = force(along("press", "Prescribed Displacement", "top", "z", travel));
    EXPECT_NEAR(by_plane / by_end, 1, 0.01 / 6) << travel;
  }
}

// Integrals by hand. What is left is round-off of places, 4 mm; exact for tables, jumps and powers up to the fifth.
TEST(SlowLoading, IntegratesAPrescribedVelocity) {
  for (const auto& [velocity, way] :
       {std::pair("table(t, 0, 0, 0.04, 0, 0.041, 1, 0.05, 1, 0.051, 0)", 0.01), std::pair("0.003*t^2", 1e-3),
        std::pair("if (t &lt; 0.3) { value = 0; } else { value = 0.01; }", 7e-3),
        std::pair("0.003*t^2*(1 + 0*x)", 1e-3)}) {
    for (const std::string steps : {"1", "5"}) {
      Parts parts;
      parts.conditions = along("move", "Prescribed Velocity", "all", "xyz", velocity);
      const Files files = files_of(parts, key("Number of Load Steps", steps), {"Mean_Displacement_Z(top)"});
      EXPECT_NEAR(files.history.at("Mean_Displacement_Z(top)").back(), way, 1e-15) << velocity << files.error;
    }
  }
}

// A cycle in four steps: half of the work of the first step is missed, and all of those from tension to compression and
// back. In 32 steps the same is missed of steps eight times shorter, and less where the sine turns.
TEST(SlowLoading, PlasticWorkThatLoadStepsMissIsTold) {
  Parts parts;
  parts.materials = copper(key("Yield Stress", "50e6"));
  parts.conditions =
      all_of_foot() + along("pull", "Prescribed Displacement", "top", "z", "5e-5*sin(6.283185307179586*t)");
  const std::string words = "too small, by some ";
  const Files coarse = files_of(parts, key("Number of Load Steps", "4"), {});
  const Files fine = files_of(parts, key("Number of Load Steps", "32"), {});
  EXPECT_EQ(fine.said.find(words), std::string::npos) << fine.said;
  if (fine.said.empty()) return;  // another rank than the one that tells
  const std::size_t told = coarse.said.find(words);
  ASSERT_NE(told, std::string::npos) << coarse.said;
  const double missed = std::stod(coarse.said.substr(told + words.size()));
  const auto work = [](const Files& files) { return files.history.at("Plastic_Work").back(); };
  EXPECT_LT(work(coarse), 0.5 * work(fine));
  EXPECT_NEAR((work(coarse) + missed) / work(fine), 1, 0.05);
}

// While a plane only stands there, forces are round-off, and there is no load that they could be compared with.
TEST(SlowLoading, AStepWithoutALoadIsToldAsSuch) {
  Parts parts;
  parts.conditions =
      all_of_foot() + section("press", key("Type", "Rigid Plane") + key("Point", "0 0 5.5e-3") +
                                           key("Normal", "0 0 -1") + key("Travel Z", "-1e-5*max(t - 0.5, 0)"));
  const std::string said = files_of(parts, key("Number of Load Steps", "2"), {}).said;
  if (said.empty()) return;  // another rank than the one that tells
  EXPECT_NE(said.find("evaluations, no load\n"), std::string::npos) << said;
  EXPECT_NE(said.find(" of the load left"), std::string::npos) << said;
}

// A bar on its held foot, pressed by a plane. Forces of all conditions cancel but for what the tolerance leaves, 1e-6
// of them at each of 96 points at the most.
TEST(SlowLoading, WritesFramesAndReactions) {
  Parts parts;
  parts.conditions = all_of_foot() + section("press", key("Type", "Rigid Plane") + key("Point", "0 0 5.5e-3") +
                                                          key("Normal", "0 0 -1") + key("Travel Z", "-2e-5*t"));
  const Files files = files_of(parts, key("Number of Load Steps", "4"),
                               {"Reaction_Z(low)", "Reaction_Z(press)", "Reaction_X(x)", "Reaction_Y(y)"});
  EXPECT_EQ(files.error, "");
  const std::vector<double>&time = files.history.at("Time"), &low = files.history.at("Reaction_Z(low)"),
        &press = files.history.at("Reaction_Z(press)");
  ASSERT_EQ(time.size(), 5u);
  for (std::size_t n = 0; n < time.size(); ++n) {
    EXPECT_NEAR(time[n], 0.25 * static_cast<double>(n), 1e-12);
    const double most = std::sqrt(96.0) * 1e-6 * low.back();
    EXPECT_NEAR(low[n] + press[n], 0, most) << n;
    EXPECT_NEAR(files.history.at("Reaction_X(x)")[n], 0, most) << n;
    EXPECT_NEAR(files.history.at("Reaction_Y(y)")[n], 0, most) << n;
    EXPECT_EQ(files.history.at("Kinetic_Energy")[n], 0) << n;
    EXPECT_LT(files.history.at("Balance_Error")[n], 4e-3) << n;  // of a law in rates: the strain
    if (n > 0) {
      EXPECT_NEAR(low[n] / low.back(), time[n], 4e-3) << n;  // linear but for the strain
    }
  }
  // E A ε with the 5 mm between the end layers; the held foot, which cannot spread, and the surfaces, which are softer.
  const double force = 117e9 * 16e-6 * 2e-5 / 5e-3;
  EXPECT_NEAR(low.back(), force, 0.3 * force);
  EXPECT_GT(files.history.at("Tool_Work").back(), 0);
  EXPECT_EQ(files.history.at("External_Work").back(), 0);
}

// One condition along three axes holds what three conditions hold, to the last bit.
TEST(SlowLoading, HoldsAllAxesByOneCondition) {
  const std::string press = along("press", "Prescribed Displacement", "top", "z", "-2e-6*t*(1 + 100*x)");
  Parts three, one;
  three.conditions = all_of_foot() + press;
  one.conditions = along("foot", "Prescribed Displacement", "foot", "xyz", "0") + press;
  const std::string steps = key("Number of Load Steps", "2");
  const Files expected = files_of(three, steps, {"Reaction_X(x)", "Reaction_Y(y)", "Reaction_Z(low)"});
  const Files found = files_of(one, steps, {"Reaction_X(foot)", "Reaction_Y(foot)", "Reaction_Z(foot)"});
  EXPECT_EQ(found.error, "");
  EXPECT_EQ(found.history.at("Reaction_X(foot)"), expected.history.at("Reaction_X(x)"));
  EXPECT_EQ(found.history.at("Reaction_Y(foot)"), expected.history.at("Reaction_Y(y)"));
  EXPECT_EQ(found.history.at("Reaction_Z(foot)"), expected.history.at("Reaction_Z(low)"));
  EXPECT_EQ(found.history.at("Elastic_Energy"), expected.history.at("Elastic_Energy"));
  EXPECT_TRUE(found.result.nodal == expected.result.nodal && found.result.element == expected.result.element);
  EXPECT_GT(found.history.at("Reaction_Z(foot)").back(), 0);
}

// Nothing holds the bar across its axis, and nothing moves it there: on several ranks, too. What is left is what the
// search leaves of the pull, 10 µm, in an oblique direction.
TEST(SlowLoading, ABarThatIsFreeAcrossItsAxisStaysThere) {
  Parts parts;
  parts.conditions = along("low", "Prescribed Displacement", "foot", "z", "0") +
                     along("pull", "Prescribed Displacement", "top", "z", "1e-5*t");
  const Files files = files_of(parts, key("Number of Load Steps", "1"), {"Mean_Displacement_X", "Mean_Displacement_Y"},
                               {.nx = 5, .ny = 5, .nz = 10});
  EXPECT_EQ(files.error, "");
  EXPECT_LT(std::abs(files.history.at("Mean_Displacement_X").back()), 1e-8);
  EXPECT_LT(std::abs(files.history.at("Mean_Displacement_Y").back()), 1e-8);
}

// The deck of a bar whose end moves so: in three load steps from this time on, with a checkpoint after each.
std::filesystem::path bar_that_goes_on(const RunFolder& folder, const std::string& name, int start,
                                       const std::string& way, const std::string& from) {
  Parts parts;
  parts.conditions = all_of_foot() + along("pull", "Prescribed Displacement", "top", "z", way);
  parts.times = key("Initial Time", std::to_string(start)) + key("Final Time", std::to_string(start + 1));
  parts.verlet = key("Number of Load Steps", "3") + key("Tolerance", "1e-12");
  parts.history = key("Filename", (folder / (name + ".csv")).string()) + key("Frequency", "1") +
                  section("Variables", switched_on({"Mean_Displacement_X(top)"}));
  std::string text = changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")");
  text.insert(text.rfind("</ParameterList>"),
              section("Restart", key("Filename", (folder / (name + ".restart")).string()) + key("Frequency", "1")) +
                  (from.empty() ? "" : section("Start From", key("Checkpoint", (folder / from).string()))));
  return folder.write(name + ".xml", text);
}

// The tolerance is that of the deck however much is strained at the start, and the same where a run is continued.
TEST(SlowLoading, FromAStrainedBodyHasItsToleranceAndGoesOnToTheLastBit) {
  const RunFolder folder;
  testing::internal::CaptureStdout();
  run(bar_that_goes_on(folder, "first", 0, "8e-4*t", ""), folder.world);
  const std::string way = "8e-4*t + 1e-2*(t-1)*x";
  run(bar_that_goes_on(folder, "whole", 1, way, "first.restart"), folder.world);
  const auto divided = bar_that_goes_on(folder, "divided", 1, way, "first.restart");
  {
    deck::Problems problems;
    deck::Deck deck = deck::read(divided, folder.world, problems);
    strut::Run(std::move(deck), problems, folder.world, Start::anew).advance({.steps = 1});
  }
  run(divided, folder.world, Start::continued);
  std::istringstream said(testing::internal::GetCapturedStdout());
  int steps = 0;
  for (std::string line, word; std::getline(said, line);) {
    const std::size_t at = line.find(" evaluations, ");
    if (!line.starts_with("step ") || at == line.npos) continue;
    ++steps;
    EXPECT_LT(std::stod(line.substr(at + 14)), 1.01e-12) << line;
  }
  EXPECT_EQ(steps, folder.world.rank() == 0 ? 9 : 0);
  EXPECT_EQ(said.str().find("; forces of former loads and tools fade in the first load step") != std::string::npos,
            folder.world.rank() == 0);
  EXPECT_EQ(read_history(folder / "divided.csv"), read_history(folder / "whole.csv"));
}

// A foam bar that is drawn out loses all stress in a load step, without work, and is told of; one that is pressed is
// not.
TEST(SlowLoading, FoamThatPartsIsTold) {
  const auto told = [](const std::string& travel) {
    Parts parts;
    parts.materials = section("copper", key("Material Model", "Metal Foam Correspondence") + key("Density", "150") +
                                            key("Young's Modulus", "300e6") + key("Poisson's Ratio", "0") +
                                            key("Plastic Poisson's Ratio", "0") + key("Plateau Stress", "1e6") +
                                            key("Linear Hardening", "0") + key("Locking Stress", "2e6") +
                                            key("Locking Exponent", "8") + key("Densification Strain", "1.0") +
                                            key("Failure Strain", "0.01"));
    parts.conditions = all_of_foot() + along("top", "Prescribed Displacement", "top", "z", travel + "*t");
    const Files files = files_of(parts, key("Number of Load Steps", "2"), {"Reaction_Z(low)"});
    EXPECT_EQ(files.error, "");
    return files.said.find("points have failed (Failure Strain)") != std::string::npos;
  };
  const bool drawn = told("4e-4"), pressed = told("-1e-4");
  if (Communicator().rank() > 0) return;
  EXPECT_TRUE(drawn);
  EXPECT_FALSE(pressed);
}

// Nothing acts on a held bar until a tool arrives, or a load or a motion begins, at t = 0.35: it rests, in balance but
// for the round-off of places, and then has what it has without the time before.
TEST(SlowLoading, WaitsForWhatActs) {
  const std::string later = "if (t &lt; 0.35) { value = 0; } else { value = 1e-5*(t - 0.35); }";
  const std::vector<std::string> actions{
      section("a", key("Type", "Rigid Plane") + key("Point", "0 0 6.0035e-3") + key("Normal", "0 0 -1") +
                       key("Travel Z", "-1e-5*t")),
      along("a", "Prescribed Displacement", "top", "z", later),
      along("a", "Body Force", "top", "z", "1e13*" + ("(" + std::string("t - 0.35 + fabs(t - 0.35)") + ")*1e-5"))};
  const auto law = [](const std::string& model, const std::string& more) {
    return section("copper", key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                                 key("Poisson's Ratio", "0.3") + more);
  };
  const std::vector<std::string> laws{law("Elastic Correspondence", ""), law("Elastic", ""),
                                      law("Elastic Plastic Correspondence", key("Yield Stress", "400e6")),
                                      law("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"))};
  const auto expect_rest = [&](const Parts& parts, const std::string& method) {
    const Files files = files_of(parts, key("Number of Load Steps", "4") + method, {"Reaction_Z(low)"});
    EXPECT_EQ(files.error, "") << parts.materials << parts.conditions;
    const std::vector<double>& force = files.history.at("Reaction_Z(low)");
    ASSERT_EQ(force.size(), 5u);
    EXPECT_LT(std::abs(force[1]), 1e-12 * 117e9 * 16e-6);  // at t = 0.25, of E A: round-off of strains
    EXPECT_EQ(files.history.at("Time").back(), 1);
  };
  for (const std::string& material : laws) {
    for (const std::string& action : actions) {
      Parts parts;
      parts.materials = material;
      parts.conditions = all_of_foot() + action;
      expect_rest(parts, "");
    }
  }
  Parts parts;
  parts.conditions = all_of_foot();
  for (const std::string& material : laws) {
    parts.materials = material;
    const Files files = files_of(parts, key("Number of Load Steps", "2"), {"Reaction_Z(low)"});
    EXPECT_EQ(files.error, "") << "nothing acts at all";
    EXPECT_LT(files.history.at("Balance_Error").back(), 0.01) << "errors are told from there on: " << material;
  }
  parts.materials = laws[0];
  parts.conditions += actions[0];
  expect_rest(parts, key("Method", "Dynamic Relaxation"));
}

// A soft block, pulled or pressed by a plane with some 0.1 N, has the force that it has alone beside one that bears
// 40 kN, and one that bears nothing: they do not touch it, and their forces are no measure for its own. So it is where
// the deck makes them one body, where contact is declared between them, and between periodic sides.
TEST(SlowLoading, EachPieceIsInEquilibriumByItsOwnForces) {
  const auto held = [](const std::string& body, const std::string& end, const std::string& to) {
    const std::string set = body + end;
    return along(set + "_x", "Prescribed Displacement", set, "x", "0") +
           along(set + "_y", "Prescribed Displacement", set, "y", "0") +
           along(set, "Prescribed Displacement", set, "z", to);
  };
  const auto block = [](const std::string& name, const std::string& material, bool separate) {
    return section(name, key("Block Names", name) + key("Material", material) + key("Horizon", "2.2e-3") +
                             key("Separate Body", separate ? "true" : "false"));
  };
  const auto metal = [](const std::string& name, const std::string& more) {
    return section(name, key("Density", "50") + key("Poisson's Ratio", "0.3") + more);
  };
  const auto ends = [](const std::string& body, const std::string& where) {
    return key(body + "_low", "z &lt; 1.1e-3 &amp;&amp; " + where) +
           key(body + "_high", "z &gt; 6.9e-3 &amp;&amp; " + where);
  };
  enum Setting { separate, one_body, in_contact, periodic };
  const auto force_with = [&](const std::string& act, Setting setting, bool with_others) {
    Parts parts;
    parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    std::string points = cubes(1, {0, 0, 0}, 4, 4, 8, 1e-3);
    parts.node_sets = ends("soft", "x &lt; 0.01");
    parts.materials = metal("rubber", key("Material Model", "Elastic Plastic Correspondence") +
                                          key("Young's Modulus", "1e6") + key("Yield Stress", "1e4"));
    const bool apart = setting != one_body;
    parts.blocks = block("block_1", "rubber", apart);
    parts.conditions = held("soft", "_low", "0") + act;
    if (setting == periodic) {
      parts.conditions += section(
          "sides", key("Type", "Periodic Sides") + key("Coordinate", "y") + key("Lower", "0") + key("Upper", "4e-3"));
    }
    if (with_others) {
      points += cubes(2, {0.02, 0, 0}, 4, 4, 8, 1e-3) + cubes(3, {0.04, 0, 0}, 4, 4, 8, 1e-3);
      parts.node_sets += ends("stiff", "x &gt; 0.01 &amp;&amp; x &lt; 0.03") + ends("idle", "x &gt; 0.03");
      parts.materials +=
          metal("steel", key("Material Model", "Elastic Correspondence") + key("Young's Modulus", "2e11"));
      parts.blocks += block("block_2", "steel", apart) + block("block_3", "rubber", apart);
      if (setting == in_contact) {
        parts.contact = section("Models", section("m", key("Contact Model", "Surface"))) +
                        section("Interactions", section("General Contact", key("Contact Model", "m")));
      }
      parts.conditions += held("stiff", "_low", "0") + held("stiff", "_high", "-1e-4*t") + held("idle", "_low", "0");
    }
    const Files files = files_of(parts, key("Number of Load Steps", "2"), {"Reaction_Z(soft_low)"}, {}, points);
    EXPECT_EQ(files.error, "");
    return files.history.at("Reaction_Z(soft_low)").back();
  };
  const std::string pulled = along("act", "Prescribed Displacement", "soft_high", "z", "-4e-4*t");
  const std::string pressed =
      section("act", key("Type", "Rigid Plane") + key("Node Set", "block_1") + key("Point", "0 0 8e-3") +
                         key("Normal", "0 0 -1") + key("Travel Z", "-4e-4*t"));
  for (const Setting setting : {separate, one_body, in_contact, periodic}) {
    for (const std::string& act : {pulled, pressed}) {
      const double alone = force_with(act, setting, false);
      EXPECT_GT(std::abs(alone), 0.05);
      // Residual forces are 1e-6 of the reactions, and what the soft body yields to them may be some times that.
      EXPECT_NEAR(force_with(act, setting, true), alone, 1e-4 * std::abs(alone)) << setting << act;
    }
  }
}

// A body that is turned at one end takes the same work beside one that rests in a clamp of its own.
TEST(SlowLoading, EachBodyTurnsByItself) {
  const auto work = [](bool with_another) {
    Parts parts;
    parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    std::string points = cubes(1, {0, 0, 0}, 3, 3, 8, 1e-3);
    parts.node_sets = key("clamp", "z &lt; 2.1e-3 &amp;&amp; x &lt; 0.01");
    const auto block = [](const std::string& name) {
      return section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.2e-3") +
                               key("Separate Body", "true"));
    };
    parts.blocks = block("block_1");
    parts.conditions = along("x", "Prescribed Displacement", "clamp", "x", "x*(cos(0.3*t) - 1) + z*sin(0.3*t)") +
                       along("y", "Prescribed Displacement", "clamp", "y", "0") +
                       along("z", "Prescribed Displacement", "clamp", "z", "-x*sin(0.3*t) + z*(cos(0.3*t) - 1)") +
                       along("load", "Body Force", "block_1", "x", "3e9*t");
    parts.watch = key("Beyond Limits", "Continue");  // of the balance: the steps are too long for the load
    if (with_another) {
      points += cubes(2, {0.02, 0, 0}, 3, 3, 8, 1e-3);
      parts.node_sets += key("rest", "z &lt; 2.1e-3 &amp;&amp; x &gt; 0.01");
      parts.blocks += block("block_2");
      parts.conditions += along("at_rest", "Prescribed Displacement", "rest", "xyz", "0");
    }
    const Files files = files_of(parts, key("Number of Load Steps", "2") + key("Tolerance", "1e-9"), {}, {}, points);
    EXPECT_EQ(files.error, "");
    return files.history.at("External_Work").back();
  };
  const double alone = work(false);
  EXPECT_GT(alone, 0);
  EXPECT_NEAR(work(true), alone, 1e-5 * alone);  // what residual forces of 1e-9 of the loads may change
}

// Forces balance, but held points cannot leave the tool.
TEST(SlowLoading, NamesTheToolThatRunsIntoHeldPoints) {
  Parts parts;
  parts.conditions = along("foot", "Prescribed Displacement", "foot", "xyz", "0") +
                     section("tool", key("Type", "Rigid Plane") + key("Point", "0 0 0") + key("Normal", "0 0 1") +
                                         key("Travel Z", "1e-5*t"));
  const Files files = files_of(parts, key("Number of Load Steps", "1"), {}, Lattice{.nx = 3, .ny = 3});
  EXPECT_NE(files.error.find("forces are balanced, but a tool overlaps by"), std::string::npos) << files.error;
  EXPECT_NE(files.error.find("if a condition holds it there, expected a Node Set"), std::string::npos) << files.error;
}

// A bar that hangs without hardening from its foot, under twice what it can carry.
TEST(SlowLoading, LeavesTheLastEquilibriumWhereThereIsNoOther) {
  Parts parts;
  parts.materials = copper(key("Yield Stress", "585e6"));
  parts.blocks = section("bar", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "1.75e-3"));
  parts.conditions = all_of_foot() + along("weight", "Body Force", "all", "z", "4*585e6/5e-3*t");
  const Files files = files_of(parts, key("Number of Load Steps", "4") + key("Maximum Solver Iterations", "5"),
                               {"Reaction_Z(low)"}, Lattice{.nx = 3, .ny = 3});
  EXPECT_NE(files.error.find("no equilibrium after t = "), std::string::npos) << files.error;
  EXPECT_NE(files.error.find("of block bar"), std::string::npos) << files.error;
  const std::vector<double>& time = files.history.at("Time");
  ASSERT_GT(time.size(), 1u);
  EXPECT_GT(time.back(), 0.2);
  EXPECT_LT(time.back(), 0.6);
  // The last line is an equilibrium: the foot carries the weight of then.
  const double weight = 4 * 585e6 / 5e-3 * time.back() * 54e-9;
  EXPECT_NEAR(-files.history.at("Reaction_Z(low)").back(), weight, 1e-4 * weight);
  if (Communicator().rank() != 0) return;
  EXPECT_NEAR(files.result.times.back(), time.back(), 1e-12);
}

}  // namespace
}  // namespace strut::regression
