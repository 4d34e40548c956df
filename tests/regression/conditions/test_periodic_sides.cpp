// Periodic sides in whole runs: one period is a long body; contact across the sides; elastic constants; what is
// refused.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "contact/interpenetration.hpp"
#include "regression/checkpoints.hpp"
#include "regression/stiff_ended_bar.hpp"
#include "regression/stretched.hpp"
#include "run/simulation.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

std::string sides(const std::string& axis, const std::string& lower, const std::string& upper,
                  const std::string& stretch = "1") {
  return section("sides " + axis, key("Type", "Periodic Sides") + key("Coordinate", axis) + key("Lower", lower) +
                                      key("Upper", upper) + key("Stretch", stretch));
}

// Displacements of the last frame, in the order of the file; on rank 0.
// Takes the terminal's text as long as it lives, also when a run ends with an error.
struct Quiet {
  Quiet() { testing::internal::CaptureStdout(); }
  ~Quiet() { testing::internal::GetCapturedStdout(); }
};

void run_quietly(const RunFolder& folder, const Parts& parts) {
  const Quiet quiet;
  run(folder.write("deck.xml", parts.text()), folder.world);
}

std::vector<Vector> run_of(const RunFolder& folder, Parts parts) {
  parts.output = key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "100000") +
                 section("Output Variables", key("Displacement", "true"));
  run_quietly(folder, parts);
  std::vector<Vector> all;
  if (folder.world.rank() > 0) return all;
  const io::ExodusResult result = io::read_result(folder / "result.e");
  for (std::size_t v = 0; v < result.nodal_names.size(); ++v) {
    const std::string& name = result.nodal_names[v];
    if (!name.starts_with("Displacement")) continue;
    const auto& values = result.nodal[v].back();
    all.resize(values.size(), Vector::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) all[i][name.back() - 'X'] = values[i];
  }
  return all;
}

Table history_of(const RunFolder& folder, Parts parts, const std::vector<std::string>& variables) {
  std::string names;
  for (const std::string& name : variables) names += key(name, "true");
  parts.history =
      key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") + section("Variables", names);
  run_quietly(folder, parts);
  return read_history(folder / "history.csv");
}

double difference(const std::vector<Vector>& some, const std::vector<Vector>& all,
                  const Vector& shift = Vector::Zero()) {
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    most = larger(most, (some[i] - all[i] - shift).norm());
    largest = larger(largest, all[i].norm());
  }
  return most / largest;
}

// ---- A long bar ----------------------------------------------------------------------------------------------------

struct Kind {
  std::string name, materials, blocks;
  bool stiff_end = false;
};

class LongBar : public testing::TestWithParam<Kind> {};

constexpr int cells = 6;  // of a period, along x

// How far apart one period and each of three are, over the largest displacement. Elements of a bar are numbered along x
// first, so that those of one period are places in the file of the other.
double apart(const std::vector<Vector>& some, const std::vector<Vector>& all) {
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t line = i / (3 * cells), place = i % cells;
    most = larger(most, (some[line * cells + place] - all[i]).norm());
    largest = larger(largest, all[i].norm());
  }
  EXPECT_GT(largest, 1e-5);
  return most / largest;
}

// A bar of 6 cells a period, thrown at a wall with a speed that repeats along the bar; three periods of it beside one.
TEST_P(LongBar, IsOnePeriod) {
  Parts parts;
  if (!GetParam().materials.empty()) parts.materials = GetParam().materials;
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + GetParam().blocks);
  parts.verlet = key("Fixed dt", "2e-8");  // an estimated one depends on the whole body
  parts.times = key("Final Time", "1.6e-6");
  const std::string start = along("flight", "Initial Velocity", "all", "z", "-80*(1 + 0.5*sin(1047.1975511966*x))") +
                            along("aside", "Initial Velocity", "all", "x", "20*cos(1047.1975511966*x)") +
                            plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1");
  const RunFolder one(Lattice{.nx = cells, .ny = 3, .nz = 5}), three(Lattice{.nx = 3 * cells, .ny = 3, .nz = 5});
  parts.conditions = start + sides("x", "0", "6e-3");
  const std::vector<Vector> some = run_of(one, parts);
  parts.conditions = start + sides("x", "0", "18e-3");
  const std::vector<Vector> all = run_of(three, parts);
  if (one.world.rank() > 0) return;
  ASSERT_EQ(all.size(), 3 * some.size());
  // The sine of x + 2π differs by round-off, which flow lets grow some hundredfold.
  EXPECT_LT(apart(some, all), 1e-9);
}

const std::string yields = key("Yield Stress", "200e6");
std::string metal(const std::string& model, const std::string& more) {
  return section("copper", key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                               key("Poisson's Ratio", "0.35") + more);
}

INSTANTIATE_TEST_SUITE_P(
    By, LongBar,
    testing::Values(
        Kind{"MeanGradient", metal("Elastic Plastic Correspondence", yields), key("Horizon Factor", "1.75")},
        Kind{"Silling", metal("Elastic Plastic Correspondence", yields + key("Stabilization", "Silling")),
             key("Horizon", "2.01e-3")},
        Kind{"LargeFamilies", metal("Elastic Plastic Correspondence", yields), key("Horizon", "3.015e-3")},
        Kind{"Ordinary", metal("Elastic", ""), key("Horizon", "3.015e-3")},
        Kind{"Quadratic",
             metal("Elastic Plastic Correspondence", yields + key("Formulation", "Quadratic Correspondence")),
             key("Horizon Factor", "1.75")}),
    [](const auto& info) { return info.param.name; });

