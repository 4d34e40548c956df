// Means, sums and extremes over the points of a set, means and sums over the layers of a profile, "Mean_X(foam)",
// "Sum_X(foam)", "Max_X(foam)" and "Min_X(foam)" of the history, and means of forces between its rows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/sections/output.hpp"
#include "output/observables.hpp"
#include "topology/point_group.hpp"

namespace strut {

// Layers of the points of a set across a direction, of equal thickness, between the outer faces of the outermost points
// (where their cells end; nodes lie on them) in the reference state.
class Layers {
 public:
  Layers() = default;  // a single layer of all points
  // Collective. Throws Error on all ranks if there is no such set, or if a layer has no point. `path`: in the deck.
  Layers(const deck::Profile& profile, const Body& body, const std::string& path);
  // Collective. A single layer of a node set or block.
  Layers(const std::string& set, const Body& body, const std::string& path);

  int count() const { return count_; }
  int of(const Body& body, int i) const;  // the layer of an owned point; -1: none

 private:
  PointGroup group_;
  Vector direction_ = Vector::UnitZ();
  double low_ = 0, thickness_ = 0;  // m
  int count_ = 1;
};

// A mean over each layer, weighted by reference volumes, or the plain sum; or the extreme over a single one.
class Reduction {
 public:
  Reduction(std::string name, PointNumber number, Layers layers)
      : name_(std::move(name)), number_(std::move(number)), layers_(std::move(layers)) {}
  static bool is_extreme(const std::string& name) { return name.starts_with("Max_") || name.starts_with("Min_"); }
  static bool is_mean(const std::string& name) { return name.starts_with("Mean_") || is_sum(name); }

  // The same under another name: of a single layer.
  Reduction named(std::string name) && {
    name_ = std::move(name);
    return std::move(*this);
  }
  // Names of the columns: "Mean_X(foam)", or for layers "Mean_X(slices 1)", ….
  std::vector<std::string> columns() const;
  std::string unit() const { return number_.observable.unit; }
  std::vector<double> values(const Body& body) const;  // collective
  // Collective. False if a layer has no point with the variable and its mean is wanted; a sum is then 0.
  bool exists(const Body& body) const;

 private:
  // Collective. For each layer the sum over its points that have the variable of value(i), then their volume.
  template <class Value>
  std::vector<double> sums(const Body& body, const Value& value) const;
  double extreme(const Body& body, const std::vector<double>& numbers) const;  // collective
  static bool is_sum(const std::string& name) { return name.starts_with("Sum_"); }

  std::string name_;
  PointNumber number_;
  Layers layers_;
};

// Collective. Throws the errors of reduction_of for unknown or ambiguous names, and for an extreme over no point.
void check_reduction(const std::vector<Observable>& all, const std::vector<deck::Profile>& profiles,
                     const PointCloud& cloud, const Communicator& communicator, const std::string& name,
                     const std::string& where);
// Collective. `name`: "Mean_X", or with a set, block or profile (not of an extreme) in parentheses. Throws Error on all
// ranks.
Reduction reduction_of(const std::vector<Observable>& all, const std::vector<deck::Profile>& profiles, const Body& body,
                       const std::string& name, const std::string& where);

// Mean forces of explicit steps between rows of the history; multiplied by the time in between they are impulses.
class MeanForces {
 public:
  MeanForces(std::size_t columns, double initial_time) : since_(initial_time), passed_(columns), ahead_(columns) {}

  // Adds this rank's impulses at a time of the solver, N s, one per column: the parts before and after that time.
  void add(std::span<const double> before, std::span<const double> after);
  // Collective; at the time of a row, after add(): mean forces from the previous row to this one, N, over all ranks. In
  // the first row, before which no force has acted, 0.
  std::vector<double> take(double time, const Communicator& communicator);

  void serialize(Archive& archive);

 private:
  double since_;                // s, the time of the last row
  std::vector<double> passed_;  // N s, from there to the last time
  std::vector<double> ahead_;   // N s, of the last time, the part after it
};

}  // namespace strut
