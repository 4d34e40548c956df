// Finds observables, their components and extremes by name.
#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "output/observables.hpp"

namespace strut {

namespace {

// The names of components in Exodus files.
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

std::vector<Observable> chosen(const std::vector<Observable>& all, const std::vector<std::string>& names,
                               const std::string& where) {
  const std::vector<std::string> valid = names_of(all);
  std::vector<Observable> result;
  std::vector<std::string> problems;
  for (const std::string& name : names) {
    if (const Observable* found = find(all, name)) {
      result.push_back(*found);
    } else {
      const bool of_others = strut::find(observables_of_all_laws(), name) != nullptr;
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
    throw Error(where + " > " + name + ": expected Max_, Min_, Mean_ or Sum_ and the name of a variable" +
                did_you_mean(whole, names_of_numbers(all, {"Max_", "Min_", "Mean_", "Sum_"})) + "; variables are " +
                joined(names_of(all)));
  }
  if (bracket != std::string::npos) {
    group_ = PointGroup(cloud, name.substr(bracket + 1, name.size() - bracket - 2), where + " > " + name);
  }
  sign_ = kind == "Max_" ? 1 : -1;
  number_ = *found;
}

std::int64_t Extreme::points(const Body& body) const {
  const std::vector<bool> has = number_.observable.blocks_that_have_it(body);
  const PointCloud& cloud = body.domain.cloud;
  std::int64_t count = 0;
  for (int i = 0; i < body.owned(); ++i) count += has[cloud.blocks[i]] && group_.counts(cloud, i) ? 1 : 0;
  return count;
}

double Extreme::local(const Body& body) const {
  const std::vector<double> values = number_.of(body);
  const std::vector<bool> has = number_.observable.blocks_that_have_it(body);
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < body.owned(); ++i) {
    if (has[body.domain.cloud.blocks[i]] && group_.counts(body.domain.cloud, i))
      best = std::max(best, sign_ * values[i]);
  }
  return best;
}

}  // namespace strut
