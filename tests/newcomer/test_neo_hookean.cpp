// The neo-Hookean law against its closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/laws.hpp"
#include "point_driver.hpp"

namespace strut::testing {
namespace {

using materials::NeoHookean;

// A rubber: K 10 MPa, μ 1 MPa.
constexpr NeoHookean rubber{10e6, 1e6};
const double lame = rubber.lame();  // Pa

// A stretch is the exponential of a strain: some ten roundings of numbers near 1, times a modulus.
const double round_off = 1e-14 * rubber.moduli().longitudinal();  // Pa

// Stretches from a third to three, s on x alone.
TEST(NeoHookean, UniaxialStrain) {
  for (const double strain : {-1.1, -0.1, 0.1, 1.1}) {
    point::Driver<NeoHookean> point(rubber);
    ASSERT_TRUE(point.advance_uniaxial_strain(strain, 1e-3));
    const double s = std::exp(strain);
    EXPECT_NEAR(point.stress[0], rubber.shear * (s - 1 / s) + lame * strain / s, 10 * round_off / s);
    EXPECT_NEAR(point.stress[1], lame * strain / s, 10 * round_off / s);
    EXPECT_NEAR(s * point.state.stored_energy,
                0.5 * rubber.shear * (s * s - 1 - 2 * strain) + 0.5 * lame * strain * strain, 10 * round_off * s);
  }
}

// The shear γ of the logarithmic strain: B has cosh 2γ and sinh 2γ.
TEST(NeoHookean, Shear) {
  constexpr double strain = 0.7;
  point::Driver<NeoHookean> point(rubber);
  ASSERT_TRUE(point.advance_strain(Symmetric{0, 0, 0, strain, 0, 0}, 1e-3));
  EXPECT_NEAR(point.stress[3], rubber.shear * std::sinh(2 * strain), 10 * round_off);
  EXPECT_NEAR(point.stress[0], rubber.shear * (std::cosh(2 * strain) - 1), 10 * round_off);
  EXPECT_NEAR(point.stress[2], 0, 10 * round_off);
}

// J σ = ∂W/∂ε along x; central differences with h = 1e-4 are good for some h² of the stress.
TEST(NeoHookean, TheStressIsTheDerivativeOfTheEnergy) {
  constexpr double h = 1e-4;
  const auto energy = [](double strain) {
    point::Driver<NeoHookean> point(rubber);
    EXPECT_TRUE(point.advance_strain(Symmetric{strain, 0.1, -0.2, 0, 0, 0}, 1e-3));
    return std::exp(strain - 0.1) * point.state.stored_energy;
  };
  for (const double strain : {-0.8, 0.3, 0.9}) {
    point::Driver<NeoHookean> point(rubber);
    ASSERT_TRUE(point.advance_strain(Symmetric{strain, 0.1, -0.2, 0, 0, 0}, 1e-3));
    const double kirchhoff = std::exp(strain - 0.1) * point.stress[0];
    EXPECT_NEAR((energy(strain + h) - energy(strain - h)) / (2 * h), kirchhoff, 10 * h * h * std::abs(kirchhoff));
  }
}

// In uniaxial strain the stiffness is that of the moduli and the stress, d σ/d ln s = λ' + 2μ' + σ, where the moduli
// are not held at those of no strain.
TEST(NeoHookean, ItsModuliGrowInCompression) {
  constexpr double h = 1e-4, strain = -0.6;
  const auto at = [](double there) {
    point::Driver<NeoHookean> point(rubber);
    EXPECT_TRUE(point.advance_uniaxial_strain(there, 1e-3));
    return point;
  };
  const double slope = (at(strain + h).stress[0] - at(strain - h).stress[0]) / (2 * h);
  const auto here = at(strain);
  EXPECT_NEAR(rubber.moduli(here.state).longitudinal() + here.stress[0], slope, 10 * h * h * slope);
}

}  // namespace
}  // namespace strut::testing
