// Decks that are wrong: for each the text that the user sees, the same on every rank.
#include <gtest/gtest.h>

#include "deck_under_test.hpp"

namespace strut::deck {
namespace {

struct Case {
  std::string name;
  std::string old, replacement;  // in full_deck
  std::string problem;           // the only one
};

void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }

class OneProblem : public testing::TestWithParam<Case> {};

TEST_P(OneProblem, IsReported) {
  const DeckFolder folder;
  EXPECT_EQ(folder.error(changed(full_deck, GetParam().old, GetParam().replacement)),
            "deck.xml: 1 problem\n  " + GetParam().problem);
}

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

// ---- Errors of one key ---------------------------------------------------------------------------------------------

const std::vector<Case> values = {
    {"BoolForReal", R"(type="int" value="8960")", R"(type="bool" value="true")",
     "Materials > copper > Density: 'true' of type bool; expected a real number > 0, in kg/m³"},
    {"NoNumber", R"(type="int" value="8960")", R"(type="string" value="heavy")",
     "Materials > copper > Density: 'heavy'; expected a real number > 0, in kg/m³"},
    {"NumberWithUnit", R"(type="int" value="8960")", R"(type="double" value="8960 kg")",
     "Materials > copper > Density: '8960 kg' is not of type double; expected a real number > 0, in kg/m³"},
    {"FractionAsInt", R"(type="int" value="8960")", R"(type="int" value="89.6")",
     "Materials > copper > Density: '89.6' is not of type int; expected a real number > 0, in kg/m³"},
    {"UnknownType", R"(type="int" value="8960")", R"(type="doubel" value="8960")",
     "Materials > copper > Density: unknown type 'doubel' (did you mean 'double'?); expected one of bool, int, double, "
     "string, Array(int), Array(double), short, long, long long, float, Array(float), Array(string)"},
    {"NoType", R"(name="Density" type="int")", R"(name="Density")",
     "Materials > copper > Density: has no type; expected the attributes name, type and value"},
    {"NoName", R"(<Parameter name="Density" type="double")",
     R"(<Parameter type="double" value="1"/><Parameter name="Density" type="double")",
     "Materials > steel > <Parameter>: has no name; expected the attributes name, type and value"},
    {"NotANumber", R"(type="int" value="8960")", R"(type="double" value="nan")",
     "Materials > copper > Density: 'nan' is not finite; expected a real number > 0, in kg/m³"},
    {"TooLarge", R"(type="int" value="8960")", R"(type="double" value="1e999")",
     "Materials > copper > Density: '1e999' is not finite; expected a real number > 0, in kg/m³"},
    {"ZeroDensity", R"(type="int" value="8960")", R"(type="int" value="0")",
     "Materials > copper > Density: '0'; expected a real number > 0, in kg/m³"},
    {"NegativeHorizon", "0.0065", "-0.0065", "Blocks > foam > Horizon: '-0.0065'; expected a real number > 0, in m"},
    {"HorizonFactorTooSmall", R"("Horizon" type="string" value="0.0065")",
     R"("Horizon Factor" type="double" value="0.99")",
     "Blocks > foam > Horizon Factor: '0.99'; expected a real number in [1, 20]"},
    {"PoissonAtHalf", "0.296", "0.5",
     "Materials > copper > Poisson's Ratio: '0.5'; expected a real number in (-1, 0.5)"},
    {"PoissonTooSmall", "0.296", "-1",
     "Materials > copper > Poisson's Ratio: '-1'; expected a real number in (-1, 0.5)"},
    {"NegativeExponent", R"("Exponent" type="double" value="0.1")", R"("Exponent" type="double" value="-0.1")",
     "Materials > copper > Hardening > Exponent: '-0.1'; expected a real number ≥ 0"},
    {"ZeroReferenceStrain", "0.00218", "0",
     "Materials > copper > Hardening > Reference Strain: '0'; expected a real number > 0"},
    {"ZeroReferenceRate", R"(value="2.0")", R"(value="0.0")",
     "Materials > copper > Rate > Reference Rate: '0.0'; expected a real number > 0, in 1/s"},
    {"NegativeStabilization", "0.05", "-0.05",
     "Materials > copper > Stabilization Coefficient: '-0.05'; expected a real number ≥ 0"},
    {"ZeroFrequency", R"(value="100")", R"(value="0")",
     "Output > Output Frequency: '0'; expected an integer ≥ 1, in steps"},
    {"RealForInteger", R"(type="int" value="100")", R"(type="double" value="100.0")",
     "Output > Output Frequency: '100.0' of type double; expected an integer ≥ 1, in steps"},
    {"NumberForBool", R"("Velocity" type="bool" value="false")", R"("Velocity" type="int" value="0")",
     "Output > Output Variables > Velocity: '0' of type int; expected true or false (type bool)"},
    {"SafetyFactorAboveOne", R"("Fixed dt" type="double" value="1e-8")", R"("Safety Factor" type="double" value="1.5")",
     "Solver > Verlet > Safety Factor: '1.5'; expected a real number in (0, 1]"},
    {"ZeroSafetyFactor", R"("Fixed dt" type="double" value="1e-8")", R"("Safety Factor" type="double" value="0")",
     "Solver > Verlet > Safety Factor: '0'; expected a real number in (0, 1]"},
    {"NegativeStep", R"(value="1e-8")", R"(value="-1e-8")",
     "Solver > Verlet > Fixed dt: '-1e-8'; expected a real number > 0, in s"},
    {"UnknownChoice", "Cubic Decay", "Qubic Decay",
     "Discretization > Influence Function: 'Qubic Decay' (did you mean 'Cubic Decay'?); expected one of One, Linear "
     "Decay, Cubic Decay"},
    {"CoordinateTwice", R"(value="z")", R"(value="xzx")",
     "Boundary Conditions > flight > Coordinate: 'xzx' has x more than once; expected one or several of x, y, z, such "
     "as xy"},
    {"NoCoordinate", R"(value="z")", R"(value="x y")",
     "Boundary Conditions > flight > Coordinate: 'x y'; expected one or several of x, y, z, such as xy"},
    {"CoordinateAsNumber", R"(type="string" value="z")", R"(type="int" value="3")",
     "Boundary Conditions > flight > Coordinate: '3' of type int; expected one or several of x, y, z, such as xy"},
    {"OtherFormat", "ExodusII", "VTK", "Output > Output File Type: 'VTK'; expected one of ExodusII"},
    {"EmptyText", R"(value="bar.csv")", R"(value=" ")",
     "History > Filename: ' ' is empty; expected a text (type string)"},
    {"TwoNumbersForPoint", "0 0 -1e-3", "0 0",
     "Boundary Conditions > wall > Point: '0 0'; expected three real numbers, in m"},
    {"RadiusZero", wall_shape,
     R"("Rigid Cylinder"/> <Parameter name="Point" type="string" value="0 0 -1e-3"/>
      <Parameter name="Axis" type="string" value="0 0 1"/> <Parameter name="Radius" type="double" value="0"/>)",
     "Boundary Conditions > wall > Radius: '0'; expected a real number > 0, in m"},
    {"ExpressionOfUnknown", "1e-3*y*t", "1e-3*q",
     "Boundary Conditions > pull > Value: '1e-3*q' is not an expression in x, y, z, t: at character 6, before "
     "'q': 'q' is not a variable; expected a number or an expression in x, y, z, t, in m"},
    {"ExpressionTooLarge", "1e-3*y*t", "1e999",
     "Boundary Conditions > pull > Value: '1e999' is not finite; expected a number or an expression in x, y, z, t, in "
     "m"},
};
INSTANTIATE_TEST_SUITE_P(Values, OneProblem, testing::ValuesIn(values), name_of);

