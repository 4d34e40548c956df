#include "run/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <utility>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "mechanics/steepness.hpp"

namespace strut {

namespace {

// Number of ledgers at the start of a run whose errors do not count: relative to the small energies they are large.
constexpr int first_ledgers = 10;

// Above this fraction of the final internal energy, the springs of the stabilization carry what the law should: users
// of explicit finite elements accept 5 to 10 % of hourglass energy. In the first microseconds of an impact it is more.
constexpr double much_in_springs = 0.1;

// Bodies that have taken up less than this part of what all have do not count: one that was hardly touched.
constexpr double least_of_all = 1e-3;

// Stretch of neighbors, in spacings, above which the material between them is not resolved any more.
constexpr double far_stretched = 8;

// Above this largest |ln det F| laws in rate form may cause a balance error: their stored energy errs by a third of it.
constexpr double much_volume = 0.02;

constexpr double of_gains = 0.2;  // limit of an energy gain over that of a loss

// Least fraction of the plastic work that gets a warning if load steps miss it: a compression in ten steps misses half
// of what flows in the one in which it begins to, 5 %.
constexpr double much_missed = 0.1;

// Energy that cracks take over that which they take in short steps, estimated (BreaksInSteps): below the least, or
// above the most, steps are too long. It is 0.95 to 1 in impacts and fast cracks of glass, concrete and steel, 1.2 by
// the energy of bonds. Halves thrown apart take 0.25 to 0.8 of their energy at an estimate of 0.4 to 0.5, 2.1 at 2.
constexpr double least_taken = 0.7, most_taken = 1.6;
// Part of the critical stretch that steps may take a bond that breaks: then cracks take 0.95 to 1.1 of their energy.
constexpr double resolved = 0.2;

// `text` on the first rank where `here` is true, else nothing.
std::string of_first(const Body& body, bool here, const std::string& text) {
  const Communicator& ranks = body.domain.communicator;
  return ranks.first_rank(here) == ranks.rank() ? text : "";
}

// `text` on the first of the ranks with the largest value over all ranks, else nothing.
std::string of_largest(const Body& body, double own, const std::string& text) {
  return of_first(body, own == body.domain.communicator.max(own), text);
}

// The point that limits the time step.
std::string fastest_point(const Body& body) {
  double largest = -1;
  int fastest = -1;
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const int i = block.points[k];
      const double here = frequency_bound(body, block, static_cast<int>(k)) * body.step_fraction(i);
      if (here > largest) largest = here, fastest = i;
    }
  }
  if (fastest < 0) return of_largest(body, largest, "");
  const double J = body.points[fastest].deformation_gradient.determinant();
  return of_largest(body, largest, text_of(locate(body, fastest), ", det F = ", J));
}

// True for laws in rate form, which define no stored energy: the ledger then uses J σ:ε/2 of the present stress.
bool is_of_rates(const MaterialBlock& block) {
  if (block.is_ordinary()) return false;
  return std::visit(
      []<class L>(const L& law) {
        return !requires(const typename L::State& state) { law.stored_energy(state); };
      },
      block.material.law);
}

// Collective. The largest |ln det F| of the points of such laws.
double largest_volume_change(const Body& body) {
  double largest = 0;
  for (const MaterialBlock& block : body.blocks) {
    if (!is_of_rates(block)) continue;
    for (const int i : block.points) {
      const double J = body.points[i].deformation_gradient.determinant();
      if (J > 0) largest = std::max(largest, std::abs(std::log(J)));
    }
  }
  return body.domain.communicator.max(largest);
}

// Collective. `steps`: of time, not of load.
std::string balance_of(const Ledger& ledger, const Body& body, bool steps) {
  if (!std::isfinite(ledger.balance_error)) {
    return "energies are too large for a number. Likely causes: a load, a speed or a density far too large";
  }
  const double change = largest_volume_change(body);
  const bool expands = body.domain.communicator.any(!body.expansion.empty());  // a rank may have no points
  const std::string of_rates =
      change > much_volume
          ? text_of(", the law of points whose volume has changed by a factor of up to ", std::exp(change),
                    ": it follows from rates alone, and what it stores errs by up to ", 100 * change / 3, " %")
          : "";
  return text_of("the balance of energy has an error of ", 100 * ledger.balance_error, " % of the largest energy, ",
                 std::abs(ledger.gained), " J ", ledger.gained > 0 ? "out of nothing" : "that nothing accounts for",
                 ": the run is ", ledger.gained > 0 && steps ? "unstable, or " : "",
                 "too coarse in time (Watch > Balance Error). Likely causes: ",
                 steps ? "a Fixed dt above the critical time step, a load too sudden, contact, a tool with a Mass or "
                         "one with friction that meets points with substeps (Subcycling)"
                       : "too few load steps (the work of each is that of the mean of the forces at its ends: one that "
                         "jumps from nothing errs most), a Tolerance too large",
                 expands ? ", thermal expansion of a law without an energy of its own, whose balance errs by some part "
                           "of the thermal strain"
                         : "",
                 of_rates, steps ? "; the last frame shows where points fly off" : "");
}

