// strut-point against closed forms, and what it says of a wrong request.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tool.hpp"

namespace strut::testing {
namespace {

constexpr double youngs = 117e9, poisson = 0.35, yield_stress = 400e6, hardening = 100e6;  // Pa, -, Pa, Pa

const char* const deck = R"(<ParameterList>
  <ParameterList name="Discretization">
    <Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="mesh.g"/>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="copper">
      <Parameter name="Material Model" type="string" value="Elastic Plastic Correspondence"/>
      <Parameter name="Density" type="double" value="8930"/>
      <Parameter name="Young's Modulus" type="double" value="117.0e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.35"/>
      <Parameter name="Yield Stress" type="double" value="400.0e6"/>
      <ParameterList name="Hardening">
        <Parameter name="Type" type="string" value="Linear"/>
        <Parameter name="Hardening Modulus" type="double" value="100.0e6"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="steel">
      <Parameter name="Material Model" type="string" value="Elastic Correspondence"/>
      <Parameter name="Density" type="double" value="7800"/>
      <Parameter name="Young's Modulus" type="double" value="210.0e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Blocks">
    <ParameterList name="bar">
      <Parameter name="Block Names" type="string" value="all"/>
      <Parameter name="Material" type="string" value="copper"/>
      <Parameter name="Horizon" type="double" value="0.0015"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Final Time" type="double" value="1e-6"/>
    <ParameterList name="Verlet">
      <Parameter name="Safety Factor" type="double" value="0.8"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)";

using Row = std::map<std::string, double>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

std::vector<Row> table(const std::string& text) {
  std::stringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> words = split(line);
    EXPECT_EQ(words.size(), names.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), words.size()); ++i) row[names[i]] = std::atof(words[i].c_str());
    rows.push_back(row);
  }
  return rows;
}

class PointToolTest : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write("mesh.g", "");  // only looked for, never read
    write("deck.xml", deck);
  }

  // The environment is emptied: the tool shall not take itself for a rank of the mpirun that runs this test.
  Outcome point(const std::string& words) const {
    return run(
        "env -i ASAN_OPTIONS=\"$ASAN_OPTIONS\" PATH=\"$PATH\" HOME=\"$HOME\" TMPDIR=\"${TMPDIR:-/tmp}\" " STRUT_POINT
        " " +
        words);
  }

  std::vector<Row> follow(const std::string& words) const {
    const Outcome outcome = point(path("deck.xml") + " " + words);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return table(outcome.text);
  }

  void expect_refused(const std::string& words, const std::string& part) const {
    const Outcome outcome = point(words);
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_NE(outcome.text.find(part), std::string::npos) << outcome.text;
  }
};

// σ = σ_y + H ε̄ with ε̄ = ε − σ/E; the tool prints 15 digits, and frees the sides to 1e-10 of the stress.
TEST_F(PointToolTest, UniaxialStressOfLinearHardeningIsTheClosedForm) {
  const std::vector<Row> rows = follow("--material copper --uniaxial-stress 1e3 0.1 --steps 50");
  ASSERT_EQ(rows.size(), 51u);
  const Row& last = rows.back();
  const double stress = (yield_stress + hardening * 0.1) / (1 + hardening / youngs);
  EXPECT_NEAR(last.at("Time"), 1e-4, 1e-13);
  EXPECT_NEAR(last.at("Strain_xx"), 0.1, 1e-13);
  EXPECT_NEAR(last.at("Stress_xx"), stress, 1e-9 * stress);
  EXPECT_NEAR(last.at("Stress_yy"), 0, 1e-9 * stress);
  EXPECT_NEAR(last.at("Von_Mises_Stress"), stress, 1e-9 * stress);
  EXPECT_NEAR(last.at("Equivalent_Plastic_Strain"), 0.1 - stress / youngs, 1e-10);
}

