#include "deck/sections/materials.hpp"

#include "base/errors.hpp"
#include "deck/laws/constants.hpp"
#include "deck/laws/laws.hpp"
#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Materials";

// A key of every law by correspondence.
const ChoiceKey<Formulation> formulation(
    {.name = "Formulation",
     .fallback = "Correspondence",
     .meaning = "Deformation gradient: constant at a point (Silling et al. 2007), or linear over the cell of the "
                "point, for struts and plates a few points thick: without stabilization, with the neighbors that share "
                "a node (or element)."},
    {{"Correspondence", Formulation::correspondence}, {"Quadratic Correspondence", Formulation::quadratic}});

std::vector<std::pair<std::string, Stabilization>> stabilizations() {
  std::vector<std::pair<std::string, Stabilization>> all;
  for_each_stabilization([&all]<class S>(const S& one) { all.emplace_back(S::name, one); });
  return all;
}

const ChoiceKey<Stabilization> stabilization(
    {.name = "Stabilization",
     .fallback = "Mean Gradient",
     .meaning = "Resists zero-energy modes: a spring in each bond on the part of its deformation that the mean "
                "deformation gradient of both ends (Silling: of each end) does not represent."},
    stabilizations());

const OptionalKey<double> stabilization_coefficient(
    {.name = "Stabilization Coefficient",
     .range = not_negative,
     .meaning =
         "Stiffness of the springs in units of (λ + 2μ)/(tr K/3), K the shape tensor. Default 0.01; 0.3 in "
         "blocks whose bonds break by stretch; in foams that compact, at nodes, 20 plateaus/(λ + 2μ), 0.01 to 1, in "
         "elastomers 4 μ/(λ + 2μ), 0.01 to 0.3, Silling a quarter."});

const RealKey linear_viscosity(
    {.name = "Linear Viscosity",
     .range = not_negative,
     .fallback = "0",
     .meaning = "b₁ of the artificial viscosity, which spreads shocks over some points (docs/theory.md). Usual: "
                "0.06."});

const RealKey quadratic_viscosity(
    {.name = "Quadratic Viscosity", .range = not_negative, .fallback = "0", .meaning = "b₂. Usual: 1.2."});

const RealKey thermal_expansion(
    {.name = "Thermal Expansion Coefficient",
     .unit = "1/K",
     .fallback = "0",
     .meaning =
         "α: points of a condition 'Prescribed Temperature' have the thermal strain α (T − T₀), T₀ at the initial "
         "time. Metals that know their own temperature have none."});

void check_needs_no_stabilization(const Values& values, Problems& problems) {
  for (const Key& key : {Key(stabilization), Key(stabilization_coefficient)}) {
    if (!values.given(key) || (values.has(stabilization) && residual_of(values[stabilization]) == ResidualKind::none))
      continue;
    problems.add(
        values.path_to(key),
        "given, but Formulation 'Quadratic Correspondence' has no zero-energy modes and takes none; expected no "
        "such key");
  }
}

void read_correspondence(const Values& values, Material& material, Problems& problems) {
  material.formulation = values[formulation];
  material.stabilization = values[stabilization];
  material.stabilization_coefficient = values[stabilization_coefficient];
  material.linear_viscosity = values[linear_viscosity];
  material.quadratic_viscosity = values[quadratic_viscosity];
  if (residual_of(material.stabilization) == ResidualKind::none && values.given(stabilization_coefficient))
    problems.note(values.path_to(stabilization_coefficient), "has no effect: Stabilization 'None' has no springs");
  if (material.formulation != Formulation::quadratic) return;
  material.stabilization = NoStabilization();
  check_needs_no_stabilization(values, problems);
}

std::vector<Section> cases() {
  std::vector<Section> all = schemas_of(laws());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (laws()[i].expands) all[i].keys.push_back(thermal_expansion);
    if (!laws()[i].by_correspondence) continue;
    all[i].keys.insert(all[i].keys.end(),
                       {formulation, stabilization, stabilization_coefficient, linear_viscosity, quadratic_viscosity});
  }
  return all;
}