// ---- Names: unknown, missing, twice --------------------------------------------------------------------------------

const std::vector<Case> names = {
    {"SectionWithoutAName", R"(<ParameterList name="pull">)", R"(<ParameterList name="">)",
     "Boundary Conditions > '': a section without a name; expected one"},
    {"BlanksAroundTheNameOfASet", R"(name="low" type)", R"(name=" low" type)",
     "Node Sets > ' low': blanks around a name; expected none"},
    {"UnknownKey", R"("Block Names" type="string" value="block_2"/>)",
     R"("Block Names" type="string" value="block_2"/> <Parameter name="Horizn" type="double" value="1"/>)",
     "Blocks > plate > Horizn: unknown key (did you mean 'Horizon'?)"},
    {"UnknownKeyWithoutLikeness", R"("Block Names" type="string" value="block_2"/>)",
     R"("Block Names" type="string" value="block_2"/> <Parameter name="Colour" type="string" value="red"/>)",
     "Blocks > plate > Colour: unknown key; expected one of Block Names, Material, Horizon, Horizon Factor, "
     "Separate Body, Bonds Across Voids, Damage Model, Initial Temperature"},
    {"KeyThatIsGone", R"("Type" type="string" value="Text File"/>)",
     R"("Type" type="string" value="Text File"/> <Parameter name="Trial Reads" type="bool" value="false"/>)",
     "Discretization > Trial Reads: unknown key; leave it out: no file is read by a forked process any more"},
    {"UnknownSection", R"(<ParameterList name="Solver">)",
     R"(<ParameterList name="Node Sts"/><ParameterList name="Solver">)",
     "Node Sts: unknown section (did you mean 'Node Sets'?)"},
    {"KeyAmongSections", R"(<ParameterList name="flight">)",
     R"(<Parameter name="Min X Nodes" type="string" value="1"/><ParameterList name="flight">)",
     "Boundary Conditions > Min X Nodes: unknown key; expected sections, or sets of points by number, whose names hold "
     "'Node Set'"},
    {"SetOfNeitherNumbersNorFile", R"(<ParameterList name="flight">)",
     R"(<Parameter name="Min X Node Set" type="string" value="0 3"/><ParameterList name="flight">)",
     "Boundary Conditions > Min X Node Set: '0 3' is neither a list of numbers, the first 1, nor a file of them in the "
     "deck's folder; numbers from 0, as in the oldest decks of Peridigm, are one too small here"},
    {"NoHorizon", R"(<Parameter name="Horizon" type="double" value="0.01"/>)", "",
     "Blocks > plate > Horizon: missing; expected a real number > 0, in m, or 'Horizon Factor' in its place"},
    {"TwoHorizons", R"(<Parameter name="Horizon" type="double" value="0.01"/>)",
     R"(<Parameter name="Horizon" type="double" value="0.01"/>
      <Parameter name="Horizon Factor" type="double" value="1.5"/>)",
     "Blocks > plate: 'Horizon' and 'Horizon Factor' are both given; expected one of them"},
    {"NodesOfAText", R"(<Parameter name="Input Mesh File")",
     R"(<Parameter name="Points" type="string" value="Nodes"/> <Parameter name="Input Mesh File")",
     "Discretization > Points: 'Nodes'; a text file has points only: expected 'Elements' (nodes have Exodus meshes of "
     "hexahedra or tetrahedra)"},
    {"SectionForKey", R"(<Parameter name="Horizon" type="double" value="0.01"/>)", R"(<ParameterList name="Horizon"/>)",
     "Blocks > plate > Horizon: is a section; expected a <Parameter>"},
    {"KeyForSection", R"(<ParameterList name="Verlet">
      <Parameter name="Fixed dt" type="double" value="1e-8"/>
      <Parameter name="Rebalance" type="double" value="1.5"/>
    </ParameterList>)",
     R"(<Parameter name="Verlet" type="double" value="1e-8"/>)",
     "Solver > Verlet: is a <Parameter>; expected a section (<ParameterList>)"},
    {"MissingKey", R"(<Parameter name="Final Time" type="double" value="3e-4"/>)", "",
     "Solver > Final Time: missing; expected a real number, in s"},
    {"MissingKeyOfCase", R"(<Parameter name="Reference Strain" type="double" value="0.00218"/>)", "",
     "Materials > copper > Hardening > Reference Strain: missing; expected a real number > 0"},
    {"MissingYieldStress", R"(<Parameter name="Yield Stress" type="double" value="50e6"/>)", "",
     "Materials > copper > Yield Stress: missing; expected a real number > 0, in Pa"},
    {"KeyOfAnotherCase", R"(<Parameter name="Point" type="string" value="0 0 -1e-3"/>)",
     R"(<Parameter name="Point" type="string" value="0 0 0"/><Parameter name="Value" type="double" value="0"/>)",
     "Boundary Conditions > wall > Value: unknown key for Type 'Rigid Plane'; it belongs to 'Initial Velocity', "
     "'Initial Displacement', 'Prescribed Displacement', 'Prescribed Velocity', 'Body Force', 'Prescribed "
     "Temperature'"},
    {"KeyTwice", R"(<Parameter name="Type" type="string" value="Text File"/>)",
     R"(<Parameter name="Type" type="string" value="Text File"/><Parameter name="Type" type="string" value="Exodus"/>)",
     "Discretization > Type: given 2 times; expected once"},
    {"SectionTwice", R"(<ParameterList name="Solver">)",
     R"(<ParameterList name="Node Sets"/><ParameterList name="Solver">)", "Node Sets: given 2 times; expected once"},
    {"ContactModelNotDefined", R"(<Parameter name="Contact Model" type="string" value="touch"/>)",
     R"(<Parameter name="Contact Model" type="string" value="tuch"/>)",
     "Contact > Interactions > pair > Contact Model: 'tuch' is not defined (did you mean 'touch'?); expected the name "
     "of "
     "a section of Contact > Models: touch"},
    {"InteractionOfOneBlock", R"(<Parameter name="Second Block" type="string" value="block_1"/>)", "",
     "Contact > Interactions > pair: one block is named; expected First Block and Second Block, or neither of them for "
     "all "
     "blocks"},
    {"InteractionTwice", R"(<ParameterList name="General Contact">)",
     R"(<ParameterList name="again"><Parameter name="First Block" type="string" value="block_1"/>
        <Parameter name="Second Block" type="string" value="block_2"/>)",
     "Contact > Interactions > again: joins the same blocks as pair; expected once"},
    {"NoContactRadius", R"(<Parameter name="Contact Radius" type="double" value="2e-3"/>)",
     R"(<Parameter name="Contact Radius" type="double" value="0"/>)",
     "Contact > Models > touch > Contact Radius: '0'; expected a real number > 0, in m"},
    {"UnknownContactLaw", R"(value="Short Range Force")", R"(value="Herz")",
     "Contact > Models > touch > Contact Model: 'Herz' (did you mean 'Hertz'?); expected one of Surface, Short Range "
     "Force, "
     "Hertz"},
    {"NoEffectiveModulus", R"(<Parameter name="Contact Model" type="string" value="Short Range Force"/>
        <Parameter name="Contact Radius" type="double" value="2e-3"/>
        <Parameter name="Spring Constant" type="double" value="1.0e12"/>)",
     R"(<Parameter name="Contact Model" type="string" value="Hertz"/>
        <Parameter name="Contact Radius" type="double" value="2e-3"/>)",
     "Contact > Models > touch > Effective Modulus: missing; expected a real number > 0, in Pa"},
    {"ModulusOfAnotherContactLaw", R"(<Parameter name="Contact Radius" type="double" value="2e-3"/>)",
     R"(<Parameter name="Contact Radius" type="double" value="2e-3"/>
        <Parameter name="Effective Modulus" type="double" value="60e9"/>)",
     "Contact > Models > touch > Effective Modulus: unknown key for Contact Model 'Short Range Force'; it belongs to "
     "'Hertz'"},
    {"EmptyDamageModels", R"(<ParameterList name="Solver">)",
     R"(<ParameterList name="Damage Models"/><ParameterList name="Solver">)",
     "Damage Models: empty; expected at least one section, named as you like"},
    {"PeridigmsHourglassBesideOurs", R"("Stabilization Coefficient" type="double" value="0.05"/>)",
     R"("Stabilization Coefficient" type="double" value="0.05"/>
      <Parameter name="Hourglass Coefficient" type="double" value="0.02"/>)",
     "Materials > copper > Hourglass Coefficient: unknown key; 'Stabilization Coefficient' is its counterpart, but "
     "another quantity: in units of (λ + 2μ)/(tr K/3), and about twice the Hourglass Coefficient for the same effect"},
    {"StabilizationOfCells", R"("Stabilization Coefficient" type="double" value="0.05"/>)",
     R"("Stabilization Coefficient" type="double" value="0.05"/>
      <Parameter name="Formulation" type="string" value="Quadratic Correspondence"/>)",
     "Materials > copper > Stabilization Coefficient: given, but Formulation 'Quadratic Correspondence' has no "
     "zero-energy modes and takes none; expected no such key"},
    {"StabilizationOfOrdinaryBonds", R"(value="Elastic Correspondence")", R"(value="Elastic")",
     "Materials > steel > Stabilization: unknown key for Material Model 'Elastic'; it belongs to 'Elastic "
     "Correspondence', 'Elastic Plastic Correspondence', 'Metal Foam Correspondence', 'Polymer Foam Correspondence', "
     "'Hyperelastic', 'User Library'"},
};
INSTANTIATE_TEST_SUITE_P(Names, OneProblem, testing::ValuesIn(names), name_of);