// With Johnson-Cook softening of exponent 1, the flow stress falls in a straight line to 0 at the melting temperature.
TEST_F(PointToolTest, StartsAtTheTemperatureOfItsBlocks) {
  const std::string modulus = R"("100.0e6"/>)";
  std::string hot = deck;
  const auto copper_ends = hot.find("</ParameterList>", hot.find(modulus)) + 16;
  hot.insert(copper_ends, R"(
      <ParameterList name="Heating"><Parameter name="Specific Heat" type="double" value="1e12"/></ParameterList>
      <ParameterList name="Softening">
        <Parameter name="Type" type="string" value="Johnson-Cook"/>
        <Parameter name="Reference Temperature" type="double" value="300"/>
        <Parameter name="Melting Temperature" type="double" value="1300"/>
        <Parameter name="Exponent" type="double" value="1"/>
      </ParameterList>)");
  const std::string horizon = R"(<Parameter name="Horizon" type="double" value="0.0015"/>)";
  hot.insert(hot.find(horizon), R"(<Parameter name="Initial Temperature" type="double" value="900"/>
      )");
  write("deck.xml", hot);
  const std::string words = "--material copper --uniaxial-stress 1e3 0.01 --steps 100";
  const Row last = follow(words).back();
  EXPECT_NEAR(last.at("Temperature"), 900, 1e-3);
  const double flow = yield_stress + hardening * last.at("Equivalent_Plastic_Strain");
  EXPECT_NEAR(last.at("Stress_xx"), (1300.0 - 900) / (1300 - 300) * flow, 1e-6 * flow);

  const std::string section = R"(<ParameterList name="bar">)", all = R"(value="all")";
  std::string two = hot;
  two.replace(two.find(all), all.size(), R"(value="rod")");
  two.insert(two.find(section), R"(<ParameterList name="cold">
      <Parameter name="Block Names" type="string" value="anvil"/>
      <Parameter name="Material" type="string" value="copper"/>
      <Parameter name="Horizon" type="double" value="0.0015"/>
    </ParameterList>
    )");
  write("deck.xml", two);
  expect_refused(path("deck.xml") + " " + words, "(cold at 293 K, bar at 900 K); expected one");
  EXPECT_EQ(follow("--material steel --uniaxial-strain 1 0.01 --steps 1").size(), 2u);
}

TEST_F(PointToolTest, CompressionMirrorsTension) {
  const double pull = follow("--material copper --uniaxial-strain 1e3 0.1 --steps 20").back().at("Stress_xx");
  const double push = follow("--material copper --uniaxial-strain 1e3 -0.1 --steps 20").back().at("Stress_xx");
  EXPECT_NEAR(push, -pull, 1e-12 * pull);
}

// A law that goes by the stretch: to a strain of 1, τ = J σ = τ_y0, and ρ* = ρ₀*/J.
TEST_F(PointToolTest, APolymericFoamIsCrushed) {
  const std::string old = R"(value="Elastic Correspondence"/>)";
  std::string with_foam = deck;
  with_foam.replace(with_foam.find(old), old.size(), R"(value="Polymer Foam Correspondence"/>
      <Parameter name="Relative Density" type="double" value="0.05"/>
      <Parameter name="Density Exponent" type="double" value="1.5"/>
      <Parameter name="Tension Ratio" type="double" value="0.3"/>
      <Parameter name="Uniaxial Yield Stress" type="double" value="80e6"/>
      <Parameter name="Hydrostatic Yield Stress" type="double" value="40e6"/>)");
  write("deck.xml", with_foam);
  const Row last = follow("--material steel --uniaxial-stress 1e3 -1 --steps 100").back();
  const double J = std::exp(last.at("Strain_xx") + last.at("Strain_yy") + last.at("Strain_zz"));
  EXPECT_NEAR(last.at("Strain_xx"), -1, 1e-12);
  EXPECT_NEAR(-J * last.at("Stress_xx"), 80e6, 1e-9 * 80e6);
  EXPECT_NEAR(last.at("Relative_Density"), 0.05 / J, 1e-12);
}

TEST_F(PointToolTest, AnOrdinaryMaterialShowsHookesLaw) {
  const std::string words = "--material steel --uniaxial-strain 1e3 0.01 --steps 3",
                    name = "\"Elastic Correspondence\"";
  const std::vector<Row> law = follow(words);
  write("deck.xml", std::string(deck).replace(std::string(deck).find(name), name.size(), "\"Elastic\""));
  EXPECT_EQ(follow(words), law);
}

TEST_F(PointToolTest, ElasticMaterialHasNoStateColumns) {
  const std::vector<Row> rows = follow("--material steel --uniaxial-stress 1 1e-3 --steps 1");
  EXPECT_EQ(rows.back().size(), 14u);
  EXPECT_NEAR(rows.back().at("Stress_xx"), 210e6, 1e-9 * 210e6);
  EXPECT_NEAR(rows.back().at("Strain_yy"), -0.3e-3, 1e-12);
}

