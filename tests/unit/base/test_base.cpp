#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "base/build_facts.hpp"
#include "base/deduplicated.hpp"
#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "base/math/table_files.hpp"
#include "base/math/tensors.hpp"
#include "base/math/time_integral.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/parallel/launch.hpp"
#include "base/parallel/reproducible_sum.hpp"
#include "base/timing.hpp"
#include "unit/temporary_folder.hpp"

namespace strut {
namespace {

// As these libraries say it.
TEST(BuildFacts, NameTheMpiLibrary) {
  EXPECT_EQ(mpi_library("Open MPI v4.1.4, package: Debian OpenMPI, ident: 4.1.4"), "Open MPI 4.1.4");
  EXPECT_EQ(mpi_library("MPICH Version:\t4.0.2\nMPICH Release date:\tThu Apr  7"), "MPICH Version 4.0.2");
  EXPECT_EQ(mpi_library("MPI VERSION    : CRAY MPICH version 8.1.25.17 (ANL base 3.4a2)\nMPI BUILD INFO : Sun"),
            "MPI VERSION CRAY MPICH version 8.1.25.17 (ANL base 3.4a2)");
}

// mpirun may be started by srun, whose tasks are then not the ranks.
TEST(Launch, IsWhatTheNearestLauncherSays) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMI_RANK"}) unsetenv(name);
  unsetenv("SLURM_STEP_NUM_TASKS");
  EXPECT_EQ(launch_of_process().processes, 1);
  EXPECT_EQ(launch_of_process().variable, "");
  setenv("SLURM_STEP_NUM_TASKS", "3", 1);
  setenv("SLURM_PROCID", "2", 1);
  EXPECT_EQ(launch_of_process().processes, 3);
  EXPECT_EQ(launch_of_process().number, 2);
  setenv("PMI_SIZE", "4 ranks", 1);  // no number: not what MPICH says
  EXPECT_EQ(launch_of_process().variable, "SLURM_STEP_NUM_TASKS");
  setenv("PMI_SIZE", "8", 1);
  setenv("PMI_RANK", "7", 1);
  EXPECT_EQ(launch_of_process().processes, 8);
  EXPECT_EQ(launch_of_process().number, 7);
  setenv("OMPI_COMM_WORLD_SIZE", "1", 1);
  EXPECT_EQ(launch_of_process().processes, 1);
  EXPECT_EQ(launch_of_process().variable, "OMPI_COMM_WORLD_SIZE");
}

TEST(Errors, OneRanksProblemIsEveryRanksError) {
  const Communicator world;
  const int last = world.size() - 1;
  std::string text = "nothing thrown";
  try {
    raise_together(world, world.rank() == last ? "rank " + std::to_string(last) + " fell over" : "");
  } catch (const Error& error) {
    text = error.what();
  }
  EXPECT_EQ(text, "rank " + std::to_string(last) + " fell over");
}

TEST(Errors, SameTextIsSaidOnce) {
  const Communicator world;
  try {
    raise_together(world, "no such file");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no such file");
  }
}

TEST(Errors, NothingWrongIsNothingThrown) {
  const Communicator world;
  EXPECT_NO_THROW(raise_together(world, ""));
  EXPECT_NO_THROW(run_on_root(world, [] {}));
}

TEST(Errors, RootsExceptionReachesAll) {
  const Communicator world;
  EXPECT_THROW(run_on_root(world, [] { throw std::runtime_error("disk full"); }), Error);
}

TEST(Errors, NearestName) {
  const std::vector<std::string> valid{"Horizon", "Material", "Block Names"};
  EXPECT_EQ(did_you_mean("Horzion", valid), " (did you mean 'Horizon'?)");
  EXPECT_EQ(did_you_mean("material", valid), " (did you mean 'Material'?)");
  EXPECT_EQ(did_you_mean("Velocity", valid), "");
}

TEST(Communicator, GatherKeepsTheOrderOfRanks) {
  const Communicator world;
  const std::vector<int> mine(world.rank() + 1, world.rank());  // rank r holds r, r + 1 times
  const std::vector<int> all = gather(world, std::span<const int>(mine));
  std::vector<int> expected;
  for (int r = 0; world.rank() == 0 && r < world.size(); ++r) expected.insert(expected.end(), r + 1, r);
  EXPECT_EQ(all, expected);
}

TEST(Communicator, Reductions) {
  const Communicator world;
  const int n = world.size();
  EXPECT_EQ(world.sum(1.0), n);
  EXPECT_EQ(world.max(static_cast<double>(world.rank())), n - 1);
  EXPECT_EQ(world.min(static_cast<double>(world.rank())), 0);
  std::string text = world.rank() == 0 ? "deck" : "";
  world.broadcast(text);
  EXPECT_EQ(text, "deck");
}

// Terms of very different size in any order on any rank: the same bits, and as near the true sum as doubles get.
TEST(Communicator, OfRanksThatAreAlikeTheFirstSpeaks) {
  const Communicator world;
  EXPECT_EQ(world.first_rank(true), 0);
  EXPECT_EQ(world.first_rank(world.rank() >= world.size() / 2), world.size() / 2);
  EXPECT_EQ(world.first_rank(false), -1);
  EXPECT_TRUE(world.any(world.rank() == world.size() - 1));
  EXPECT_FALSE(world.any(false));
}

TEST(Communicator, ReproducibleSumDoesNotKnowOfRanks) {
  const Communicator world;
  const auto term = [](int k) { return std::sin(k) * std::pow(10, k % 7) / 3; };
  std::vector<double> all, mine;
  double expected = 0;
  for (int k = 0; k < 1000; ++k) {
    all.push_back(term(k));
    expected += term(k);
    if ((k * 7 + 3) % 5 % world.size() == world.rank()) mine.push_back(term(k));
  }
  std::reverse(mine.begin(), mine.end());
  if (world.rank() > 0) all.clear();
  const auto sum = [&world](const std::vector<double>& terms) {
    return reproducible_sum(world, static_cast<int>(terms.size()), [&terms](int k) { return terms[k]; });
  };
  EXPECT_EQ(sum(mine), sum(all));
  EXPECT_NEAR(sum(mine), expected, 1e-12 * 1e6);
  EXPECT_EQ(sum({0, 0, 0}), 0);
  if (world.rank() == 0) mine.push_back(std::nan(""));
  EXPECT_FALSE(std::isfinite(sum(mine)));
}

// Two kinds of values, each in many places with its round-off; and values that are all different.
TEST(Deduplicated, KeepsTheSameValuesOnce) {
  std::vector<Vector> all;
  for (int i = 0; i < 100; ++i) {
    all.push_back(Vector(1 + i % 2, 1e-3, 0) * 1e-30 * (1 + 1e-15 * (i % 7)));
    for (int c = 0; c < 3; ++c) {
      const double value = rounded(all[i][c], 1e-30, 44);
      EXPECT_LE(std::abs(value - all[i][c]), std::ldexp(1e-30, -44));
      all[i][c] = value;
    }
  }
  const Deduplicated<Vector> few(all);
  EXPECT_LE(few.bytes(), 8 * sizeof(Vector) + 100 * sizeof(int)) << "some may lie where rounding parts them";
  for (int i = 0; i < 100; ++i) EXPECT_EQ(few[i], all[i]);
  for (int i = 0; i < 100; ++i) all[i][1] = i;
  const Deduplicated<Vector> different(all);
  EXPECT_EQ(different.bytes(), 100 * sizeof(Vector)) << "places would be more";
  for (int i = 0; i < 100; ++i) EXPECT_EQ(different[i], all[i]);
}

TEST(Function, NumberExpressionStatement) {
  EXPECT_DOUBLE_EQ(Function::parse("-2.5e3")(1, 1, 1, 1), -2500);
  EXPECT_TRUE(Function::parse(" +4 ").is_constant());
  EXPECT_DOUBLE_EQ(Function::parse("1.0e-3*t + x*y")(2, 3, 0, 4), 6.004);
  EXPECT_DOUBLE_EQ(Function::parse("value = z*z")(0, 0, 3, 0), 9);
  EXPECT_DOUBLE_EQ(Function::parse("z < 1e-3")(0, 0, 0, 0), 1);
}

TEST(Function, KnowsWhetherItDependsOnTime) {
  EXPECT_TRUE(Function::parse("x*t").depends_on_time());
  EXPECT_FALSE(Function::parse("sqrt(x)").depends_on_time());  // the t of sqrt is none
}

TEST(Function, KnowsWhetherItDependsOnThePlace) {
  for (const char* text : {"x", "2*y*t", "value = 0; if (z > 1) { value = 1; }"}) {
    EXPECT_TRUE(Function::parse(text).depends_on_position()) << text;
  }
  for (const char* text : {"3", "exp(-t)", "value = t"})
    EXPECT_FALSE(Function::parse(text).depends_on_position()) << text;
}

// Pulses and jumps that equal parts miss or meet at the same phase; times that the text names by a product or below 0.
TEST(TimeIntegral, MissesNoPulse) {
  const double root_of_pi = std::sqrt(std::acos(-1));
  const std::vector<std::tuple<const char*, double, double>> cases{
      {"exp(-((1000*t - 334)^2))", 0, 1e-3 * root_of_pi},
      {"exp(-(((t - 0.334)/1e-6)^2))", 0, 1e-6 * root_of_pi},
      {"abs(1e6*t - 334e3) < 1", 0, 2e-6},
      {"value = 0; if (t > 0.4) { if (t < 0.4001) { value = 1; } }", 0, 1e-4},
      {"3*t > 1", 0, 2. / 3},
      {"t < -0.3", -1, 0.7},
      {"sin(201.06192982974676*t)^2", 0, 0.5},
      {"max(t, 0.3)", 0, 0.545},
      {"1/sqrt(t)", 0, 2},
      {"table(2*t, 0, 0, 0.5, 1, 1, 0)", 0, 0.25}};
  for (const auto& [text, from, integral] : cases) {
    const double found = time_integral(Function::parse(text), Vector::Zero(), from, from < 0 ? 0 : 1);
    EXPECT_NEAR(found, integral, 1e-8 * integral) << text << ": a hundred parts that are each known to 1e-10";
  }
}

// expressions.txt: "value | text" or "error | text"; the tools in Python are tested by the same lines.
TEST(Function, GivesWhatTheSharedTableSays) {
  std::ifstream file(STRUT_EXPRESSIONS);
  int lines = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t bar = line.find(" | ");
    const std::string expected = line.substr(0, bar), text = line.substr(bar + 3);
    ++lines;
    if (expected == "error") {
      EXPECT_THROW(Function::parse(text), Error) << text;
      continue;
    }
    const double found = Function::parse(text)(3, 0, 0, 0), value = std::strtod(expected.c_str(), nullptr);
    if (std::isfinite(value)) {
      EXPECT_NEAR(found, value, 4e-16 * std::fabs(value)) << text;  // the last bit of a library's function
    } else {
      EXPECT_EQ(std::to_string(std::fabs(found)), std::to_string(std::fabs(value))) << text;
    }
  }
  EXPECT_GT(lines, 60);
}

