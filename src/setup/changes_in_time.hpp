// When and where values of a deck change: their jumps, and the times at which they turn.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "base/math/function.hpp"
#include "mechanics/body.hpp"

namespace strut {

// A value at a place.
struct OfTime {
  const Function& value;
  Vector X;
  double operator()(double t) const { return value.evaluate(X, t); }
};

constexpr int samples_in_a_run = 1000;  // samples of a function of time

struct Jump {
  double time = 0, length = 0;  // s, and m or the unit of a load
};

// The steps of a run.
struct Steps {
  double start, end, longest;  // s
};

// The largest change of `of_time`, more than `least`, within one step, if the steps before and after add less than a
// third of it (a steady motion goes on in them). Its length is 0 if there is none.
Jump largest_jump(const OfTime& of_time, const Steps& steps, double least);

// The jumps of `of_time`, which is 0 before the start, by a tenth of its largest value or more, in order.
std::vector<Jump> jumps_of(const OfTime& of_time, double start, double end);

// A time at which `of_time` goes to infinity so fast that no integral over it exists, near its largest sample; nullopt
// without one.
std::optional<double> pole_of(const OfTime& of_time, double start, double end);

// The box of the points of a condition over all ranks, and their least spacing, m.
struct Where {
  Eigen::AlignedBox3d box;
  double spacing = std::numeric_limits<double>::infinity();
};

// Collective. `points`: owned.
Where where(const std::vector<int>& points, const Body& body);

// Calls visit(of_time) with the value as a function of time at the corners and middles of the box, of its edges and
// faces, or once if it does not depend on place.
void over_the_box(const Function& value, const Where& where, const std::function<void(const OfTime&)>& visit);

// Times in a run, s, in order, at which the value may turn or jump: its jumps and its turns, and the middles between
// these.
std::vector<double> changes_of(const Function& value, const Where& where, double start, double end);

// Every n-th of the times, with the least n that leaves `most` at most.
std::vector<double> thinned(const std::vector<double>& times, int most);

}  // namespace strut
