// Thermal expansion of points whose temperature T is prescribed: their thermal strain is ε = α (T − T₀).
//   correspondence  F = (1 + ε) F_e: the law sees the rate of the elastic stretch U/(1 + ε)
//   ordinary        extensions less the thermal ones, e − ε |ξ|, each bond with ε of the point itself
// The expansion does work on the body from outside, dW = pull dε, J/m³.
#pragma once

#include <limits>
#include <vector>

#include "base/math/function.hpp"

namespace strut {

struct Body;

// The points of a condition, and their temperature.
struct HeatedPoints {
  std::vector<int> points;  // owned
  Function temperature;     // of the reference position and time, K
};

struct PointExpansion {
  double before = 0, now = 0;  // ε at the start and at the end of the point's last step
  double pull = 0;             // −J tr σ/(1 + ε), J/m³ of the reference volume: the work of expansion, by ε
  double work = 0;             // J/m³, so far, also in runs that this one continues or starts from
  double reference = std::numeric_limits<double>::quiet_NaN();  // T₀, K; NaN until a temperature is prescribed

  // Counts the work of the step, by the mean pull of its ends.
  void count(double pull_now) {
    work += 0.5 * (pull + pull_now) * (now - before);
    pull = pull_now;
  }

  static constexpr double PointExpansion::*numbers[] = {&PointExpansion::now, &PointExpansion::pull,
                                                        &PointExpansion::work, &PointExpansion::reference};
};

// Adds heated points; where several overlap, the last ones count.
void add_heated(Body& body, HeatedPoints heated);

// Takes the temperatures at time t (s) as T₀ of the points that have none.
void set_reference_temperatures(Body& body, double t);

// Begins the own steps, which end at `time` (s), of the points that are due at this level: ε changes to that at their
// end. A step of no length, dt = 0, leaves ε as it is.
void set_expansion(Body& body, double time, double dt, int level = 0);

// The largest change of ε on this rank, if points had the temperatures at time t (s) now.
double sudden_expansion(Body& body, double t);

// Collective: tells ghosts ε.
void exchange_expansion(Body& body);

// True if any point of the block has or had a prescribed temperature by which it expands.
bool expands(const Body& body, std::size_t block);

}  // namespace strut
