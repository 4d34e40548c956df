// All output variables of points: one table for output, history, error messages about names and the page
// inputs/VARIABLES.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/body.hpp"
#include "topology/point_group.hpp"

namespace strut {

struct Observable {
  std::string name;
  int components = 1;  // 1, 3, 6 or 9, as Exodus output names them
  bool nodal = false;
  std::string meaning;  // for the page
  // Writes the components of every owned point, point by point.
  std::function<void(const Body&, std::vector<double>&)> fill;
  std::string unit = {};
  std::function<bool(const MaterialBlock&)> exists = {};  // in a block; empty: in all

  // For each block, whether its points count in extremes and means.
  std::vector<bool> blocks_that_have_it(const Body& body) const;
};

// All observables of a body: the fixed ones and the state variables of its laws (zero in blocks whose law has none).
std::vector<Observable> observables(const Body& body);
std::vector<Observable> observables(const std::vector<materials::AnyLaw>& laws);

// The observables of a body with any law.
std::vector<Observable> observables_of_all_laws();

// The page inputs/VARIABLES.md: the fixed ones, and the state variables of all laws.
std::string observables_page();

// The members of `all` with these names. Throws one Error for all unknown names, with the valid ones. `where`: path in
// the deck.
std::vector<Observable> chosen(const std::vector<Observable>& all, const std::vector<std::string>& names,
                               const std::string& where);

// A scalar per point: an observable with one component, a component of another ("Displacement_Z"), or the root of the
// sum of squares of its components ("Displacement").
struct PointNumber {
  Observable observable;
  int component = -1;  // -1: of all components

  // Parses `name`; nullopt if there is no such observable.
  static std::optional<PointNumber> find(const std::vector<Observable>& all, const std::string& name);
  std::vector<double> of(const Body& body) const;  // for the owned points
};

// Valid names of scalars, with each prefix, for error messages: observables and their components.
std::vector<std::string> names_of_numbers(const std::vector<Observable>& all, const std::vector<std::string>& prefixes);
// The observables alone.
std::vector<std::string> names_of(const std::vector<Observable>& all);

// "Max_X" and "Min_X" of a scalar X: collective, over all points of all ranks; "Max_X(foam)": over the points of the
// node set foam or, if there is none, of the block.
class Extreme {
 public:
  // Throws Error like chosen(). `cloud`: the points of the body.
  Extreme(const std::vector<Observable>& all, const PointCloud& cloud, const std::string& name,
          const std::string& where);
  const std::string& name() const { return name_; }
  std::string unit() const { return number_.observable.unit; }
  // Number of points of this rank in its group.
  std::int64_t points(const PointCloud& cloud) const { return group_.points(cloud); }
  // Number of these points whose block has the variable.
  std::int64_t points(const Body& body) const;
  double local(const Body& body) const;  // of this rank, negated for a minimum, so that ranks always take the maximum
  double value(double largest) const { return sign_ * largest; }

 private:
  std::string name_;
  PointNumber number_;
  double sign_ = 1;
  PointGroup group_;
};

}  // namespace strut
