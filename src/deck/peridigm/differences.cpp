// Reports keys of Peridigm's decks that mean something else in this program, and by how much.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

bool has_any(List& list, std::initializer_list<const char*> names) {
  return std::ranges::any_of(names, [&](const char* name) { return find_parameter(list, name); });
}

bool sets_are_parameters(List* conditions) {
  return conditions && std::ranges::any_of(conditions->parameters, [](const Parameter& one) {
           return one.name.find("Node Set") != std::string::npos;
         });
}

class Differences {
 public:
  Differences(List& deck, Problems& problems) : deck_(deck), problems_(problems) {}

  void tell() {
    if (!sections_of(deck_, {"Damage Models"}).empty()) tell_of_damage();
    if (values_of("Horizon").size() > 1 && !are_separate()) tell_of_horizons();
    tell_of_contact();
    tell_of_steps();
    tell_of_laws();
    if (has_loads()) {
      for (const char* field : {"Force", "Force_Density"}) {
        tell_of_field(field, "holds the loads of Body Force, too; Peridigm writes the internal force alone");
      }
    }
  }

 private:
  // The values of a key in the sections of Blocks; "" for a section without it.
  std::set<std::string> values_of(const std::string& key) {
    std::set<std::string> values;
    for (const List& block : sections_of(deck_, {"Blocks"})) values.insert(value_of(block, key));
    return values;
  }

  // True for all but at most one section: then no two of them have bonds.
  bool are_separate() {
    return std::ranges::count_if(sections_of(deck_, {"Blocks"}), [](const List& one) {
             return to_boolean(value_of(one, "Separate Body")) != true;
           }) <= 1;
  }

  bool has_condition(const std::string& type) {
    return std::ranges::any_of(sections_of(deck_, {"Boundary Conditions"}),
                               [&](const List& one) { return value_of(one, "Type") == type; });
  }

  bool has_loads() { return has_condition("Body Force"); }

  void tell_of_damage() {
    tell_of_field("Damage",
                  "weighs each broken bond by the volume of its other end; Peridigm counts bonds: the same where all "
                  "points of a family have one volume, else by at most the ratio of the largest to the smallest");
    tell_of_field("Number_Of_Neighbors", "falls by one for each broken bond; in Peridigm it stays");
    const std::set<std::string> models = values_of("Damage Model");
    if (models.contains("") && models.size() > 1) {
      problems_.note("Blocks",
                     "with a Damage Model have bonds to blocks without one, which break for both of their ends; in "
                     "Peridigm for the end that has the model alone: the other end's half of the force of the bond "
                     "stays, and pulls both");
    }
  }

  void tell_of_horizons() {
    problems_.note("Blocks",
                   "have horizons of their own: points of two of them are neighbors below the mean of both, and feel "
                   "each other's forces; in Peridigm each takes those within its own horizon, which reaches half the "
                   "difference of both farther, or less far. Points are neighbors here up to "
                   "1.0001 horizons");
  }

  // Steps of the motion: where they end, and which of them have frames.
  void tell_of_steps() {
    for (const char* name : {"Solver", "Solver 2"}) {
      List* solver = find_list(deck_, name);
      List* steps = solver ? find_list(*solver, "Verlet") : nullptr;
      if (steps) tell_of_steps(*solver, *steps);
    }
  }

  void tell_of_steps(const List& solver, const List& steps) {
    const auto dt = real_of(steps, "Fixed dt");
    const double duration = real_of(solver, "Final Time").value_or(0) - real_of(solver, "Initial Time").value_or(0);
    if (!dt) {
      problems_.note(solver.name + " > Verlet",
                     "has no Fixed dt: the critical time step is estimated in another way (by the highest frequency), "
                     "0.83 and 1.3 times Peridigm's in its decks Contact_Perforation and Contact_Cubes; frames by the "
                     "number of steps have other times accordingly");
    } else if (*dt > 0 && std::abs(duration / *dt - std::round(duration / *dt)) > 1e-6) {
      problems_.note(solver.name + " > Final Time",
                     "is where the last step ends, which is shorter than Fixed dt; Peridigm takes whole steps only");
    }
    if (has_condition("Prescribed Displacement")) {
      tell_of_field("Velocity",
                    "of points with Prescribed Displacement is that of their motion from the initial time on; in "
                    "Peridigm's frame at the initial time it is 0, and such points keep half a kick of their forces");
    }
  }