// ---- Errors of two keys --------------------------------------------------------------------------------------------

const std::vector<Case> pairs = {
    {"FinalBeforeInitial", R"(value="3e-4")", R"(value="1e-4")",
     "Solver > Final Time: '1e-04'; expected > Initial Time (1e-04), in s"},
    {"StepAndSafetyFactor", R"(<Parameter name="Fixed dt")",
     R"(<Parameter name="Safety Factor" type="double" value="0.5"/><Parameter name="Fixed dt")",
     "Solver > Verlet: 'Fixed dt' and 'Safety Factor' are both given; expected one of them"},
    {"OutputFrequencyAndInterval", R"(<Parameter name="Output Frequency")",
     R"(<Parameter name="Output Interval" type="double" value="1"/><Parameter name="Output Frequency")",
     "Output: 'Output Frequency' and 'Output Interval' are both given; expected one of them"},
    {"HistoryFrequencyAndInterval", R"(<Parameter name="Interval")",
     R"(<Parameter name="Frequency" type="int" value="1"/><Parameter name="Interval")",
     "History: 'Frequency' and 'Interval' are both given; expected one of them"},
    {"OneElasticConstant", R"(<Parameter name="Bulk Modulus" type="double" value="160e9"/>)", "",
     "Materials > steel: elastic constants given: Shear Modulus; expected exactly two of Bulk Modulus, Shear Modulus, "
     "Young's Modulus, Poisson's Ratio"},
    {"ThreeElasticConstants", R"(<Parameter name="Bulk Modulus")",
     R"(<Parameter name="Young's Modulus" type="double" value="2e11"/><Parameter name="Bulk Modulus")",
     "Materials > steel: elastic constants given: Bulk Modulus, Shear Modulus, Young's Modulus; expected exactly two "
     "of "
     "Bulk Modulus, Shear Modulus, Young's Modulus, Poisson's Ratio"},
    {"ContradictingConstants", R"("Bulk Modulus" type="double" value="160e9")",
     R"("Young's Modulus" type="double" value="300e9")",
     "Materials > steel: Shear Modulus and Young's Modulus contradict each other; expected such that bulk and shear "
     "modulus are > 0 (0 < E < 3 G, 0 < E < 9 K)"},
    {"UndefinedMaterial", R"("Material" type="string" value="steel")", R"("Material" type="string" value="steal")",
     "Blocks > plate > Material: 'steal' is not defined (did you mean 'steel'?); expected the name of a section of "
     "Materials: copper, steel"},
    {"BlockTwice", R"(value="block_2")", R"(value="block_2 block_3")",
     "Blocks > plate > Block Names: 'block_3' is named twice: here and in Blocks > foam; expected once"},
    {"AllAndOne", R"(value="block_2")", R"(value="all")",
     "Blocks > plate > Block Names: 'block_1' is named twice: here and in Blocks > foam; expected once"},
    {"OneAndAll", R"(value="block_1 block_3")", R"(value="all")",
     "Blocks > plate > Block Names: 'block_2' is named twice: here and in Blocks > foam; expected once"},
    {"ZeroNormal", "{0, 0, 2}", "{0, 0, 0}", "Boundary Conditions > wall > Normal: is zero; expected a direction"},
    {"ZeroAxis", wall_shape,
     R"("Rigid Cylinder"/> <Parameter name="Point" type="string" value="0 0 -1e-3"/>
      <Parameter name="Axis" type="string" value="0 0 0"/> <Parameter name="Radius" type="double" value="1"/>)",
     "Boundary Conditions > wall > Axis: is zero; expected a direction"},
    {"BoxWithoutHeight", wall_shape,
     R"("Rigid Box"/> <Parameter name="Lower Corner" type="string" value="0 0 0.5"/>
      <Parameter name="Upper Corner" type="string" value="1 1 0.5"/>)",
     "Boundary Conditions > wall > Upper Corner: '1 1 0.5'; expected > Lower Corner (0 0 0.5) in each component, in m"},
    {"TravelInSpace", R"(value="{0, 0, 2}"/>)",
     R"(value="{0, 0, 2}"/><Parameter name="Travel Z" type="string" value="-z*t"/>)",
     "Boundary Conditions > wall > Travel Z: '-z*t' depends on x, y or z; expected a number or an expression in t, in "
     "m"},
    {"NodeSetNamedAll", R"(name="low")", R"(name="all")",
     "Node Sets > all: is the set of all points; expected another name"},
    {"ProbeNamedAll", R"(<Parameter name="Interval")",
     R"(<ParameterList name="Probes"> <ParameterList name="all">
          <Parameter name="Point" type="string" value="0 0 0"/></ParameterList></ParameterList> <Parameter name="Interval")",
     "History > Probes > all: is the set of all points; expected another name"},
    {"NodeSetInTime", "z &lt; 1e-3", "z &lt; t", "Node Sets > low: depends on t; expected an expression in x, y, z"},
};
INSTANTIATE_TEST_SUITE_P(Pairs, OneProblem, testing::ValuesIn(pairs), name_of);

