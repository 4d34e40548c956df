#include "setup/sudden_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <variant>

#include "base/math/time_integral.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "setup/blocks.hpp"
#include "setup/changes_in_time.hpp"
#include "setup/found_points.hpp"

namespace strut {

namespace {

// Spacings. A step is some tenths of the time that a wave takes for one spacing, so a jump by a hundredth of a spacing
// throws points at some hundredths of the wave speed.
constexpr double no_jump = 1e-6, sudden = 0.01;

// Strain: a jump sends waves of this strain from all ends of a body. Metals yield at some tens of it.
constexpr double sudden_strain = 1e-4;

// The least time between two jumps of `of_time` by a tenth of its largest value or more, s; infinite without two.
// `acts_before`: the value acts before the start, too.
double shortest_pulse(const OfTime& of_time, double start, double end, bool acts_before) {
  double last = -std::numeric_limits<double>::infinity(), shortest = -last;
  for (const Jump& jump : jumps_of(of_time, start, end)) {
    if (acts_before && jump.time == start) continue;
    shortest = std::min(shortest, jump.time - last);
    last = jump.time;
  }
  return shortest;
}

// The largest change by more than `least`, at the places of the box, that is done within one step.
Jump largest_jump(const Function& value, const Where& where, const Steps& steps, double least) {
  Jump worst;
  over_the_box(value, where, [&](const OfTime& of_time) {
    const Jump jump = strut::largest_jump(of_time, steps, least);
    if (jump.length > worst.length) worst = jump;
  });
  return worst;
}

const PrescribedMotion* displacement_of(const deck::Condition& condition) {
  const auto* motion = std::get_if<PrescribedMotion>(&condition.kind);
  return motion && !motion->is_velocity ? motion : nullptr;
}

// The values of a load, a prescribed velocity or the force on a tool.
std::vector<Function> sampled_values(const deck::Condition& condition) {
  if (const auto* load = std::get_if<BodyForce>(&condition.kind)) return {load->value};
  const auto* motion = std::get_if<PrescribedMotion>(&condition.kind);
  if (motion && motion->is_velocity) return {motion->value};
  std::vector<Function> forces;
  const auto* tool = std::get_if<RigidTool>(&condition.kind);
  if (!tool || !tool->free) return forces;
  for (const std::optional<Function>& force : tool->free->force) {
    if (force) forces.push_back(*force);
  }
  return forces;
}

// The functions of time that give positions of points or of a tool.
std::vector<Function> positions_of(const deck::Condition& condition) {
  if (const PrescribedMotion* motion = displacement_of(condition)) return {motion->value};
  if (const auto* tool = std::get_if<RigidTool>(&condition.kind)) {
    if (!tool->free) return tool->values_at_points();
  }
  return {};
}

// The values whose changes since the start strain a body: temperatures, and the distance of periodic sides.
std::vector<Function> straining_values(const deck::Condition& condition) {
  if (const auto* heats = std::get_if<PrescribedTemperature>(&condition.kind)) return {heats->value};
  if (const auto* sides = std::get_if<PeriodicSides>(&condition.kind)) return {sides->stretch};
  return {};
}

// The time that a wave takes for one spacing of each block, s; 0 of a block without points.
std::vector<double> wave_times(const Body& body) {
  std::vector<double> times;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    times.push_back(body.domain.blocks[b].spacing / wave_speed(body.blocks[b].material));
  }
  return times;
}

// The largest of these numbers of blocks among the points over all ranks.
double largest_at(const std::vector<double>& of_blocks, const std::vector<int>& points, const Body& body) {
  double largest = 0;
  for (const int i : points) largest = std::max(largest, of_blocks[body.domain.cloud.blocks[i]]);
  return body.domain.communicator.max(largest);
}

// About the longest step of some points, s. `by_waves`: the largest of their wave times, which only substeps reach.
double longest_step(const deck::Solver& solver, std::vector<double> times, double by_waves) {
  if (solver.fixed_dt) return *solver.fixed_dt;
  std::erase(times, 0);
  return std::max(solver.subcycling ? by_waves : std::ranges::min(times), solver.scaled_dt.value_or(0));
}

// The largest coefficient of thermal expansion of the points over all ranks, 1/K.
double expansion_of(const std::vector<int>& points, const Body& body) {
  std::vector<double> of_blocks;
  for (const MaterialBlock& block : body.blocks) of_blocks.push_back(block.material.thermal_expansion);
  return largest_at(of_blocks, points, body);
}

}  // namespace