// A deck can do nothing to the machine it runs on, nor keep it busy.
TEST(Function, OnlyComputesAndEnds) {
  for (const char* text : {"while (1) { value = 1; }", "for (int i = 0; i < 1; i = i) { value = 1; }", "rand()",
                           "readline(x, y)", "printf(x)", "double a[1000000000]; value = 1;"}) {
    EXPECT_THROW(Function::parse(text), Error) << text;
  }
  const auto nested = [](int n) { return std::string(n, '(') + "x" + std::string(n, ')'); };
  EXPECT_EQ(Function::parse(nested(90))(3, 0, 0, 0), 3);
  EXPECT_THROW(Function::parse(nested(101)), Error);
  EXPECT_THROW(Function::parse(nested(1000000)), Error);
  EXPECT_EQ(Function::parse("x" + std::string(9000, '-') + "x")(3, 0, 0, 0), 6);
  std::string right = "x";
  for (int n = 0; n < 90; ++n) right = "(0 || 1 && 1 == 1 < 2 + 3 * " + right + ")";
  EXPECT_EQ(Function::parse(right)(3, 0, 0, 0), 1);
  EXPECT_THROW(Function::parse("x" + std::string(10000, '-') + "x"), Error);
  const auto declared = [](int n) {
    std::string text;
    for (int k = 0; k < n; ++k) text += "double v" + std::to_string(k) + " = " + std::to_string(k) + "; ";
    return text + "value = v" + std::to_string(n - 1) + ";";
  };
  EXPECT_EQ(Function::parse(declared(59))(0, 0, 0, 0), 58);
  EXPECT_THROW(Function::parse(declared(60)), Error);
}

