// Bodies that are warmed, by decks: closed forms of free, clamped, pressed and layered bars, in equilibria and in
// steps, of metal beyond yield, the balance of energy, and what is refused.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "regression/checkpoints.hpp"
#include "regression/stiff_ended_bar.hpp"
#include "run/simulation.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

constexpr double modulus = 117e9, poisson = 0.35, bulk = modulus / (3 * (1 - 2 * poisson));  // Pa, -, Pa

struct Solid {
  std::string name, model, more;

  bool adds_up() const { return model == "Elastic"; }  // extensions, not stretches
};
void PrintTo(const Solid& solid, std::ostream* stream) { *stream << solid.name; }

std::string of_copper(const Solid& solid, const std::string& expansion, const std::string& name = "copper") {
  return section(name, key("Material Model", solid.model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                           key("Poisson's Ratio", "0.35") + key("Thermal Expansion Coefficient", expansion) +
                           solid.more);
}

std::string warmed(const std::string& set, const std::string& temperature) {
  return section("warm " + set,
                 key("Type", "Prescribed Temperature") + key("Node Set", set) + key("Value", temperature));
}

std::string held(const std::string& set, const std::string& axes, const std::string& way = "0") {
  return along(set + axes, "Prescribed Displacement", set, axes, way);
}

const std::string sides = key("left", "x &lt; 1e-3") + key("front", "y &lt; 1e-3");  // node sets
const std::string held_sides = held("foot", "z") + held("left", "x") + held("front", "y");

const Solid ordinary{"Ordinary", "Elastic", ""}, of_points{"Correspondence", "Elastic Correspondence", ""},
    silling{"Silling", "Elastic Correspondence", key("Stabilization", "Silling")},
    cells{"Quadratic", "Elastic Correspondence", key("Formulation", "Quadratic Correspondence")},
    metal{"Plastic", "Elastic Plastic Correspondence", key("Yield Stress", "9e9")};
std::string name_of(const testing::TestParamInfo<Solid>& info) { return info.param.name; }

std::string in_equilibria(const Parts& parts) {
  return changed(parts.text(), R"(name="Verlet")", R"(name="QuasiStatic")");
}

// The last frame of equilibria from 0 to 1 s, and the history.
struct Files {
  Table history;
  std::map<std::string, std::vector<double>> fields;  // of rank 0
  std::array<std::vector<double>, 3> places;
};

Files equilibria(Parts parts, const std::string& steps, const Lattice& lattice = {}) {
  const RunFolder folder(lattice);
  parts.times = key("Final Time", "1");
  parts.verlet = key("Number of Load Steps", steps) + key("Tolerance", "1e-8");  // of the forces
  parts.output = key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "1") +
                 section("Output Variables", key("Displacement", "true") + key("Cauchy_Stress", "true") +
                                                 key("Thermal_Strain", "true") + key("Deformation_Gradient", "true"));
  parts.history = key("Filename", (folder / "history.csv").string()) + key("Frequency", "1") +
                  section("Variables", key("Max_Von_Mises_Stress", "true"));
  run(folder.write("deck.xml", in_equilibria(parts)), folder.world);
  Files files{read_history(folder / "history.csv"), {}, {}};
  if (folder.world.rank() > 0) return files;
  const io::ExodusResult result = io::read_result(folder / "result.e");
  for (std::size_t v = 0; v < result.nodal_names.size(); ++v)
    files.fields[result.nodal_names[v]] = result.nodal[v].back();
  for (std::size_t v = 0; v < result.element_names.size(); ++v)
    files.fields[result.element_names[v]] = result.element[v].back();
  files.places = result.places;
  return files;
}

double largest(const std::vector<double>& values, double less = 0) {
  double most = 0;
  for (const double value : values) most = larger(most, std::abs(value - less));
  return most;
}

class Warmed : public testing::TestWithParam<Solid> {};

