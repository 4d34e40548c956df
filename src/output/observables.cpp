#include "output/observables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <type_traits>
#include <variant>

#include "base/errors.hpp"
#include "fracture/fragments.hpp"
#include "materials/state_variables.hpp"

namespace strut {

namespace {

std::span<const double> components(const double& scalar) { return {&scalar, 1}; }
template <class Matrix>
std::span<const double> components(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

// An observable from a function of body and point that returns a double, Vector, Symmetric or (row by row) Tensor.
template <class Value>
Observable observable(std::string name, std::string meaning, Value value, bool nodal = false) {
  const auto fill = [value](const Body& body, std::vector<double>& out) {
    out.clear();
    for (int i = 0; i < body.owned(); ++i) {
      const auto v = value(body, i);
      for (const double c : components(v)) out.push_back(c);
    }
  };
  using Result = decltype(value(std::declval<const Body&>(), 0));
  int count = 1;
  if constexpr (!std::is_same_v<Result, double>) count = static_cast<int>(Result::SizeAtCompileTime);
  return {std::move(name), count, nodal, std::move(meaning), fill};
}

// Eigen stores columns; files want rows.
Tensor by_rows(const Tensor& t) { return t.transpose(); }

Symmetric cauchy(const Body& body, int i) {
  const MaterialPoint& p = body.points[i];
  const Tensor R = p.rotation.tensor();
  return symmetric_part(R * to_tensor(p.stress) * R.transpose());
}

// 0 of points whose neighbors do not span space.
double trace_of_shape(const Body& body, int i) {
  const Symmetric& inverse = body.shape_inverse[i];
  return trace(inverse) > 0 ? to_tensor(inverse).inverse().trace() : 0;
}

// Of ordinary points that of the whole family, before bonds broke.
Observable weighted_volume() {
  const auto fill = [](const Body& body, std::vector<double>& out) {
    out.assign(body.owned(), 0);
    for (const MaterialBlock& block : body.blocks) {
      for (std::size_t k = 0; k < block.points.size(); ++k) {
        const int i = block.points[k];
        out[i] = block.is_ordinary() ? block.ordinary[k].weighted_volume : trace_of_shape(body, i);
      }
    }
  };
  return {"Weighted_Volume", 1, false, "Σ ω |ξ|² V = tr K, m⁵", fill};
}

// Ordinary points: θ. By correspondence tr U − 3, which under an isotropic stretch is the same.
Observable dilatation() {
  const auto fill = [](const Body& body, std::vector<double>& out) {
    out.assign(body.owned(), 0);
    for (const MaterialBlock& block : body.blocks) {
      for (std::size_t k = 0; k < block.points.size(); ++k) {
        const MaterialPoint& p = body.points[block.points[k]];
        const double traced = p.rotation.tensor().cwiseProduct(p.deformation_gradient).sum() - 3;
        out[block.points[k]] = block.is_ordinary() ? block.ordinary[k].dilatation : traced;
      }
    }
  };
  return {"Dilatation", 1, false, "θ of ordinary points, tr U − 3 of others", fill};
}

std::vector<Observable> kinematic() {
  return {
      observable(
          "Displacement", "y − X, m", [](const Body& b, int i) { return b.displacement(i); }, true),
      observable(
          "Coordinate_X", "of the current position y, m", [](const Body& b, int i) { return b.current(i)[0]; }, true),
      observable(
          "Coordinate_Y", "of y, m", [](const Body& b, int i) { return b.current(i)[1]; }, true),
      observable(
          "Coordinate_Z", "of y, m", [](const Body& b, int i) { return b.current(i)[2]; }, true),
      observable(
          "Radial_Distance", "of y from the z axis, m",
          [](const Body& b, int i) { return std::hypot(b.current(i)[0], b.current(i)[1]); }, true),
      observable(
          "Velocity", "at the time of the frame, m/s",
          [](const Body& b, int i) -> Vector { return 0.5 * (b.previous_velocity[i] + b.velocity[i]); }, true),
      observable(
          "Force", "internal force and loads, N; where points are subcycled, what acts at the end of a step",
          [](const Body& b, int i) -> Vector { return b.force_density[i] * b.domain.volume(i); }, true),
      observable("Deformation_Gradient", "F",
                 [](const Body& b, int i) { return by_rows(b.points[i].deformation_gradient); }),
      observable("Rotation_Tensor", "R of F = V R",
                 [](const Body& b, int i) { return by_rows(b.points[i].rotation.tensor()); }),
      observable("Left_Stretch_Tensor", "V of F = V R",
                 [](const Body& b, int i) {
                   const MaterialPoint& p = b.points[i];
                   return symmetric_part(p.deformation_gradient * p.rotation.tensor().transpose());
                 }),
      observable("Residual", "of F: the root mean square of |y_j − y_i − F ξ| over that of |ξ| in the family",
                 [](const Body& b, int i) {
                   const double scale = trace_of_shape(b, i);
                   return scale > 0 ? std::sqrt(std::max(0.0, b.residual[i]) / scale) : 0.0;
                 }),
      observable("Jacobian", "det F",
                 [](const Body& b, int i) { return b.points[i].deformation_gradient.determinant(); }),
      dilatation(),
  };
}

std::vector<Observable> stresses() {
  return {
      observable("Cauchy_Stress", "σ, Pa", cauchy),
      observable("Von_Mises_Stress", "√(3/2 s:s), Pa",
                 [](const Body& b, int i) { return von_mises(b.points[i].stress); }),
      observable("Pressure", "−tr σ/3, Pa", [](const Body& b, int i) { return -trace(b.points[i].stress) / 3; }),
  };
}

Observable fragment() {
  const auto fill = [](const Body& body, std::vector<double>& out) {
    const std::vector<std::int64_t> ids = fragment_ids(body);
    out.assign(ids.begin(), ids.end());
  };
  return {"Fragment", 1, false, "the least id of the points that bonds lead to", fill};
}

std::vector<Observable> fixed_properties() {
  return {
      observable("Volume", "reference volume, m³", [](const Body& b, int i) { return b.domain.volume(i); }),
      observable("Density", "in the reference state, kg/m³",
                 [](const Body& b, int i) { return b.block_of(i).material.density; }),
      observable("Horizon", "δ, m", [](const Body& b, int i) { return b.domain.horizon(i); }),
      weighted_volume(),
      observable("Number_Of_Neighbors", "size of the family",
                 [](const Body& b, int i) { return static_cast<double>(b.domain.families.size(i)); }),
      fragment(),
      observable("Element_Id", "the mesh's own number",
                 [](const Body& b, int i) { return static_cast<double>(b.domain.cloud.element_ids[i]); }),
      observable("Proc_Num", "the rank that owns the point",
                 [](const Body& b, int) { return static_cast<double>(b.domain.communicator.rank()); }),
  };
}

// Calls take(field, the number that the part begins with) for the part with this name as an output variable.
template <class Take>
void with_part(const FieldSet& fields, const std::string& variable, const Take& take) {
  for (const auto& field : fields.all()) {
    int first = 0;
    for (const FieldPart& part : field->parts) {
      if (part.variable == variable && field->bytes() > 0) take(*field, first);
      first += part.width;
    }
  }
}

// The observable of a declared field, of points or of blocks: the mean over integration points.
Observable declared(const FieldPart& part) {
  const auto fill = [variable = part.variable, width = part.width](const Body& body, std::vector<double>& out) {
    out.assign(static_cast<std::size_t>(body.owned()) * width, 0);
    const auto number = [&](int i, int c) -> double& { return out[static_cast<std::size_t>(i) * width + c]; };
    with_part(body.fields, variable, [&](const AnyField& field, int first) {
      for (int i = 0; i < body.owned(); ++i) {
        for (int c = 0; c < width; ++c) number(i, c) = field.number(i, first + c);
      }
    });
    for (const MaterialBlock& block : body.blocks) {
      with_part(block.fields, variable, [&](const AnyField& field, int first) {
        const int places = field.at == At::point ? 1 : block.places_a_point();
        for (std::size_t k = 0; k < block.points.size(); ++k) {
          for (int c = 0; c < width; ++c) {
            double sum = 0;
            for (int q = 0; q < places; ++q) sum += field.number(places > 1 ? block.place(k, q) : k, first + c);
            number(block.points[k], c) = sum / places;
          }
        }
      });
    }
  };
  return {part.variable, part.width, part.nodal, part.meaning, fill, part.unit};
}

std::vector<Observable> declared_fields() {
  std::vector<Observable> all;
  const auto add = [&all](const FieldSet& fields) {
    for (const auto& field : fields.all()) {
      for (const FieldPart& part : field->parts) {
        if (!part.variable.empty()) all.push_back(declared(part));
      }
    }
  };
  add(PointFields().fields);
  add(MaterialBlock().fields);
  return all;
}

Observable of_state(const std::string& name) {
  const materials::StateVariable known = materials::state_variable(name);
  return declared(
      {.unit = std::string(known.unit), .meaning = std::string(known.meaning), .variable = name, .width = 1});
}

template <class L>
void add_state_names(std::set<std::string>& names) {
  names.insert(L::state_names.begin(), L::state_names.end());
}

std::set<std::string> states_of_all_laws() {
  std::set<std::string> states;
  [&]<class... L>(std::type_identity<std::variant<L...>>) {
    (add_state_names<L>(states), ...);
  }(std::type_identity<materials::AnyLaw>());
  return states;
}

// The fixed observables, and the state variables of these names.
std::vector<Observable> with_states(const std::set<std::string>& states) {
  std::vector<Observable> all = kinematic();
  for (auto group : {stresses(), fixed_properties(), declared_fields()})
    all.insert(all.end(), group.begin(), group.end());
  for (const std::string& name : states) all.push_back(of_state(name));
  return all;
}

const char* const introduction = R"(# Output variables

Generated from `src/output/observables.cpp` and the fields that are declared as output variables (`src/mechanics/body.hpp`, `materials/state_variables.hpp`); do not edit by hand. SI units throughout.

Each is a field of the points that the section `Output` of a deck can write (`Output Variables`). With `Max_` or `Min_`
in front it is a column that the section `History` can write: the extreme over all points, or with the name of a node
set or block, `Max_Displacement(foot)`, over its points. 3 components are x, y, z; 6 are xx, yy, zz, xy, yz, zx; 9 are a
tensor row by row. An extreme of several components is that of the root of the sum of their squares; one of them is named as
in `Max_Displacement_Z` and `Min_Cauchy_Stress_ZZ`. `Mean_` is the mean over the same points, weighted by their reference
volumes: `Mean_Displacement_Z(top)`. Where the brackets name a section of `History` > `Profiles`, there is a column for each of
its layers, `Mean_Velocity_Z(slices 1)`, ….

Besides, the history knows `Contact_Force_X(foam:plate)`, `_Y` and `_Z`, the force of contact on the block `foam` from the
block `plate`, with friction (N), and `Reaction_X(wall)`, `Reaction_Y(wall)` and `Reaction_Z(wall)`, the force of the condition `wall`
on the body (N). Both are means from the row before to this one, so that each times its interval is an impulse and all of them together
the change of momentum; the first row has 0. With `Instant_` in front, `Instant_Reaction_Z(wall)`, they are those of the one step at the
row's time. Of equilibria all are those of the row's time. Of a crack that the section `History` > `Cracks` names there are `Crack_Tip(notch)`, how far it has come along its
direction (m), and `Crack_Speed(notch)`, the slope of that over the last rows (m/s).

X and y are the reference and the current position of a point, F is its deformation gradient; other symbols are those of
the [glossary](../docs/glossary.md). A state variable is there where a material of the deck has a law with it: `Failed` of
metal foams alone, say; by quadratic correspondence it is the mean over the cell.

| variable | components | in the Exodus file | meaning, with its unit |
|---|---|---|---|
)";

// As a cell of a table.
std::string escaped(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, 1, '\\');
  return text;
}

// As in the names of an Exodus file's fields.
std::vector<std::string> component_names(int components) {
  if (components == 3) return {"X", "Y", "Z"};
  if (components == 6) return {"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
  if (components == 9) return {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
  return {};
}

const Observable* find(const std::vector<Observable>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Observable& o) { return o.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Observable> observables(const std::vector<materials::AnyLaw>& laws) {
  std::set<std::string> states;
  for (const materials::AnyLaw& law : laws) {
    std::visit([&]<class L>(const L&) { add_state_names<L>(states); }, law);
  }
  return with_states(states);
}

std::vector<Observable> observables(const Body& body) {
  std::vector<materials::AnyLaw> laws;
  for (const MaterialBlock& block : body.blocks) laws.push_back(block.material.law);
  return observables(laws);
}

std::vector<Observable> observables_of_all_laws() { return with_states(states_of_all_laws()); }

std::string observables_page() {
  std::string text = introduction;
  for (const Observable& o : observables_of_all_laws()) {
    text += "| `" + o.name + "` | " + std::to_string(o.components) + " | " + (o.nodal ? "nodal" : "element") + " | " +
            escaped(o.meaning + (o.unit.empty() || o.unit == "1" ? "" : ", " + o.unit)) + " |\n";
  }
  return text;
}

// As it is declared, or the part of the meaning after a comma that is one of these.
std::string unit_of(const Observable& observable) {
  if (!observable.unit.empty()) return observable.unit;
  static const std::vector<std::string> units = {"N/m³", "kg/m³", "m/s", "m³", "m⁵", "N", "m", "Pa"};
  for (const std::string& unit : units) {
    const std::size_t at = observable.meaning.find(", " + unit);
    const std::size_t end = at + 2 + unit.size();
    if (at != std::string::npos && (end == observable.meaning.size() || observable.meaning[end] == ';')) return unit;
  }
  return "1";
}

std::vector<Observable> chosen(const std::vector<Observable>& all, const std::vector<std::string>& names,
                               const std::string& where) {
  const std::vector<std::string> valid = names_of(all);
  std::vector<Observable> result;
  std::vector<std::string> problems;
  for (const std::string& name : names) {
    if (const Observable* found = find(all, name)) {
      result.push_back(*found);
    } else {
      const bool of_others = states_of_all_laws().contains(name);
      problems.push_back(where + " > " + name + ": " +
                         (of_others ? "no material of this deck has a law with this state variable"
                                    : "no such variable" + did_you_mean(name, valid)) +
                         "; valid are " + joined(valid));
    }
  }
  if (!problems.empty()) throw Error(joined(problems, "\n"));
  return result;
}

std::optional<PointNumber> PointNumber::find(const std::vector<Observable>& all, const std::string& name) {
  if (const Observable* whole = strut::find(all, name)) return PointNumber{*whole, -1};
  const std::size_t bar = name.rfind('_');
  const Observable* of = bar == std::string::npos ? nullptr : strut::find(all, name.substr(0, bar));
  if (!of) return std::nullopt;
  const std::vector<std::string> components = component_names(of->components);
  const auto found = std::find(components.begin(), components.end(), name.substr(bar + 1));
  if (found == components.end()) return std::nullopt;
  return PointNumber{*of, static_cast<int>(found - components.begin())};
}

std::vector<double> PointNumber::of(const Body& body) const {
  std::vector<double> values;
  observable.fill(body, values);
  const int width = observable.components;
  if (width == 1) return values;
  std::vector<double> numbers(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    const double* first = &values[static_cast<std::size_t>(i) * width];
    numbers[i] = component < 0 ? Eigen::Map<const Eigen::VectorXd>(first, width).norm() : first[component];
  }
  return numbers;
}

std::vector<std::string> names_of(const std::vector<Observable>& all) {
  std::vector<std::string> names;
  for (const Observable& o : all) names.push_back(o.name);
  return names;
}

std::vector<std::string> names_of_numbers(const std::vector<Observable>& all,
                                          const std::vector<std::string>& prefixes) {
  std::vector<std::string> names;
  for (const std::string& prefix : prefixes) {
    for (const Observable& o : all) {
      names.push_back(prefix + o.name);
      for (const std::string& component : component_names(o.components))
        names.push_back(prefix + o.name + "_" + component);
    }
  }
  return names;
}

Extreme::Extreme(const std::vector<Observable>& all, const PointCloud& cloud, const std::string& name,
                 const std::string& where)
    : name_(name) {
  const std::size_t bracket = name.back() == ')' ? name.find('(') : std::string::npos;
  const std::string whole = name.substr(0, bracket);
  const std::string kind = whole.substr(0, 4);
  const bool extreme = kind == "Max_" || kind == "Min_";
  const std::optional<PointNumber> found = extreme ? PointNumber::find(all, whole.substr(4)) : std::nullopt;
  if (!found) {
    throw Error(where + " > " + name + ": expected Max_, Min_ or Mean_ and the name of a variable" +
                did_you_mean(whole, names_of_numbers(all, {"Max_", "Min_", "Mean_"})) + "; variables are " +
                joined(names_of(all)));
  }
  if (bracket != std::string::npos) {
    group_ = PointGroup(cloud, name.substr(bracket + 1, name.size() - bracket - 2), where + " > " + name);
  }
  sign_ = kind == "Max_" ? 1 : -1;
  number_ = *found;
}

double Extreme::local(const Body& body) const {
  const std::vector<double> values = number_.of(body);
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < body.owned(); ++i) {
    if (group_.counts(body.domain.cloud, i)) best = std::max(best, sign_ * values[i]);
  }
  return best;
}

}  // namespace strut