std::string check_initial_displacements(const deck::Deck& deck, const PointsOfConditions& points, const Body& body,
                                        deck::Problems& problems, MayRest may_rest) {
  const double t = deck.solver.initial_time;
  PointsOfConditions moved(points.size());
  for (std::size_t c = 0; c < points.size(); ++c) {
    const PrescribedMotion* motion = displacement_of(deck.conditions[c]);
    if (!motion) continue;
    for (const int i : points[c]) {
      const Vector X = body.domain.reference(i);
      const double u = motion->value.evaluate(X, t);
      if (may_rest == MayRest::yes && std::abs(u) <= no_jump * body.domain.cloud.spacings[i]) continue;
      const auto is_far = [&](int c) {  // from where it is: after equilibria, no more where it was
        return std::abs(u - (body.domain.current(i) - X)[c]) > no_jump * body.domain.cloud.spacings[i];
      };
      if (std::ranges::any_of(motion->components, is_far)) moved[c].push_back(i);
    }
  }
  const std::vector<FoundPoints> found = found_points(body, moved);
  std::ostringstream reported;
  for (std::size_t c = 0; c < points.size(); ++c) {
    if (found[c].count == 0) continue;
    const Function& value = displacement_of(deck.conditions[c])->value;
    std::ostringstream text;
    const double u = value.evaluate(found[c].one[0], found[c].one[1], found[c].one[2], t);
    text << (u == 0 ? 0 : u) << " m at the initial time, t = " << t << " s, where the body is displaced otherwise, by "
         << place_text(found[c].displacement) << ", at " << place_text(found[c].one) << " and " << found[c].count - 1
         << " other points";
    if (deck.solver.quasi_static && !deck.start_from) {
      reported << value.path() << " is " << text.str() << ": the first load step takes all of it\n";
    } else {
      problems.add(value.path(), text.str() +
                                     "; expected the displacement that these points have then, which counts from the "
                                     "mesh, or they would be thrown within one step");
    }
  }
  return reported.str();
}

void check_poles(const deck::Deck& deck, const PointsOfConditions& points, const Body& body, deck::Problems& problems) {
  for (std::size_t c = 0; c < points.size(); ++c) {
    for (const Function& value : sampled_values(deck.conditions[c])) {
      if (!value.depends_on_time()) continue;
      std::optional<double> pole;
      over_the_box(value, where(points[c], body), [&](const OfTime& of_time) {
        if (!pole) pole = pole_of(of_time, deck.solver.initial_time, deck.solver.final_time);
      });
      if (!pole) continue;
      std::ostringstream text;
      text << value.path() << ": '" << value.text() << "' goes to infinity at t = " << to_text(*pole)
           << " s, so that it has no integral over time; expected a value that is finite throughout the run";
      problems.add(text.str());
    }
  }
}

std::string sudden_motions(const deck::Deck& deck, const PointsOfConditions& points, const Body& body) {
  if (deck.solver.quasi_static) return "";
  const std::vector<double> times = wave_times(body);
  std::ostringstream text;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const deck::Condition& condition = deck.conditions[c];
    std::vector<Function> values = positions_of(condition);
    std::ranges::copy(straining_values(condition), std::back_inserter(values));
    if (std::ranges::none_of(values, &Function::depends_on_time)) continue;
    const Where there = where(points[c], body);
    const double step = longest_step(deck.solver, times, largest_at(times, points[c], body));
    const Steps steps{deck.solver.initial_time, deck.solver.final_time, step};
    const auto* sides = std::get_if<PeriodicSides>(&condition.kind);
    const bool heats = std::holds_alternative<PrescribedTemperature>(condition.kind);
    // Meters, or strain by a temperature, per unit of the value; and the least jump that gives a warning.
    const double size = sides ? sides->upper - sides->lower : heats ? expansion_of(points[c], body) : 1;
    const double least = heats ? sudden_strain : sudden * there.spacing;
    for (const Function& value : values) {
      const Jump jump = largest_jump(value, there, steps, least / size);
      if (!(jump.length > 0)) continue;
      text << "WARNING: " << value.path() << ": jumps by " << jump.length;
      if (heats) text << " K, a strain of " << size * jump.length;
      if (sides) text << ", the distance of the sides by " << size * jump.length;
      if (!heats) text << " m, " << size * jump.length / there.spacing << " spacings";
      text << ", at t = " << jump.time << " s: within one step; is it meant to change so suddenly?\n";
    }
  }
  return text.str();
}