// An amplitude that was measured has tens of thousands of rows, which a look-up does not pass one by one.
TEST(Function, TakesTablesOfAnyLength) {
  std::ostringstream table;
  table << "2*table(t";
  for (int n = 0; n < 20000; ++n) table << ", " << n << ", " << n * n;
  const std::string text = table.str() + ")";
  EXPECT_GT(text.size(), 200000);
  EXPECT_EQ(Function::parse(text)(0, 0, 0, 17000.5), 2 * (17000.0 * 17000 + 17000.5));
  EXPECT_THROW(Function::parse(text + "+x" + std::string(10000, '-') + "x"), Error);
}

// A table in a file: two numbers a row.
class TableFiles : public testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  std::string numbers(const std::string& content) const {
    const std::string file = (folder / ("pull" + std::to_string(world.rank()) + ".csv")).string();
    std::ofstream(file, std::ios::binary) << content;
    return numbers_in_table(file);
  }
  void expect_problem(const std::string& content, const std::string& words) const {
    try {
      numbers(content);
      ADD_FAILURE() << content;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
};

TEST_F(TableFiles, AreReadAsInstrumentsWriteThem) {
  for (const char* content :
       {"0,0\n1e-3,-5.25\n", "\xef\xbb\xbf# of a press\r\nTime,Force\r\n\r\n+0, 0\r\n0.001 , -5.25",
        "Time,Force # of a press\n0,0 # a\n1e-3,-5.25# b\n", "t / s;F / N\n0;0\n# a pause\n1E-3;-525e-2\n",
        "0 0\n\t1e-3 \t -5.25", "time,2nd gauge\n0,0\n1e-3,-5.25"}) {
    EXPECT_EQ(numbers(content), "0, 0, 0.001, -5.25") << content;
  }
  EXPECT_EQ(numbers("-1 0.1\n0 0.30000000000000004"), "-1, 0.1, 0, 0.30000000000000004");  // every bit
}

TEST_F(TableFiles, AreRefusedByFileAndLine) {
  expect_problem("", "pull" + std::to_string(world.rank()) + ".csv has no row; expected two numbers");
  expect_problem("Time,Force\n# none\n", "has no row");
  expect_problem("Time,Force\ns,N\n0,0\n", "line 2: 's,N'; expected two numbers");  // two headers
  for (const std::string row : {"0.D0 0.D0", "-1d0;+0D0", "nan nan", "Inf,NaN", "\"0\",\"500\"", "−1 −2"})
    expect_problem(row + "\n0 0\n1 1000\n", "line 1: '" + row + "'; expected two numbers");
  expect_problem("nan,0\n1,1\n", "line 1: 'nan,0'");  // no header: it has a number
  expect_problem("0,0\n1,x\n", "line 2: '1,x'; expected two numbers, the place (the time, s) and the value");
  expect_problem("0,0\n1,inf\n", "line 2");
  expect_problem("0,0\n1,2,3\n", "line 2: '1,2,3'");
  expect_problem("0,0\n1,,3\n", "line 2: '1,,3'");
  expect_problem("0,001;5\n", "line 1: '0,001;5'");  // commas for points
  expect_problem("0\n", "line 1: '0'");
  expect_problem("# a\n0,0\n2,1\n\n2,1\n", "line 5: 2 after 2; expected places that rise");
  expect_problem("0,0\n2,1\n1,1\n", "line 3: 1 after 2");
  EXPECT_THROW(numbers_in_table(folder / "none.csv"), Error);
  EXPECT_THROW(numbers_in_table(folder / ""), Error);
}

TEST(Tables, AreNamedInQuotesAsTheLastWordOfACall) {
  const std::string text = "2*table(t, 'a b.csv') + table( t - min(1,2) ,'c.csv' )";
  EXPECT_EQ(table_files(text), (std::vector<std::string>{"a b.csv", "c.csv"}));
  const std::string filled = with_table(with_table(text, "c.csv", "0, 7"), "a b.csv", "0, 1, 1, 2");
  EXPECT_EQ(filled, "2*table(t, 0, 1, 1, 2) + table( t - min(1,2) ,0, 7 )");
  EXPECT_EQ(Function::parse(filled)(0, 0, 0, 0.5), 10);
  for (const char* none : {"table(t, 0, 0, 1, 5)", "'", "don't, 'x", "'a.csv'", "f('a.csv')", ", 'a.csv'", ""})
    EXPECT_TRUE(table_files(none).empty()) << none;
  EXPECT_THROW(Function::parse("table(t, pull.csv)"), Error);
}

// The list that the reference page shows.
TEST(Function, KnowsTheFunctionsOfTheList) {
  for (const std::string& name : functions_in_expressions()) {
    const bool two = name == "pow" || name == "atan2" || name == "min" || name == "max";
    EXPECT_NO_THROW(Function::parse(name + (two ? "(x, y)" : "(x)"))) << name;
  }
  EXPECT_DOUBLE_EQ(Function::parse("fabs(x)")(-2, 0, 0, 0), 2);
  try {
    Function::parse("floor(x)");
    FAIL() << "floor is known: add it to the list";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("there is no function 'floor'"), std::string::npos) << error.what();
  }
}

