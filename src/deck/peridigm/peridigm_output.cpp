// Peridigm has any number of output sections whose names begin with "Output", each with fields and totals of the body.
// Ours are one file of fields (Output) and one table of totals (History).
#include <algorithm>
#include <map>
#include <optional>

#include "base/errors.hpp"
#include "deck/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

// Fields that do not exist here, and their substitutes.
const std::map<std::string, std::string> missing_fields = {
    {"Bond_Damage", "there is Damage, the fraction of broken bonds of a point"},
    {"Coordinates", "there are Coordinate_X, Coordinate_Y and Coordinate_Z"},
    {"Model_Coordinates", "they are the coordinates of the nodes in the file"},
    {"Block_Id", "elements are in the blocks of the file"},
    {"Radius", "it is the attribute radius in the file"},
    {"Acceleration", ""},
    {"Hourglass_Force_Density", ""},
    {"Contact_Force", ""},
    {"Contact_Force_Density", ""},
    {"Kinetic_Energy", "History has that of the whole"},
    {"Strain_Energy", "History has Elastic_Energy of the whole"},
    {"Strain_Energy_Density", ""},
    {"Stored_Elastic_Energy", "History has Elastic_Energy of the whole"},
    {"Stored_Elastic_Energy_Density", ""},
    {"Linear_Momentum", "History has that of the whole"},
    {"Angular_Momentum", ""},
    {"Shape_Tensor_Inverse", ""},
    {"Unrotated_Rate_Of_Deformation", ""},
    {"Partial_Stress", ""},
    {"Strain", "there is Deformation_Gradient"},
    {"Stress", "there is Cauchy_Stress"},
    {"Surface_Correction_Factor", "it would be 1 everywhere"},
    {"Neighborhood_Volume", ""},
    {"Temperature_Change", "there is none"},
};

// ½ m v⁻·v⁺ with the velocities before and after a force: it conserves energy, but it can be negative.
const std::string kinetic =
    "Kinetic_Energy, by the velocities half a step before and after, which may be below zero where they turn round; "
    "Peridigm's, by one of them, may not";

// Totals of the body, and the columns of every History that contain them.
const std::map<std::string, std::string> global_columns = {
    {"Global_Kinetic_Energy", kinetic},
    {"Global_Strain_Energy", "Elastic_Energy"},
    {"Global_Linear_Momentum", "Momentum_X, Momentum_Y, Momentum_Z"},
    {"Global_Angular_Momentum", ""},
    {"Global_Strain_Energy_Density", ""},
    {"Nonlinear_Solver_Iterations", ""},
};

const std::vector<std::string> tensors = {"Deformation_Gradient",
                                          "Rotation_Tensor",
                                          "Left_Stretch_Tensor",
                                          "Cauchy_Stress",
                                          "Unrotated_Cauchy_Stress",
                                          "Shape_Tensor_Inverse",
                                          "Unrotated_Rate_Of_Deformation",
                                          "Strain",
                                          "Stress",
                                          "Partial_Stress"};

const std::vector<std::string> scalars = {"Von_Mises_Stress", "Equivalent_Plastic_Strain", "Dilatation",
                                          "Weighted_Volume",  "Number_Of_Neighbors",       "Volume"};