class Notch : public testing::TestWithParam<bool> {};

// By quadratic correspondence faces at a side without a neighbor behind it are surface, others are none: a bar with a
// notch at the side, where its upper cells face the void, and three periods of it.
TEST_P(Notch, AtASideHasItsSurface) {
  const int parts_of_cell = GetParam() ? 6 : 1;
  const auto solid = [](int i, int j) { return i % cells > 0 || j > 0; };
  const auto run_of_length = [&](int nx, const std::string& upper) {
    const Lattice lattice{.nx = nx, .ny = 3, .nz = 4, .inside = [&](double x, double y) {
                            return solid(static_cast<int>(x / 1e-3), static_cast<int>(y / 1e-3));
                          }};
    const RunFolder folder(lattice);
    if (GetParam()) run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", in_tetrahedra(lattice.mesh())); });
    Parts parts;
    parts.materials = metal("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                        key("Horizon Factor", GetParam() ? "2.2" : "1.75"));
    parts.verlet = key("Fixed dt", "1e-8");
    parts.times = key("Final Time", "5e-7");
    parts.conditions = along("flight", "Initial Velocity", "all", "z", "-80") +
                       plane("wall", "Rigid Plane", "all", "0 0 0", "0 0 1") + sides("x", "0", upper);
    return run_of(folder, parts);
  };
  const std::vector<Vector> some = run_of_length(cells, "6e-3"), all = run_of_length(3 * cells, "18e-3");
  if (Communicator().rank() > 0) return;
  ASSERT_EQ(all.size(), 3 * some.size());
  std::map<std::array<int, 3>, std::size_t> places;  // of the cells of one period
  const auto visit = [&](int nx, const auto& act) {
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < nx; ++i) {
          if (solid(i, j)) act(std::array{i % cells, j, k});
        }
      }
    }
  };
  visit(cells, [&](const auto& cell) { places.emplace(cell, places.size()); });
  std::size_t n = 0;
  double most = 0, largest = 0;
  visit(3 * cells, [&](const auto& cell) {
    for (int part = 0; part < parts_of_cell; ++part) {
      most = larger(most, (some[places.at(cell) * parts_of_cell + part] - all[n]).norm());
      largest = larger(largest, all[n++].norm());
    }
  });
  EXPECT_GT(largest, 1e-5);
  EXPECT_LT(most, 1e-9 * largest);  // the same sums in another order; percents where no face at a side is surface
}

INSTANTIATE_TEST_SUITE_P(Of, Notch, testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Tetrahedra" : "Hexahedra"; });

// Two bars that lie on each other with their surfaces; the upper one is thrown onto the lower one and along it, so that
// faces slide through the sides: one period of it, and three.
TEST(PeriodicContact, OfSurfacesIsThatOfALongBody) {
  constexpr int cells = 6;
  Parts parts;
  parts.blocks.clear();
  for (const std::string name : {"bar", "plate"}) {
    parts.blocks += section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon Factor", "1.75") +
                                      key("Separate Body", "true"));
  }
  parts.contact =
      section("Models", section("m", key("Contact Model", "Surface") + key("Friction Coefficient", "0.3"))) +
      section("Interactions", section("General Contact", key("Contact Model", "m")));
  parts.verlet = key("Fixed dt", "2e-8");
  parts.times = key("Final Time", "6e-6");
  const std::string start = along("down", "Initial Velocity", "plate", "z", "-60*(1 + 0.5*sin(1047.1975511966*x))") +
                            along("along", "Initial Velocity", "plate", "x", "200") +
                            plane("wall", "Rigid Plane", "bar", "0 0 0", "0 0 1");
  std::vector<std::vector<Vector>> found;
  for (const int periods : {1, 3}) {
    const RunFolder folder(Lattice{.nx = cells * periods, .ny = 3, .nz = 5, .plate_layers = 2});
    parts.conditions = start + sides("x", "0", std::to_string(cells * periods) + "e-3");
    found.push_back(run_of(folder, parts));
  }
  double most = 0, struck = 0;
  for (std::size_t i = 0; i < found[1].size(); ++i) {
    const std::size_t line = i / (3 * cells), place = i % cells;
    most = larger(most, (found[0][line * cells + place] - found[1][i]).norm());
    if (line < 9) struck = std::max(struck, std::abs(found[1][i][0]));  // of the lower bar, by friction
  }
  if (found[1].empty()) return;  // other ranks
  EXPECT_GT(struck, 1e-5);
  EXPECT_LT(most, 1e-9 * struck);  // places are rounded otherwise by the period, which friction and flow let grow
}

// ---- Elastic constants ---------------------------------------------------------------------------------------------