const char* const of_text = R"(<Parameter name="Type" type="string" value="Text File"/>)";

// Keys that only one type of mesh has.
TEST(DeckErrors, KeysOfOtherMeshesAreRefused) {
  const DeckFolder folder;
  const std::string box = R"(<Parameter name="NeighborhoodType" type="string" value="Box"/>)";
  EXPECT_EQ(
      folder.error(changed(full_deck, of_text, of_text + box)),
      "deck.xml: 1 problem\n  Discretization > NeighborhoodType: 'Box'; expected 'Spherical': only Type 'PdQuickGrid' "
      "has boxes of cells");
  const auto integer = [](const std::string& name) {
    return R"(<Parameter name=")" + name + R"(" type="int" value="3"/>)";
  };
  std::string axes;
  for (const std::string axis : {"X", "Y", "Z"})
    axes += integer(axis + " Origin") + integer(axis + " Length") + integer("Number Points " + axis);
  const std::string grid = R"(<Parameter name="Type" type="string" value="PdQuickGrid"/>)";
  const std::string of_grid =
      changed(changed(full_deck, R"(<Parameter name="Input Mesh File" type="string" value="bar.txt"/>)", ""), of_text,
              grid + box + R"(<ParameterList name="TensorProduct3DMeshGenerator">)" + grid + axes + "</ParameterList>");
  EXPECT_EQ(folder.error(of_grid), "");
  const std::string nodes = R"(<Parameter name="Points" type="string" value="Nodes"/>)";
  EXPECT_EQ(folder.error(changed(of_grid, box, box + nodes)),
            "deck.xml: 1 problem\n  Discretization > Points: 'Nodes'; a PdQuickGrid has the centers of cells only: "
            "expected 'Elements' (nodes have Exodus meshes of hexahedra or tetrahedra)");
}