// A free body, held at three layers of points along their normals: u = ε (X − X of the layer), and no stress.
TEST_P(Warmed, FreeBodyGrowsWithoutStress) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.node_sets = sides;
  parts.conditions = warmed("all", "293 + 500*t") + held_sides;
  const Files files = equilibria(parts, "4");
  EXPECT_LT(largest(files.history.at("Max_Von_Mises_Stress")), 1e-6 * modulus * 0.01);
  EXPECT_LT(largest(files.history.at("Balance_Error")), 1e-2);  // the log tells users of more
  if (files.fields.empty()) return;
  const double strain = 0.01;
  EXPECT_LT(largest(files.fields.at("Thermal_Strain"), strain), 1e-15);
  for (int c = 0; c < 3; ++c) {
    const std::vector<double>& u = files.fields.at(std::string("Displacement") + "XYZ"[c]);
    for (std::size_t i = 0; i < u.size(); ++i) {
      // The forces that are left by four steps, 1e-8 each, act most on the softest motions.
      ASSERT_NEAR(u[i], strain * (files.places[c][i] - 0.5e-3), 1e-6 * strain * 6e-3) << c << " " << i;
    }
  }
}

// Every point is held: the elastic stretch is 1/(1 + ε), and the pressure K times three logarithms of that, or, of the
// ordinary solid, 3 K ε. What the body stores is what its expansion gave.
TEST_P(Warmed, ClampedBodyIsUnderPressure) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.conditions = warmed("all", "293 + 500*t") + held("all", "xyz");
  const Files files = equilibria(parts, "20");
  const double strain = 0.01, whole = GetParam().adds_up() ? strain : std::log1p(strain),
               energy = 4.5 * bulk * whole * whole * 96e-9;
  // By rates, twenty mid-points of the logarithm err by (Δε)²/12 of it, 2e-8; the trapezoid of the pull
  // 9 K ln(1 + ε)/(1 + ε) by (Δε)²/(2 ε) of the work, 1.25e-5.
  const double of_steps = GetParam().adds_up() ? 1e-12 : 1e-6, of_work = GetParam().adds_up() ? 1e-12 : 1.3e-5;
  EXPECT_NEAR(files.history.at("Elastic_Energy").back(), energy, of_steps * energy);
  EXPECT_NEAR(files.history.at("External_Work").back(), energy, of_work * energy);
  if (files.fields.empty()) return;
  for (const char* axis : {"XX", "YY", "ZZ"}) {
    EXPECT_LT(largest(files.fields.at(std::string("Cauchy_Stress") + axis), -3 * bulk * whole), 1e-6 * 3 * bulk * whole)
        << axis;
  }
}

// Fast: what the expansion gives is what the body stores and carries.
TEST_P(Warmed, FastExpansionKeepsTheBalance) {
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.conditions = warmed("all", "293 + 200*sin(4e5*t)*(1 + 100*x)") + held("foot", "xyz");
  parts.times = key("Final Time", "1e-5");
  const RunFolder folder;
  Simulation run(folder, parts);
  double largest = 0;
  const Ledger end = run.go([&](const Ledger& now) { largest = larger(largest, now.balance_error); });
  EXPECT_GT(end.external, 1e-4);
  EXPECT_GT(end.kinetic, 1e-2 * end.external);
  EXPECT_LT(largest, 2e-2);
}

INSTANTIATE_TEST_SUITE_P(By, Warmed, testing::Values(ordinary, of_points, silling, cells, metal), name_of);

// A bar between periodic sides that stay, free aside: the same all along, so that closed forms hold at every point. (At
// walls the families of points end, and the discrete bar is not in uniform stress, warmed or pressed.)
Parts between_sides(const Solid& solid, const std::string& temperature) {
  Parts parts;
  parts.materials = of_copper(solid, "2e-5");
  parts.node_sets = sides;
  parts.conditions = warmed("all", temperature) + held_sides +
                     section("ends", key("Type", "Periodic Sides") + key("Coordinate", "z") + key("Lower", "0") +
                                         key("Upper", "6e-3"));
  return parts;
}

class WarmedBar : public testing::TestWithParam<Solid> {};

// σ = −E ln(1 + ε), and the sides spread by (1 + ε)^(1 + ν).
TEST_P(WarmedBar, BetweenSidesIsPressed) {
  const Files files = equilibria(between_sides(GetParam(), "293 + 500*t"), "20");
  if (files.fields.empty()) return;
  const double strain = 0.01, stress = -modulus * std::log1p(strain), spread = std::pow(1 + strain, 1 + poisson);
  // Twenty mid-points of the logarithm err by 2e-8 of it.
  EXPECT_LT(largest(files.fields.at("Cauchy_StressZZ"), stress), 1e-6 * std::abs(stress));
  EXPECT_LT(largest(files.fields.at("Cauchy_StressXX")), 1e-6 * std::abs(stress));
  EXPECT_LT(largest(files.fields.at("Deformation_GradientXX"), spread), 1e-6 * strain);
}