// A block that repeats in all directions is without surfaces: stretched along x it has the stresses of Hooke's law with
// (λ + 2 μ) and λ, to the second order of a strain of 1e-4. The work is ½ N ΔL.
TEST(PeriodicBlock, HasTheElasticConstantsOfItsMaterial) {
  for (const bool is_quadratic : {false, true}) {
    Parts parts;
    parts.materials =
        metal("Elastic Correspondence", is_quadratic ? key("Formulation", "Quadratic Correspondence") : "");
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
    parts.node_sets = key("one", "x + y + z &lt; 2e-3");
    parts.conditions = sides("x", "0", "4e-3", "1 + 1e-4*t") + sides("y", "0", "4e-3") + sides("z", "0", "6e-3");
    for (const std::string axis : {"x", "y", "z"}) {
      parts.conditions += along("hold " + axis, "Prescribed Displacement", "one", axis, "0");
    }
    parts.times = key("Final Time", "1");
    const RunFolder folder;
    const std::vector<std::string> names = {"Reaction_X(sides x)", "Reaction_Y(sides y)", "Reaction_Z(sides z)"};
    std::string variables;
    for (const std::string& name : names) variables += key(name, "true");
    parts.history = key("Filename", (folder / "history.csv").string()) + section("Variables", variables);
    const std::string deck = changed(parts.text(), section("Verlet", parts.verlet),
                                     section("QuasiStatic", key("Number of Load Steps", "2")));
    {
      const Quiet quiet;
      run(folder.write("deck.xml", deck), folder.world);
    }
    const Table table = read_history(folder / "history.csv");
    const double E = 117e9, nu = 0.35, lambda = E * nu / (1 + nu) / (1 - 2 * nu), mu = E / 2 / (1 + nu);
    const double strain = 1e-4;
    const auto last = [&](const std::string& name) { return table.at(name).back(); };
    EXPECT_NEAR(last(names[0]) / ((lambda + 2 * mu) * strain * 24e-6), 1, 3e-4);
    EXPECT_NEAR(last(names[1]) / (lambda * strain * 24e-6), 1, 3e-4);
    EXPECT_NEAR(last(names[2]) / (lambda * strain * 16e-6), 1, 3e-4);
    const double energy = 0.5 * (lambda + 2 * mu) * strain * strain * 96e-9;
    EXPECT_NEAR(last("Elastic_Energy"), energy, 1e-3 * energy);
    EXPECT_NEAR(last("External_Work"), energy, 1e-3 * energy);
  }
}

// Explicitly, with the sides moving: waves run from them, and the work of the sides is what the body holds.
TEST(PeriodicBlock, KeepsTheBalanceWhileItsSidesMove) {
  for (const std::string more : {"", "Subcycling"}) {
    Parts parts;
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
    parts.conditions = sides("x", "0", "4e-3", "1 - 3e3*t") + sides("y", "0", "4e-3");
    parts.times = key("Final Time", "2e-6");
    parts.verlet = key("Safety Factor", "0.7") + (more.empty() ? "" : key(more, "true"));
    const RunFolder folder;
    const Table table = history_of(folder, parts, {"Reaction_X(sides x)"});
    EXPECT_LT(table.at("Reaction_X(sides x)").back(), -1e3);
    EXPECT_GT(table.at("External_Work").back(), 1e-3);
    for (const double error : table.at("Balance_Error")) EXPECT_LT(std::abs(error), 2e-3);  // central differences
  }
}

// A stiff layer has substeps, the soft layers have none: the sides pull at both. They stretch it evenly, without waves.
TEST(PeriodicLayers, KeepTheBalanceWhileOneHasSubsteps) {
  for (const std::string& formulation : {std::string(), key("Formulation", "Quadratic Correspondence")}) {
    Parts parts = stiff_ended_bar(
        changed(copper(), key("Poisson's Ratio", "0.35"), key("Poisson's Ratio", "0") + formulation), "1.17e9");
    parts.conditions = sides("x", "0", "4e-3", "1 + 300*t") + along("pull", "Initial Velocity", "all", "x", "300*x");
    parts.times = key("Final Time", "10e-6");
    parts.verlet = key("Subcycling", "true");
    const RunFolder folder({.nx = 4, .ny = 4, .nz = 20, .plate_layers = 4});
    const Table table = history_of(folder, parts, {"Reaction_X(sides x)"});
    EXPECT_LT(table.at("Time").size(), 40u) << "steps are as long as the soft part lets them be";
    const double strain = 3e-3, length = 4e-3, stiffness = (16 * 1.17e9 + 4 * 117e9) * 4e-6;  // N
    const double energy = 0.5 * stiffness * strain * strain * length;
    EXPECT_NEAR(table.at("External_Work").back() / energy, 1, 3e-3);  // to first order of the strain
    EXPECT_LT(table.at("Balance_Error").back(), 3e-3);
  }
}

// ---- Contact across the sides --------------------------------------------------------------------------------------

