// Laws from shared objects: user_j2.c has J2 with linear hardening by each interface, which must be the built-in law.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "materials/laws.hpp"
#include "materials/step_work.hpp"

namespace strut::testing {
namespace {

using namespace materials;

constexpr double bulk = 89.87e9, shear = 42.44e9, yield = 50e6, hardening = 1e9;  // Pa, of copper's size

J2 built_in() { return {bulk, shear, {yield, LinearHardening{hardening}, NoRate{}}}; }

UserLaw law_of(const std::string& function, LibraryInterface interface = LibraryInterface::strut) {
  UserLaw law{.bulk = bulk, .shear = shear, .density = 8960, .name = "copper"};
  law.constants = UserLaw::with_none_behind({bulk, shear, yield, hardening});
  law.states = 1;
  law.function = loaded(STRUT_USER_J2, function, interface);
  law.tells_energy = true;
  return law;
}

const std::vector<std::pair<std::string, LibraryInterface>> interfaces{
    {"strut_law", LibraryInterface::strut}, {"umat_", LibraryInterface::umat}, {"vumat_", LibraryInterface::vumat}};

// Steps of a tenth of the yield strain to some of it, in any direction.
PointStep random_step(std::mt19937& random) {
  std::uniform_real_distribution<double> in(-1, 1);
  PointStep step{.dt = 1e-7, .J = 1 + 1e-3 * in(random)};
  for (int c = 0; c < 6; ++c) step.rate[c] = 3e-4 * in(random) / step.dt, step.stretch[c] = c < 3;
  return step;
}

// Both have the same closed form but for the order of operations: 1e-12 of the yield stress and strain after 200 steps.
TEST(UserLibrary, IsTheBuiltInLawByEachInterface) {
  constexpr double tolerance = 1e-12;
  for (const auto& [function, interface] : interfaces) {
    const UserLaw law = law_of(function, interface);
    std::mt19937 random(7);
    Symmetric stress = Symmetric::Zero(), expected = stress;
    UserLaw::State state;
    J2::State of_built_in;
    for (int n = 0; n < 200; ++n) {
      const PointStep step = random_step(random);
      const PointStress next = law.step(step, stress, state), right = built_in().step(step, expected, of_built_in);
      ASSERT_TRUE(next.converged && right.converged) << function << " " << n;
      stress = next.stress, expected = right.stress;
    }
    EXPECT_LT((stress - expected).cwiseAbs().maxCoeff(), 200 * tolerance * yield) << function;
    EXPECT_GT(of_built_in.equivalent_plastic_strain, 0.01);
    EXPECT_NEAR(state.user[0], of_built_in.equivalent_plastic_strain, tolerance) << function;
    // With strains of 3e-4 a step the elastic energy differs from the built-in law's by nothing, the work by J.
    EXPECT_NEAR(law.dissipation(state), of_built_in.plastic_work, 2e-3 * of_built_in.plastic_work) << function;
    EXPECT_NEAR(state.stored, (Elastic{bulk, shear}.elastic_energy(expected)), 2e-3 * state.stored) << function;
    EXPECT_TRUE(law.has_flowed(state));
  }
}

// Lanes are the points one by one, with steps of their own, and a lane whose J is not positive leaves the others alone.
TEST(UserLibrary, TakesPointsSideBySide) {
  constexpr int lanes = small::lane_count;
  for (const auto& [function, interface] : interfaces) {
    UserLaw law = law_of(function, interface);
    law.states = 2;
    std::mt19937 random(8);
    SymmetricOf<RawLanes> stress{};
    UserLaw::StateOf<RawLanes> state{};
    std::vector<Symmetric> stresses(lanes, Symmetric::Zero());
    std::vector<UserLaw::State> states(lanes);
    for (int n = 0; n < 20; ++n) {
      StepOf<RawLanes> together{};
      for (int l = 0; l < lanes; ++l) {
        PointStep step = random_step(random);
        step.dt *= 1 << l, step.rate /= 1 << l;
        if (l == 1) step.J = -1;
        together.dt[l] = step.dt, together.J[l] = step.J;
        for (int c = 0; c < 6; ++c) together.rate[c][l] = step.rate[c], together.stretch[c][l] = step.stretch[c];
        if (l == 1) continue;
        const PointStress next = law.step(step, stresses[l], states[l]);
        ASSERT_TRUE(next.converged);
        stresses[l] = next.stress;
      }
      stress = law.step(together, stress, state).stress;
    }
    for (int l = 0; l < lanes; ++l) {
      if (l == 1) continue;
      for (int c = 0; c < 6; ++c) EXPECT_EQ(stress[c][l], stresses[l][c]) << function << " " << l;
      EXPECT_EQ(state.user[0][l], states[l].user[0]) << function << " " << l;
      EXPECT_NEAR(state.user[1][l], 20e-7 * (1 << l), 1e-19 * (1 << l)) << function << " " << l;  // the sum of steps, s
    }
  }
}

// Without energies of its own: those of Hooke's law, and what is left of the work.
TEST(UserLibrary, ThatCountsNoEnergyHasThatOfItsElasticConstants) {
  UserLaw law = law_of("strut_law");
  law.tells_energy = false;
  std::mt19937 random(9);
  Symmetric stress = Symmetric::Zero();
  UserLaw::State state;
  double work = 0;
  for (int n = 0; n < 100; ++n) {
    const PointStep step = random_step(random);
    const Symmetric before = stress;
    stress = law.step(step, stress, state).stress;
    work += step_work(step, old_determinant(step), before, stress);
  }
  EXPECT_NEAR(state.stored + state.dissipated, work, 1e-9 * work);
  EXPECT_GT(state.dissipated, 0.5 * work);
  EXPECT_FALSE(law.has_flowed(state));
}

TEST(UserLibrary, IsTriedAtTheStart) {
  for (const auto& [function, interface] : interfaces) {
    const LibraryTrial trial = tried(law_of(function, interface));
    EXPECT_EQ(trial.problem + trial.warning, "") << function;
    EXPECT_TRUE(trial.tells_energy) << function;
  }
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"prestressed", "gives a stress of 1e+06 Pa in a step of the undeformed state without strain"},
      {"beyond_its_states", "in a step without strain changed a state variable beyond its State Variables"},
      {"far_beyond_its_states", "in a step without strain changed a state variable beyond its State Variables"},
      {"changes_the_strain", "in a step without strain changed a state variable beyond its State Variables"},
      {"changes_constants", "in a step without strain changed its Constants (PROPS)"},
      {"of_the_wrong_sign", "has an elastic stiffness of -1e+09 Pa in some direction"},
      {"not_a_number", "in a step without strain gave a stress, a state variable or an energy that is no number"},
      {"reads_a_fifth_constant",
       "in a step without strain gave a stress, a state variable or an energy that is no number"},
      {"unable", "in a step without strain found no stress (PNEWDT"}};
  for (const auto& [function, words] : wrong) {
    const std::string problem = tried(law_of(function)).problem;
    EXPECT_NE(problem.find(words), std::string::npos) << function << ": " << problem;
  }
  for (const char* const function : {"umat_beyond_its_states", "umat_far_beyond_its_states"}) {
    const std::string beyond = tried(law_of(function, LibraryInterface::umat)).problem;
    EXPECT_NE(beyond.find("changed a state variable beyond its State Variables"), std::string::npos) << beyond;
  }
  const std::string warning = tried(law_of("in_megapascals")).warning;
  EXPECT_NE(warning.find("is softer, 1e+05 Pa, than its elastic constants say"), std::string::npos) << warning;
}