// Loaded by stress beyond yield, and unloaded again: Hooke's law and the plastic strain remain.
TEST_F(PointToolTest, FollowsAPathOfStress) {
  write("path.csv",
        "time, xx, yy, zz, xy, yz, zx\n"
        "0,0,0,0,0,0,0\n\n# up and down\n"
        "1e-5,410e6,0,0,0,0,0\n"
        "2e-5,0,0,0,0,0,0\n");
  const std::vector<Row> rows = follow("--material copper --path stress " + path("path.csv") + " --steps 10");
  ASSERT_EQ(rows.size(), 21u);
  const double plastic = (410e6 - yield_stress) / hardening;
  EXPECT_NEAR(rows[10].at("Strain_xx"), plastic + 410e6 / youngs, 1e-8);  // 1e-9 of the stress over H
  EXPECT_NEAR(rows[20].at("Strain_xx"), plastic, 1e-8);
  EXPECT_NEAR(rows[20].at("Strain_yy"), -plastic / 2, 1e-8);
  EXPECT_NEAR(rows[20].at("Stress_xx"), 0, 1);  // Pa
}

TEST_F(PointToolTest, FollowsAPathOfStrain) {
  write("path.csv", "0,0,0,0,0,0,0\n1e-5,0,0,0,1e-3,0,0\n");
  const std::vector<Row> rows = follow("--material copper --path strain " + path("path.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[1].at("Stress_xy"), youngs / (1 + poisson) * 1e-3, 1e-3);  // 2μ ε_xy, Pa
}

TEST_F(PointToolTest, RefusesAWrongRequest) {
  const std::string file = path("deck.xml");
  expect_refused("", "no deck is given");
  expect_refused(file, "no path is given");
  expect_refused(file + " --uniaxial-strain 1 0.1", "choose one with --material");
  expect_refused(file + " --material coper --uniaxial-strain 1 0.1", "did you mean 'copper'?");
  expect_refused(file + " --uniaxial-stran 1 0.1", "did you mean '--uniaxial-strain'?");
  expect_refused(file + " --uniaxial-strain 1", "needs a final strain");
  expect_refused(file + " --uniaxial-strain 0 0.1", "expected a rate > 0");
  expect_refused(file + " --uniaxial-strain one 0.1", "'one' is not a number");
  expect_refused(file + " --uniaxial-strain 1 0.1 --steps 1.5", "a whole number from 1");
  expect_refused(file + " --uniaxial-strain 1 0.1 --uniaxial-stress 1 0.1", "more than one path");
  expect_refused(path("other.xml") + " --uniaxial-strain 1 0.1", "does not exist");
}

TEST_F(PointToolTest, RefusesAWrongPath) {
  const auto expect = [&](const std::string& text, const std::string& part) {
    write("path.csv", text);
    expect_refused(path("deck.xml") + " --material copper --path strain " + path("path.csv"), part);
  };
  expect("", "expected two rows or more");
  expect("0,0,0,0,0,0,0\n1,0,0,0,0,0\n", "path.csv:2: expected seven numbers");
  expect("0,0,0,0,0,0,0\n1,0,0,0,0,0,x\n", "path.csv:2: expected seven numbers");
  expect("0,0,0,0,0,0,0\n1,0,0,0,0,0,nan\n", "path.csv:2: expected seven numbers");
  expect("0,0,0,0,0,0,0\n0,1,0,0,0,0,0\n", "path.csv:2: the time does not rise");
  expect("0,1,0,0,0,0,0\n1,1,0,0,0,0,0\n", "path.csv:1: the first row is the unloaded start");
}

TEST_F(PointToolTest, FailsIfItsTableDoesNotFitTheDisk) {
  EXPECT_EQ(point(path("deck.xml") + " --material steel --uniaxial-strain 1 0.1 > /dev/full; exit $?").status, 1);
}

// Perfectly plastic beyond its flow stress: no strain carries it. (Hardening modulus 0.)
TEST_F(PointToolTest, SaysWhereNoStepIsFound) {
  std::string saturated = deck;
  const auto at = saturated.find("100.0e6");
  saturated.replace(at, 7, "0");
  write("saturated.xml", saturated);
  write("path.csv", "0,0,0,0,0,0,0\n1e-5,390e6,0,0,0,0,0\n2e-5,410e6,0,0,0,0,0\n");
  expect_refused(path("saturated.xml") + " --material copper --path stress " + path("path.csv"),
                 "no step found after t = 1e-05 s, towards row 3");
}

}  // namespace
}  // namespace strut::testing