// Two blocks in a period of 10.5 mm. The second flies through the upper side, behind which the first one's image is:
// the same as if the first stood there, without sides.
std::vector<Vector> meeting(bool across, const std::string& contact) {
  Parts parts = thrown_block(contact);
  parts.times = key("Final Time", "1.4e-5");
  parts.verlet = key("Fixed dt", "5e-8");
  parts.conditions = along("flight", "Initial Velocity", "block_2", "x", "100") +
                     along("rub", "Initial Velocity", "block_2", "y", "30");
  if (across) parts.conditions += sides("x", "0", "10.5e-3");
  const RunFolder folder;
  const double first = across ? 0.2e-3 : 10.7e-3;
  folder.write("points.txt", cubes(1, {first, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {6e-3, 0.3e-3, 0.2e-3}, 4, 4, 4, 1e-3));
  return run_of(folder, parts);
}

TEST(PeriodicContact, MeetsTheImageBehindTheSide) {
  const std::vector<std::pair<std::string, std::string>> pair = {{"block_1", "block_2"}};
  const std::string penalty = key("Contact Model", "Short Range Force") + key("Spring Constant", "1e12");
  for (const std::string& contact : {contact_by(penalty, pair, "1.1e-3", "0.3"), contact_by(penalty, pair, "1.1e-3")}) {
    const std::vector<Vector> across = meeting(true, contact), there = meeting(false, contact);
    if (across.empty()) continue;  // other ranks
    double moved = 0;              // of the struck block
    for (std::size_t i = 0; i < there.size() / 2; ++i) moved = std::max(moved, there[i].norm());
    EXPECT_GT(moved, 1e-4);
    EXPECT_LT(difference(across, there), 1e-9);  // places are rounded otherwise by the period
  }
}

// The section at the sides carries what one block pushes the other with, friction too.
TEST(PeriodicContact, IsPartOfTheReactionOfTheSides) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0.2e-3, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {6e-3, 0.3e-3, 0.2e-3}, 4, 4, 4, 1e-3));
  const std::vector<std::pair<std::string, std::string>> pair = {{"block_1", "block_2"}};
  for (const std::string& law :
       {key("Contact Model", "Short Range Force") + key("Spring Constant", "1e12"), key("Contact Model", "Surface")}) {
    const bool by_surfaces = law.find("Surface") != std::string::npos;
    Parts parts =
        thrown_block(by_surfaces ? section("Models", section("m", law + key("Friction Coefficient", "0.3"))) +
                                       section("Interactions", section("General Contact", key("Contact Model", "m")))
                                 : contact_by(law, pair, "1.1e-3", "0.3"));
    parts.times = key("Final Time", "8e-6");
    parts.verlet = key("Fixed dt", "5e-8");
    parts.conditions = along("flight", "Initial Velocity", "block_2", "x", "100") +
                       along("rub", "Initial Velocity", "block_2", "y", "30") + sides("x", "0", "10.5e-3");
    const Table table = history_of(folder, parts, {"Reaction_X(sides x)", "Contact_Force_X(block_1:block_2)"});
    double through_sides = 0, given = 0;
    const auto &times = table.at("Time"), &force = table.at("Reaction_X(sides x)");
    for (std::size_t n = 1; n < times.size(); ++n) {
      through_sides += force[n] * (times[n] - times[n - 1]);
      given += table.at("Contact_Force_X(block_1:block_2)")[n] * (times[n] - times[n - 1]);
    }

    EXPECT_GT(given, 0.01);
    EXPECT_NEAR(through_sides / given, -1, 0.03) << law;  // half a step of the last force
  }
}

// Blocks without contact pass through each other behind the side; 0.7 mm are between their faces.
TEST(PeriodicContact, IsMissedWhereNoneIsDeclared) {
  for (const bool across : {true, false}) {
    const RunFolder folder;
    const double first = across ? 0.2e-3 : 10.7e-3;
    folder.write("points.txt", cubes(1, {first, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {6e-3, 0, 0}, 4, 4, 4, 1e-3));
    Parts parts = thrown_block("");
    parts.times = key("Final Time", "2e-5");
    parts.conditions = along("flight", "Initial Velocity", "block_2", "x", "100");
    if (across) parts.conditions += sides("x", "0", "10.5e-3");
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    EXPECT_NE(told_at_the_start(deck, folder.world).warnings.find("meet at about t = 7e-06 s"), std::string::npos)
        << told_at_the_start(deck, folder.world).warnings;
    Simulation run(folder, parts);
    run.go();
    const auto found = contact::find_undeclared(run.scene.body.domain, run.scene.contact);
    ASSERT_TRUE(found) << across;
    EXPECT_GT(found->points, 30) << across;
  }
}

// A block with soft contact is pushed into another one by half their height, and aside: as many points are inside
// however many periods it has come, also where the side divides both blocks.
TEST(PeriodicContact, ThatIsTooSoftIsSeenBehindAnySide) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0.2e-3, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {0.2e-3, 0, 7e-3}, 4, 4, 4, 1e-3));
  Parts parts = thrown_block(contact_of({{"block_1", "block_2"}}, "0.6e-3", "1"));
  parts.conditions = sides("x", "0", "10e-3");
  Simulation run(folder, parts);
  Domain& domain = run.scene.body.domain;
  const auto points_inside = [&](double both, double aside) -> std::int64_t {
    const Vector ways[] = {{both, 0, 0}, {both + aside, 0, -5e-3}};
    for (int i = 0; i < domain.owned; ++i) {
      domain.sites[i].current.head<3>() = (domain.reference(i) + ways[domain.cloud.blocks[i]]).array();
    }
    const auto found = contact::find_interpenetration(domain, run.solver.contact(), 0.01);
    return found ? found->points : 0;
  };
  for (const double aside : {0.3e-3, 4.3e-3}) {
    const std::int64_t expected = points_inside(0, aside);
    EXPECT_EQ(expected > 0, aside < 1e-3);
    for (const double both : {0., 8e-3}) {
      for (const int periods : {-2, -1, 0, 1, 3}) {
        EXPECT_EQ(points_inside(both, aside + periods * 10e-3), expected) << both << " " << periods;
      }
    }
  }
}

