#include "deck/sections/solver.hpp"

#include "base/numbers.hpp"
#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

const char* const name = "Solver";
const char* const next_name = "Solver 2";
const char* const own_solver = "equilibria are found in another way";

const ChoiceKey<bool> with_tangent(
    {.name = "Method",
     .fallback = "Newton",
     .meaning =
         "Newton's method with the tangent, or damped motion without it. Where Newton fails, the other continues."},
    {{"Newton", true}, {"Dynamic Relaxation", false}});

const IntegerKey load_steps({.name = "Number of Load Steps",
                             .range = {.low = 1},
                             .fallback = "10",
                             .meaning = "Number of equal load steps. A step without equilibrium is halved."});

const RealKey tolerance({.name = "Tolerance",
                         .range = {.low = 0, .high = 1, .with_low = false, .with_high = false},
                         .fallback = "1e-6",
                         .meaning = "Residual force over reactions, loads and contact forces, in each piece that bonds "
                                    "connect."});

const IntegerKey most_iterations({.name = "Maximum Solver Iterations",
                                  .range = {.low = 1},
                                  .fallback = "20",
                                  .meaning = "Newton iterations of a load step before damped motion takes over."});

Section quasi_static_section() {
  return {.name = "QuasiStatic",
          .meaning =
              "A series of equilibria without inertia, instead of Verlet. Strain rates follow from the times of the "
              "conditions. Bonds of elastic solids break between equilibria, by Critical Stretch, or Cohesive Crack in "
              "quadratic "
              "cells; with a Damage Model there are no tools, contact, symmetry planes or temperatures.",
          .keys = {with_tangent, load_steps, tolerance, most_iterations,
                   without_effect({.name = "Absolute Tolerance", .range = positive},
                                  "what may be left is a part of the forces that act: Tolerance"),
                   without_effect({.name = "Belos Linear Solver", .kind = Kind::text}, own_solver),
                   without_effect({.name = "Disable Heuristics", .kind = Kind::boolean}, own_solver),
                   without_effect({.name = "Damped Newton Diagonal Scale Factor"}, own_solver),
                   without_effect({.name = "Damped Newton Diagonal Shift Factor"}, own_solver)},
          .hints = {{"Adaptive Load-Stepping",
                     "unknown section; a load step that finds no equilibrium is cut in halves by itself"}}};
}
const Section quasi_static = quasi_static_section();

QuasiStatic read_quasi_static(const Values& values) {
  return {.with_tangent = values[with_tangent],
          .load_steps = values[load_steps],
          .tolerance = values[tolerance],
          .most_iterations = values[most_iterations]};
}

const OptionalKey<double> fixed_dt(
    {.name = "Fixed dt", .unit = "s", .range = positive, .meaning = "Constant time step."});

const RealKey safety_factor({.name = "Safety Factor",
                             .range = {.low = 0, .high = 1, .with_low = false},
                             .fallback = "0.8",
                             .meaning = "Time step over the critical time step, which follows the deformation; a step "
                                        "is kept until this ratio exceeds 1.05 times the factor."});

const BooleanKey subcycling(
    {.name = "Subcycling",
     .fallback = "true",
     .meaning = "Points that limit the time step take smaller steps of their own (not with a fixed step)."});

const OptionalKey<double> scaled_dt(
    {.name = "Mass Scaling dt",
     .unit = "s",
     .range = positive,
     .meaning = "Mass scaling: points that would make the first step shorter get additional mass (reported). Contact "
                "and deformation may shorten later steps."});

const RealKey most_added_mass({.name = "Most Added Mass",
                               .range = {.low = 0, .with_low = false},
                               .fallback = "0.05",
                               .meaning = "Limit of the additional mass over the whole mass; more is an error."});

const RealKey rebalance({.name = "Rebalance",
                         .range = {.low = 1, .with_low = false},
                         .fallback = "1.3",
                         .meaning = "A new partition is made if the largest work of a rank exceeds this multiple of "
                                    "the mean and the remaining run is worth it. Fields keep their bits. 1e9: never."});

const Section verlet = {.name = "Verlet",
                        .meaning = "Explicit steps by central differences, with a fixed step or a safety factor.",
                        .keys = {fixed_dt, safety_factor, subcycling, scaled_dt, most_added_mass, rebalance}};

const BooleanKey verbose(
    {.name = "Verbose",
     .fallback = "false",
     .meaning = "Prints each iteration (QuasiStatic), or the load balance of several ranks every 100 steps (Verlet)."});

const RealKey initial_time({.name = "Initial Time", .unit = "s", .fallback = "0", .meaning = "Begin of the run."});

const RealKey final_time({.name = "Final Time", .unit = "s", .meaning = "End of the run."});