// ---- Slow loading --------------------------------------------------------------------------------------------------

std::string in_quasi_static(const std::string& parameters) {
  return changed(small_deck, R"(value="2e-4"/>)",
                 R"(value="2e-4"/><ParameterList name="QuasiStatic">)" + parameters + "</ParameterList>");
}

TEST(DeckErrors, KeysOfQuasiStaticAreChecked) {
  const DeckFolder folder;
  const auto expect = [&](const std::string& name, const std::string& type, const std::string& value,
                          const std::string& problem) {
    const std::string key = R"(<Parameter name=")" + name + R"(" type=")" + type + R"(" value=")" + value + R"("/>)";
    EXPECT_EQ(folder.error(in_quasi_static(key)), "deck.xml: 1 problem\n  Solver > QuasiStatic > " + name + problem);
  };
  expect("Method", "string", "Newtn", ": 'Newtn' (did you mean 'Newton'?); expected one of Newton, Dynamic Relaxation");
  expect("Number of Load Steps", "int", "0", ": '0'; expected an integer ≥ 1");
  expect("Tolerance", "double", "0", ": '0'; expected a real number in (0, 1)");
  expect("Tolerance", "double", "1", ": '1'; expected a real number in (0, 1)");
  expect("Maximum Solver Iterations", "int", "0", ": '0'; expected an integer ≥ 1");
  expect("Safety Factor", "double", "0.8",
         ": unknown key; expected one of Method, Number of Load Steps, Tolerance, Maximum Solver Iterations");
}

