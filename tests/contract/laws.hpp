// The table of laws that every contract test loops over. A new law is one line in table_of_laws(), and one below "What
// sets laws apart" for each way in which it is not like a metal.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "materials/laws.hpp"
#include "polyurethane.hpp"

namespace strut::testing {

// ---- What sets laws apart -------------------------------------------------------------------------------------------

// Of the second form, by the stretch: then J and the stretch belong to the path, and logarithmic strains of more than
// about 1 are no path that a body could take.
template <class L>
inline constexpr bool from_stretch = false;
template <>
inline constexpr bool from_stretch<materials::PolymerFoam> = true;

// Hooke's law of the logarithmic strain, and flow, if any, that keeps the volume: the closed forms of that, and the
// balance of work at J = 1, are checked. A law that is not has its own closed forms in a file of its own.
template <class L>
inline constexpr bool like_a_metal = true;
template <>
inline constexpr bool like_a_metal<materials::DeshpandeFleck> = false;
template <>
inline constexpr bool like_a_metal<materials::PolymerFoam> = false;

// How far stress and energy below yield may be from Hooke's law at a strain of 1e-4, as a part of themselves. 0: not
// but by round-off. A law that curves from the start departs by some strains.
template <class L>
inline constexpr double departs_from_hooke = 0;

// ---- The table ------------------------------------------------------------------------------------------------------

struct NamedLaw {
  std::string name;  // letters, digits and _: part of the name of a test
  materials::AnyLaw law;
};
inline void PrintTo(const NamedLaw& law, std::ostream* out) { *out << law.name; }

// Copper: E 110 GPa, ν 0.296, σ_y 50 MPa, ε̄₀ 0.00218, ε̄̇₀ 1e-3 /s (Postek, Nowak & Pęcherski 2021); the other curves
// are of the size that copper's have.
inline constexpr double youngs = 110e9, poisson = 0.296;                                                // Pa, -
inline constexpr double bulk = youngs / (3 * (1 - 2 * poisson)), shear = youngs / (2 * (1 + poisson));  // Pa
inline constexpr double yield_stress = 50e6;                                                            // Pa

inline const std::vector<std::pair<std::string, materials::Hardening>>& hardenings() {
  using namespace materials;
  static const std::vector<std::pair<std::string, Hardening>> table{
      {"perfect", NoHardening{}},
      {"linear", LinearHardening{100e6}},
      {"power", PowerHardening{0.00218, 0.1}},
      {"ludwik", LudwikHardening{292e6, 0.31}},
      {"voce", VoceHardening{150e6, 8}},
      {"table", TableHardening{{0, 0.002, 0.05, 0.3}, {50e6, 70e6, 150e6, 180e6}}},
      {"softening", LinearHardening{-20e6}},
      {"softening_table", TableHardening{{0, 0.01, 0.2, 0.5}, {50e6, 80e6, 60e6, 40e6}}},
  };
  return table;
}

inline const std::vector<std::pair<std::string, materials::Rate>>& rates() {
  using namespace materials;
  static const std::vector<std::pair<std::string, Rate>> table{
      {"no_rate", NoRate{}},
      {"weak_power", PowerRate{1e-3, 0.01}},
      {"strong_power", PowerRate{1e-3, 0.1}},
      {"johnson_cook", JohnsonCookRate{1, 0.025}},
  };
  return table;
}

inline std::vector<NamedLaw> table_of_laws() {
  std::vector<NamedLaw> table;
  table.push_back({"elastic", materials::Elastic{bulk, shear}});
  for (const auto& [hardening_name, hardening] : hardenings()) {
    for (const auto& [rate_name, rate] : rates()) {
      table.push_back(
          {"j2_" + hardening_name + "_" + rate_name, materials::J2{bulk, shear, {yield_stress, hardening, rate}}});
    }
  }
  // Not yet failing; what it does then: test_ductile.cpp.
  const materials::J2 metal{bulk, shear, {yield_stress, materials::VoceHardening{150e6, 8}, materials::NoRate{}}};
  table.push_back(
      {"ductile", materials::Ductile{metal, {materials::JohnsonCookFailure{{1e3, 0, 0, 0}, 1}, 1e3}, 1e-3}});
  for (const double growth : {1.0, 4.0}) {
    for (const double alpha : {0.0, 1.0, 2.1}) {
      materials::DeshpandeFleck foam{.initial = {bulk, shear}, .compacted = {growth * bulk, growth * shear}};
      foam.alpha = alpha, foam.plateau = yield_stress, foam.linear = 20e6, foam.locking = 400e6, foam.exponent = 3.3;
      foam.densification = 1.2;
      const std::string of_alpha = "foam_alpha_" + std::to_string(static_cast<int>(10 * alpha));
      table.push_back({of_alpha + (growth > 1 ? "_growing" : ""), foam});
    }
  }
  for (const double poisson : {0.0, 0.2}) {
    const std::string of_poisson = "polymer_foam_" + std::to_string(static_cast<int>(10 * poisson));
    for (const bool hardens : {false, true}) {
      table.push_back({of_poisson + (hardens ? "_hardening" : ""),
                       hardens ? Polyurethane::hardening(poisson) : Polyurethane::perfect(poisson)});
    }
  }
  return table;
}

}  // namespace strut::testing
