#include "integrators/quasi_static/line_search.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

namespace {

constexpr double enough = 0.5;      // fraction of the power at the start, of either sign, that ends the search
constexpr int most_places = 12;     // evaluations at most; one costs a hundredth of the step
constexpr double margin = 0.02;     // fraction of the remaining interval: least distance from its ends
constexpr double of_failure = 1e3;  // if a point inverts, the power counts as minus this multiple of that at the start

// The interval of the step in which the power changes its sign.
struct Bracket {
  double low, high, power_low, power_high;

  // The zero of the secant; every third time the middle, because a kink keeps the secant on one side.
  double next(bool middle) const {
    const double secant = low + (high - low) * power_low / (power_low - power_high);
    const double wanted = middle ? 0.5 * (low + high) : secant;
    return std::clamp(wanted, low + margin * (high - low), high - margin * (high - low));
  }
  void cut(double at, double power) {
    if (power > 0) {
      low = at, power_low = power;
    } else {
      high = at, power_high = power;
    }
  }
};

}  // namespace

void move_by(Body& body, double factor, const Field& step) {
  for (int i = 0; i < body.owned(); ++i) body.domain.sites[i].current.head<3>() += factor * step[i].array();
}

double power_along(const Equilibrium& equilibrium, const Body& body, const Field& step) {
  double sum = 0;
  for (std::size_t i = 0; i < step.size(); ++i) sum += step[i].dot(equilibrium.residual()[i]);
  return body.domain.communicator.sum(sum);
}

Stop search_downhill(Equilibrium& equilibrium, const Field& step, double power, double drag, const Imbalance& left) {
  Body& body = equilibrium.body();
  Stop stop{1, left};
  const auto power_now = [&] {
    return stop.left.failed ? -of_failure * power : power_along(equilibrium, body, step) - stop.fraction * drag;
  };
  double now = power_now();
  if (now >= 0) return stop;
  Bracket bracket{0, 1, power, now};
  for (int n = 0; n < most_places && std::abs(now) > enough * power; ++n) {
    const double to = bracket.next(n % 3 == 2 || stop.left.failed);
    move_by(body, to - stop.fraction, step);
    stop = {to, equilibrium.evaluate()};
    now = power_now();
    bracket.cut(to, now);
  }
  return stop;
}

}  // namespace strut