// Collective. The first point without a number as its force, velocity or place, on one rank; nothing where all have
// one.
std::string without_a_number(const Body& body) {
  int point = -1;
  for (int i = body.owned(); i-- > 0;) {
    const bool is_right =
        body.current(i).allFinite() && body.velocity[i].allFinite() && body.force_density[i].allFinite();
    if (!is_right) point = i;
  }
  return of_first(body, point >= 0,
                  "the force, velocity or place of a point is not a number: " + locate(body, point) +
                      ". Likely causes: a tool or a condition that has put several points in one place (bonds between "
                      "them have no direction), a load or a speed far too large");
}

}  // namespace

std::string Monitor::at(double time) { return text_of("at t = ", time, " s "); }

void Monitor::warn_once(What what, const std::string& text) {
  if (!warned_[what] && !text.empty()) print_("WARNING: " + text + " (told once)");
  warned_[what] = true;
}

void Monitor::passed(What what, const std::string& text) {
  if (limits_.stops) raise_together(body_.domain.communicator, text);
  warn_once(what, text);
}

void Monitor::check_step(const CentralDifference& solver) {
  dt_ = solver.dt();
  if (solver.went_on())
    warn_once(point, solver.warning().empty() ? "" : solver.warning() + " (Watch > Inverted Points)");
  const double now = solver.critical_time_step();  // the step that is taken may be shorter at the end of the run
  if (first_step_ == 0) first_step_ = now;
  const contact::Contact& contact = solver.contact();
  if (!(now >= limits_.smallest_step * first_step_) && !(is_silent(step) && std::isfinite(now))) {
    std::string text = fastest_point(body_);
    if (!text.empty()) {
      text =
          text_of(at(solver.time()), "the critical time step has fallen to ", now, " s from ", first_step_,
                  " s (Watch > Smallest Step): the stiffest is ", text,
                  ". Likely causes: a point is being crushed flat or turned inside out, too little stabilization, or "
                  "bodies in contact that are far too stiff");
    }
    passed(step, text);
    if (!std::isfinite(now)) raise_together(body_.domain.communicator, text);
  }
  if (contact.penetration() > limits_.penetration && !is_silent(penetration)) {
    const contact::DeepestPenetration deepest = contact.deepest();
    std::string text;
    if (deepest.point >= 0 && deepest.penetration == contact.penetration()) {
      text = text_of(
          at(solver.time()), "contact is penetrated by ", 100 * deepest.penetration, " % of ",
          deepest.of_surfaces ? "a spacing" : "the distance at which points touch",
          " (Watch > Penetration): ", locate(body_, deepest.point), ". Likely causes: ",
          deepest.of_surfaces
              ? "a Stiffness Factor that is too small for the speed, a Largest Overlap of 0 (no limit) or near 1"
              : "a Spring Constant that is too small for the speed (of Hertz an Effective Modulus), a Contact Radius "
                "below the spacing");
    }
    passed(penetration, of_first(body_, !text.empty(), text));
  }
}

void Monitor::serialize(Archive& archive, std::size_t tools) {
  archive.number("first_step", first_step_);
  archive.number("ledgers", ledgers_);
  archive.number("next_look", next_interpenetration_);
  archive.number("told_error", warned_error_);
  archive.number("next_undeclared", next_undeclared_);
  archive.number("next_tools", next_tools_);
  archive.number("next_energy", next_energy_);
  archive.number("failed_before", failed_before_);
  archive.number("most_in_contact", most_in_contact_);
  archive.number("part_in_contact", part_in_contact_);
  for (int what = 0; what < count; ++what) archive.number("told_" + std::to_string(what), warned_[what]);
  overlapped_.resize(tools * tools, 0);
  for (std::size_t pair = 0; pair < overlapped_.size(); ++pair)
    archive.number("overlapped_" + std::to_string(pair), overlapped_[pair]);
}