std::string sampled_pulses(const deck::Deck& deck, const PointsOfConditions& points, const Body& body) {
  if (deck.solver.quasi_static) return "";
  constexpr double reported = 0.005;  // of the impulse
  const std::vector<double> times = wave_times(body);
  const double step = longest_step(deck.solver, times, std::ranges::max(times));
  const bool acts_before = deck.start_from || deck.next_solver;
  std::ostringstream text;
  text.precision(2);
  for (std::size_t c = 0; c < points.size(); ++c) {
    for (const Function& value : sampled_values(deck.conditions[c])) {
      if (!value.depends_on_time()) continue;
      double pulse = std::numeric_limits<double>::infinity();
      over_the_box(value, where(points[c], body), [&](const OfTime& of_time) {
        pulse = std::min(pulse, shortest_pulse(of_time, deck.solver.initial_time, deck.solver.final_time, acts_before));
      });
      if (!(step > reported * pulse)) continue;
      text << "WARNING: " << value.path() << ": jumps twice within " << pulse
           << " s, and each step takes the value at one "
           << "time: the integral over these is off by up to a step, about " << 100 * step / pulse
           << " %; a ramp over some steps at each end reduces that\n";
    }
  }
  return text.str();
}

namespace {

// A value between two load steps, at which it is `before` and `after`, and by how much it lies outside of these.
struct Missed {
  double value = 0, time = 0, before = 0, after = 0, beyond = 0;
};

// `values`: at these times of one load step. Takes the value that is farthest outside of those at both ends, or, if
// `rate_counts`, farthest from the straight line between them.
void take_missed(const std::vector<double>& values, const std::vector<double>& times, bool rate_counts, Missed& worst) {
  const double before = values.front(), after = values.back(), duration = times.back() - times.front();
  if (!std::isfinite(before) || !std::isfinite(after)) return;  // an error there
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double on_line = std::lerp(before, after, (times[n] - times.front()) / duration);
    const auto [least, most] = rate_counts ? std::pair(on_line, on_line) : std::minmax({before, after});
    const double beyond = std::max(values[n] - most, least - values[n]);
    if (beyond > worst.beyond) worst = {values[n], times[n], before, after, beyond};
  }
}

// How the value of a condition counts in equilibria.
enum class Counts { as_it_is, by_change, by_integral };

// Values of a condition at and between load steps.
struct OverLoadSteps {
  double largest = 0;                     // at load steps
  double zero = 0, most = 0;              // at the start, if changes count; anywhere
  std::array<double, 2> displacements{};  // two integrals over one load step that differ, if any do
  Missed missed;
};

// The integral from one time to another as the run finds it, and by sixteen times as many samples, if this differs by
// more than `reported` of all that the value does: it then has pulses that few samples miss, or turns more often than
// is looked at. `checks`: how many more integrals may take so many samples. Most take none, as a quick sum over
// midpoints finds the same.
std::array<double, 2> two_integrals(const OfTime& of_time, double from, double to, int& checks) {
  constexpr double reported = 0.005;
  constexpr int parts = 16, midpoints = 512;
  const std::vector<double> times = telling_times(of_time.value, of_time.X, from, to, midpoints);
  double sum = 0, size = 0;
  for (std::size_t n = 1; n < times.size(); ++n) {
    const double part = (times[n] - times[n - 1]) * of_time(std::midpoint(times[n - 1], times[n]));
    sum += part, size += std::abs(part);
  }
  if (!std::isfinite(sum)) return {};  // nor is it an error where no point is: the integral stores such values
  const double of_run = time_integral(of_time.value, of_time.X, from, to);
  if (!(std::abs(sum - of_run) > reported * size)) return {};
  --checks, sum = 0;
  for (int n = 0; n < parts; ++n) {
    const double begin = std::lerp(from, to, n / double{parts}), end = std::lerp(from, to, (n + 1) / double{parts});
    sum += time_integral(of_time.value, of_time.X, begin, end);
  }
  if (std::abs(sum - of_run) > reported * size) return {of_run, sum};
  return {};
}

