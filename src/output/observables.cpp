#include "output/observables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <type_traits>
#include <variant>

#include "base/errors.hpp"
#include "io/exodus/exodus.hpp"
#include "materials/state_variables.hpp"
#include "mechanics/steepness.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

std::span<const double> components(const double& scalar) { return {&scalar, 1}; }
template <class Matrix>
std::span<const double> components(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

// Makes an observable from a function of body and point that returns a double, Vector, Symmetric or Tensor (by rows).
template <class Value>
Observable observable(std::string name, std::string unit, std::string meaning, Value value, bool nodal = false) {
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
  return {std::move(name), count, nodal, std::move(meaning), fill, std::move(unit)};
}

// Transposed: Eigen stores columns, files have rows.
Tensor by_rows(const Tensor& t) { return t.transpose(); }

Symmetric cauchy(const Body& body, int i) {
  const MaterialPoint& p = body.points[i];
  const Tensor R = p.rotation.tensor();
  return symmetric_part(R * to_tensor(p.stress) * R.transpose());
}

// 0 for points whose neighbors do not span space.
double trace_of_shape(const Symmetric& inverse) {
  return trace(inverse) > 0 ? to_tensor(inverse).inverse().trace() : 0;
}

double residual(const Body& body, int i) {
  // shape_inverse of an ordinary point stays that of its whole family.
  const bool is_of_others = body.block_of(i).is_ordinary() && body.has_lost_bonds(i);
  const double scale = trace_of_shape(is_of_others ? inverse_of(shape_tensor(body, i)) : body.shape_inverse[i]);
  return scale > 0 ? std::sqrt(std::max(0.0, body.residual[i]) / scale) : 0;
}

// For ordinary points, that of the complete family before bonds broke.
Observable weighted_volume() {
  const auto fill = [](const Body& body, std::vector<double>& out) {
    out.assign(body.owned(), 0);
    for (const MaterialBlock& block : body.blocks) {
      for (std::size_t k = 0; k < block.points.size(); ++k) {
        const int i = block.points[k];
        const bool is_alone = body.domain.families.size(i) == 0 && !body.has_lost_bonds(i);  // m is then a stand-in
        out[i] = block.is_ordinary() && !is_alone ? block.ordinary[k].weighted_volume
                                                  : trace_of_shape(body.shape_inverse[i]);
      }
    }
  };
  return {"Weighted_Volume", 1, false, "Σ ω |ξ|² V = tr K over the family", fill, "m⁵"};
}

// θ of ordinary points; by correspondence tr U − 3, which is the same under an isotropic stretch.
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
  return {"Dilatation", 1, false, "θ at ordinary points, tr U − 3 at others", fill, "1"};
}

std::vector<Observable> kinematic() {
  return {
      observable(
          "Displacement", "m", "y − X", [](const Body& b, int i) { return b.displacement(i); }, true),
      observable(
          "Coordinate_X", "m", "component of the current position y",
          [](const Body& b, int i) { return b.current(i)[0]; }, true),
      observable(
          "Coordinate_Y", "m", "component of the current position y",
          [](const Body& b, int i) { return b.current(i)[1]; }, true),
      observable(
          "Coordinate_Z", "m", "component of the current position y",
          [](const Body& b, int i) { return b.current(i)[2]; }, true),
      observable(
          "Radial_Distance", "m", "distance of y from the z axis",
          [](const Body& b, int i) { return std::hypot(b.current(i)[0], b.current(i)[1]); }, true),
      observable(
          "Velocity", "m/s", "velocity at the time of the frame",
          [](const Body& b, int i) -> Vector { return 0.5 * (b.previous_velocity[i] + b.velocity[i]); }, true),
      observable(
          "Force", "N",
          "internal force, contact and loads, without tools and prescribed motion; with substeps, what acts at the end "
          "of the step",
          [](const Body& b, int i) -> Vector { return b.force_density[i] * b.domain.volume(i); }, true),
      observable("Deformation_Gradient", "1", "F",
                 [](const Body& b, int i) { return by_rows(b.points[i].deformation_gradient); }),
      observable("Rotation_Tensor", "1", "R of F = V R",
                 [](const Body& b, int i) { return by_rows(b.points[i].rotation.tensor()); }),
      observable("Left_Stretch_Tensor", "1", "V of F = V R",
                 [](const Body& b, int i) {
                   const MaterialPoint& p = b.points[i];
                   return symmetric_part(p.deformation_gradient * p.rotation.tensor().transpose());
                 }),
      observable("Residual", "1", "root mean square of |y_j − y_i − F ξ| over that of |ξ| in the family", residual),
      observable("Jacobian", "1", "det F",
                 [](const Body& b, int i) { return b.points[i].deformation_gradient.determinant(); }),
      dilatation(),
  };
}

std::vector<Observable> stresses() {
  return {
      observable("Cauchy_Stress", "Pa", "σ", cauchy),
      observable("Von_Mises_Stress", "Pa", "√(3/2 s:s), s the deviator of σ",
                 [](const Body& b, int i) { return von_mises(b.points[i].stress); }),
      observable("Pressure", "Pa", "−tr σ/3. In quadratic cells that flow it alternates: average it over neighbors",
                 [](const Body& b, int i) { return -trace(b.points[i].stress) / 3; }),
  };
}