// Viscous stress is that of a modulus of viscosity/dt: it counts by the step that a run takes.
TEST(UserLibrary, IsTheStifferByViscosityTheShorterTheStep) {
  UserLaw law = law_of("viscous");
  law.constants[2] = 100 * shear;  // a time of 100 s
  EXPECT_EQ(tried(law).problem + tried(law).warning, "");
  EXPECT_EQ(too_stiff_in(law, 600), "");
  EXPECT_NE(too_stiff_in(law, 100).find("(K + 4/3 G), in a step of 100 s"), std::string::npos)
      << too_stiff_in(law, 100);
  EXPECT_NE(too_stiff_in(law, 1).find("(the larger of 3 K and 2 G), in a step of 1 s"), std::string::npos);
  EXPECT_EQ(too_stiff_in(law_of("strut_law"), 1e-9), "");
  EXPECT_NE(too_stiff_in(law_of("far_too_stiff"), 1e3).find("is stiffer, 1e+15 Pa, than its elastic constants say"),
            std::string::npos);
}

TEST(UserLibrary, ThatIsNoneIsAnError) {
  EXPECT_THROW(loaded("/no/such/library.so", "strut_law", LibraryInterface::strut), Error);
  EXPECT_THROW(loaded(STRUT_USER_J2, "no_such_function", LibraryInterface::strut), Error);
}

// A law must find its constants in each call, and no other state than its own is changed.
TEST(UserLibrary, SpoilsNothingBesidesItsOwn) {
  for (const char* const function : {"changes_constants", "changes_the_strain", "far_beyond_its_states"}) {
    const UserLaw law = law_of(function);
    UserLaw::State state;
    EXPECT_FALSE(
        law.step(PointStep{Symmetric::Zero(), 1e-7, 1, Symmetric::Zero()}, Symmetric::Zero(), state).converged);
    EXPECT_EQ(law.constants[0], bulk) << function;
    EXPECT_EQ(state.strain[0], 0) << function;
  }
}

// The file of the test's library with other bytes, or cut off.
std::string damaged(const std::string& name, std::size_t size, std::size_t place = 0, const std::string& bytes = "") {
  std::ifstream good(STRUT_USER_J2, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(good), {}};
  content.replace(place, bytes.size(), bytes);
  const std::string file = ::testing::TempDir() + name;
  std::ofstream(file, std::ios::binary) << content.substr(0, size);
  return file;
}

TEST(UserLibrary, OfAnotherProcessorIsToldAsThat) {
  const std::string file = damaged("other.so", std::string::npos, 18, "\x15");  // 64-bit PowerPC
  try {
    loaded(file, "strut_law", LibraryInterface::strut);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("is compiled for another processor (machine 21 of ELF"), 0u)
        << error.what();
  }
}

TEST(UserLibraryDeathTest, DamagedLibraryIsToldAsTheFault) {
  EXPECT_DEATH(loaded(damaged("cut.so", 4000), "strut_law", LibraryInterface::strut), "cut.so of a User .* crashed");
}

TEST(UserLibraryDeathTest, FaultIsToldAsItsOwnWithThePoint) {
  const auto call = [](const std::string& function) {
    const double place[3] = {1e-3, 2e-3, -0.5};
    PointsOfCall<UserLaw> here;
    here.add(place);
    UserLaw::State state;
    law_of(function).step(PointStep{Symmetric::Zero(), 1e-7, 1, Symmetric::Zero()}, Symmetric::Zero(), state);
  };
  const std::string point = " at the point with the reference position .0.001, 0.002, -0.5. m: a fault of that library";
  EXPECT_DEATH(call("crashes"), "user_j2.* crashed" + point);
  // STOP of Fortran ends a program with the status 0.
  EXPECT_EXIT(call("stops"), ::testing::ExitedWithCode(1), "user_j2.* ended the program.*" + point);
}

}  // namespace
}  // namespace strut::testing
