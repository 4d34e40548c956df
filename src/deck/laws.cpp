#include "deck/laws.hpp"

#include <array>

#include "base/errors.hpp"

namespace strut::deck {

namespace {

const std::array<std::string, 4> elastic_keys = {"Bulk Modulus", "Shear Modulus", "Young's Modulus", "Poisson's Ratio"};

}  // namespace

materials::Moduli moduli_from(double E, double nu) { return {E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))}; }

namespace {

// From any two of the four constants.
materials::Moduli moduli(const Values& material) {
  const auto& [bulk, shear, young, poisson] = elastic_keys;
  const double K = material.real(bulk), G = material.real(shear);
  const double E = material.real(young), nu = material.real(poisson);
  if (!material.has(young) && !material.has(poisson)) return {K, G};
  if (!material.has(bulk) && !material.has(shear)) return moduli_from(E, nu);
  if (!material.has(shear) && !material.has(poisson)) return {K, 3 * K * E / (9 * K - E)};
  if (!material.has(shear)) return {K, 3 * K * (1 - 2 * nu) / (2 * (1 + nu))};
  if (!material.has(poisson)) return {G * E / (3 * (3 * G - E)), G};
  return {2 * G * (1 + nu) / (3 * (1 - 2 * nu)), G};
}

materials::Moduli checked_moduli(const Values& material, Problems& problems) {
  std::vector<std::string> given;
  for (const std::string& key : elastic_keys) {
    if (material.given(key)) given.push_back(key);
  }
  if (given.size() != 2) {
    problems.add(material.path(), "elastic constants given: " + (given.empty() ? "none" : joined(given)) +
                                      "; expected exactly two of " +
                                      joined({elastic_keys.begin(), elastic_keys.end()}));
    return {};
  }
  if (!material.has(given[0]) || !material.has(given[1])) return {};  // already among the problems
  const materials::Moduli result = moduli(material);
  if (!(result.bulk > 0 && result.shear > 0)) {
    problems.add(material.path(), joined(given, " and ") +
                                      " contradict each other; expected such that bulk and shear "
                                      "modulus are > 0 (0 < E < 3 G, 0 < E < 9 K)");
  }
  return result;
}

materials::AnyLaw make_elastic(const Values& material, Problems& problems) {
  const materials::Moduli moduli = checked_moduli(material, problems);
  return materials::Elastic{.bulk = moduli.bulk, .shear = moduli.shear};
}

materials::AnyLaw make_j2(const Values& material, Problems& problems) {
  const materials::Moduli moduli = checked_moduli(material, problems);
  return materials::J2{.bulk = moduli.bulk, .shear = moduli.shear, .flow = make_flow_stress(material, problems)};
}

materials::AnyLaw make_foam(const Values& material, Problems& problems) {
  return make_metal_foam(material, checked_moduli(material, problems), problems);
}

materials::AnyLaw make_polymer(const Values& material, Problems& problems) {
  return make_polymer_foam(material, checked_moduli(material, problems), problems);
}

// Of every law by correspondence.
Section with_common_keys(Section law) {
  law.keys.push_back({.name = "Formulation",
                      .kind = Kind::choice,
                      .choices = {"Correspondence", "Quadratic Correspondence"},
                      .fallback = "Correspondence",
                      .meaning =
                          "How the deformation gradient is found: one for each point (Silling et al. 2007), or one "
                          "that is linear over the cell of each point, with the stress at four places of it. The "
                          "second is for struts and plates a few points thick; it has no zero-energy modes and "
                          "no stabilization. Its families are those of the mesh: elements that share a node, nodes "
                          "that share an element."});
  law.keys.push_back({.name = "Stabilization",
                      .kind = Kind::choice,
                      .choices = {"Mean Gradient", "Silling", "None"},
                      .fallback = "Mean Gradient",
                      .meaning =
                          "What holds zero-energy modes down: a spring in each bond on what the mean deformation "
                          "gradient of both ends, or (Silling) each end's own, does not see of it."});
  law.keys.push_back({.name = "Stabilization Coefficient",
                      .range = not_negative,
                      .fallback = "0.01",
                      .meaning = "Its strength in units of (λ + 2μ)/(tr K/3), with the shape tensor K: the same for "
                                 "every influence function and horizon. Not Peridigm's Hourglass Coefficient."});
  law.keys.push_back({.name = "Linear Viscosity",
                      .range = not_negative,
                      .fallback = "0",
                      .meaning =
                          "b₁ of the artificial viscosity, which spreads shocks over some points: where the volume "
                          "shrinks at the rate D, a pressure ρ l |D| (b₁ c + b₂² l |D|). 0.06 is usual."});
  law.keys.push_back(
      {.name = "Quadratic Viscosity", .range = not_negative, .fallback = "0", .meaning = "b₂. 1.2 is usual."});
  return law;
}

Section elastic_ordinary() {
  return {.name = "Elastic",
          .meaning =
              "The ordinary state-based linear elastic solid (Silling et al. 2007), as Peridigm's `Elastic`: "
              "forces along the bonds, no deformation gradient, no stabilization, for bodies that stay elastic. "
              "On a lattice its shear moduli depend on direction, more or less with Influence Function and "
              "Horizon (table in src/mechanics/README.md). No further keys."};
}

Section elastic() {
  return with_common_keys({.name = "Elastic Correspondence", .meaning = "Isotropic and elastic (hypoelastic)."});
}

Section elastic_plastic() {
  Section section = with_common_keys(flow_stress_section());
  section.name = "Elastic Plastic Correspondence";
  section.meaning = "J2 plasticity: hypoelastic, with the flow stress that Yield Stress, Hardening and Rate define.";
  return section;
}

}  // namespace

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> entries = {
      {elastic_ordinary(), Formulation::ordinary, make_elastic},
      {elastic(), Formulation::correspondence, make_elastic},
      {elastic_plastic(), Formulation::correspondence, make_j2},
      {with_common_keys(metal_foam_section()), Formulation::correspondence, make_foam},
      {with_common_keys(polymer_foam_section()), Formulation::correspondence, make_polymer},
  };
  return entries;
}

Section material_section() {
  const std::string two = " Exactly two of the four elastic constants.";
  return {
      .name = any_name,
      .required = true,
      .meaning = "One material.",
      .keys =
          {{.name = "Density", .unit = "kg/m³", .range = positive, .required = true, .meaning = "Reference density."},
           {.name = "Bulk Modulus", .unit = "Pa", .range = positive, .meaning = "K." + two},
           {.name = "Shear Modulus", .unit = "Pa", .range = positive, .meaning = "G." + two},
           {.name = "Young's Modulus", .unit = "Pa", .range = positive, .meaning = "E." + two},
           {.name = "Poisson's Ratio", .range = {-1, 0.5, false, false}, .meaning = "ν." + two}},
      .hints = {{"Hourglass Coefficient",
                 "unknown key; 'Stabilization Coefficient' is its counterpart, but another quantity: in units of "
                 "(λ + 2μ)/(tr K/3), and about twice the Hourglass Coefficient for the same effect"},
                {"Strain Hardening Exponent", "unknown key; write it as Hardening > Exponent (Type 'Power Law')"},
                {"Reference Strain 0", "unknown key; write it as Hardening > Reference Strain (Type 'Power Law')"},
                {"Rate Hardening Exponent", "unknown key; write it as Rate > Exponent (Type 'Power Law')"},
                {"Reference Strain Rate", "unknown key; write it as Rate > Reference Rate (Type 'Power Law')"}}};
}

}  // namespace strut::deck