Observable fragment() {
  const auto fill = [](const Body& body, std::vector<double>& out) {
    const std::vector<std::int64_t> ids = piece_ids(body.domain);
    out.assign(ids.begin(), ids.end());
  };
  return {"Fragment", 1, false, "number of the fragment: the smallest id of the points that bonds connect", fill, "1"};
}

std::vector<Observable> fixed_properties() {
  return {
      observable("Volume", "m³", "reference volume", [](const Body& b, int i) { return b.domain.volume(i); }),
      observable("Density", "kg/m³", "density in the reference state",
                 [](const Body& b, int i) { return b.block_of(i).material.density; }),
      observable("Horizon", "m", "δ", [](const Body& b, int i) { return b.domain.horizon(i); }),
      weighted_volume(),
      observable("Number_Of_Neighbors", "1", "number of points in the family; of one on a symmetry plane, both halves",
                 [](const Body& b, int i) { return static_cast<double>(b.domain.families.size(i)); }),
      fragment(),
      observable("Element_Id", "1", "number of the element (or node) in the mesh",
                 [](const Body& b, int i) { return static_cast<double>(b.domain.cloud.element_ids[i]); }),
      observable("Proc_Num", "1", "rank that owns the point",
                 [](const Body& b, int) { return static_cast<double>(b.domain.communicator.rank()); }),
  };
}

// Calls take(field, index of the part's first number) for the part with this name as an output variable.
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

// The observable of a declared field of points or blocks: the mean over integration points.
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
        const int places = field.at == At::point ? 1 : block.points_per_cell();
        for (std::size_t k = 0; k < block.points.size(); ++k) {
          for (int c = 0; c < width; ++c) {
            double sum = 0;
            for (int q = 0; q < places; ++q) sum += field.number(places > 1 ? block.index(k, q) : k, first + c);
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
  Observable one =
      declared({.unit = std::string(known.unit), .meaning = std::string(known.meaning), .variable = name, .width = 1});
  if (known.never_zero) {
    one.exists = [name](const MaterialBlock& block) {
      const auto is_it = [&name](const FieldPart& part) { return part.variable == name; };
      return std::ranges::any_of(block.fields.all(),
                                 [&](const auto& field) { return std::ranges::any_of(field->parts, is_it); });
    };
  }
  return one;
}

template <class L>
void add_state_names(const L& law, std::set<std::string>& names) {
  for (std::size_t k = 0; k < L::state_names.size(); ++k) {
    if constexpr (requires { law.shows(k); }) {
      if (!law.shows(k)) continue;
    }
    names.emplace(L::state_names[k]);
  }
}

std::set<std::string> states_of_all_laws() {
  std::set<std::string> states;
  [&]<class... L>(std::type_identity<std::variant<L...>>) {
    (add_state_names(L{}, states), ...);
  }(std::type_identity<materials::AnyLaw>());
  return states;
}

// The fixed observables, and the state variables with these names.
std::vector<Observable> with_states(const std::set<std::string>& states) {
  std::vector<Observable> all = kinematic();
  for (auto group : {stresses(), fixed_properties(), declared_fields()})
    all.insert(all.end(), group.begin(), group.end());
  for (const std::string& name : states) all.push_back(of_state(name));
  return all;
}

}  // namespace

std::vector<Observable> observables(const std::vector<materials::AnyLaw>& laws) {
  std::set<std::string> states;
  for (const materials::AnyLaw& law : laws) {
    std::visit([&](const auto& one) { add_state_names(one, states); }, law);
  }
  return with_states(states);
}

std::vector<Observable> observables(const Body& body) {
  std::vector<materials::AnyLaw> laws;
  for (const MaterialBlock& block : body.blocks) laws.push_back(block.material.law);
  return observables(laws);
}

std::vector<Observable> observables_of_all_laws() { return with_states(states_of_all_laws()); }

// ---- Names of observables, their components and numbers of them

namespace {

const Observable* find(const std::vector<Observable>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Observable& o) { return o.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

const Observable& chosen(const std::vector<Observable>& all, const std::string& name, const std::string& where) {
  if (const Observable* found = find(all, name)) return *found;
  const std::vector<std::string> valid = names_of(all);
  const bool of_others = find(observables_of_all_laws(), name) != nullptr;
  throw Error(where + " > " + name + ": " +
              (of_others ? "no material of this deck has a law with this state variable"
                         : "no such variable" + did_you_mean(name, valid)) +
              "; valid are " + joined(valid));
}

std::optional<PointNumber> PointNumber::find(const std::vector<Observable>& all, const std::string& name) {
  if (const Observable* whole = strut::find(all, name)) return PointNumber{*whole, -1};
  const std::size_t bar = name.rfind('_');
  const Observable* of = bar == std::string::npos ? nullptr : strut::find(all, name.substr(0, bar));
  if (!of) return std::nullopt;
  const std::vector<std::string> components = io::component_names(of->components);
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

std::vector<bool> Observable::blocks_that_have_it(const Body& body) const {
  std::vector<bool> all;
  for (const MaterialBlock& block : body.blocks) all.push_back(!exists || exists(block));
  return all;
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
      for (const std::string& component : io::component_names(o.components))
        names.push_back(prefix + o.name + "_" + component);
    }
  }
  return names;
}

}  // namespace strut