// full_deck has steps in time, a friction of contact and an initial velocity: each is one problem.
TEST(DeckErrors, NothingOfInertiaIsAskedOfQuasiStatic) {
  const DeckFolder folder;
  const std::string both = changed(full_deck, R"(<ParameterList name="Verlet">)",
                                   R"(<ParameterList name="QuasiStatic"/><ParameterList name="Verlet">)");
  const std::string reason =
      " has no meaning with Solver > QuasiStatic, which knows no inertia; expected a prescribed motion, a load, a "
      "plane or a tool\n";
  EXPECT_EQ(folder.error(both),
            "deck.xml: 3 problems\n"
            "  Solver: 'Verlet' and 'QuasiStatic' are both given; expected one of them\n"
            "  Boundary Conditions > flight > Type: 'Initial Velocity'" +
                reason +
                "  Contact > Models > touch > Friction Coefficient: '0.3'; expected 0, or Contact Model 'Surface', "
                "with Solver > QuasiStatic: "
                "there, friction is that of surfaces, rigid planes and tools");
  const std::string open = R"(<ParameterList name="Boundary Conditions"><ParameterList name="end">
      <Parameter name="Type" type="string" value="Non-Reflecting End"/>
      <Parameter name="Node Set" type="string" value="all"/>
      <Parameter name="Normal" type="string" value="0 0 1"/></ParameterList></ParameterList>
    <ParameterList name="Solver">)";
  const std::string with_end = changed(in_quasi_static(""), R"(<ParameterList name="Solver">)", open);
  EXPECT_EQ(folder.error(with_end) + "\n",
            "deck.xml: 1 problem\n  Boundary Conditions > end > Type: 'Non-Reflecting End'" + reason);
}

// ---- Tables of hardening -------------------------------------------------------------------------------------------

std::string with_table(const std::string& strains, const std::string& stresses) {
  return changed(small_deck, R"(value="50e6"/>)",
                 R"(value="50e6"/>
      <ParameterList name="Hardening">
        <Parameter name="Type" type="string" value="Table"/>
        <Parameter name="Strains" type="string" value=")" +
                     strains + R"("/>
        <Parameter name="Stresses" type="string" value=")" +
                     stresses + R"("/>
      </ParameterList>)");
}

TEST(DeckErrors, TablesAreChecked) {
  const DeckFolder folder;
  const auto expect = [&](const std::string& strains, const std::string& stresses, const std::string& problem) {
    EXPECT_EQ(folder.error(with_table(strains, stresses)), "deck.xml: 1 problem\n  Materials > copper > " + problem);
  };
  expect("0 0.1", "50e6", "Hardening > Strains: 2 strains for 1 stresses; expected as many");
  expect("0.1 0.2", "50e6 60e6", "Hardening > Strains: the first is 0.1; expected 0");
  expect("0 0.2 0.2", "50e6 6e7 7e7", "Hardening > Strains: 0.2 follows 0.2; expected rising strains");
  expect("0 0.1", "50e6 -1", "Hardening > Stresses: '50e6 -1'; expected a list of real numbers > 0, in Pa");
  expect("0 x", "50e6 6e7", "Hardening > Strains: '0 x'; expected a list of real numbers ≥ 0");
  expect(
      "0 0.1", "60e6 70e6",
      "Yield Stress: '5e+07' is not the first of Hardening > Stresses, 6e+07; expected the same, or no Yield Stress");
}

// ---- Valid decks ---------------------------------------------------------------------------------------------------

TEST(DeckErrors, NothingIsReadThatTheDeckDoesNotName) {
  const DeckFolder folder;
  const std::string list = "<ParameterList>", entity = "<!DOCTYPE d [<!ENTITY e SYSTEM \"file:///etc/passwd\">]>";
  EXPECT_EQ(
      folder.error(entity + changed(small_deck, "8960", "&e;")),
      "deck.xml: 1 problem\n  XML: '<!DOCTYPE d [<!ENTIT': no document type, entities or CDATA; expected elements "
      "only");
  EXPECT_NE(folder.error(changed(small_deck, "8960", "&e;")).find("malformed XML"), std::string::npos);
  const std::string include = "<ParameterList><xi:include href=\"bar.txt\"/>";
  EXPECT_NE(folder.error(changed(small_deck, list, include)).find("<xi:include>: expected"), std::string::npos);
}

// Nor by another name of the same file.
TEST(DeckErrors, WhatIsReadIsNotReplaced) {
  namespace fs = std::filesystem;
  const DeckFolder folder;
  folder.write("deck.xml", "");
  run_on_root(folder.world(), [&] {
    fs::create_symlink(folder / "bar.txt", folder / "soft.e");
    fs::create_hard_link(folder / "bar.txt", folder / "hard.e");
    fs::create_hard_link(folder / "deck.xml", folder / "deck.e");
    fs::create_directory(folder / "folder.e");
  });
  for (const auto& [name, problem] : {std::pair("soft.e", "is the input mesh"),
                                      {"hard.e", "is the input mesh"},
                                      {"deck.e", "is this deck"},
                                      {"folder.e", "is a folder, a pipe or a device"}}) {
    const std::string text = changed(full_deck, "value=\"bar\"", "value=\"" + (folder / name).string() + "\"");
    EXPECT_EQ(folder.error(text), "deck.xml: 1 problem\n  Output > Output Filename: '" + std::string(name) + "' " +
                                      problem + "; expected a file that may be replaced");
  }
}

