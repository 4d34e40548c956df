#include "run/report.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <variant>

#include "base/errors.hpp"
#include "base/parallel/threads.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "fracture/fracture.hpp"
#include "fracture/fragments.hpp"
#include "integrators/explicit/step_length.hpp"
#include "materials/user_law.hpp"
#include "mechanics/make_body.hpp"

namespace strut {

namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// True if a person watches. Open MPI gives every rank a terminal of its own, so under mpirun only tools/run, which sees
// the real one, can tell (STRUT_TERMINAL).
bool watched() {
  if (const char* terminal = std::getenv("STRUT_TERMINAL")) return std::string(terminal) == "1";
  return isatty(STDOUT_FILENO) != 0 && std::getenv("OMPI_COMM_WORLD_RANK") == nullptr;
}

std::string as_size(double bytes) {
  return bytes < 1e9 ? formatted("%.1f MB", bytes / 1e6) : formatted("%.2f GB", bytes / 1e9);
}

}  // namespace

std::string as_duration(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  if (seconds < 60) return formatted("%.1f s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return formatted("%ld min %ld s", whole / 60, whole % 60);
  return formatted("%ld h %ld min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(const Communicator& communicator, double initial_time, double now, double final_time)
    : speaks_(communicator.rank() == 0),
      terminal_(watched()),
      initial_(initial_time),
      begin_(now),
      final_(final_time),
      shown_time_(now) {}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

// The remaining time is estimated from the speed since the last line, and from that of the whole run if it is lower,
// because rigid motion at first costs nothing.
std::string Progress::left(double time) {
  if (!(time > shown_time_)) return "";
  const double since_last = (elapsed() - shown_elapsed_) / (time - shown_time_), whole = elapsed() / (time - begin_);
  return "  left: " + as_duration((final_ - time) * std::max(since_last, whole));
}

void Progress::show(int step, double time, double dt) {
  if (!speaks_) return;
  constexpr double often = 0.2, seldom = 60;  // s, between lines on a terminal, and in a log
  const double fraction = (time - initial_) / (final_ - initial_), pause = elapsed() - shown_elapsed_;
  const int now = static_cast<int>(fraction * 10 + 1e-9);
  const bool shows = terminal_ ? pause >= often || fraction >= 1 : now != shown_ || pause >= seldom;
  if (!shows && shown_ >= 0) return;
  const std::string facts = formatted("%3.0f %%  t = %.4g s  step %d  dt = %.3g s", 100 * fraction, time, step, dt);
  if (terminal_) {
    const int filled = static_cast<int>(30 * fraction + 1e-9);
    std::cout << "\r[" << std::string(filled, '=') << std::string(30 - filled, ' ') << "] " << facts << left(time)
              << "   " << std::flush;
  } else {
    std::cout << facts << left(time) << std::endl;
  }
  shown_ = now, shown_elapsed_ = elapsed(), shown_time_ = time;
}

void Progress::finish() {
  if (speaks_ && terminal_) std::cout << std::endl;
}

namespace {

// Memory of points, bonds and the solver (the estimate of the critical time step, or the search for equilibria) on all
// ranks, bytes; the program itself takes some 50 MB per rank, 80 with equilibria.
double predicted_memory(const Scene& scene) {
  const double solver =
      scene.quasi_static ? QuasiStatic::bytes(scene.body, *scene.quasi_static) : StepLength::bytes(scene.body);
  const double fracture = scene.fracture ? scene.fracture->bytes(scene.body) : 0;
  return scene.body.domain.communicator.sum(footprint(scene.body) + fracture + solver);
}

std::string threads_of_a_rank() { return threads() == 1 ? "" : formatted(" of %d threads", threads()); }

// mpirun binds each of one or two ranks to a core, more ranks to a socket, unless told otherwise.
std::string warning_of_cores(const Communicator& ranks) {
  if (threads() == 1) return "";
  const int of_node = cores_of_node() / ranks.ranks_of_node();
  const int least = static_cast<int>(ranks.min(std::min(cores(), std::max(1, of_node))));
  if (least >= threads()) return "";
  return formatted(
      "WARNING: the %d threads of a rank have %d core%s, and wait for each other: fewer ranks, or mpirun "
      "--map-by slot:PE=%d, which gives each as many cores\n",
      threads(), least, least == 1 ? "" : "s", threads());
}

}  // namespace

std::string describe_scene(const Scene& scene, const Advice& advice) {
  const double neighbors = static_cast<double>(scene.bonds) / static_cast<double>(scene.points);
  const double memory = predicted_memory(scene);
  const int ranks = scene.body.domain.communicator.size();
  return text_of(formatted("%lld points, %lld bonds (%.1f a point), %s of memory, %d rank%s%s\n",
                           static_cast<long long>(scene.points), static_cast<long long>(scene.bonds), neighbors,
                           as_size(memory).c_str(), ranks, ranks == 1 ? "" : "s", threads_of_a_rank().c_str()),
                 warning_of_cores(scene.body.domain.communicator), describe_dropped(scene.dropped), scene.pieces,
                 " connected piece", scene.pieces == 1 ? "; " : "s; ", advice.outline, advice.warnings);
}

double frame_bytes(const OutputVariables& variables, std::int64_t points) {
  double numbers = 1;  // the time
  for (const Observable& variable : variables.frame) numbers += variable.components * static_cast<double>(points);
  return sizeof(double) * numbers;
}

std::string memory_and_frame(const Scene& scene, const OutputVariables& variables) {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const double mine = 1024.0 * static_cast<double>(usage.ru_maxrss);
  const Communicator& ranks = scene.body.domain.communicator;
  const bool first = ranks.rank() == 0;
  const double root = ranks.max(first ? mine : 0.0), most = ranks.max(first ? 0.0 : mine);
  return "most memory so far: rank 0 " + as_size(root) + (ranks.size() > 1 ? ", the others " + as_size(most) : "") +
         "; a frame takes " + as_size(frame_bytes(variables, scene.points)) + "\n";
}

std::string step_warning(const StepControl& control, double limit, double time) {
  if (!(control.fixed_dt > limit)) return "";
  return formatted(
      "WARNING: Fixed dt = %.4g s is above the critical time step of %.4g s at t = %.4g s: expect it to blow up\n",
      control.fixed_dt, limit, time);
}

void check_step_at(double time, const StepControl& control, double limit) {
  constexpr double least = 100;  // numbers of the computer in a step: its length errs by 1 %
  const double step = control.fixed_dt > 0 ? control.fixed_dt : control.safety_factor * limit;
  const double apart = std::nextafter(std::abs(time), std::numeric_limits<double>::infinity()) - std::abs(time);
  if (!(step < least * apart)) return;
  if (time == 0) {
    throw Error(
        formatted("Solver > Verlet: steps of %.2g s are too short for numbers; expected a longer Fixed dt, or less "
                  "stiffness beside the Density",
                  step));
  }
  throw Error(
      formatted("Solver > Initial Time: at t = %.4g s numbers are %.2g s apart, too far for steps of %.2g s; "
                "expected a time nearer to 0",
                time, apart, step));
}

void check_libraries(const Body& body, const StepControl& control, double limit) {
  const double whole = control.fixed_dt > 0 ? control.fixed_dt : control.safety_factor * limit;
  if (!std::isfinite(whole)) return;
  const std::vector<std::uint8_t>& levels = *body.time_levels;
  std::string problem;
  for (const MaterialBlock& block : body.blocks) {
    const auto* law = std::get_if<materials::UserLaw>(&block.material.law);
    if (!law) continue;
    int level = 0;
    for (const int i : block.points) level = std::max(level, levels.empty() ? 0 : static_cast<int>(levels[i]));
    const std::string stiff = materials::too_stiff_in(*law, std::ldexp(whole, -level));
    if (problem.empty() && !stiff.empty())
      problem = "Materials > " + law->name + " > Library: '" + law->function.file + "' " + stiff;
  }
  raise_together(body.domain.communicator, problem);
}

namespace {

std::string table_of_phases(const Scene& scene, double seconds) {
  std::string text = formatted("\n%-26s %10s %10s %7s\n", "phase", "mean s", "longest s", "part");
  double sum = 0;
  for (const PhaseTime& p : phase_times(scene.body.domain.communicator)) {
    text += formatted("%-26s %10.3f %10.3f %6.1f%%\n", p.name.c_str(), p.mean, p.longest, 100 * p.mean / seconds);
    sum += p.mean;
  }
  return text + formatted("%-26s %10.3f %10s %6.1f%%\n", "other", seconds - sum, "", 100 * (seconds - sum) / seconds) +
         formatted("%-26s %10.3f\n", "whole run", seconds);
}

// Collective. One value per rank: its minimum, mean and maximum over the ranks.
std::string row_of_ranks(const Communicator& ranks, const char* name, const char* format, double mine) {
  const double mean = ranks.sum(mine) / ranks.size();
  std::string text = formatted("%-26s", name);
  for (const double value : {ranks.min(mine), mean, ranks.max(mine)}) {
    text += formatted(" %10s", formatted(format, value).c_str());
  }
  return text + "\n";
}

// The distribution of work: all ranks wait for the one that has most.
std::string table_of_ranks(const Body& body) {
  const Communicator& ranks = body.domain.communicator;
  if (ranks.size() == 1) return "";
  double updates = body.time_levels.empty() ? body.owned() : 0;
  for (int i = 0; !body.time_levels.empty() && i < body.owned(); ++i) updates += 1 << body.time_levels[i];
  return formatted("\n%-26s %10s %10s %10s\n", "of a rank", "least", "mean", "most") +
         row_of_ranks(ranks, "points", "%.0f", body.owned()) +
         row_of_ranks(ranks, "ghosts", "%.0f", body.domain.ghosts) +
         row_of_ranks(ranks, "updates a step, at the end", "%.0f", updates) +
         row_of_ranks(ranks, "s beside halo exchanges", "%.3f",
                      seconds_outside({"Halo exchange", "Agreement of ranks"})) +
         "\n";
}

std::string searches(const contact::Contact& contact) {
  if (!contact.any()) return "";
  return formatted("%d searches for contact\n", contact.searches());
}

// Collective. The fragments left by broken bonds.
std::string fragment_table(const Body& body) {
  constexpr std::size_t most = 10;
  if (!body.may_break()) return "";
  const std::int64_t broken = body.domain.communicator.sum(broken_bonds(body));
  if (broken == 0) return "no bond broke\n";
  const std::vector<Fragment> all = fragments(body);
  std::string text = formatted("%lld bonds are broken; %zu fragments:\n%12s %12s %12s   velocity, m/s\n",
                               static_cast<long long>(broken / 2), all.size(), "point", "points", "mass, kg");
  for (std::size_t f = 0; f < std::min(most, all.size()); ++f) {
    const auto& [id, points, mass, v] = all[f];
    text += formatted("%12lld %12lld %12.5g   %.5g %.5g %.5g\n", static_cast<long long>(id),
                      static_cast<long long>(points), mass, v[0], v[1], v[2]);
  }
  if (all.size() > most) text += formatted("and %zu lighter ones\n", all.size() - most);
  return text;
}

// Collective. True if every point is where the mesh has it: equilibria with correspondence have energies of round-off.
bool is_as_in_mesh(const Body& body) {
  double moved = 0;
  for (int i = 0; i < body.owned(); ++i) moved = std::max(moved, body.displacement(i).cwiseAbs().maxCoeff());
  return body.domain.communicator.max(moved) == 0;
}

// Collective. Hints for a run in which nothing happened.
std::string what_did_not_happen(const Scene& scene, const Ledger& ledger, int before) {
  const std::string since = before > 0 ? ", since it went on" : "";
  std::string text;
  for (const ToolOfScene& tool : scene.tools) {
    if (!scene.body.domain.communicator.any(*tool.touched))
      text += "the tool '" + tool.name + "' touched nothing" + since + "\n";
  }
  const auto zero = [](double energy) { return energy == 0; };
  const double done[] = {ledger.kinetic,  ledger.dissipated, ledger.fracture,
                         ledger.external, ledger.tools,      ledger.contact};
  const double held[] = {ledger.elastic, ledger.stabilization};
  const bool nothing = std::ranges::all_of(done, zero);
  if (nothing && (std::ranges::all_of(held, zero) || is_as_in_mesh(scene.body)))
    text +=
        "WARNING: nothing moved: no velocity, force or tool of Boundary Conditions has reached a point" + since + "\n";
  return text;
}

std::string energies(const Ledger& ledger) {
  return formatted(
             "energies at %.6g s (J): kinetic %.5g, elastic %.5g, plastic %.5g%s, stabilization %.5g%s%s;\n",
             ledger.time, ledger.kinetic, ledger.elastic, ledger.dissipated,
             ledger.heat > 0 ? formatted(" (heat %.5g)", ledger.heat).c_str() : "", ledger.stabilization,
             ledger.fracture > 0 ? formatted(", fracture %.5g", ledger.fracture).c_str() : "",
             ledger.jumps > 0 ? formatted(", lost in jumps to the next equilibrium %.5g", ledger.jumps).c_str() : "") +
         formatted(
             "work of conditions %.5g, of tools %.5g, of contact %.5g; balance error %.2e of the largest energy\n",
             ledger.external, ledger.tools, ledger.contact, ledger.balance_error);
}

}  // namespace

std::string closing_report(const Scene& scene, const CentralDifference& solver, const Ledger& ledger, double seconds,
                           int before) {
  std::string text = table_of_phases(scene, seconds) + table_of_ranks(scene.body) + searches(solver.contact());
  const int steps = std::max(1, solver.steps() - before);  // zero if a completed run was resumed
  const double core_seconds = seconds * scene.body.domain.communicator.size() * threads();
  text += formatted("%d steps, %.3g points*steps/s, %.2f ns per bond and step on each core\n", steps,
                    static_cast<double>(scene.points) * steps / seconds,
                    1e9 * core_seconds / (static_cast<double>(scene.bonds) * steps));
  if (solver.most_substeps() > 1) {
    text += formatted("the stiffest points were subcycled, up to %d times a step: %.2f updates a point and step\n",
                      solver.most_substeps(), solver.updates() / solver.steps());
  }
  return text + fragment_table(scene.body) + energies(ledger) + what_did_not_happen(scene, ledger, before);
}

std::string closing_report(const Scene& scene, const QuasiStatic& solver, const Ledger& ledger, double seconds,
                           int before) {
  const double point_evaluations = static_cast<double>(scene.points) * solver.evaluations();
  return table_of_phases(scene, seconds) + table_of_ranks(scene.body) + searches(solver.contact()) +
         formatted("%d load steps, %d iterations, %d evaluations of forces or tangent, %.3g points*evaluations/s\n",
                   solver.steps() - before, solver.iterations(), solver.evaluations(), point_evaluations / seconds) +
         energies(ledger) + what_did_not_happen(scene, ledger, before);
}

}  // namespace strut