// Layers of 4 mm along x that are one piece. If there are three in a period of 12 mm, the first and the last are
// bonded through the side; two in a period of 12 mm, bonded to each other in the cell, leave 4 mm between the second
// and an image.
TEST(PeriodicContact, IsMissedByBlocksThatNoSideBonds) {
  for (const bool bonded : {true, false}) {
    const RunFolder folder;
    std::string points;
    for (int n = 0; n < (bonded ? 3 : 2); ++n) points += cubes(n + 1, {n * 4e-3, 0, 0}, 4, 3, 3, 1e-3);
    folder.write("points.txt", points);
    Parts parts = thrown_block("");
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3"));
    parts.conditions = sides("x", "0", "12e-3") + along("flight", "Initial Velocity", bonded ? "all" : "block_2", "x",
                                                        bonded ? "-30*sin(523.59877559830*x)" : "200");
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    const std::string told = told_at_the_start(deck, folder.world).warnings;
    EXPECT_EQ(told.find("will pass through each other") == std::string::npos, bonded) << told;
  }
}

// Two plates that repeat along x, one thrown onto the other and along it: faces go on behind the sides, wherever the
// points are, on one rank or on several.
TEST(PeriodicContact, OfSurfacesIsThatOfALongPlate) {
  Parts parts;
  parts.blocks.clear();
  for (const std::string block : {"bar", "plate"}) {
    parts.blocks += section(block, key("Block Names", block) + key("Material", "copper") +
                                       key("Horizon Factor", "1.75") + key("Separate Body", "true"));
  }
  parts.contact =
      section("Models", section("m", key("Contact Model", "Surface") + key("Friction Coefficient", "0.3"))) +
      section("Interactions", section("General Contact", key("Contact Model", "m")));
  parts.verlet = key("Fixed dt", "5e-8");
  const std::string flight =
      along("flight", "Initial Velocity", "plate", "z", "-30") + along("aside", "Initial Velocity", "plate", "x", "20");
  const RunFolder one(Lattice{.nx = cells, .ny = 3, .nz = 5, .plate_layers = 2}),
      three(Lattice{.nx = 3 * cells, .ny = 3, .nz = 5, .plate_layers = 2});
  parts.conditions = flight + sides("x", "0", "6e-3");
  const std::vector<Vector> some = run_of(one, parts);
  parts.conditions = flight + sides("x", "0", "18e-3");
  const std::vector<Vector> all = run_of(three, parts);
  if (one.world.rank() == 0) {
    EXPECT_LT(apart(some, all), 1e-9);  // round-off of places three times as far
  }
}

// ---- Bonds that break -----------------------------------------------------------------------------------------------

// All points are held while the sides move apart by 6 % of a cell: bonds through them, and no others, stretch by 2 to
// 6 %. At a limit of 1.5 % all of these break: 4 of the 11 of a point at an edge along x, at a face 6 of 17.
TEST(PeriodicSides, BreakTheBondsThatTheyStretch) {
  Parts parts;
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                      key("Horizon Factor", "1.75") + key("Damage Model", "apart"));
  parts.damage = section("apart", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.015"));
  parts.conditions = sides("x", "0", "6e-3", "1 + 2e3*t");
  for (const std::string axis : {"x", "y", "z"}) {
    parts.conditions += along("hold " + axis, "Prescribed Velocity", "all", axis, "0");
  }
  parts.node_sets = key("face", "x &lt; 1e-3 &amp;&amp; y &lt; 1e-3 &amp;&amp; z &gt; 2e-3 &amp;&amp; z &lt; 3e-3") +
                    key("middle", "x &gt; 1e-3 &amp;&amp; x &lt; 5e-3");
  const RunFolder folder(Lattice{.nx = cells, .ny = 3, .nz = 5});
  const Table table = history_of(folder, parts, {"Max_Damage(face)", "Max_Damage", "Max_Damage(middle)"});
  EXPECT_NEAR(table.at("Max_Damage(face)").back(), 6. / 17, 1e-12);
  EXPECT_NEAR(table.at("Max_Damage").back(), 4. / 11, 1e-12);
  EXPECT_EQ(table.at("Max_Damage(middle)").back(), 0);
}

// The energy of a break follows from the positions of the images at the start of its step, also in the first one after
// a checkpoint: the same bits.
TEST(PeriodicSides, ThatMoveBreakBondsAfterACheckpointAsWithoutOne) {
  Parts parts;
  parts.materials = metal("Elastic", "");
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.6e-3") +
                                      key("Damage Model", "apart"));
  parts.damage = section("apart", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "0.002"));
  parts.conditions = sides("x", "0", "6e-3", "1 + 1e3*t") + along("v", "Initial Velocity", "all", "z", "4e3*z");
  const RunFolder folder(Lattice{.nx = cells, .ny = 3, .nz = 5});
  EXPECT_GT(expect_same_after_checkpoints(folder, parts, &Ledger::fracture).back(), 0);
}

// ---- Refusals ------------------------------------------------------------------------------------------------------

std::string error_of(Parts parts, const Lattice& lattice = {}) {
  const RunFolder folder(lattice);
  testing::internal::CaptureStdout();
  std::string text;
  try {
    run(folder.write("deck.xml", parts.text()), folder.world);
  } catch (const Error& error) {
    text = error.what();
  }
  testing::internal::GetCapturedStdout();
  return text;
}