// For texts that all ranks have: rank 0 prints them.
void Monitor::warn(What what, const std::string& text) {
  warn_once(what, body_.domain.communicator.rank() == 0 ? text : "");
}

void Monitor::check_energy(const Ledger& ledger, bool last) {
  const double error = ledger.balance_error;
  next_energy_ = ledger.time + pause();
  if (++ledgers_ <= first_ledgers && !last && std::isfinite(error)) return;
  const double limit = (ledger.gained > 0 ? of_gains : 1) * limits_.balance_error;
  if (!std::isfinite(error)) {
    const std::string point = without_a_number(body_);
    raise_together(body_.domain.communicator, point.empty() ? "" : at(ledger.time) + point);
  }
  const bool exceeds = !(error <= std::min(limit, worth_a_warning));
  const std::string text = exceeds ? at(ledger.time) + balance_of(ledger, body_, dt_ > 0) : "";
  if (!(error <= limit)) {
    const std::string once = body_.domain.communicator.rank() == 0 ? text : "";
    passed(energy, once);
    if (!std::isfinite(error)) raise_together(body_.domain.communicator, once);
  } else if (error > worth_a_warning) {
    if (last && error > 2 * warned_error_) warned_[imbalance] = false;
    if (!warned_[imbalance]) warned_error_ = error;
    warn(imbalance, text);
  }
  warn_if_negative(turning, "the kinetic energy", ledger.kinetic, ledger,
                   "velocities turn round from one step to the next. Likely causes: noise whose periods are of a few "
                   "steps, or a load too sudden; a smaller Safety Factor follows it");
  warn_if_negative(
      unstored, "Elastic_Energy", ledger.elastic, ledger,
      "a law gave back more energy than it stored. Likely causes: steps in which metal heats so much that "
      "its Shear Modulus Slope takes much of its modulus (more load steps; is Specific Heat in J/(kg K)?), "
      "elastic strains far beyond those of a rate form");
  warn_if_negative(
      breaking, "Fracture_Energy", ledger.fracture, ledger,
      "bonds that broke gave energy. Likely causes: a Fixed dt above the critical time step, breaks in steps "
      "that are too long for them; a smaller Safety Factor or Fixed dt");
}

void Monitor::warn_if_negative(What what, const char* name, double energy, const Ledger& ledger, const char* causes) {
  if (!(energy < -worth_a_warning * ledger.largest)) return;
  warn(what, text_of(at(ledger.time), name, " is negative, ", energy, " J: ", causes));
}

namespace {

// For this rank: the number of points without stress by a criterion of their law, of quadratic cells those all of whose
// integration points have failed, since others hold; and the first of them, or -1.
std::pair<int, int> failed_points(const Body& body) {
  int count = 0, first = -1;
  for (const MaterialBlock& block : body.blocks) {
    std::visit(
        [&]<class Law>(const Law&) {
          if constexpr (requires(typename Law::State state) { state.failed > 0; }) {
            for (std::size_t k = 0; k < block.points.size(); ++k) {
              int failed = 0;
              for (int q = 0; q < block.points_per_cell(); ++q) {
                failed += block.template state_of<Law>(block.index(k, q)).failed > 0 ? 1 : 0;
              }
              if (failed < block.points_per_cell()) continue;
              if (++count == 1) first = block.points[k];
            }
          }
        },
        block.material.law);
  }
  return {count, first};
}

}  // namespace

void Monitor::check_failed(double time) {
  if (warned_[failing]) return;
  const auto [own, point] = failed_points(body_);
  const double all = body_.domain.communicator.sum(static_cast<double>(own));
  if (failed_before_ < 0) failed_before_ = all;
  if (!(all > failed_before_)) return;
  const std::string where = failed_before_ > 0 ? ", beside those that had before" : ": " + locate(body_, point);
  warn_once(failing,
            of_first(body_, own > 0,
                     text_of(at(time), all - failed_before_,
                             " points have failed (Failure Strain), each all at once in a load step", where,
                             ". The work of that is not counted, and what nothing else holds is in equilibrium "
                             "anywhere; expected explicit steps (Solver > Verlet) where material parts")));
}

void Monitor::check_breaks(const Fracture& fracture, double time) {
  const BreaksInSteps breaks = fracture.breaks_in_steps(body_.domain.communicator);
  const double taken = breaks.taken / breaks.ends;
  if (!(taken < least_taken || taken > most_taken)) return;
  warn(fast_breaks, text_of(at(time), std::setprecision(2),
                            "steps were too long for the cracks: these have taken an estimated ", std::max(0.0, taken),
                            " of the energy that they take in short steps (by the stretch of each bond before and "
                            "after the step in which it broke); expected a Fixed dt of ",
                            resolved * std::sqrt(breaks.ends / breaks.speed2), " s (Solver > Verlet)"));
}

