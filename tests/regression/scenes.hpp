// Small scenes that together have every formulation, contact, damage, tools, heat, viscosity, substeps and equilibria,
// for properties that must hold in every run.
#pragma once

#include <string>
#include <vector>

#include "regression/bodies.hpp"

namespace strut::regression {

struct AnyScene {
  std::string name;
  Parts parts;  // of points.txt, which points_of_scenes() has
  std::string damage = "";
  bool is_static = false;

  std::string text(const std::string& more = "") const {
    std::string deck = changed(parts.text(), "<ParameterList>\n",
                               "<ParameterList>\n" + (damage.empty() ? "" : section("Damage Models", damage)) + more);
    return is_static ? changed(deck, R"(name="Verlet")", R"(name="QuasiStatic")") : deck;
  }
};

inline void PrintTo(const AnyScene& scene, std::ostream* stream) { *stream << scene.name; }

// A block on another with four stiff points on one side, which are subcycled. Spacing 1 mm.
inline std::string points_of_scenes() {
  return cubes(1, {0, 0, 0}, 4, 4, 3, 1e-3) + cubes(2, {0.5e-3, 0.5e-3, 3.02e-3}, 3, 3, 3, 1e-3) +
         cubes(3, {4e-3, 1e-3, 0}, 1, 2, 2, 1e-3);
}

inline std::string metal(const std::string& name, const std::string& model, const std::string& modulus,
                         const std::string& more = "") {
  return section(name, key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", modulus) +
                           key("Poisson's Ratio", "0.3") + more);
}

inline std::string scene_block(const std::string& name, const std::string& number, const std::string& material,
                               const std::string& more = "") {
  return section(name,
                 key("Block Names", "block_" + number) + key("Material", material) + key("Horizon", "2.01e-3") + more);
}

// Block 2 flies onto block 1 and along it; a heavy plane follows. `lower`, `upper`: further keys of the materials;
// `damage`: of the blocks.
inline Parts impact_of_scenes(const std::string& lower_model, const std::string& lower, const std::string& upper_model,
                              const std::string& upper, const std::string& damage, const std::string& contact) {
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.materials = metal("soft", lower_model, "110e9", lower) + metal("hard", upper_model, "200e9", upper) +
                    metal("stiff", lower_model == "Elastic" ? lower_model : "Elastic Correspondence", "4000e9");
  parts.blocks = scene_block("lower", "1", "soft", damage) +
                 scene_block("upper", "2", "hard", key("Separate Body", "true")) + scene_block("side", "3", "stiff");
  parts.contact = section("Models", section("m", contact + key("Friction Coefficient", "0.3"))) +
                  section("Interactions", section("General Contact", key("Contact Model", "m")));
  parts.conditions = along("down", "Initial Velocity", "block_2", "z", "-150") +
                     along("along", "Initial Velocity", "block_2", "x", "90") +
                     section("wall", key("Type", "Rigid Plane") + key("Node Set", "all") + key("Point", "0 0 0") +
                                         key("Normal", "0 0 1")) +  // with friction block 3 would have no substeps
                     section("punch", key("Type", "Rigid Plane") + key("Node Set", "all") + key("Point", "0 0 6.1e-3") +
                                          key("Normal", "0 0 -1") + key("Friction Coefficient", "0.2") +
                                          key("Mass", "1e-3") + key("Speed Z", "-160"));
  parts.times = key("Final Time", "4e-6");
  return parts;
}

inline std::vector<AnyScene> all_scenes() {
  const std::string surface = key("Contact Model", "Surface");
  const std::string of_points =
      key("Contact Model", "Short Range Force") + key("Contact Radius", "1.1e-3") + key("Spring Constant", "1e12");
  const std::string flow =
      key("Yield Stress", "50e6") +
      section("Hardening", key("Type", "Power Law") + key("Reference Strain", "0.00218") + key("Exponent", "0.1"));
  const std::string heating = section("Heating", key("Specific Heat", "383"));
  const std::string viscosity = key("Linear Viscosity", "0.06") + key("Quadratic Viscosity", "1.2");
  const std::string plastic = "Elastic Plastic Correspondence", elastic = "Elastic";
  const std::string broken = key("Damage Model", "break");
  const auto model = [](const std::string& name, const std::string& keys) {
    return section("break", key("Damage Model", name) + keys);
  };
  Parts press = impact_of_scenes(plastic, flow, plastic, flow, "", surface);
  press.conditions =
      along("foot", "Prescribed Displacement", "foot", "xyz", "0") +
      along("drag", "Prescribed Displacement", "head", "x", "(t &gt; 0.4)*(t - 0.4)*2e-4") +
      along("side", "Prescribed Displacement", "head", "y", "0") +
      section("plate", key("Type", "Rigid Plane") + key("Node Set", "block_2") + key("Point", "0 0 6.02e-3") +
                           key("Normal", "0 0 -1") + key("Friction Coefficient", "0.2") + key("Travel Z", "-1e-4*t"));
  press.node_sets = key("foot", "z &lt; 1e-3") + key("head", "z &gt; 5.1e-3");
  press.times = key("Final Time", "1");
  press.verlet = key("Number of Load Steps", "5") + key("Tolerance", "1e-6");
  Parts cracking = impact_of_scenes("Elastic Correspondence", "", elastic, "", broken, surface);
  cracking.blocks = changed(cracking.blocks, "2.01e-3", "1.75e-3");  // of the block that cracks
  Parts heavier = impact_of_scenes(plastic, flow, elastic, "", "", surface);
  heavier.verlet += key("Mass Scaling dt", "60e-9") + key("Most Added Mass", "10");
  return {{"Correspondence", impact_of_scenes(plastic, flow + viscosity, elastic, "", "", surface)},
          {"Points", impact_of_scenes(plastic, flow + viscosity, "Elastic Correspondence", "", "", of_points)},
          {"Quadratic", impact_of_scenes(plastic, flow + viscosity + key("Formulation", "Quadratic Correspondence"),
                                         elastic, "", "", surface)},
          {"Stretch", impact_of_scenes(plastic, flow, elastic, "", broken, of_points),
           model("Critical Stretch", key("Critical Stretch", "0.01"))},
          {"Energy", impact_of_scenes(elastic, "", elastic, "", broken, surface),
           model("Bond Energy", key("Fracture Energy", "200"))},
          {"Cohesive",
           impact_of_scenes("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"), elastic, "",
                            broken, surface),
           model("Cohesive Crack", key("Fracture Energy", "0.5"))},
          {"CohesivePoints", cracking, model("Cohesive Crack", key("Fracture Energy", "0.5"))},
          {"Failure",
           impact_of_scenes(plastic, flow + heating + key("Stabilization", "Silling"), elastic, "", broken, surface),
           model("Plastic Strain", key("Failure Strain", "0.02") + key("Fracture Energy", "10e3"))},
          {"Heavier", heavier},
          {"Equilibria", press, "", true}};
}

}  // namespace strut::regression
