// What a run can show of its points: one table, from which output, history, the errors about names and the page
// inputs/VARIABLES.md are made.
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
  std::string meaning;  // with its unit, for the page
  // Writes the components of every owned point, point by point.
  std::function<void(const Body&, std::vector<double>&)> fill;
  std::string unit = {};  // of a declared field; empty: as the meaning has it
};

std::string unit_of(const Observable& observable);  // as its meaning has it; "1" for none

// All observables of a body: the fixed ones and the state variables of its laws (zero in blocks whose law has none).
std::vector<Observable> observables(const Body& body);
std::vector<Observable> observables(const std::vector<materials::AnyLaw>& laws);

// Those that a body of any law can have.
std::vector<Observable> observables_of_all_laws();

// The page inputs/VARIABLES.md: the fixed ones, and the state variables of all laws.
std::string observables_page();

// The members of `all` that `names` ask for. Throws one Error for all names that are not there, with the valid ones.
// `where`: the place in the deck.
std::vector<Observable> chosen(const std::vector<Observable>& all, const std::vector<std::string>& names,
                               const std::string& where);

// A number of each point: an observable of one component, one of the components of another ("Displacement_Z"), or the
// root of the sum of their squares ("Displacement").
struct PointNumber {
  Observable observable;
  int component = -1;  // -1: of all

  // As `name` says; none where there is no such observable.
  static std::optional<PointNumber> find(const std::vector<Observable>& all, const std::string& name);
  std::vector<double> of(const Body& body) const;  // of the owned points
};

// What follows `prefixes` in names of numbers of points, for errors: observables, and their components.
std::vector<std::string> names_of_numbers(const std::vector<Observable>& all, const std::vector<std::string>& prefixes);
// The observables alone.
std::vector<std::string> names_of(const std::vector<Observable>& all);

// "Max_X" and "Min_X" of a number X of points: collective, over all points of all ranks;
// "Max_X(foam)": over the points of the node set foam or, where there is no such set, of the block.
class Extreme {
 public:
  // Throws Error like chosen(). `cloud`: the points of the body.
  Extreme(const std::vector<Observable>& all, const PointCloud& cloud, const std::string& name,
          const std::string& where);
  const std::string& name() const { return name_; }
  std::string unit() const { return unit_of(number_.observable); }
  // How many points of this rank it is taken over.
  std::int64_t points(const PointCloud& cloud) const { return group_.points(cloud); }
  double local(const Body& body) const;  // of this rank, negated for a minimum, so that all ranks take the maximum
  double value(double largest) const { return sign_ * largest; }

 private:
  std::string name_;
  PointNumber number_;
  double sign_ = 1;
  PointGroup group_;
};

}  // namespace strut