// Partly filled cells bring their surfaces: of a box that was not made to repeat, those at its ends, too, behind which
// the body goes on. Counted as surface, they took the stress of a dense block in flow to a quarter.
TEST(PeriodicSides, TakeTheCutOffTheSurfaceOfCells) {
  const RunFolder folder;
  enum class Face { at_end, inclined };
  const auto surface_left = [&](Face face, const std::string& conditions) {
    io::Mesh mesh = Lattice{}.mesh();
    io::Mesh::Block& bar = mesh.blocks[0];
    for (std::size_t e = 0; e < bar.elements(); ++e) {
      const Vector middle = 0.5 * (mesh.nodes[bar.nodes[8 * e]] + mesh.nodes[bar.nodes[8 * e + 6]]);
      io::PartialCell cell{.volume = face == Face::inclined ? 0.85e-9 : 1e-9, .centroid = middle};
      cell.moments.head<3>().setConstant(1e-6 / 12);
      const bool is_lower = middle[0] < 1e-3;
      if (is_lower || middle[0] > 3e-3) {
        cell.surface[0] = (is_lower ? -1 : 1) * (face == Face::at_end ? 1e-6 : -0.3e-6);  // a strut that grows outwards
        cell.surface_moments(0, 0) = face == Face::at_end ? 0.5e-9 : 0;  // m² times the distance from the middle
      }
      bar.cells.push_back(cell);
    }
    run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
    Parts parts;
    parts.materials = metal("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
    parts.node_sets = key("lower", "x &lt; 1e-3");
    parts.conditions = conditions;
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    const Scene scene = set_up(deck, folder.world);
    double left[] = {0, 0};  // m², at the lower and the upper end
    const Domain& domain = scene.body.domain;
    for (int i = 0; i < domain.owned; ++i) {
      const double area = std::abs(domain.cloud.shapes[i].surface[0]);
      (domain.reference(i)[0] < 2e-3 ? left[0] : left[1]) += area + domain.cloud.shapes[i].surface_moments.norm();
    }
    folder.world.sum(left);
    return std::pair(left[0] / 24e-6, left[1] / 24e-6);  // of 24 cells at an end
  };
  const auto [of_lower, of_upper] = surface_left(Face::at_end, sides("x", "0", "4e-3"));
  EXPECT_LT(of_lower, 1e-12);  // round-off
  EXPECT_LT(of_upper, 1e-12);
  const auto [of_strut, of_other] = surface_left(Face::inclined, sides("x", "0", "4e-3"));
  EXPECT_GT(of_strut, 0.29);  // a strut that goes on
  EXPECT_GT(of_other, 0.29);
  const auto [at_plane, at_end] = surface_left(Face::at_end, plane("p", "Symmetry Plane", "lower", "0 0 0", "1 0 0"));
  EXPECT_LT(at_plane, 1e-12);
  EXPECT_GT(at_end, 0.99);
}

// A crack along the sides cuts the bonds between faces that are alike; a mesh whose faces are not is told of.
TEST(PeriodicSides, TellOfCellsWithoutANeighborButNotOfACrack) {
  const auto told = [](const std::string& x_of_crack, bool whole) {
    const RunFolder folder(Lattice{.inside = [whole](double x, double y) { return whole || x > 2e-3 || y > 2e-3; }});
    std::string disk = key("Type", "Disk") + key("Radius", "1") + key("Normal_X", "1") + key("Center_X", x_of_crack);
    for (const char* zero : {"Normal_Y", "Normal_Z", "Center_Y", "Center_Z"}) disk += key(zero, "0");
    Parts parts;
    parts.materials = metal("Elastic", "");
    parts.conditions = sides("x", "0", "4e-3");
    const std::string text =
        changed(parts.text(), "<ParameterList name=\"Discretization\">",
                "<ParameterList name=\"Discretization\">" + section("Bond Filters", section("disk", disk)));
    const deck::Deck deck = deck::read(folder.write("deck.xml", text), folder.world);
    return set_up(deck, folder.world).warnings.find("have no neighbor behind it") != std::string::npos;
  };
  for (const char* side : {"0", "4e-3"}) EXPECT_FALSE(told(side, true)) << side;
  EXPECT_FALSE(told("2e-3", true));
  EXPECT_TRUE(told("2e-3", false));
}

// Where nodes are double, as those of a crack or of bodies that touch, the two halves of a bar are beside each other at
// the sides as within: bonds run through either one.
TEST(PeriodicSides, LeaveDoubleNodesApart) {
  Parts parts;
  parts.materials = metal("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  parts.conditions = sides("y", "0", "4e-3") + sides("z", "0", "6e-3");
  const auto made = [&](const RunFolder& folder) {
    const Scene scene = set_up(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
    return std::pair(scene.pieces, scene.bonds);
  };
  const auto [one, bonds_of_half] = made(RunFolder(Lattice{.nx = 2}));
  EXPECT_EQ(one, 1);
  const RunFolder folder;
  io::Mesh mesh = Lattice{}.mesh();
  const auto nodes = mesh.nodes;
  mesh.nodes.insert(mesh.nodes.end(), nodes.begin(), nodes.end());
  for (std::size_t e = 0; e < mesh.blocks[0].elements(); ++e) {
    int* const corners = &mesh.blocks[0].nodes[8 * e];
    const bool is_beyond = nodes[corners[0]][0] > 1.5e-3;
    for (int n = 0; n < 8 && is_beyond; ++n) corners[n] += static_cast<int>(nodes.size());
  }
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
  EXPECT_EQ(made(folder), std::pair(std::int64_t{2}, 2 * bonds_of_half));
}

// A plane that only holds a block (plane strain), here the first condition, is no side.
TEST(PeriodicSides, AreNoSymmetryPlanes) {
  Parts parts;
  parts.materials = metal("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  const RunFolder folder;
  const auto made = [&](const std::string& conditions) {
    parts.conditions = conditions + sides("x", "0", "4e-3");
    const Scene scene = set_up(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world);
    EXPECT_EQ(scene.warnings.find("have no neighbor behind it"), std::string::npos) << scene.warnings;
    return scene.bonds;
  };
  EXPECT_EQ(made(plane("p", "Symmetry Plane", "bar", "0 0 2e-3", "0 0 1")), made(""));
}

// Nodes miss the sides by the round-off of single precision; points without nodes show gaps at them.
TEST(PeriodicSides, TellWhereTheyDoNotContinueTheMesh) {
  const auto told = [](bool text, const std::string& lower, const std::string& upper) {
    const RunFolder folder;
    folder.write("points.txt", cubes(1, Vector::Zero(), 4, 4, 6, 1e-3));
    Parts parts;
    if (text) parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
    const std::string by = text ? "" : key("Formulation", "Quadratic Correspondence");
    parts.materials = metal("Elastic Correspondence", by);
    parts.blocks =
        section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
    parts.conditions = sides("x", lower, upper);
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    return set_up(deck, folder.world).warnings;
  };
  const std::string path = "WARNING: Boundary Conditions > sides x: ";
  for (const char* upper : {"4e-3", "4.000001e-3"}) {
    for (const char* lower : {"0", "-1e-9", "1e-9"}) {
      for (const bool text : {false, true}) EXPECT_EQ(told(text, lower, upper).find(path), std::string::npos) << lower;
    }
  }
  EXPECT_NE(told(true, "0", "4.2e-3").find(path + "24 points"), std::string::npos) << told(true, "0", "4.2e-3");
  EXPECT_NE(told(true, "-5e-4", "4e-3").find("neighbor behind the side as from the one inside (0.0015"),
            std::string::npos)
      << told(true, "-5e-4", "4e-3");
  EXPECT_NE(told(true, "0", "7e-3").find(path + "no bond crosses its sides"), std::string::npos);
}

// A bar that slides through the sides meets a box and a roll wherever these stand, as their images between the sides.
TEST(PeriodicSides, ToolsHaveImages) {
  const RunFolder folder;
  const std::string sliding = sides("x", "0", "4e-3") + along("slide", "Initial Velocity", "all", "x", "600") +
                              plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
  const auto pressed_by = [&](const std::string& shape) {
    Parts parts;
    parts.conditions = sliding + section("press", shape + key("Travel Z", "-20*t"));
    return run_of(folder, parts);
  };
  const auto box = [](const std::string& from, const std::string& to) {
    return key("Type", "Rigid Box") + key("Lower Corner", from + " -1e-3 6e-3") +
           key("Upper Corner", to + " 9e-3 9e-3");
  };
  const auto roll = [](const std::string& x) {
    return key("Type", "Rigid Cylinder") + key("Point", x + " 0 7.6e-3") + key("Axis", "0 1 0") +
           key("Radius", "1.6e-3");
  };
  const std::vector<Vector> free = pressed_by(box("1e-3", "2.5e-3") + key("Node Set", "foot"));
  const std::vector<std::vector<std::string>> alike{
      {box("1e-3", "2.5e-3"), box("5e-3", "6.5e-3"), box("-7e-3", "-5.5e-3")},
      {roll("3.5e-3"), roll("-0.5e-3"), roll("11.5e-3")}};
  for (const std::vector<std::string>& shapes : alike) {
    const std::vector<Vector> between = pressed_by(shapes[0]);
    for (const std::string& shape : shapes) {
      const std::vector<Vector> moved = pressed_by(shape);
      if (folder.world.rank() != 0) continue;
      EXPECT_LT(difference(moved, between), 1e-9) << shape;  // round-off of distances
      EXPECT_GT(difference(moved, free), 1e-4) << shape;
    }
  }
}

// A box as long as the period touches its own images, wherever it stands: it presses a bar that slides through the
// sides as a plane does.
TEST(PeriodicSides, BoxAsLongAsThePeriodIsWithoutEnds) {
  const RunFolder folder;
  Parts parts;
  const std::string others = sides("x", "0", "4e-3") + along("slide", "Initial Velocity", "all", "x", "600") +
                             plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1");
  parts.conditions = others + section("press", key("Type", "Rigid Plane") + key("Point", "0 0 6e-3") +
                                                   key("Normal", "0 0 -1") + key("Travel Z", "-20*t"));
  const std::vector<Vector> by_plane = run_of(folder, parts);
  const auto by_box = [&](const std::string& from, const std::string& to) {
    parts.conditions = others + section("press", key("Type", "Rigid Box") + key("Lower Corner", from + " -1e-3 6e-3") +
                                                     key("Upper Corner", to + " 9e-3 9e-3") + key("Travel Z", "-20*t"));
    return run_of(folder, parts);
  };
  for (const auto& [from, to] : {std::pair{"-0.5e-3", "4.5e-3"}, {"1.3e-3", "5.2999999999999e-3"}}) {
    const std::vector<Vector> moved = by_box(from, to);
    if (folder.world.rank() == 0) {
      EXPECT_LT(difference(moved, by_plane), 1e-12) << from;  // the same sums
    }
  }
}

// Sides that move at 4 m/s from the start give a strain of 4/(2 · 4586) at once, 9 % of that in the end.
TEST(PeriodicSides, TellOfASuddenStretch) {
  const RunFolder folder;
  const auto told = [&](const std::string& stretch, const std::string& velocity) {
    Parts parts;
    parts.conditions = sides("x", "0", "4e-3", stretch) + along("v", "Initial Velocity", "all", "x", velocity);
    const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
    return told_at_the_start(deck, folder.world).warnings.find("> Stretch: the period changes by") != std::string::npos;
  };
  EXPECT_TRUE(told("1 + 1e3*t", "0"));
  EXPECT_TRUE(told("1 + 1e3*t", "3"));
  EXPECT_FALSE(told("1 + 1e3*t", "1e3*x"));
  EXPECT_FALSE(told("1 + 2e8*t^2", "0"));
  EXPECT_FALSE(told("1", "0"));
}

// So they do of a body between whose sides another one, in which waves are 14 times as fast, meets none of them.
TEST(PeriodicSides, TellOfASuddenStretchOfTheBodiesThatTheyBond) {
  const RunFolder folder;
  folder.write("points.txt", cubes(1, {0, 0, 0}, 4, 4, 4, 1e-3) + cubes(2, {0, 0, 8e-3}, 2, 2, 2, 1e-3));
  Parts parts = thrown_block("");
  parts.materials += section("hard", key("Material Model", "Elastic Correspondence") + key("Density", "8930") +
                                         key("Young's Modulus", "234e11") + key("Poisson's Ratio", "0.35"));
  parts.blocks = changed(parts.blocks, key("Block Names", "block_2") + key("Material", "copper"),
                         key("Block Names", "block_2") + key("Material", "hard"));
  parts.conditions = sides("x", "0", "4e-3", "1 + 1e3*t");
  parts.times = key("Final Time", "5e-6");
  const deck::Deck deck = deck::read(folder.write("deck.xml", parts.text()), folder.world);
  EXPECT_NE(told_at_the_start(deck, folder.world).warnings.find("> Stretch: the period changes by"), std::string::npos);
}

// A horizon by a factor has the round-off of a spacing.
TEST(PeriodicContact, MayHaveThePeriodThatItsRefusalExpects) {
  Parts parts;
  parts.contact = contact_of({{"bar", "bar"}}, "1e-3", "1e12");
  parts.conditions = sides("z", "0", "6e-3");
  for (const auto& [horizon, refusal] : {std::pair{"2.0000000000001e-3", ""}, std::pair{"2.1e-3", "expected 0.0063"}}) {
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", horizon));
    const std::string error = error_of(parts);
    EXPECT_TRUE(*refusal ? error.find(refusal) != std::string::npos : error.empty()) << error;
  }
}

// Micrometers have digits, too: three horizons of 8.75 µm.
TEST(PeriodicContact, MayHaveASmallPeriodThatItsRefusalExpects) {
  Parts parts;
  parts.contact = contact_of({{"bar", "bar"}}, "5e-6", "1e12");
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "8.75e-6"));
  const auto refusal = [&](const std::string& upper) {
    parts.conditions = sides("z", "0", upper);
    return error_of(parts, Lattice{.nz = 5, .spacing = 5e-6});
  };
  EXPECT_NE(refusal("25e-6").find("contact needs a period of 3 horizons or more; expected 2.625e-05 m"),
            std::string::npos)
      << refusal("25e-6");
  EXPECT_EQ(refusal("2.625e-05").find("contact needs"), std::string::npos);
}

TEST(PeriodicSides, ThatDoNotFitAreRefused) {
  Parts parts;
  const auto with = [&](const std::string& conditions) {
    parts.conditions = conditions;
    return error_of(parts);
  };
  EXPECT_NE(with(sides("x", "0", "3.0e-3")).find("not all between the sides"), std::string::npos);
  EXPECT_NE(with(sides("x", "0", "3.5e-3")).find("no element has a node on the upper side"), std::string::npos);
  EXPECT_NE(with(sides("x", "-2e-4", "4e-3")).find("no element has a node on the lower side"), std::string::npos);
  EXPECT_NE(with(sides("x", "0", "0")).find("expected > Lower"), std::string::npos);
  EXPECT_NE(with(sides("xy", "0", "4e-3")).find("expected one: x, y or z"), std::string::npos);
  EXPECT_NE(with(sides("x", "0", "4e-3", "1 + x")).find("depends on x, y or z"), std::string::npos);
  EXPECT_NE(with(sides("x", "0", "4e-3", "1.1")).find("is not 1 at the initial time"), std::string::npos);
  EXPECT_NE(with(sides("x", "0", "4e-3", "1 - 1e8*t")).find("expected a stretch > 0"), std::string::npos);
  EXPECT_EQ(with(sides("x", "0", "4e-3", "1 - 1e8*t")).find("t = 0.0000"), std::string::npos);
  EXPECT_NE(with(sides("z", "0", "6e-3") + plane("mid", "Symmetry Plane", "foot", "0 0 0", "0 0 1"))
                .find("have no periodic sides, too"),
            std::string::npos);
  EXPECT_NE(with(sides("z", "0", "6e-3") + plane("floor", "Rigid Plane", "all", "0 0 0", "0 0 1"))
                .find("floor > Normal: has a component along z"),
            std::string::npos);
  parts.points = "Nodes";
  EXPECT_NE(with(sides("x", "0", "4e-3")).find("expected Discretization > Points \"Elements\""), std::string::npos);
}

}  // namespace
}  // namespace strut::regression
