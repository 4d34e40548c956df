// strut --check: what a run would do, from a real set-up and a few real steps that are thrown away.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include "deck/deck.hpp"
#include "output/variables.hpp"
#include "run/report.hpp"
#include "run/simulation.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

// Seconds a step, the mean of a few.
double measured_step(const deck::Deck& deck, CentralDifference& solver) {
  constexpr int trial_steps = 5;
  const auto start = std::chrono::steady_clock::now();
  int steps = 0;
  for (; steps < trial_steps && solver.time() < deck.solver.final_time; ++steps) {
    solver.advance_velocity(deck.solver.final_time);
    solver.advance_position(false);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / std::max(1, steps);
}

}  // namespace

void check(const std::filesystem::path& deck_file, const Communicator& communicator) {
  const deck::Deck deck = deck::read(deck_file, communicator);
  Scene scene = set_up(deck, communicator);
  output_variables_of(deck, scene.body, scene.contact);
  if (scene.quasi_static) {
    const std::string text = describe_scene(scene);
    if (communicator.rank() == 0) {
      std::cout << text << scene.quasi_static->load_steps << " load steps\n" << deck_file.string() << ": no errors\n";
    }
    return;
  }
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time);
  const double limit = solver.critical_time_step();
  const double step_time = measured_step(deck, solver);
  const double dt = scene.control.fixed_dt > 0 ? scene.control.fixed_dt : scene.control.safety_factor * limit;
  const double steps = std::ceil((deck.solver.final_time - deck.solver.initial_time) / dt);
  const std::string scene_text = describe_scene(scene);
  if (communicator.rank() != 0) return;
  std::cout << scene_text << step_warning(scene.control, limit, deck.solver.initial_time) << "critical time step "
            << limit << " s at the start; about " << steps << " steps of " << dt
            << " s (more where the step must shrink with the deformation)\n"
            << "estimated time " << as_duration(steps * step_time) << " (" << step_time << " s a step, measured)\n"
            << deck_file.string() << ": no errors\n";
}

}  // namespace strut