bool among(const std::vector<std::string>& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

// "Cauchy_StressXY" is a component of Cauchy_Stress, which is written as a whole.
std::string whole_field(const std::string& name) {
  if (name == "ID") return "Element_Id";
  const std::string whole = name.substr(0, name.size() < 2 ? 0 : name.size() - 2);
  const bool component = among(tensors, whole) && name.find_first_not_of("XYZ", whole.size()) == std::string::npos;
  return component ? whole : name;
}

// Our name for a compute class of a block or node set: "Max_Von_Mises_Stress(block_1)", or "".
std::string column_of(const List& compute) {
  const std::string kind = value_of(compute, "Compute Class"), calculation = value_of(compute, "Calculation Type");
  const std::string where = value_of(compute, kind == "Block_Data" ? "Block" : "Node Set");
  const std::string variable = value_of(compute, "Variable");
  const bool known = (kind == "Block_Data" || kind == "Node_Set_Data") && among(scalars, variable);
  if (!known || (calculation != "Maximum" && calculation != "Minimum")) return "";
  return calculation.substr(0, 3) + "_" + variable + "(" + where + ")";
}

class Outputs {
 public:
  Outputs(List& deck, Problems& problems) : deck_(deck), problems_(problems) {
    const List* computes = find_list(deck, "Compute Class Parameters");
    if (!computes) return;
    for (const List& one : computes->lists) computed_[value_of(one, "Output Label")] = column_of(one);
    erase_list(deck, "Compute Class Parameters");
  }

  void translate() {
    std::vector<List> sections = std::move(deck_.lists);
    deck_.lists.clear();
    for (List& section : sections) {
      if (is_output(section)) {
        add(section);
      } else {
        deck_.lists.push_back(section);
      }
    }
    add_history();
  }

 private:
  static bool is_output(List& section) {
    return section.name == "Output" || (section.name.starts_with("Output") && find_list(section, "Output Variables") &&
                                        find_parameter(section, "Output Filename"));
  }

  void add(List& section) {
    List* variables = find_list(section, "Output Variables");
    const bool had_numbers = variables && sort_out(*variables, section.name);
    if (had_numbers) want_history(section);
    if (had_numbers && variables->parameters.empty()) return;
    if (!fields_.empty()) {
      return problems_.add(section.name, "a second section with fields, after '" + fields_ +
                                             "'; there is one file of fields: put all into one of them");
    }
    fields_ = section.name;
    section.name = "Output";
    deck_.lists.push_back(section);
  }

  // Keeps in `variables` the fields that exist here; returns true if there were totals among the others.
  bool sort_out(List& variables, const std::string& section) {
    std::vector<Parameter> fields;
    bool had_numbers = false;
    for (Parameter one : variables.parameters) {
      if (one.type == "bool" && to_boolean(one.value) == false) continue;
      const std::string path = section + " > Output Variables > " + one.name;
      if (take_number(one.name, path)) {
        had_numbers = true;
        continue;
      }
      one.name = whole_field(one.name);
      if (take_missing(one, section)) continue;
      const auto same = [&](const Parameter& other) { return other.name == one.name; };
      if (std::none_of(fields.begin(), fields.end(), same)) fields.push_back(one);
    }
    variables.parameters = fields;
    return had_numbers;
  }

  bool take_number(const std::string& name, const std::string& path) {
    if (const auto global = global_columns.find(name); global != global_columns.end()) {
      note_column(path, global->second);
      return true;
    }
    const auto computed = computed_.find(name);
    if (computed == computed_.end()) return false;
    note_column(path, computed->second);
    if (!computed->second.empty() && !among(columns_, computed->second)) columns_.push_back(computed->second);
    return true;
  }

  void note_column(const std::string& path, const std::string& column) {
    problems_.note(path,
                   column.empty() ? "is not written: there is no such number here" : "goes into History: " + column);
  }

  bool take_missing(const Parameter& field, const std::string& section) {
    const auto missing = missing_fields.find(field.name);
    if (missing == missing_fields.end()) return false;
    if (!among(told_, field.name)) {
      problems_.note(
          section + " > Output Variables > " + field.name,
          "is not written: there is no such field here" + (missing->second.empty() ? "" : "; " + missing->second));
    }
    told_.push_back(field.name);
    return true;
  }

  void want_history(const List& section) {
    if (file_.empty()) file_ = value_of(section, "Output Filename");
    const auto frequency = to_integer(value_of(section, "Output Frequency"));
    if (frequency && (!frequency_ || *frequency < *frequency_)) frequency_ = frequency;
  }

  void add_history() {
    if (file_.empty()) return;
    List* own = find_list(deck_, "History");
    if (!own) {
      if (file_.ends_with(".e")) file_.resize(file_.size() - 2);
      List history{"History", {{"Filename", "string", file_ + ".csv"}}, {{"Variables", {}, {}}}};
      if (frequency_) history.parameters.push_back({"Frequency", "int", std::to_string(*frequency_)});
      deck_.lists.push_back(history);
      own = &deck_.lists.back();
    }
    if (!find_list(*own, "Variables")) own->lists.push_back({"Variables", {}, {}});
    List& variables = *find_list(*own, "Variables");
    for (const std::string& name : columns_) {
      if (!find_parameter(variables, name)) variables.parameters.push_back({name, "bool", "true"});
    }
  }

  List& deck_;
  Problems& problems_;
  std::map<std::string, std::string> computed_;  // label of each compute class, with its column, or ""
  std::vector<std::string> columns_, told_;
  std::string fields_;  // name of the section with the fields
  std::string file_;    // of the totals
  std::optional<int> frequency_;
};

}  // namespace

void translate_outputs(List& deck, Problems& problems) { Outputs(deck, problems).translate(); }

}  // namespace strut::deck