// In steps: after a ramp of 30 periods of the sides these swing by 2 (π/(ω τ))² = 5e-4 of what they have spread.
TEST_P(WarmedBar, BetweenSidesIsPressedInSteps) {
  Parts parts = between_sides(GetParam(), "293 + 250*(1 - cos(3.14159265358979e4*t))");
  parts.times = key("Final Time", "1e-4");
  const RunFolder folder;
  Simulation run(folder, parts);
  run.go();
  const double stress = -modulus * std::log1p(0.01);
  const Body& body = run.body();
  for (int i = 0; i < body.owned(); ++i) {
    ASSERT_NEAR(body.points[i].stress[2], stress, 1e-3 * std::abs(stress)) << i;
    ASSERT_NEAR(body.points[i].stress[0], 0, 1e-3 * std::abs(stress)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(By, WarmedBar, testing::Values(of_points, silling, cells, metal), name_of);

// A bar between walls has no closed form, but y = (1 + ε) y' of a cold one that is pressed by ε/(1 + ε) has its forces
// everywhere, by a factor, so it is in the same equilibrium, of the same stress; of the ordinary solid, whose force
// does not know J, of 1/(1 + ε) of it.
class BarBetweenWalls : public testing::TestWithParam<Solid> {};

TEST_P(BarBetweenWalls, IsAsPressed) {
  const std::string strain = "0.01*sin(1.5707963267948966*t)";
  Parts parts;
  parts.materials = of_copper(GetParam(), "2e-5");
  parts.node_sets = sides;
  parts.conditions = warmed("all", "293 + " + strain + "/2e-5") + held("top", "z") + held_sides;
  const Files warm = equilibria(parts, "20");
  parts.conditions = held("top", "z", "-5e-3*" + strain + "/(1 + " + strain + ")") + held_sides;
  const Files pressed = equilibria(parts, "20");
  if (warm.fields.empty()) return;
  const bool has_springs = GetParam().name != cells.name && !GetParam().adds_up();
  for (const char* axis : {"XX", "YY", "ZZ", "YZ", "ZX"}) {
    const auto &one = warm.fields.at(std::string("Cauchy_Stress") + axis),
               &other = pressed.fields.at(std::string("Cauchy_Stress") + axis);
    double most = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      most = larger(most, std::abs(one[i] * (GetParam().adds_up() ? 1.01 : 1) - other[i]));
    // Springs of a stabilization grow by 1 + ε, all other forces by its square: 1 % of the small part that they carry.
    EXPECT_LT(most, (has_springs ? 1e-3 : 1e-5) * 0.01 * modulus) << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(By, BarBetweenWalls, testing::Values(ordinary, of_points, silling, cells, metal), name_of);

// The part beyond yield stays when the bar cools. With h = H/E, e = ln(1 + ε) and the yield strain y: warm, the plastic
// strain is p = (e − y)/(1 + h); cold, the stress without more flow is E p, and it flows if that is more than
// σ_y + H p.
struct Hardening {
  std::string name;
  double slope;  // H, Pa

  std::string keys() const {
    return key("Yield Stress", "50e6") +
           (slope == 0 ? ""
                       : section("Hardening", key("Type", "Linear") + key("Hardening Modulus", std::to_string(slope))));
  }
  double left_stress(double strain) const {
    const double y = 50e6 / modulus, h = slope / modulus, p = (std::log1p(strain) - y) / (1 + h);
    const double more = (p - y - h * p) / (1 + h);  // plastic strain of the way back
    return more > 0 ? 50e6 + slope * (p + more) : modulus * p;
  }
};
void PrintTo(const Hardening& hardening, std::ostream* stream) { *stream << hardening.name; }

class CooledBar : public testing::TestWithParam<std::tuple<Hardening, Solid>> {
 protected:
  CooledBar() {
    solid_.model = "Elastic Plastic Correspondence";
    solid_.more += hardening_.keys();
  }
  Hardening hardening_ = std::get<0>(GetParam());
  Solid solid_ = std::get<1>(GetParam());
};

TEST_P(CooledBar, IsLeftInTension) {
  const Files files =
      equilibria(between_sides(solid_, "value = 293 + 200*t; if (t &gt; 0.5) { value = 293 + 200*(1 - t); }"), "20");
  if (files.fields.empty()) return;
  const double stress = hardening_.left_stress(2e-3);
  // A step that begins to flow midway takes its strain as if it were even, 1 % of which is beside the axis of the bar.
  EXPECT_LT(largest(files.fields.at("Cauchy_StressZZ"), stress), 1e-3 * stress);
  EXPECT_LT(largest(files.history.at("Balance_Error")), 2e-3);  // some ε: energy is stored per present volume
}

TEST_P(CooledBar, IsLeftInTensionAfterSteps) {
  Parts parts = between_sides(solid_, "293 + 50*(1 - cos(1.570796326794897e4*t))");
  parts.times = key("Final Time", "4e-4");
  const RunFolder folder;
  Simulation run(folder, parts);
  run.go();
  // Where the bar begins to flow, on the way up and down, its sides, which spread at (1 + ν) ε̇, go on at 1.5 ε̇: both
  // swing by 0.15 ε̇/ω, with a period of 3.5 µs, and Lamé's λ makes that a stress along the bar.
  const double lame = 3 * bulk * poisson / (1 + poisson), most_rate = 1e-3 * 1.57e4, omega = 2 * 3.14 / 3.5e-6,
               swing = 2 * 2 * 0.15 * most_rate / omega * lame;
  const Body& body = run.body();
  for (int i = 0; i < body.owned(); ++i)
    ASSERT_NEAR(body.points[i].stress[2], hardening_.left_stress(2e-3), swing) << i;
}

INSTANTIATE_TEST_SUITE_P(By, CooledBar,
                         testing::Combine(testing::Values(Hardening{"Perfect", 0}, Hardening{"Hard", 20e9},
                                                          Hardening{"Harder", 80e9}),
                                          testing::Values(of_points, silling, cells)),
                         [](const auto& info) { return std::get<0>(info.param).name + std::get<1>(info.param).name; });

// Two layers of unequal expansion: Timoshenko's curvature (1925) of a strip of one modulus, 3/2 Δα ΔT/h.
TEST(WarmedMetal, StripOfTwoMetalsBends) {
  Parts parts;
  const Lattice strip{.nx = 40, .ny = 2, .nz = 6, .plate_layers = 3};
  parts.materials = of_copper(cells, "2e-5") + of_copper(cells, "1e-5", "other");
  parts.blocks =
      section("low", key("Block Names", "bar") + key("Material", "copper") + key("Horizon Factor", "1.75")) +
      section("high", key("Block Names", "plate") + key("Material", "other") + key("Horizon Factor", "1.75"));
  parts.node_sets = sides + key("edge", "x &lt; 1e-3 &amp;&amp; z &lt; 1e-3");
  parts.conditions = warmed("all", "293 + 100*t") + held("left", "x") + held("front", "y") + held("edge", "z");
  const Files files = equilibria(parts, "2", strip);
  if (files.fields.empty()) return;
  const double thickness = 6e-3, curvature = 1.5 * 1e-5 * 100 / thickness;
  const std::vector<double>& w = files.fields.at("DisplacementZ");
  double at_end = 0, in_middle = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (std::abs(files.places[2][i] - 0.5e-3) > 1e-6) continue;
    if (std::abs(files.places[0][i] - 39.5e-3) < 1e-6) at_end = w[i];
    if (std::abs(files.places[0][i] - 19.5e-3) < 1e-6) in_middle = w[i];
  }
  // w = κ x²/2 from the held layer.
  const double measured = (at_end - 2 * in_middle + 0) / (std::pow(39e-3, 2) / 2 - std::pow(19e-3, 2));
  EXPECT_NEAR(measured / curvature, 1, 0.05);
}

// Points with substeps of their own expand by as much, and as if all took short ones.
TEST(WarmedMetal, ExpandsInSubstepsAsInSteps) {
  for (const Solid& solid : {of_points, cells}) {
    const auto end = [&](const std::string& subcycling) {
      const RunFolder folder({.nx = 4, .ny = 4, .nz = 20, .plate_layers = 4});
      Parts parts = stiff_ended_bar(of_copper(solid, "2e-5"), "1.17e9");
      parts.conditions = warmed("all", "293 + 200*sin(1e5*t)*(1 + 100*x)") + held("top", "xyz");
      parts.verlet = key("Safety Factor", "0.5") + key("Subcycling", subcycling);
      Simulation run(folder, parts);
      const Ledger last = run.go();
      EXPECT_EQ(run.solver.most_substeps() > 1, subcycling == "true");
      EXPECT_LT(last.balance_error, 1e-2);
      return last;
    };
    const Ledger one = end("true"), other = end("false");
    EXPECT_GT(other.elastic, 0.1 * other.external);
    EXPECT_NEAR(one.expansion / other.expansion, 1, 1e-2) << solid.name;
    EXPECT_NEAR(one.elastic / other.elastic, 1, 1e-2) << solid.name;
  }
}

// The energy of a bond follows from the expansion of both ends at the start of a step, also in the first one after a
// checkpoint: the same bits. The body expands by more than the stretch that its bonds bear.
TEST(WarmedSolid, BreaksBondsAfterACheckpointAsWithoutOne) {
  Parts parts;
  parts.materials = of_copper(ordinary, "2e-5");
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Damage Model", "apart"));
  parts.damage = section("apart", key("Damage Model", "Bond Energy") + key("Fracture Energy", "300"));
  parts.conditions = warmed("all", "293 + 2e8*t*(1 + 200*x)") + along("v", "Initial Velocity", "all", "z", "8e3*z");
  const RunFolder folder({.nx = 4, .ny = 3, .nz = 6});
  EXPECT_GT(expect_same_after_checkpoints(folder, parts, &Ledger::fracture).back(), 0);
}

deck::Problems problems_of(const std::string& text) {
  const RunFolder folder;
  deck::Problems problems;
  deck::read(folder.write("deck.xml", text), folder.world, problems);
  return problems;
}
std::string refusal(const Parts& parts) { return problems_of(parts.text()).text("deck.xml"); }

TEST(Temperature, IsRefusedWhereItWouldMeanNothing) {
  Parts parts;
  parts.conditions = warmed("all", "293 + t");
  parts.materials = copper(key("Yield Stress", "50e6") + section("Heating", key("Specific Heat", "383")));
  EXPECT_NE(refusal(parts).find("whose temperature follows from its flow"), std::string::npos);
  parts.conditions.clear();
  parts.materials = copper(key("Yield Stress", "50e6") + key("Thermal Expansion Coefficient", "1e-5") +
                           section("Heating", key("Specific Heat", "383")));
  EXPECT_NE(refusal(parts).find("by which it does not expand"), std::string::npos);
}

// Points expand by the change of T, from that of a checkpoint on, if a run starts there.
TEST(Temperature, ThatStaysIsToldToHaveNoEffect) {
  const auto is_told = [](const std::string& value, bool from_there = false) {
    const RunFolder folder;
    Parts parts;
    parts.materials = of_copper(of_points, "2e-5");
    parts.conditions = warmed("all", value);
    std::string text = parts.text();
    if (from_there)
      text.insert(text.rfind("</ParameterList>"), section("Start From", key("Checkpoint", "other.restart")));
    deck::Problems problems;
    const deck::Deck deck = deck::read(folder.write("deck.xml", text), folder.world, problems);
    return std::ranges::any_of(deck.notes, [](const std::string& note) {
      return note.find("Boundary Conditions > warm all > Value has no effect") != note.npos;
    });
  };
  EXPECT_TRUE(is_told("393"));
  EXPECT_TRUE(is_told("293 + 1e4*x"));
  EXPECT_FALSE(is_told("293 + t"));
  EXPECT_FALSE(is_told("393", true));
}

// A value that is no number later on ends the run with its path.
std::string end_of(const std::string& text) {
  const RunFolder folder;
  try {
    run(folder.write("deck.xml", text), folder.world);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Temperature, ThatIsNoNumberHasItsPath) {
  Parts parts;
  parts.materials = of_copper(of_points, "2e-5");
  parts.conditions = warmed("all", "293 + sqrt(2e-6 - t)") + held("foot", "xyz");
  EXPECT_NE(end_of(parts.text()).find("Boundary Conditions > warm all > Value"), std::string::npos);
  parts.verlet = key("Number of Load Steps", "5");
  EXPECT_NE(end_of(in_equilibria(parts)).find("Boundary Conditions > warm all > Value"), std::string::npos);
}

}  // namespace
}  // namespace strut::regression
