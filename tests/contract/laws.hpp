// The table of laws that every contract test loops over. A new law is one line in table_of_laws(), and one below
// "Exceptions" for each property in which it differs from a metal.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "materials/laws.hpp"
#include "polyurethane.hpp"

namespace strut::testing {

// ---- Exceptions -----------------------------------------------------------------------------------------------------

// True for a law of the second form, which takes the stretch, or with a pressure by the volume. Its test paths contain
// J and the stretch, with logarithmic strains up to about 1: no body deforms more.
template <class L>
inline constexpr bool from_stretch = false;
template <>
inline constexpr bool from_stretch<materials::PolymerFoam> = true;
template <>
inline constexpr bool from_stretch<materials::ShockJ2> = true;
template <>
inline constexpr bool from_stretch<materials::Hyperelastic> = true;

// True for Hooke's law of the logarithmic strain, with flow, if any, that keeps the volume: tests check its closed
// forms and the balance of work at J = 1. Other laws have closed forms in files of their own.
template <class L>
inline constexpr bool like_a_metal = true;
template <>
inline constexpr bool like_a_metal<materials::DeshpandeFleck> = false;
template <>
inline constexpr bool like_a_metal<materials::PolymerFoam> = false;
template <>
inline constexpr bool like_a_metal<materials::ShockJ2> = false;
template <>
inline constexpr bool like_a_metal<materials::Hyperelastic> = false;

// Largest relative deviation of stress and energy below yield from Hooke's law at a strain of 1e-4; 0: by round-off
// only. A law that is curved from the start deviates by a few times the strain.
template <class L>
inline constexpr double departs_from_hooke = 0;
template <>
inline constexpr double departs_from_hooke<materials::ShockJ2> = 5e-4;  // (n + 1)/2 strains of 2e-4, n 4
template <>
inline constexpr double departs_from_hooke<materials::Hyperelastic> = 5e-4;  // J of W = ½ K (J − 1)², twice the strain

// The part of its energy that a step of 1e-8 s below yield may dissipate: none, unless the law relaxes.
template <class L>
inline constexpr double relaxes_by = 0;
template <>
inline constexpr double relaxes_by<materials::Hyperelastic> = 1e-5;  // 1e-8 s of a time of 1e-3 s

// ---- The table ------------------------------------------------------------------------------------------------------

struct NamedLaw {
  std::string name;  // letters, digits and _: part of the name of a test
  materials::AnyLaw law;
};
inline void PrintTo(const NamedLaw& law, std::ostream* out) { *out << law.name; }

// Copper: E 110 GPa, ν 0.296, σ_y 50 MPa, ε̄₀ 0.00218, ε̄̇₀ 1e-3 /s (Postek, Nowak & Pęcherski 2021); the other curves
// have values typical of copper.
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
      {"needleman", NeedlemanHardening{0.00218, 0.1, 0.436}},
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
      {"needleman", NeedlemanRate{1e-3, 0.01}},
  };
  return table;
}

// Copper with temperature; its heat capacity is a hundred times the real one, so that no path of a test melts it.
inline materials::ThermalJ2 hot_metal(materials::ThermalFlow flow) {
  return {.bulk = bulk, .shear = shear, .flow = std::move(flow), .heating = {3.4e8, 0.9, 293}};
}

inline std::vector<std::pair<std::string, materials::ThermalFlow>> thermal_flows() {
  using namespace materials;
  const FlowStress johnson_cook{90e6, LudwikHardening{292e6, 0.31}, JohnsonCookRate{1, 0.025}};
  // Follansbee & Kocks's copper, as MPM codes have it.
  const MechanicalThreshold threshold{.athermal = 40e6,
                                      .initial = 0,
                                      .shear = 47.7e9,
                                      .shear_fall = 3e9,
                                      .shear_temperature = 180,
                                      .boltzmann = 0.823e6,
                                      .energy = 1.6,
                                      .rate = 1e7,
                                      .p = 2.0 / 3,
                                      .q = 1,
                                      .slopes = {2390e6, 12e6, 1.696e6},
                                      .curvature = 2,
                                      .saturation = 770e6,
                                      .saturation_energy = 0.2625,
                                      .saturation_rate = 1e7};
  return {{"softened", SoftenedFlow{johnson_cook, JohnsonCookSoftening{294, 1356, 1.09}}},
          {"zerilli_fcc", ZerilliArmstrong{65e6, {0, 1}, {890e6, 0.5}, 0.0028, 0.000115}},
          {"zerilli_bcc", ZerilliArmstrong{66e6, {266e6, 0.289}, {1033e6, 0}, 0.00698, 0.000415}},
          {"threshold", threshold}};
}

inline std::vector<NamedLaw> table_of_laws() {
  std::vector<NamedLaw> table;
  table.push_back({"elastic", materials::Elastic{bulk, shear}});
  table.push_back({"brittle", materials::Brittle{{bulk, shear}}});  // cracks: test_brittle.cpp
  for (const auto& [hardening_name, hardening] : hardenings()) {
    for (const auto& [rate_name, rate] : rates()) {
      table.push_back(
          {"j2_" + hardening_name + "_" + rate_name, materials::J2{bulk, shear, {yield_stress, hardening, rate}}});
    }
  }
  // Before failure; after it: test_ductile.cpp.
  const materials::J2 metal{bulk, shear, {yield_stress, materials::VoceHardening{150e6, 8}, materials::NoRate{}}};
  table.push_back(
      {"ductile", materials::Ductile{metal, {materials::JohnsonCookFailure{{1e3, 0, 0, 0}, 1}, 1e3}, 1e-3}});
  for (const auto& [name, flow] : thermal_flows()) table.push_back({"hot_" + name, hot_metal(flow)});
  const materials::ThermalJ2 softening = hot_metal(thermal_flows().front().second);
  const materials::Ductility lasting{materials::JohnsonCookFailure{{1e3, 0, 0, 0, 1}, 1, 294, 1356}, 1e3};
  table.push_back({"hot_ductile", materials::ThermalDuctile{softening, lasting, 1e-3}});
  table.push_back(
      {"shock_mie_gruneisen",
       materials::ShockJ2{softening, materials::MieGruneisen{8930, 3940, 0.8, 2}}});  // of tests' wild paths
  table.push_back({"shock_tait", materials::ShockJ2{softening, materials::Tait{bulk, 4}}});
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
  table.push_back(
      {"hyperelastic_ogden", materials::Hyperelastic{.bulk = bulk, .terms = {{{0.7 * shear, 2}, {-0.3 * shear, -2}}}}});
  table.push_back(
      {"hyperelastic_relaxing",
       materials::Hyperelastic{.bulk = bulk, .terms = {{{2 * shear / 1.3, 1.3}}}, .times = {{{0.3, 1e-3}}}}});
  return table;
}

}  // namespace strut::testing