// A result, history or checkpoint is written to no file twice, whatever it is called, and to none of another kind.
TEST(DeckErrors, FilesThatAreOne) {
  namespace fs = std::filesystem;
  const DeckFolder folder;
  run_on_root(folder.world(), [&] {
    fs::create_directory(folder / "sub");
    fs::create_symlink("run.e", folder / "soft");
    std::ofstream(folder / "notes.txt") << "of mine\n";
    std::ofstream(folder / "run.lock") << "of mine\n";
    std::ofstream(folder / "other.csv") << "# strut 0.1; units: s\nTime\n0\n";
  });
  const auto told = [&](const std::string& output, const std::string& history, const std::string& checkpoint) {
    const auto file = [&](const char* section, const char* key, const std::string& name) {
      return std::string("<ParameterList name=\"") + section + "\"><Parameter name=\"" + key +
             "\" type=\"string\" value=\"" + (folder / name).string() + "\"/></ParameterList>";
    };
    const std::string end = "</ParameterList>";
    std::string text = small_deck.substr(0, small_deck.rfind(end));
    text += file("Output", "Output Filename", output) + file("History", "Filename", history);
    return folder.error(text + file("Restart", "Filename", checkpoint) + end);
  };
  EXPECT_EQ(told("run.e", "run.csv", "run.restart"), "");
  for (const char* alias : {"run.e", "./run.e", "sub/../run.e", "soft", "RUN.e"}) {
    const std::string problem = std::string(" > Filename: '") + alias + "' is Output's file, too; expected another";
    EXPECT_NE(told("run.e", alias, "run.restart").find("History" + problem), std::string::npos) << alias;
    EXPECT_NE(told("run.e", "run.csv", alias).find("Restart" + problem), std::string::npos) << alias;
  }
  for (const char* beside : {"run.restart.old", "run.restart.part", "run.restart.lock"}) {
    EXPECT_NE(told("run.e", beside, "run.restart").find("is History's file, too"), std::string::npos) << beside;
  }
  EXPECT_NE(told("notes.txt", "run.csv", "run.restart").find("'notes.txt' is there and is no result of strut"),
            std::string::npos);
  EXPECT_NE(told("run.e", "notes.txt", "run.restart").find("'notes.txt' is there and is no history of strut"),
            std::string::npos);
  EXPECT_NE(told("other.csv", "run.csv", "run.restart").find("is no result of strut"), std::string::npos);
  EXPECT_NE(told("run.e", "run.csv", "run").find("'run.lock' is there and is no lock of a run"), std::string::npos);
}

