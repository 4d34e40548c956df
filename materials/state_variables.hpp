// Units and meanings of the laws' state variables: equal names have the same meaning in all laws.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace strut::materials {

struct StateVariable {
  std::string_view name, unit, meaning;
  bool never_zero = false;  // a point whose law lacks it does not count in extremes and means; others have 0 there
};

inline constexpr std::array<StateVariable, 23> state_variables{{
    {"Brittle_Damage", "1", "d: fraction of its stiffness in tension that a cracking point has lost"},
    {"Crack_Work", "J/m³", "dissipation of a cracking point per reference volume, a part of Fracture_Energy"},
    {"Dissipated_Energy_Density", "J/m³", "dissipation so far per reference volume, of elastomers and user libraries"},
    {"Ductile_Damage", "1", "d: fraction of its stress that a softening point has lost"},
    {"Elastic_Energy_Density", "J/m³", "stored elastic energy per reference volume"},
    {"Equivalent_Plastic_Strain", "1",
     "ε̄_p = ∫ √(2/3 ė_p:ė_p) dt; foams: the equivalent strain of their law, as in uniaxial compression"},
    {"Equivalent_Plastic_Strain_Rate", "1/s", "rate of ε̄_p in the last step"},
    {"Failed", "1", "1 from the step on in which a point of metal foam fails, else 0"},
    {"Failure_Indicator", "1", "D of the failure criterion; softening begins at 1"},
    {"Internal_Energy_Density", "J/m³", "e of the equation of state per reference volume"},
    {"Mechanical_Threshold", "Pa", "σ̂, the flow stress at 0 K"},
    {"Plastic_Compaction", "1", "ε_v of polymeric foam, positive where compacted"},
    {"Plastic_Strain_XX", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Strain_YY", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Strain_ZZ", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Strain_XY", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Strain_YZ", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Strain_ZX", "1", "component of ½ (I − C_p⁻¹) in the reference frame"},
    {"Plastic_Work_Density", "J/m³", "plastic work per reference volume; at failed points with their elastic energy"},
    {"Relative_Density", "1", "ρ* of polymeric foam: density over that of the solid", true},
    {"Relative_Volume", "1", "v = V/V₀ of the equation of state", true},
    {"Temperature", "K", "temperature of the metal", true},
    {"Volumetric_Plastic_Strain", "1", "∫ tr ε̇_p dt of metal foam, negative where compacted"},
}};

// The entry with this name; laws added by users may have none.
constexpr StateVariable state_variable(std::string_view name) {
  const auto* found = std::find_if(state_variables.begin(), state_variables.end(),
                                   [name](const StateVariable& variable) { return variable.name == name; });
  if (found != state_variables.end()) return *found;
  if (name.starts_with("User_State_")) return {name, "any", "the state variable of this number of a user's library"};
  return {name, "1", "state of its material law"};
}

}  // namespace strut::materials