TEST(Tensors, SymmetricOrderAndProducts) {
  Tensor t;
  t << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const Symmetric s = symmetric_part(t);
  EXPECT_TRUE(to_tensor(s).isApprox(0.5 * (t + t.transpose())));
  EXPECT_DOUBLE_EQ(double_dot(s, s), to_tensor(s).squaredNorm());
  EXPECT_NEAR(trace(deviator(s)), 0, 1e-14);
  Symmetric uniaxial = Symmetric::Zero();
  uniaxial[1] = -3;
  EXPECT_DOUBLE_EQ(von_mises(uniaxial), 3);
}

// A rank may pass through phases that others never see (a contact that it alone has): the table must not wait for them.
TEST(Timing, PhasesOfOneRankAreInTheTableOfAll) {
  const Communicator world;
  phase("of all");
  phase("of rank " + std::to_string(world.rank()));
  std::vector<std::string> names;
  for (const PhaseTime& time : phase_times(world)) names.push_back(time.name);
  ASSERT_EQ(names.size(), 1u + world.size());
  EXPECT_EQ(names[0], "of all");
  for (int r = 0; r < world.size(); ++r) EXPECT_EQ(names[1 + r], "of rank " + std::to_string(r));
}

// Else the shares of a run's table would add up to more than the run.
TEST(Timing, APhaseWithinAnotherCountsForItselfAlone) {
  const Communicator world;
  {
    const Timed outer(phase("outer"));
    const Timed inner(phase("inner"));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  double inner = 0, outer = 0;
  for (const PhaseTime& p : phase_times(world)) {
    if (p.name == "inner") inner = p.mean;
    if (p.name == "outer") outer = p.mean;
  }
  EXPECT_GE(inner, 0.1);
  EXPECT_LT(outer, 0.5 * inner);  // nothing but the calls, and what a busy machine takes
}

}  // namespace
}  // namespace strut
