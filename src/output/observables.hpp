// All output variables of points: one table for output, history, error messages about names and the page
// inputs/VARIABLES.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/body.hpp"

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

// The member of `all` with this name; throws Error, with the valid names. `where`: path in the deck.
const Observable& chosen(const std::vector<Observable>& all, const std::string& name, const std::string& where);

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

}  // namespace strut
