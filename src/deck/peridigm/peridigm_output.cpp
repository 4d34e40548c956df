// Peridigm has any number of output sections whose names begin with "Output", each with fields and totals of the body.
// Ours are one file of fields (Output) and one table of totals (History).
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/errors.hpp"
#include "base/numbers.hpp"
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
    {"Temperature_Change", "there is Thermal_Strain, which is α times that"},
    {"External_Force_Density", "Force_Density holds the loads"},
    {"Lambda", "there is Equivalent_Plastic_Strain"},
    {"Jacobian_Determinant", "there is Jacobian"},
    {"Green_Lagrange_Strain", "there is Deformation_Gradient"},
    {"Influence_Function", "it is the deck's"},
    {"Undamaged_Weighted_Volume", "there is Weighted_Volume, which does not fall with damage"},
};

// More of them, with nothing near.
const std::vector<std::string> other_missing_fields = to_words(
    "Bond_Damage_Parameter Bond_Equivalent_Plastic_Strain Bond_Stress_Triaxiality Bond_Visualization "
    "Bond_Von_Mises_Stress Broken_Bond_Volume_Averaged Concentration Concentration_Flux_Divergence Critical_Stretch "
    "Deformation_Gradient_Dot Deformation_Gradient_Inv Deviatoric_Back_Extension Deviatoric_Normalization "
    "Deviatoric_Plastic_Extension Dilatation_Normalization Error Fluid_Concentration Fluid_Pressure_U Fluid_Pressure_V "
    "Fluid_Pressure_Y Flux_Density Flux_Divergence Flying_Point_Flag Gradient_Weight Gradient_Weight_Evaluation_Flag "
    "Influence_State Interface_Aperture Neighbor_Centroid Neighbor_Volume Nonhomogeneous_Integral "
    "Normalized_Weighted_Volume OBC_Functional Pals_Pressure Piola_Stress Quadrature_Weights Self_Centroid Self_Volume "
    "Stress_Integral Stress_Triaxiality Velocity_Gradient");

// ½ m v⁻·v⁺ with the velocities before and after a force: it conserves energy, but it can be negative.
const std::string kinetic =
    "Kinetic_Energy, by the velocities half a step before and after: less than Peridigm's by ½ m (½ a Δt)², and below "
    "zero where they turn round";

// Totals of the body, and the columns of every History that contain them.
const std::map<std::string, std::string> global_columns = {
    {"Global_Kinetic_Energy", kinetic},
    {"Global_Strain_Energy", "Elastic_Energy"},
    {"Global_Linear_Momentum", "Momentum_X, Momentum_Y, Momentum_Z"},
    {"Global_Angular_Momentum", ""},
    {"Global_Error", ""},
    {"Global_Strain_Energy_Density", ""},
    {"Nonlinear_Solver_Iterations", ""},
};

const std::vector<std::string> tensors = to_words(
    "Deformation_Gradient Rotation_Tensor Left_Stretch_Tensor Cauchy_Stress Unrotated_Cauchy_Stress "
    "Shape_Tensor_Inverse Unrotated_Rate_Of_Deformation Strain Stress Partial_Stress");

const std::vector<std::string> vectors = {"Displacement", "Velocity", "Force", "Force_Density"};
const std::vector<std::string> scalars = to_words(
    "Von_Mises_Stress Equivalent_Plastic_Strain Dilatation Weighted_Volume Number_Of_Neighbors Volume Damage Horizon");

bool among(const std::vector<std::string>& all, const std::string& name) {
  return std::ranges::find(all, name) != all.end();
}

// "Cauchy_Stress_XY" is Cauchy_Stress of a bond: a field there, not here.
std::string without_axes(const std::string& name) {
  const std::size_t last = name.find_last_not_of("XYZ");
  const bool has_axes = last != std::string::npos && last + 1 < name.size() && name[last] == '_';
  return has_axes ? name.substr(0, last) : name;
}

// `is_theirs`: in our decks a name that is nearly right is an error, and a metal may have a Temperature.
bool is_missing(const std::string& name, bool is_theirs) {
  const std::string whole = without_axes(name);
  return missing_fields.contains(name) ||
         (is_theirs &&
          (name == "Temperature" || name.starts_with("Lagrange_Multiplier_") || among(other_missing_fields, name) ||
           among(other_missing_fields, whole) || (whole != name && among(tensors, whole))));
}

// "Cauchy_StressXY" is a component of Cauchy_Stress, which is written as a whole.
std::string whole_field(const std::string& name) {
  if (name == "ID") return "Element_Id";
  const std::string whole = name.substr(0, name.size() < 2 ? 0 : name.size() - 2);
  const bool component = among(tensors, whole) && name.find_first_not_of("XYZ", whole.size()) == std::string::npos;
  return component ? whole : name;
}

// Our names for a compute class: "Max_Von_Mises_Stress(block_1)"; none if there is nothing like it. `set`: the name of
// the points.
std::vector<std::string> columns_of(const List& compute, const std::string& set) {
  const std::string kind = value_of(compute, "Compute Class"), calculation = value_of(compute, "Calculation Type");
  const std::string variable = value_of(compute, "Variable");
  const std::map<std::string, std::string> starts = {
      {"Maximum", "Max_"}, {"Minimum", "Min_"}, {"Sum", "Sum_"}, {"", kind == "Nearest_Point_Data" ? "Mean_" : ""}};
  const auto start = starts.find(calculation);
  if (start == starts.end() || start->second.empty()) return {};
  if (among(scalars, variable)) return {start->second + variable + "(" + set + ")"};
  if (!among(vectors, variable)) return {};
  std::vector<std::string> columns;
  for (const char* axis : {"_X", "_Y", "_Z"}) columns.push_back(start->second + variable + axis + "(" + set + ")");
  return columns;
}

