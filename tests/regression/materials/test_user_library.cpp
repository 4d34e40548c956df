// Materials from a shared object in runs: user_j2.c has the built-in J2 with linear hardening, so that every
// formulation must give what it gives with that law.
#include <gtest/gtest.h>

#include <fstream>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"

namespace strut::regression {
namespace {

// Copper of bodies.hpp: K = E/(3 (1 − 2ν)), G = E/(2 (1 + ν)).
constexpr double bulk = 117e9 / 0.9, shear = 117e9 / 2.7;

std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

const std::string built_in =
    key("Yield Stress", "100e6") + section("Hardening", key("Type", "Linear") + key("Hardening Modulus", "1e9"));

std::string from_library(const std::string& interface, const std::string& more = "") {
  return section("copper", key("Material Model", "User Library") + key("Density", "8930") +
                               key("Young's Modulus", "117e9") + key("Poisson's Ratio", "0.35") +
                               key("Library", STRUT_USER_J2) + key("Interface", interface) +
                               key("Constants", number(bulk) + " " + number(shear) + " 100e6 1e9") +
                               key("State Variables", "1") + more);
}

// A bar that strikes a plane at 150 m/s, its foot some percent into flow.
Parts striking(const std::string& material, const std::string& formulation) {
  Parts parts;
  parts.materials = changed(material, key("Density", "8930"), key("Density", "8930") + key("Formulation", formulation));
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-150") +
                     section("wall", key("Type", "Rigid Plane") + key("Point", "0 0 0") + key("Normal", "0 0 1"));
  parts.times = key("Final Time", "3e-6");
  return parts;
}

struct End {
  std::vector<Vector> places;
  Ledger ledger;
};
End end_of(const Parts& parts) {
  const RunFolder folder;
  Simulation run(folder, parts);
  End end{.ledger = run.go()};
  for (int i = 0; i < run.body().owned(); ++i) end.places.push_back(run.body().current(i));
  return end;
}

// The laws differ by round-off, 1e-12 of each stress, which some hundred steps make 1e-9 of a displacement of 0.4 mm at
// most.
TEST(UserLibrary, IsTheBuiltInLawInEachFormulation) {
  for (const std::string formulation : {"Correspondence", "Quadratic Correspondence"}) {
    const End expected = end_of(striking(copper(built_in), formulation));
    EXPECT_GT(expected.ledger.dissipated, 0.2 * expected.ledger.largest) << formulation;
    for (const std::string interface : {"strut", "UMAT", "VUMAT"}) {
      const End found = end_of(striking(from_library(interface), formulation));
      double apart = 0;
      for (std::size_t i = 0; i < found.places.size(); ++i) {
        apart = std::max(apart, (found.places[i] - expected.places[i]).norm());
      }
      EXPECT_LT(apart, 0.4e-3 * 1e-9) << formulation << " " << interface;
      EXPECT_NEAR(found.ledger.dissipated, expected.ledger.dissipated, 1e-3 * expected.ledger.largest) << interface;
      EXPECT_LT(found.ledger.balance_error, 2 * expected.ledger.balance_error + 1e-4) << interface;
    }
  }
}

// Also in a body that flies before it is struck, and at points that lose bonds.
TEST(UserLibrary, HasTheTimeOfTheRun) {
  const RunFolder folder(Lattice{.nx = 3, .ny = 3, .nz = 4});
  const std::string timed = changed(from_library("strut"), key("State Variables", "1"), key("State Variables", "2"));
  Parts parts = striking(timed, "Correspondence");
  parts.conditions = along("flight", "Initial Velocity", "all", "z", "-100") +
                     section("wall", key("Type", "Rigid Plane") + key("Point", "0 0 -0.1e-3") + key("Normal", "0 0 1"));
  const auto times_of = [&](const Parts& of) {
    Simulation run(folder, of);
    const Ledger last = run.go();
    EXPECT_EQ(last.fracture > 0, !of.damage.empty());
    const double end = last.time;
    const MaterialBlock& block = run.body().blocks[0];
    double least = end, most = 0;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const double time = block.state_of<materials::UserLaw>(k).time;
      least = std::min(least, time), most = std::max(most, time);
    }
    return std::pair(-run.world().max(-least) / end, run.world().max(most) / end);
  };
  for (const bool breaks : {false, true}) {
    if (breaks) {
      parts.conditions = along("pull", "Initial Velocity", "all", "z", "2e4*(z - 2e-3)*(1 + 300*x)");
      parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.02"));
      parts.blocks =
          changed(parts.blocks, key("Material", "copper"), key("Material", "copper") + key("Damage Model", "brittle"));
    }
    const auto [least, most] = times_of(parts);
    // Round-off of a sum of some hundred steps. A point that carries nothing more is not called.
    EXPECT_NEAR(breaks ? 1 : least, 1, 1e-12);
    EXPECT_NEAR(most, 1, 1e-12) << breaks;
  }
}

std::string error_of(const std::string& material) {
  const RunFolder folder;
  Parts parts;
  parts.materials = material;
  std::string error;
  try {
    deck::read(folder.write("deck.xml", parts.text()), folder.world);
  } catch (const Error& found) {
    error = found.what();
  }
  EXPECT_EQ(folder.world.max(error.empty() ? 1.0 : 0.0), folder.world.min(error.empty() ? 1.0 : 0.0));
  return error;
}

TEST(UserLibrary, ThatCannotBeUsedIsRefused) {
  const std::string good = from_library("strut");
  EXPECT_EQ(error_of(good), "");
  for (const auto& [material, words] : std::vector<std::pair<std::string, std::string>>{
           {changed(good, STRUT_USER_J2, "nowhere.so"), "nowhere.so' does not exist"},
           {changed(good, STRUT_USER_J2, "bar.g"), "cannot be loaded"},
           {from_library("strut", key("Function", "my_law")), "has no function 'my_law'"},
           {from_library("strut", key("Function", "far_too_stiff")), "is stiffer"},
           {changed(good, key("State Variables", "1"), key("State Variables", "30")), "State Variables"}}) {
    const std::string error = error_of(material);
    EXPECT_NE(error.find("Materials > copper"), std::string::npos) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  }
}

// By a viscosity of 200 ns times G it is hardly stiffer in a step as long as the run, but far stiffer in those that the
// run takes, some 100 ns. Equilibria with load steps of 600 s may have one of 100 s.
TEST(UserLibrary, ThatIsTooStiffInTheFirstStepIsRefusedThere) {
  const auto error_in = [](double relaxation_time, const std::string& until, const std::string& solver) {
    const RunFolder folder;
    const std::string viscous = from_library("strut", key("Function", "viscous"));
    Parts parts = striking(changed(viscous, "100e6", number(relaxation_time * shear)), "Correspondence");
    parts.times = key("Final Time", until);
    if (solver == "QuasiStatic") parts.conditions = along("hold", "Prescribed Displacement", "all", "xyz", "0");
    if (solver == "QuasiStatic") parts.verlet = key("Number of Load Steps", "1");
    std::string error;
    try {
      run(folder.write("deck.xml", changed(parts.text(), R"(name="Verlet")", "name=\"" + solver + "\"")), folder.world);
    } catch (const Error& found) {
      error = found.what();
    }
    return error;
  };
  const std::string error = error_in(2e-7, "3e-6", "Verlet");
  EXPECT_NE(error.find("Materials > copper > Library: '"), std::string::npos) << error;
  EXPECT_NE(error.find("is stiffer, "), std::string::npos) << error;
  EXPECT_EQ(error_in(100, "600", "QuasiStatic"), "");
}

// A library that has been compiled anew has other bytes; one more byte at the end of a file changes nothing but these.
TEST(UserLibrary, ThatHasChangedIsNotThatOfTheCheckpoint) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { std::filesystem::copy(STRUT_USER_J2, folder / "law.so"); });
  const auto outcome = [&](const std::string& until, Start start, const std::string& from = "") {
    Parts parts = striking(changed(from_library("strut"), STRUT_USER_J2, "law.so"), "Correspondence");
    parts.times = key("Initial Time", from.empty() ? "0" : "1e-7") + key("Final Time", until);
    const std::string name = (folder / (from.empty() ? "first" : "second")).string();
    parts.output = key("Output Filename", name + ".e") + section("Output Variables", key("Displacement", "true"));
    const std::string solver = R"(<ParameterList name="Solver">)";
    const auto deck = folder.write(
        "deck.xml",
        changed(parts.text(), solver, section("Restart", key("Filename", name + ".restart")) + from + solver));
    testing::internal::CaptureStdout();
    std::string error;
    try {
      run(deck, folder.world, start);
    } catch (const Error& one) {
      error = one.what();
    }
    std::string said = testing::internal::GetCapturedStdout() + error;
    folder.world.broadcast(said);
    return said;
  };
  const std::string from = section("Start From", key("Checkpoint", (folder / "first.restart").string()));
  const std::string words = "law.so' is not the file with which the run began";
  EXPECT_EQ(outcome("1e-7", Start::anew).find(words), std::string::npos);
  EXPECT_EQ(outcome("2e-7", Start::continued).find(words), std::string::npos);
  run_on_root(folder.world, [&] { std::ofstream(folder / "law.so", std::ios::app) << '.'; });
  EXPECT_NE(outcome("3e-7", Start::continued).find(words + "; a run can go on"), std::string::npos);
  EXPECT_NE(outcome("3e-7", Start::anew, from).find("WARNING: Materials > copper > Library"), std::string::npos);
}

// Its stress is a function of the stretch: where bonds break, the gradient of a family jumps, and the energy with it.
TEST(Hyperelastic, DoesNotBreak) {
  Parts parts;
  parts.materials = section("copper", key("Material Model", "Hyperelastic") + key("Density", "1100") +
                                          key("Shear Modulus", "4e6") + key("Bulk Modulus", "40e6"));
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.1"));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Damage Model", "brittle"));
  const RunFolder folder;
  std::string error;
  try {
    deck::read(folder.write("deck.xml", parts.text()), folder.world);
  } catch (const Error& found) {
    error = found.what();
  }
  EXPECT_NE(error.find("bonds of material 'copper' cannot break: the stress of a Hyperelastic point"),
            std::string::npos)
      << error;
}

}  // namespace
}  // namespace strut::regression
