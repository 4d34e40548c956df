#include "base/math/time_integral.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <queue>

namespace strut {

std::vector<double> uneven_times(double from, double to, int parts) {
  constexpr double golden = 0.6180339887498949;
  std::vector<double> times{from};
  for (int k = 1; k < parts; ++k) {
    const double shift = 0.5 * (std::fmod(k * golden, 1) - 0.5);
    times.push_back(from + (to - from) * (k + shift) / parts);
  }
  times.push_back(to);
  return times;
}

std::vector<double> telling_times(const Function& value, const Vector& X, double from, double to, int parts) {
  std::vector<double> times = uneven_times(from, to, parts);
  const std::vector<double> turns = value.turns(X, times);
  const bool few = turns.size() <= times.size();  // not all rows of a long table
  times.insert(times.end(), turns.begin(), turns.end());
  for (std::size_t n = 1; n < turns.size(); ++n) times.push_back(std::midpoint(turns[n - 1], turns[n]));
  for (std::size_t n = 0; few && n < turns.size(); ++n) {
    for (const double beside : {1e-1, 1e-2, 1e-3, 1e-4}) {
      for (const double side : {-beside, beside}) times.push_back(turns[n] + side * (to - from) / parts);
    }
  }
  std::erase_if(times, [&](double t) { return !(t >= from && t <= to); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double time_integral(const Function& value, const Vector& X, double from, double to) {
  if (!value.depends_on_time() || from == to) return (to - from) * value(X, from);
  constexpr int parts = 32, most_halvings = 2000;
  constexpr double accuracy = 1e-10, off = 0.7745966692414834, outer = 5.0 / 18, inner = 8.0 / 18;  // exact to t⁵
  const auto rule = [&](double begin, double end) {
    const double middle = std::midpoint(begin, end), reach = 0.5 * off * (end - begin);
    return (end - begin) * (outer * (value(X, middle - reach) + value(X, middle + reach)) + inner * value(X, middle));
  };
  struct Part {
    double begin, end, left, right, error;  // left, right: integrals over its halves
    bool operator<(const Part& other) const { return error < other.error; }
  };
  std::priority_queue<Part> all;
  double sum = 0, size = 0, error = 0;
  const auto add = [&](double begin, double end, double whole) {
    const double middle = std::midpoint(begin, end);
    Part part{begin, end, rule(begin, middle), rule(middle, end), 0};
    const bool may_halve = end - begin > 16 * std::numeric_limits<double>::epsilon() * std::abs(end);
    if (may_halve) part.error = std::abs(part.left + part.right - whole);
    sum += part.left + part.right, size += std::abs(part.left) + std::abs(part.right), error += part.error;
    all.push(part);
  };
  const std::vector<double> times = telling_times(value, X, from, to, parts);
  for (std::size_t n = 1; n < times.size(); ++n) add(times[n - 1], times[n], rule(times[n - 1], times[n]));
  for (int n = 0; n < most_halvings && error > accuracy * size; ++n) {
    const Part worst = all.top();
    all.pop();
    sum -= worst.left + worst.right, size -= std::abs(worst.left) + std::abs(worst.right), error -= worst.error;
    const double middle = std::midpoint(worst.begin, worst.end);
    add(worst.begin, middle, worst.left);
    add(middle, worst.end, worst.right);
  }
  return sum;
}

}  // namespace strut