class Outputs {
 public:
  Outputs(List& deck, bool is_theirs, Problems& problems) : deck_(deck), is_theirs_(is_theirs), problems_(problems) {
    List* found = find_list(deck, "Compute Class Parameters");
    if (!found) return;
    const std::vector<List> computes = found->lists;
    erase_list(deck, "Compute Class Parameters");
    for (const List& one : computes) computed_[value_of(one, "Output Label")] = columns_of(one, points_of(one));
  }

  void translate() {
    std::vector<List> sections = std::move(deck_.lists);
    deck_.lists.clear();
    for (List& section : sections) {
      is_output(section) ? add(section) : deck_.lists.push_back(section);
    }
    add_history();
  }

 private:
  // The name of a compute class's points. The point nearest to a place is a set of its own.
  std::string points_of(const List& compute) {
    const std::string kind = value_of(compute, "Compute Class");
    if (kind == "Block_Data") return value_of(compute, "Block");
    if (kind == "Node_Set_Data") return value_of(compute, "Node Set");
    if (kind != "Nearest_Point_Data") return "";
    const std::string label = value_of(compute, "Output Label"), set = label + " Node Set";
    List* conditions = find_list(deck_, "Boundary Conditions");
    if (!conditions) {
      deck_.lists.push_back({"Boundary Conditions", {}, {}});
      conditions = &deck_.lists.back();
    }
    std::string place = "nearest";
    for (const char* axis : {"X", "Y", "Z"}) place += " " + value_of(compute, axis);
    conditions->parameters.push_back({set, "string", place});
    return set;
  }

  static bool is_output(List& section) {
    return section.name == "Output" || (section.name.starts_with("Output") && find_list(section, "Output Variables") &&
                                        find_parameter(section, "Output Filename"));
  }

  void add(List& section) {
    List* variables = find_list(section, "Output Variables");
    const bool had_numbers = variables && sort_out(*variables, section.name);
    if (had_numbers) want_history(section);
    if (had_numbers && variables->parameters.empty()) return;
    drop_range(section);
    if (!fields_.empty()) return join(section, variables ? *variables : List{.name = "Output Variables"});
    fields_ = section.name;
    section.name = "Output";
    deck_.lists.push_back(section);
  }

  // A file is written during the whole run.
  void drop_range(List& section) {
    for (const char* key : {"Initial Output Step", "Final Output Step"}) {
      if (!find_parameter(section, key)) continue;
      erase_parameter(section, key);
      problems_.note(section.name + " > " + key, "has no effect here: there are frames in the whole run");
    }
  }

  // There is one file of fields: it takes those of the others, too, as often as the one with most frames.
  void join(List& section, const List& variables) {
    List& first = *find_list(deck_, "Output");
    problems_.note(section.name, "writes no file of its own: its fields go into that of " + fields_ + ", '" +
                                     value_of(first, "Output Filename") + "'");
    if (!find_list(first, variables.name)) first.lists.push_back({.name = variables.name});
    List& fields = *find_list(first, variables.name);
    for (const Parameter& one : variables.parameters) {
      if (!find_parameter(fields, one.name)) fields.parameters.push_back(one);
    }
    const auto often = to_integer(value_of(section, "Output Frequency"));
    Parameter* frequency = find_parameter(first, "Output Frequency");
    const auto known = frequency ? to_integer(frequency->value) : std::nullopt;
    if (often && known && *often < *known) frequency->value = std::to_string(*often);
  }

  // Keeps in `variables` the fields that exist here; returns true if there were totals among the others.
  bool sort_out(List& variables, const std::string& section) {
    std::vector<Parameter> fields;
    bool had_numbers = false;
    for (Parameter one : variables.parameters) {
      if (one.type == "bool" && to_boolean(one.value) == false) continue;
      const std::string path = section + " > Output Variables > " + one.name;
      const bool is_number = take_number(one.name, path);
      had_numbers = had_numbers || is_number;
      one.name = whole_field(one.name);
      if (is_number || take_missing(one, section)) continue;
      if (std::ranges::find(fields, one.name, &Parameter::name) == fields.end()) fields.push_back(one);
    }
    variables.parameters = fields;
    return had_numbers;
  }

  bool take_number(const std::string& name, const std::string& path) {
    if (const auto global = global_columns.find(name); global != global_columns.end()) {
      note_columns(path, global->second);
      return true;
    }
    const auto computed = computed_.find(name);
    if (computed == computed_.end()) return false;
    note_columns(path, joined(computed->second));
    for (const std::string& column : computed->second) {
      if (!among(columns_, column)) columns_.push_back(column);
    }
    return true;
  }

  void note_columns(const std::string& path, const std::string& column) {
    problems_.note(path,
                   column.empty() ? "is not written: there is no such number here" : "goes into History: " + column);
  }

  bool take_missing(const Parameter& field, const std::string& section) {
    if (!is_missing(field.name, is_theirs_)) return false;
    const auto known = missing_fields.find(field.name);
    const std::string instead = known == missing_fields.end() ? "" : known->second;
    if (reported_.insert(field.name).second) {
      problems_.note(section + " > Output Variables > " + field.name,
                     "is not written: there is no such field here" + (instead.empty() ? "" : "; " + instead));
    }
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
  bool is_theirs_;
  Problems& problems_;
  std::map<std::string, std::vector<std::string>> computed_;  // label of each compute class, with its columns
  std::vector<std::string> columns_;
  std::set<std::string> reported_;
  std::string fields_;  // name of the section with the fields
  std::string file_;    // of the totals
  std::optional<int> frequency_;
};

}  // namespace

void translate_outputs(List& deck, bool is_theirs, Problems& problems) {
  Outputs(deck, is_theirs, problems).translate();
}

}  // namespace strut::deck