TEST(DeckErrors, DecksThatNeverEnd) {
  const DeckFolder folder;
  std::string deep;
  for (int n = 0; n < 30000; ++n) deep += "<ParameterList name=\"a\">";
  EXPECT_EQ(folder.error(deep), "deck.xml: 1 problem\n  XML: more than 100 elements within each other");
  EXPECT_NE(folder.error(small_deck + std::string(2'000'000, ' ')).find("expected at most 1000000"), std::string::npos);
  const std::string name(200'000, 'x');
  EXPECT_NE(folder.error(changed(small_deck, "Density", name)).find("unknown key"), std::string::npos);
}

// ---- Whole decks ---------------------------------------------------------------------------------------------------

TEST(DeckErrors, AllAtOnce) {
  const DeckFolder folder;
  std::string text = changed(full_deck, "8960", "-1");
  text = changed(text, "Yield Stress", "Yeild Stress");
  text = changed(text, "0.0065", "wide");
  text = changed(text, "value=\"z\"", "value=\"height\"");
  text = changed(text, "3e-4", "0");
  text = changed(text, "bar.txt", "rod.txt");
  EXPECT_EQ(folder.error(text),
            "deck.xml: 7 problems\n"
            "  Materials > copper > Density: '-1'; expected a real number > 0, in kg/m³\n"
            "  Materials > copper > Yeild Stress: unknown key (did you mean 'Yield Stress'?)\n"
            "  Blocks > foam > Horizon: 'wide'; expected a real number > 0, in m\n"
            "  Boundary Conditions > flight > Coordinate: 'height'; expected one or several of x, y, z, such as xy\n"
            "  Materials > copper > Yield Stress: missing; expected a real number > 0, in Pa\n"
            "  Solver > Final Time: '0'; expected > Initial Time (1e-04), in s\n"
            "  Discretization > Input Mesh File: 'rod.txt' does not exist; expected a mesh, its path relative to the "
            "deck's folder");
}

TEST(DeckErrors, AnEmptyDeckLacksTheRequiredSections) {
  const DeckFolder folder;
  EXPECT_EQ(folder.error("<ParameterList/>"),
            "deck.xml: 4 problems\n  Discretization: missing section\n  Materials: missing section\n"
            "  Blocks: missing section\n  Solver: missing section");
  EXPECT_EQ(
      folder.error(changed(small_deck, R"(name="Blocks">)", R"(name="Blocks"/><ParameterList name="Node Sets">)")),
      "deck.xml: 2 problems\n  Node Sets > foam: unknown section; expected none here\n"
      "  Blocks: empty; expected at least one section, named as you like");
}

TEST(DeckErrors, MalformedXmlNamesTheLine) {
  const DeckFolder folder;
  EXPECT_EQ(folder.error(changed(full_deck, "z &lt; 1e-3", "z < 1e-3")),
            "deck.xml: 1 problem\n  line 11: malformed XML: invalid character in attribute value (inside a value write "
            "&lt; for < and &amp; for &, and close its quotes)");
  EXPECT_EQ(folder.error("<ParameterList>\n<ParameterList name=\"Solver\">\n</ParameterList>\n"),
            "deck.xml: 1 problem\n  line 4: malformed XML: file ended before closing element 'ParameterList' from line "
            "1");
  EXPECT_EQ(folder.error(""), "deck.xml: 1 problem\n  XML: the file is empty; expected a <ParameterList>");
  EXPECT_EQ(folder.error("<Deck/>"),
            "deck.xml: 1 problem\n  <Deck>: expected the outermost element to be "
            "<ParameterList>");
}

TEST(DeckErrors, StrayElementsAndTextAreRefused) {
  const DeckFolder folder;
  EXPECT_EQ(folder.error(changed(small_deck, R"(<ParameterList name="Solver">)",
                                 R"(<Paramter/> <ParameterList name="Solver"> soon)")),
            "deck.xml: 2 problems\n  <Paramter>: expected <ParameterList name=\"…\"> or <Parameter …/>\n"
            "  Solver: stray text 'soon'");
}

TEST(DeckErrors, WhatAParameterContainsAndUnknownAttributesAreRefused) {
  const DeckFolder folder;
  const std::string density = R"(<Parameter name="Density" type="double" value="8960")";
  ASSERT_NE(small_deck.find(density), std::string::npos);
  const auto problem_of = [&](const std::string& instead) {
    return folder.error(changed(small_deck, density + "/>", instead));
  };
  const std::string inside = "before its </Parameter>; expected <Parameter …/>, with nothing inside",
                    place = "deck.xml: 1 problem\n  Materials > copper > Density: ";
  EXPECT_EQ(problem_of(density + R"(><Parameter name="Linear Viscosity" type="double" value="1"/></Parameter>)"),
            place + "'<Parameter …>' " + inside);
  EXPECT_EQ(problem_of(density + ">2000</Parameter>"), place + "'2000' " + inside);
  EXPECT_EQ(problem_of(density + R"( units="g/cm3"/>)"),
            place + "unknown attribute 'units'; expected name, type, value");
  EXPECT_EQ(folder.error(
                changed(small_deck, R"(<ParameterList name="Solver">)", R"(<ParameterList name="Solver" value="1">)")),
            "deck.xml: 1 problem\n  Solver: unknown attribute 'value'; expected name, type");
}

// Some editors write a byte order mark, and Teuchos itself empty validators and what it knows of a key.
TEST(DeckErrors, HarmlessXmlIsAccepted) {
  const DeckFolder folder;
  EXPECT_EQ(
      folder.error(changed(small_deck, R"(type="double" value="8960")",
                           R"(type="double" value="8960" docString="1 &lt; 2 = 'two' &quot;a&quot; b = c&gt;" id="7")"
                           R"( isUsed="true" isDefault="false")")),
      "");
  EXPECT_EQ(folder.error("\xef\xbb\xbf" + small_deck), "");
  EXPECT_EQ(folder.error(changed(small_deck, "<ParameterList>", "<ParameterList name=\"ANONYMOUS\"><Validators/>")),
            "");
}

TEST(DeckErrors, MissingFiles) {
  const DeckFolder folder;
  const auto error_of = [&](const std::string& name) {
    try {
      read(folder / name, folder.world());
    } catch (const Error& error) {
      return folder.without_folder(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(error_of("none.xml"), "none.xml: the deck does not exist");
  run_on_root(folder.world(), [&] { std::filesystem::create_directory(folder / "folder.xml"); });
  EXPECT_EQ(error_of("folder.xml"), "folder.xml: the deck is not a file that can be read");
}

TEST(DeckErrors, AMissingMeshWithARecipe) {
  const DeckFolder folder;
  folder.write("rod.recipe", "name = rod\n");
  EXPECT_EQ(folder.error(changed(small_deck, "bar.txt", "rod.g")),
            "deck.xml: 1 problem\n  Discretization > Input Mesh File: 'rod.g' does not exist (tools/run makes it from "
            "rod.recipe); expected a mesh, its path relative to the deck's folder");
}

TEST(DeckErrors, AMeshOfAnotherProgramNamesTheToolThatConvertsIt) {
  const DeckFolder folder;
  for (const std::string mesh : {"rod.vtk", "rod.vtu", "rod.msh"}) {
    folder.write(mesh, "of another program\n");
    EXPECT_EQ(
        folder.error(changed(small_deck, "bar.txt", mesh)),
        "deck.xml: 1 problem\n  Discretization > Input Mesh File: '" + mesh +
            "' is a mesh of another program, of which tools/tetrahedra makes one that can be read; expected a mesh, "
            "its path relative to the deck's folder");
  }
}

}  // namespace
}  // namespace strut::deck