void Monitor::check_plastic_work(const Ledger& ledger, double missed) {
  const double whole = ledger.dissipated + missed;
  if (!(missed > std::max(much_missed * whole, worth_a_warning * ledger.largest))) return;
  warn(uncounted,
       text_of(at(ledger.time), "Plastic_Work, External_Work",
               ledger.heat != 0 ? ", Tool_Work, Heat and Temperature" : " and Tool_Work", " are too small, by some ",
               std::setprecision(3), missed, " J, ", 100 * missed / whole,
               " % of the plastic work: a load step counts the mean of the stress at both of its ends, which is too "
               "little where it begins below yield, and next to nothing where it leads from tension to compression; "
               "expected more load steps"));
}

void Monitor::check_resolution(const Ledger& ledger, bool last) {
  if (last) check_springs(ledger.time);
  if (!warned_[stretch]) check_stretch(ledger.time);
}

void Monitor::check_springs(double time) {
  const std::vector<Energies> bodies = stored_energies_of_bodies(body_);
  const auto taken_up = [](const Energies& one) { return one.elastic + one.dissipated; };
  double all = 0, most = much_in_springs;
  for (const Energies& one : bodies) all += taken_up(one);
  int worst = -1;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Energies& one = bodies[b];
    const bool counts = one.dissipated > one.elastic && taken_up(one) > least_of_all * all;
    if (!counts || !(one.stabilization > most * taken_up(one))) continue;
    worst = static_cast<int>(b), most = one.stabilization / taken_up(one);
  }
  if (worst < 0) return;
  const Domain& domain = body_.domain;
  const auto block = std::ranges::find(domain.blocks, worst, &BlockHorizons::body) - domain.blocks.begin();
  warn(springs,
       text_of(at(time), "the springs of the stabilization hold ", 100 * most,
               " % of the energy that the body of block ", domain.cloud.block_names[block],
               " has taken up; up to 10 % is usual. The motion is finer than the points resolve: expect "
               "wrong stresses. Likely causes: too few points, metal that is too soft to hold together, another "
               "Stabilization Coefficient than the default"));
}

void Monitor::check_inverted(double time) {
  constexpr double flat = 20;  // flatness: two layers have 1.3; F across a plane of neighbors is anything
  if (warned_[inverted]) return;
  int point = -1;
  for (const MaterialBlock& block : body_.blocks) {
    if (!block.is_ordinary()) continue;
    const auto is_inverted = [&](int i) {
      return !body_.has_lost_bonds(i) && body_.points[i].deformation_gradient.determinant() <= 0 &&
             flatness(body_.domain, i) < flat;
    };
    const auto found = std::ranges::find_if(block.points, is_inverted);
    if (point < 0 && found != block.points.end()) point = *found;
  }
  if (!body_.domain.communicator.any(point >= 0)) return;
  const std::string where =
      point < 0 ? "" : text_of(body_.points[point].deformation_gradient.determinant(), ": ", locate(body_, point));
  warn_once(inverted,
            of_first(body_, point >= 0,
                     at(time) +
                         "a point of an ordinary solid is turned inside out, and the run goes on, for only the other "
                         "laws fail there (Watch > Inverted Points): its Jacobian is " +
                         where +
                         ". Likely causes: a load or a motion too large or too sudden, bodies that fold without Self "
                         "Contact"));
}

// The largest stretch of a point with all its bonds is at most the norm of F.
void Monitor::check_stretch(double time) {
  double largest = 0;
  int point = -1;
  for (int i = 0; i < body_.owned(); ++i) {
    const double here = body_.has_lost_bonds(i) ? 0 : body_.points[i].deformation_gradient.norm();
    if (here > largest) largest = here, point = i;
  }
  if (!(body_.domain.communicator.max(largest) > far_stretched)) return;
  warn_once(
      stretch,
      of_largest(body_, largest,
                 text_of(at(time), "neighbors have been drawn ", largest,
                         " spacings apart: the shape between them is not resolved, and nothing tears where the deck "
                         "has no Damage Model: ",
                         locate(body_, point),
                         ". Likely causes: metal near its melting temperature, a speed far above what the metal "
                         "bears, a load that pulls without an end")));
}

}  // namespace strut
