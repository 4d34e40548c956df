#include "deck/laws/laws.hpp"

#include "deck/laws/constants.hpp"

namespace strut::deck {

namespace {

Section elastic_ordinary() {
  return {.name = "Elastic",
          .meaning =
              "Ordinary state-based linear elastic solid (Silling et al. 2007), as Peridigm's `Elastic`, without "
              "stabilization. On a lattice its shear moduli depend on direction (table in docs/theory.md, Ordinary "
              "solid)."};
}

Section elastic() { return {.name = "Elastic Correspondence", .meaning = "Isotropic and elastic (hypoelastic)."}; }

materials::AnyLaw make_elastic(const Values& material, Problems& problems) {
  const materials::Moduli moduli = checked_moduli(material, problems);
  return materials::Elastic{.bulk = moduli.bulk, .shear = moduli.shear};
}

}  // namespace

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> entries = {
      {elastic_ordinary(), make_elastic, false, true}, {elastic(), make_elastic, true, true},
      {metal_section(), make_metal, true, true},       {metal_foam_section(), make_metal_foam},
      {polymer_foam_section(), make_polymer_foam},     {hyperelastic_section(), make_hyperelastic},
      {user_library_section(), make_user_library},
  };
  return entries;
}

}  // namespace strut::deck
