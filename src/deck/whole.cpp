#include "deck/whole.hpp"

#include "deck/sections/blocks.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/contact.hpp"
#include "deck/sections/damage_models.hpp"
#include "deck/sections/discretization.hpp"
#include "deck/sections/history.hpp"
#include "deck/sections/materials.hpp"
#include "deck/sections/node_sets.hpp"
#include "deck/sections/output.hpp"
#include "deck/sections/restart.hpp"
#include "deck/sections/several_sections.hpp"
#include "deck/sections/solver.hpp"
#include "deck/sections/start_from.hpp"
#include "deck/sections/watch.hpp"

namespace strut::deck {

const Section& schema() {
  static const std::string one_solver =
      "unknown section; at most two solvers follow each other, equilibria and explicit steps: 'Solver', 'Solver 2'";
  static const Section whole = {
      .meaning = "",
      .keys = {verbose_without_effect()},
      .sections = {discretization_section(), node_sets_section(), materials_section(), damage_models_section(),
                   blocks_section(), contact_section(), conditions_section(), start_from_section(), solver_section(),
                   next_solver_section(), output_section(), history_section(), restart_section(), watch_section()},
      .hints = {{"Interfaces", "unknown section; there are no interfaces between elements"},
                {"Problem",
                 "unknown section; this is the oldest layout of Peridigm's decks: its sections belong to the "
                 "deck itself"},
                {"Solver 3", one_solver}}};
  return whole;
}

}  // namespace strut::deck