const OptionalKey<double> wall_time(
    {.name = "Wall Time",
     .unit = "s",
     .range = positive,
     .meaning = "After this time, set-up included, the run ends with a checkpoint (none with Solver 2), a last frame "
                "and the exit "
                "status 3. Choose the job's limit less the time of a step, a frame and a checkpoint."});

const BooleanKey keeps_velocities(
    {.name = "Keep Velocities",
     .fallback = "false",
     .meaning = "true: points begin with the velocities of the last load step, as in Peridigm; else at rest."});

void check_times(const Values& values, Problems& problems) {
  if (!values.has(initial_time) || !values.has(final_time)) return;
  const double begin = values[initial_time], end = values[final_time];
  if (end > begin) return;
  problems.add(values.path_to(final_time),
               "'" + to_text(end) + "'; expected > Initial Time (" + to_text(begin) + "), in s");
}

}  // namespace

Section solver_section() {
  return {.name = name,
          .required = true,
          .meaning = "Simulated time and its steps.",
          .keys = {verbose, without_effect({.name = "Peridigm Preconditioner", .kind = Kind::text}, own_solver),
                   without_effect({.name = "Finite Difference Probe Length", .range = positive}, own_solver),
                   initial_time, final_time, wall_time},
          .sections = {verlet, quasi_static},
          .hints = {{"Implicit", "unknown section; there are 'Verlet', and 'QuasiStatic' for loads without inertia"}}};
}

namespace {

Solver read_one(const Values& values, Problems& problems) {
  const Values& steps = values.section(verlet.name);
  Solver solver{.initial_time = values[initial_time],
                .final_time = values[final_time],
                .wall_time = values[wall_time],
                .verbose = values[verbose],
                .fixed_dt = steps[fixed_dt],
                .safety_factor = steps[safety_factor],
                .subcycling = steps[subcycling],
                .scaled_dt = steps[scaled_dt],
                .most_added_mass = steps[most_added_mass],
                .rebalance = steps[rebalance]};
  if (values.has_section(quasi_static.name)) {
    solver.quasi_static = read_quasi_static(values.section(quasi_static.name));
    if (values.has_section(verlet.name)) {
      problems.add(values.path(), "'Verlet' and 'QuasiStatic' are both given; expected one of them");
    }
  }
  check_one_of(steps, fixed_dt, safety_factor, problems);
  check_one_of(steps, fixed_dt, scaled_dt, problems);
  if (steps.given(most_added_mass) && !steps.given(scaled_dt))
    problems.note(steps.path_to(most_added_mass), "has no effect without Mass Scaling dt");
  return solver;
}

}  // namespace

Section next_solver_section() {
  Section section = solver_section();
  section.name = next_name;
  section.required = false;
  section.meaning =
      "Explicit steps after the equilibria of Solver: a body is loaded slowly, then struck. Conditions that need "
      "inertia (initial velocities, tools with a mass, non-reflecting ends) begin here; bonds that hold in equilibria "
      "may break. Initial Time is Solver's Final Time; Wall Time, QuasiStatic and mass scaling are errors here.";
  section.keys.push_back(keeps_velocities);
  return section;
}

Solver read_solver(const Values& deck, Problems& problems) {
  check_times(deck.section(name), problems);
  return read_one(deck.section(name), problems);
}

std::optional<Solver> read_next_solver(const Values& deck, const Solver& first, Problems& problems) {
  if (!deck.has_section(next_name)) return std::nullopt;
  const Values& values = deck.section(next_name);
  Solver next = read_one(values, problems);
  next.keeps_velocities = values[keeps_velocities];
  if (values.given(initial_time)) {
    check_times(values, problems);
  } else {
    next.initial_time = first.final_time;
  }
  if (!first.quasi_static || next.quasi_static) {
    problems.add(next_name,
                 "expected explicit steps (Verlet) after equilibria (Solver > QuasiStatic): no other solvers "
                 "follow each other in one deck");
  }
  if (next.initial_time != first.final_time) {
    problems.add(values.path_to(initial_time), "'" + to_text(next.initial_time) +
                                                   "'; expected the Final Time of Solver (" +
                                                   to_text(first.final_time) + "), in s, or no such key");
  }
  if (!(next.final_time > next.initial_time) && values.has(final_time) && !values.given(initial_time)) {
    problems.add(values.path_to(final_time), "'" + to_text(next.final_time) +
                                                 "'; expected > the Final Time of Solver (" +
                                                 to_text(first.final_time) + "), in s");
  }
  if (next.wall_time) {
    problems.add(values.path_to(wall_time), "given; expected none: that of Solver is the time of both");
  }
  if (next.scaled_dt) {
    problems.add(values.section(verlet.name).path_to(scaled_dt),
                 "given; expected none: masses are scaled from the start "
                 "or not at all");
  }
  return next;
}

}  // namespace strut::deck