OverLoadSteps over_load_steps(const Function& value, const Where& where, const deck::Solver& solver, Counts counts,
                              bool rate_counts) {
  constexpr int most_between = 16, most_samples = 100000;  // of a load step and of a run
  constexpr int most_integrals = 300;
  int checks = 100;  // of many thousand values each
  const int load_steps = solver.quasi_static->load_steps;
  const int between = std::clamp(most_samples / load_steps, 2, most_between);
  const double start = solver.initial_time, duration = solver.final_time - start;
  OverLoadSteps found;
  over_the_box(value, where, [&](const OfTime& of_time) {
    if (counts == Counts::by_change) found.zero = of_time(start);
    double position = 0;  // of a velocity, up to t
    for (int k = 0; k < load_steps; ++k) {
      const std::vector<double> times = telling_times(value, of_time.X, start + duration * k / load_steps,
                                                      start + duration * (k + 1) / load_steps, between);
      std::vector<double> all;
      for (std::size_t n = 0; n < times.size(); ++n) {
        if (counts == Counts::by_integral && n > 0)  // time_integral() is exact, but takes hundreds of values
          position += (times[n] - times[n - 1]) * of_time(std::midpoint(times[n - 1], times[n]));
        all.push_back(counts == Counts::by_integral ? position : of_time(times[n]) - found.zero);
        if (std::isfinite(all.back())) found.most = std::max(found.most, std::abs(all.back()));
      }
      if (counts == Counts::by_integral && load_steps <= most_integrals && checks > 0 &&
          found.displacements[0] == found.displacements[1])
        found.displacements = two_integrals(of_time, times.front(), times.back(), checks);
      found.largest = std::max({found.largest, std::abs(all.front()), std::abs(all.back())});
      take_missed(all, times, rate_counts, found.missed);
    }
  });
  return found;
}

}  // namespace

std::string values_between_load_steps(const deck::Deck& deck, const PointsOfConditions& points, const Body& body) {
  if (!deck.solver.quasi_static) return "";
  constexpr double reported = 0.06;  // of the largest at load steps: ten a period of a sine miss 5.1 % of that at most
  constexpr double round_off = 1e-12;
  const bool rate_counts = std::ranges::any_of(
      body.blocks, [](const MaterialBlock& block) { return materials::depends_on_rate(block.material.law); });
  std::string text;
  for (std::size_t c = 0; c < points.size(); ++c) {
    const deck::Condition& condition = deck.conditions[c];
    std::vector<Function> values = straining_values(condition);
    const auto* motion = std::get_if<PrescribedMotion>(&condition.kind);
    const Counts counts = !values.empty()                 ? Counts::by_change
                          : motion && motion->is_velocity ? Counts::by_integral
                                                          : Counts::as_it_is;
    std::ranges::copy(positions_of(condition), std::back_inserter(values));
    std::ranges::copy(sampled_values(condition), std::back_inserter(values));
    for (const Function& value : values) {
      if (!value.depends_on_time()) continue;
      const auto [largest, zero, most, displacements, missed] =
          over_load_steps(value, where(points[c], body), deck.solver, counts, rate_counts);
      if (displacements[0] != displacements[1]) {
        text += text_of("WARNING: ", value.path(),
                        ": has pulses or turns that are too many for one load step, whose displacement is ",
                        displacements[0], " m by the samples of the run, and ", displacements[1],
                        " m by sixteen times as many; expected more load steps\n");
      }
      if (!(missed.beyond > reported * largest + round_off * (std::abs(zero) + most))) continue;
      constexpr const char* what[] = {": reaches ", ": changes by ", ": its integral reaches "};
      text += text_of("WARNING: ", value.path(), what[static_cast<int>(counts)], missed.value, " at t = ", missed.time,
                      " s, between two load steps, and ", missed.before, " and ", missed.after, " at these: ",
                      rate_counts ? "equilibria follow the straight line between these, and a material may depend on "
                                    "its rate"
                                  : "the equilibria do not see it",
                      "; are ", deck.solver.quasi_static->load_steps, " load steps enough?\n");
    }
  }
  return text;
}

}  // namespace strut
