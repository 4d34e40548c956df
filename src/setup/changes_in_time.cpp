#include "setup/changes_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/math/time_integral.hpp"
#include "topology/bounding_box.hpp"

namespace strut {

namespace {

constexpr int halvings = 40;  // bisections between two samples that distinguish a jump from a steep slope

// The jump of a function between `from` and `to`, by halving the interval toward its largest change: the change over a
// steep slope vanishes, that of a jump stays. With a `length` (s): the change over the part of this length in which the
// function changes most. Ends at a part whose halves change by less than `least`.
Jump jump_between(const OfTime& of_time, double from, double to, double length = 0, double least = 0) {
  for (int n = 0; n < halvings && to - from > length; ++n) {
    const double middle = 0.5 * (from + to), at_middle = of_time(middle);
    const double first = std::abs(at_middle - of_time(from)), second = std::abs(of_time(to) - at_middle);
    if (std::max(first, second) < least) return {to, std::max(first, second)};
    (first > second ? to : from) = middle;
  }
  return {to, std::abs(of_time(to) - of_time(from))};
}

// The change of a step that begins at `from`, if those before and after it add less than a third of it.
double change_at_once(const OfTime& of_time, double from, const Steps& steps) {
  const double step = steps.longest, to = from + step;
  const double change = std::abs(of_time(to) - of_time(from));
  const double before = std::abs(of_time(from) - of_time(std::max(steps.start, from - step)));
  const double after = std::abs(of_time(to + step) - of_time(to));
  return 3 * (before + after) < change ? change : 0;
}

}  // namespace

std::vector<double> thinned(const std::vector<double>& times, int most) {
  const int least = (static_cast<int>(times.size()) + most - 1) / most;
  const int stride = least | 1;  // odd, as turns and the middles between them alternate
  std::vector<double> some;
  for (std::size_t n = 0; n < times.size(); n += stride) some.push_back(times[n]);
  return some;
}

Jump largest_jump(const OfTime& of_time, const Steps& steps, double least) {
  const std::vector<double> times = telling_times(of_time.value, of_time.X, steps.start, steps.end, samples_in_a_run);
  Jump worst;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double a = times[k - 1], b = std::max(times[k], a + steps.longest);
    if (!(std::abs(of_time(b) - of_time(a)) > 0.5 * least)) continue;  // a half, if it goes on beyond b
    const double near = jump_between(of_time, a, b, steps.longest).time;
    for (const double part : {1.0, 0.75, 0.5, 0.25, 0.0}) {
      const double from = std::max(steps.start, near - part * steps.longest);
      const double change = change_at_once(of_time, from, steps);
      if (!(change > std::max(least, worst.length))) continue;
      const double time = jump_between(of_time, from, from + steps.longest).time;
      if (time <= steps.end) worst = {time, change};
    }
  }
  return worst;
}

std::vector<Jump> jumps_of(const OfTime& of_time, double start, double end) {
  const std::vector<double> times = telling_times(of_time.value, of_time.X, start, end, samples_in_a_run);
  std::vector<double> samples;
  double largest = 0;
  for (const double t : times) {
    samples.push_back(of_time(t));
    largest = std::max(largest, std::abs(samples.back()));
  }
  std::vector<Jump> jumps;
  if (std::abs(samples.front()) > 0.1 * largest) jumps.push_back({start, std::abs(samples.front())});
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (!(std::abs(samples[k] - samples[k - 1]) > 0.1 * largest)) continue;
    const Jump jump = jump_between(of_time, times[k - 1], times[k], 0, 0.05 * largest);
    if (jump.length > 0.1 * largest) jumps.push_back(jump);
  }
  return jumps;
}

// By its growth toward this time, again and again: a pulse ceases to grow, and a root's inverse grows by 2.8 each time.
bool is_pole(const OfTime& of_time, double at, double apart) {
  constexpr double nearer = 8, growth = 4;
  const auto beside = [&](double away) {
    return std::fmax(std::abs(of_time(at - away)), std::abs(of_time(at + away)));
  };
  double away = std::max(1e-6 * apart, 1e7 * std::numeric_limits<double>::epsilon() * std::abs(at));
  double size = beside(away);
  for (int n = 0; n < 4 && !std::isinf(size); ++n) {
    away /= nearer;
    const double before = std::exchange(size, beside(away));
    if (!(size > growth * before)) return false;
  }
  return true;
}

// By ternary search, and where the value may turn, as a divisor does.
std::optional<double> pole_of(const OfTime& of_time, double start, double end) {
  if (!std::isfinite(of_time(start))) return std::nullopt;  // an error if a point is there
  const double apart = (end - start) / samples_in_a_run;
  const auto size = [&of_time](double t) { return std::abs(of_time(t)); };
  double highest = start;
  for (int k = 1; k <= samples_in_a_run; ++k) {
    if (size(start + k * apart) > size(highest)) highest = start + k * apart;
  }
  double from = std::max(start, highest - apart), to = std::min(end, highest + apart);
  for (int n = 0; n < 2 * halvings; ++n) {
    const double low = from + (to - from) / 3, high = to - (to - from) / 3;
    (size(low) < size(high) ? from : to) = size(low) < size(high) ? low : high;
  }
  std::vector<double> suspects = of_time.value.turns(of_time.X, uneven_times(start, end, samples_in_a_run));
  suspects.push_back(0.5 * (from + to));
  const auto found = std::ranges::find_if(suspects, [&](double at) { return is_pole(of_time, at, apart); });
  return found == suspects.end() ? std::nullopt : std::optional(*found);
}

Where where(const std::vector<int>& points, const Body& body) {
  Where all;
  for (const int i : points) {
    all.box.extend(body.domain.reference(i));
    all.spacing = std::min(all.spacing, body.domain.cloud.spacings[i]);
  }
  all.box = common_box(all.box, body.domain.communicator);
  all.spacing = body.domain.communicator.min(all.spacing);
  return all;
}

void over_the_box(const Function& value, const Where& where, const std::function<void(const OfTime&)>& visit) {
  if (value.depends_on_position() && where.box.isEmpty()) return;
  for (int place = 0; place < (value.depends_on_position() ? 27 : 1); ++place) {
    const Vector part(0.5 * (place % 3), 0.5 * (place / 3 % 3), 0.5 * (place / 9));
    const Vector X = where.box.min() + part.cwiseProduct(where.box.sizes());
    visit({value, X});
  }
}

std::vector<double> changes_of(const Function& value, const Where& where, double start, double end) {
  if (!value.depends_on_time()) return {};
  const std::vector<double> samples = uneven_times(start, end, samples_in_a_run);
  std::vector<double> times;
  over_the_box(value, where, [&](const OfTime& of_time) {
    std::ranges::copy(value.turns(of_time.X, samples), std::back_inserter(times));
    for (const Jump& jump : jumps_of(of_time, start, end)) times.push_back(jump.time);
  });
  std::erase_if(times, [&](double t) { return !(t > start && t < end); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (std::size_t n = 1, count = times.size(); n < count; ++n) times.push_back(0.5 * (times[n - 1] + times[n]));
  std::ranges::sort(times);
  return times;
}

}  // namespace strut
