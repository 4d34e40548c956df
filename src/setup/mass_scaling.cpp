#include "setup/mass_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "integrators/explicit/critical_time_step.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

namespace {

void scale(const std::vector<double>& densities, const std::vector<double>& bounds, double highest, Body& body) {
  body.mass_scale.use(body.owned(), 1);
  for (int i = 0; i < body.owned(); ++i) {
    body.mass_scale[i] = std::max(1.0, std::pow(bounds[i] / highest, 2));
    body.density[i] = body.mass_scale[i] * densities[i];
  }
}

// The highest frequency bound (1/s) for a critical time step of `wanted` (s); 0 if the step is as long without scaling.
double highest_for(double wanted, Body& body) {
  constexpr int most_trials = 20;
  constexpr double lower = 0.99;  // factor by which each trial undershoots the estimate
  const std::vector<double> densities = body.density, bounds = frequency_bounds(body);
  advance_stress(body, 0, false);
  CriticalTimeStep estimate;
  double critical = estimate.estimate(body);
  if (critical >= wanted) return 0;
  double highest = body.domain.communicator.max(bounds.empty() ? 0.0 : *std::ranges::max_element(bounds));
  for (int trial = 0; trial < most_trials && critical < wanted; ++trial) {
    highest *= lower * critical / wanted;
    scale(densities, bounds, highest, body);
    critical = estimate.estimate(body);
  }
  return highest;
}

struct Added {
  double mass = 0, added = 0, points = 0, scaled = 0;

  double fraction() const { return mass > 0 ? added / mass : 0; }
};

// The added mass of each block, then of all.
std::vector<Added> added_to(const Body& body) {
  const std::size_t blocks = body.blocks.size();
  std::vector<double> sums(4 * (blocks + 1), 0);
  for (int i = 0; i < body.owned(); ++i) {
    const double mass = body.mass(i) / body.mass_scale[i];
    for (const std::size_t b : {static_cast<std::size_t>(body.domain.cloud.blocks[i]), blocks}) {
      double* of_block = &sums[4 * b];
      of_block[0] += mass, of_block[1] += body.mass(i) - mass;
      of_block[2] += 1, of_block[3] += body.mass_scale[i] > 1 ? 1 : 0;
    }
  }
  body.domain.communicator.sum(sums);
  std::vector<Added> all;
  for (std::size_t b = 0; b <= blocks; ++b) {
    all.push_back({sums[4 * b], sums[4 * b + 1], sums[4 * b + 2], sums[4 * b + 3]});
  }
  return all;
}

std::string percent(double fraction) { return text_of(std::setprecision(3), 100 * fraction, " %"); }

// `most`: the largest fraction of added mass that all blocks together may have.
std::string report_of(const Body& body, const std::vector<Added>& added, double wanted, double most) {
  std::ostringstream text;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (added[b].scaled == 0) continue;  // what round-off adds is no mass
    text << "mass scaling for a step of " << wanted << " s: block '" << body.blocks[b].name << "' gets "
         << added[b].added << " kg, " << percent(added[b].fraction()) << " of its own, on " << added[b].scaled << " of "
         << added[b].points << " points\n";
    if (added[b].fraction() > most)
      text << "WARNING: the inertia of block '" << body.blocks[b].name << "' grows by " << percent(added[b].fraction())
           << ", more than Most Added Mass, which limits that of all blocks together; expected a shorter step\n";
  }
  text << "mass scaling: " << added.back().added << " kg in all, " << percent(added.back().fraction())
       << "; inertia, momentum and kinetic energy are those of the larger mass\n";
  return text.str();
}

}  // namespace

void scale_masses(double highest, Body& body) {
  if (highest > 0) scale(std::vector<double>(body.density), frequency_bounds(body), highest, body);
}

double scale_masses(const deck::Deck& deck, Body& body, std::string& report) {
  if (!deck.solver.scaled_dt) return 0;
  const double wanted = *deck.solver.scaled_dt;
  const double highest = highest_for(wanted / deck.solver.safety_factor, body);
  if (highest == 0) {
    report += "mass scaling adds nothing: the step is " + to_text(wanted) + " s or longer without\n";
    return 0;
  }
  const std::vector<Added> added = added_to(body);
  const double fraction = added.back().fraction(), most = deck.solver.most_added_mass;
  raise_together(body.domain.communicator, fraction > most
                                               ? "Solver > Verlet > Mass Scaling dt: a step of " + to_text(wanted) +
                                                     " s takes " + percent(fraction) + " more mass; expected " +
                                                     percent(most) + " at most (Most Added Mass): want a shorter step"
                                               : "");
  report += report_of(body, added, wanted, most);
  return highest;
}

}  // namespace strut
