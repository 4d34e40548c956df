// The section Solver: the simulated time and its steps.
#pragma once

#include <optional>

#include "deck/forward.hpp"

namespace strut::deck {

// Loads without inertia.
struct QuasiStatic {
  bool with_tangent{};  // Newton; else dynamic relaxation
  int load_steps{};
  double tolerance{};
  int most_iterations{};
};

struct Solver {
  double initial_time{}, final_time = 0;    // s
  std::optional<double> wall_time;          // s, of the computer, after which the run ends itself; nullopt: no limit
  bool verbose{};                           // prints each iteration of an equilibrium, or the balance of the ranks
  std::optional<QuasiStatic> quasi_static;  // else explicit steps:
  std::optional<double> fixed_dt;           // s; else from the critical time step
  double safety_factor{};
  bool subcycling{};
  std::optional<double> scaled_dt;  // s; the step that mass scaling aims at
  double most_added_mass{};         // by mass scaling, relative to the whole mass
  bool keeps_velocities{};          // of a second solver: of the last load step before it; else bodies begin at rest
  double rebalance{};               // largest work of a rank over the mean; above it points are partitioned again

  double duration() const { return final_time - initial_time; }
};

Section solver_section();
Section next_solver_section();
Solver read_solver(const Values& deck, Problems& problems);
// The section "Solver 2", explicit steps after equilibria; nullopt without it.
std::optional<Solver> read_next_solver(const Values& deck, const Solver& first, Problems& problems);

}  // namespace strut::deck