  // Both programs integrate rates of deformation.
  void tell_of_laws() {
    for (const List& material : sections_of(deck_, {"Materials"})) {
      const std::string model = value_of(material, "Material Model"), path = "Materials > " + material.name;
      if (!model.ends_with("Correspondence")) continue;
      problems_.note(path,
                     "integrates the rate of deformation at the middle of a step, Peridigm at its end: stresses differ "
                     "by half a step's strain, relative to the strain");
      if (real_of(material, "Thermal Expansion Coefficient").value_or(0) != 0) {
        problems_.note(path_to(path, "Thermal Expansion Coefficient"),
                       "α: a free body is stretched by 1 + α ΔT; in Peridigm by exp(α ΔT), about, as it adds up rates");
      }
      if (model.starts_with("Elastic Plastic")) {
        tell_of_field("Equivalent_Plastic_Strain",
                      "is what the yield condition asks for; Peridigm's is some 10 % lower, the more the larger the "
                      "steps, and so is what it adds to the flow stress by hardening");
      }
    }
  }

  void tell_of_contact() {
    for (const List& model : sections_of(deck_, {"Contact", "Models"})) {
      if (value_of(model, "Contact Model") != "Short Range Force") continue;
      problems_.note("Contact > Models > " + model.name + " > Contact Radius",
                     "is the distance from which points push each other; those of two bodies that start nearer do so "
                     "from that distance on, in Peridigm from the radius on, so that they push at once, as hard as "
                     "here after an approach by the difference of both; those of one body that start nearer than 1/0.9 "
                     "of it push from 0.9 of their first distance on");
      if (real_of(model, "Friction Coefficient").value_or(0) > 0) {
        problems_.note("Contact > Models > " + model.name + " > Friction Coefficient",
                       "acts across the normal of the surface, and no more than stops the sliding; in Peridigm across "
                       "the bond, always the whole");
      }
    }
  }

  void tell_of_field(const std::string& name, const std::string& what) {
    List* output = find_list(deck_, "Output");
    List* variables = output ? find_list(*output, "Output Variables") : nullptr;
    if (variables && find_parameter(*variables, name)) problems_.note("Output > Output Variables > " + name, what);
  }

  List& deck_;
  Problems& problems_;
};

bool has_peridigms_solver(List& deck) {
  const auto is_theirs = [](List& solver) {
    List* slow = find_list(solver, "QuasiStatic");
    return find_list(solver, "NOXQuasiStatic") || find_list(solver, "Implicit") ||
           find_list(solver, "ImplicitDiffusion") || find_parameter(solver, "Peridigm Preconditioner") ||
           (slow && has_any(*slow, {"Absolute Tolerance", "Relative Tolerance", "Belos Linear Solver",
                                    "Disable Heuristics", "Time Steps"}));
  };
  return std::ranges::any_of(deck.lists, [&](List& one) {
    const bool is_our_name = one.name == "Solver" || one.name == "Solver 2";
    return one.name.starts_with("Solver") && (!is_our_name || is_theirs(one));
  });
}

bool has_peridigms_output(List& deck) {
  return std::ranges::any_of(deck.lists, [](List& one) {
    const bool is_output = find_list(one, "Output Variables") && one.name.starts_with("Output");
    return is_output && (one.name != "Output" || has_any(one, {"Output Format", "Parallel Write"}));
  });
}

bool has_peridigms_law(List& deck) {
  return std::ranges::any_of(sections_of(deck, {"Materials"}), [](const List& one) {
    const std::string model = value_of(one, "Material Model");
    return model.starts_with("Viscoplastic") || model.starts_with("Isotropic Hardening");
  });
}

}  // namespace

bool is_peridigms(List& deck) {
  const auto section = [&](const char* name) { return find_list(deck, name); };
  List* mesh = section("Discretization");
  return deck.name == "Peridigm" || has_missing_ability(deck) || has_peridigms_law(deck) ||
         section("Compute Class Parameters") || has_peridigms_output(deck) || has_peridigms_solver(deck) ||
         (mesh && has_any(*mesh, {"Omit Bonds Between Blocks", "Store Exodus Mesh"})) ||
         std::ranges::any_of(sections_of(deck, {"Materials"}), [](List& one) {
           return has_any(one, {"Hourglass Coefficient", "Apply Shear Correction Factor", "Enable Flaw",
                                "Disable Plasticity", "Apply Automatic Differentiation Jacobian"});
         });
}

bool may_be_peridigms(List& deck) {
  List *mesh = find_list(deck, "Discretization"), *contact = find_list(deck, "Contact");
  return is_peridigms(deck) || (contact && has_any(*contact, {"Search Radius", "Search Frequency"})) ||
         sets_are_parameters(find_list(deck, "Boundary Conditions")) || (mesh && has_any(*mesh, {"NeighborhoodType"}));
}

void tell_differences(List& deck, Problems& problems) { Differences(deck, problems).tell(); }

}  // namespace strut::deck