Key model() {
  return {.name = "Material Model",
          .meaning = "Constitutive law.",
          .hints = {{"Elastic Plastic", "did you mean 'Elastic Plastic Correspondence'?"}}};
}

void read_expansion(const Values& values, Material& material, Problems& problems) {
  material.thermal_expansion = values[thermal_expansion];
  const bool knows_temperature = std::visit([]<class L>(const L&) { return materials::tells_heat<L>; }, material.law);
  if (material.thermal_expansion == 0 || !knows_temperature) return;
  problems.add(values.path_to(thermal_expansion),
               "given, but this metal's temperature follows from its flow, by which it does not expand; expected none, "
               "or no Softening, other Flow Stress, Heating, Equation of State and Shear Modulus Slope");
}

Material read_material(const Values& values, Problems& problems) {
  Material material{.name = values.name(), .density = read_density(values)};
  const LawEntry* law = chosen_of(laws(), values);
  if (!law) return material;
  material.formulation = Formulation::ordinary;
  if (law->by_correspondence) read_correspondence(values, material, problems);
  material.law = law->make(values, problems);
  if (law->expands) read_expansion(values, material, problems);
  return material;
}

}  // namespace

Section materials_section() {
  return {
      .name = name,
      .required = true,
      .meaning = "The materials that blocks refer to.",
      .sections = {with_cases(
          {.name = any_name,
           .required = true,
           .meaning = "One material.",
           .keys = constants_keys(),
           .hints = {{"Thermal Expansion Coefficient",
                      "unknown key; 'Elastic', 'Elastic Correspondence' and 'Elastic Plastic Correspondence' expand by "
                      "heat, other laws do not"},
                     {"Hourglass Coefficient",
                      "unknown key; 'Stabilization Coefficient' is its counterpart, but another quantity: in units of "
                      "(λ + 2μ)/(tr K/3), and about twice the Hourglass Coefficient for the same effect"},
                     {"Strain Hardening Exponent", "unknown key; write it as Hardening > Exponent (Type 'Power Law')"},
                     {"Reference Strain 0", "unknown key; write it as Hardening > Reference Strain (Type 'Power Law')"},
                     {"Rate Hardening Exponent", "unknown key; write it as Rate > Exponent (Type 'Power Law')"},
                     {"Reference Strain Rate", "unknown key; write it as Rate > Reference Rate (Type 'Power Law')"}}},
          model(), cases())}};
}

std::vector<Material> read_materials(const Values& deck, Problems& problems) {
  std::vector<Material> all;
  for (const Values& section : deck.section(name).sections()) all.push_back(read_material(section, problems));
  return all;
}

namespace {

using materials::UserLaw;

void load(const Material& material, UserLaw& law, const std::filesystem::path& folder, Problems& problems) {
  const std::filesystem::path file = std::filesystem::absolute(folder / law.function.file);
  const std::string where = "Materials > " + material.name + " > Library";
  const auto wrong = [&](const std::string& what) { problems.add(where, "'" + file.string() + "' " + what); };
  if (!std::filesystem::exists(file)) return wrong("does not exist");
  try {
    law.function = materials::loaded(file.string(), law.function.name, law.function.interface);
  } catch (const Error& error) {
    return wrong(error.what());
  }
  const materials::LibraryTrial trial = materials::tried(law);
  law.tells_energy = trial.tells_energy;
  if (!trial.problem.empty()) return wrong(trial.problem);
  if (!trial.warning.empty()) problems.note(where, "'" + file.string() + "' " + trial.warning);
}

}  // namespace

void load_user_libraries(std::vector<Material>& materials, const std::filesystem::path& folder, Problems& problems) {
  for (Material& material : materials) {
    if (auto* law = std::get_if<UserLaw>(&material.law)) load(material, *law, folder, problems);
  }
}

}  // namespace strut::deck
