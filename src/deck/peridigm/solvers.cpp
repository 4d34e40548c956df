// Peridigm's solvers: several one after the other, and more than one kind for equilibria.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

const char* const equilibria = "QuasiStatic";
const std::string steps_key = "Number of Load Steps";

// Converts another solver for the same equilibria.
void translate_nox(List& solver, Problems& problems) {
  List* nox = find_list(solver, "NOXQuasiStatic");
  if (!nox || find_list(solver, equilibria)) return;
  nox->name = equilibria;
  nox->lists.clear();
  std::erase_if(nox->parameters,
                [](const Parameter& one) { return one.name != steps_key && one.name != "Time Steps"; });
  problems.note(path_to(solver.name, "NOXQuasiStatic"),
                "is taken as QuasiStatic, of all its keys Number of Load Steps: equilibria are found in another way");
}

void set(List& list, const std::string& name, const std::string& type, const std::string& value) {
  erase_parameter(list, name);
  list.parameters.push_back({name, type, value});
}

// The number of equal steps that have all of these times among theirs; nothing if there would be too many.
std::optional<int> equal_steps(const std::vector<double>& times) {
  constexpr int most = 1000;
  const double whole = times.back() - times.front();
  for (int count = 1; count <= most && whole > 0; ++count) {
    const bool fits = std::ranges::all_of(times, [&](double time) {
      const double place = (time - times.front()) / whole * count;
      return std::abs(place - std::round(place)) < 1e-6 * count;
    });
    if (fits) return count;
  }
  return std::nullopt;
}

// "0 0.1 0.5 1" is the times of the load steps, and with them initial and final time.
void translate_time_steps(List& solver, Problems& problems) {
  List* slow = find_list(solver, equilibria);
  const Parameter* given = slow ? find_parameter(*slow, "Time Steps") : nullptr;
  const auto times = given ? to_reals(given->value) : std::nullopt;
  const auto count = times && times->size() > 1 ? equal_steps(*times) : std::nullopt;
  if (!count) return;
  erase_parameter(*slow, "Time Steps");
  set(*slow, steps_key, "int", std::to_string(*count));
  set(solver, "Initial Time", "double", to_text(times->front()));
  set(solver, "Final Time", "double", to_text(times->back()));
  if (*count + 1 == static_cast<int>(times->size())) return;
  problems.note(path_to(solver.name, "QuasiStatic > Time Steps"),
                "are cut into " + std::to_string(*count) + " of equal length, which have its times among theirs");
}

void translate_equilibria(List& solver, Problems& problems) {
  List* slow = find_list(solver, equilibria);
  if (!slow) return;
  const std::string path = path_to(solver.name, equilibria);
  if (List* adaptive = find_list(*slow, "Adaptive Load-Stepping")) {
    const bool switches = find_list(*adaptive, "Switch to Verlet");
    problems.note(path + " > Adaptive Load-Stepping",
                  std::string("has no effect here: a load step that finds no equilibrium is cut in halves, and none "
                              "grows") +
                      (switches ? "; the run does not go on by Verlet: where Peridigm does, its points vibrate about "
                                  "the equilibria that are found here"
                                : ""));
    erase_list(*slow, "Adaptive Load-Stepping");
  }
  if (Parameter* tolerance = find_parameter(*slow, "Relative Tolerance");
      tolerance && !find_parameter(*slow, "Tolerance")) {
    tolerance->name = "Tolerance";
    problems.note(path + " > Relative Tolerance", "is taken as Tolerance");
  }
}

void translate(List& solver, Problems& problems) {
  const auto drop = [&](const std::string& name, const std::string& why) {
    if (!find_list(solver, name) && !find_parameter(solver, name)) return;
    erase_list(solver, name), erase_parameter(solver, name);
    problems.note(path_to(solver.name, name), "has no effect here: " + why);
  };
  if (find_list(solver, "Rebalance")) drop("Rebalance", "the points stay with their ranks");
  drop("Initialize Predictor From Previous Solver", "equilibria are found in another way");
  translate_nox(solver, problems);
  translate_time_steps(solver, problems);
  translate_equilibria(solver, problems);
}

// The number of load steps of a solver for equilibria; nothing for another.
std::optional<int> load_steps(List& solver) {
  List* slow = find_list(solver, equilibria);
  return slow ? to_integer(value_of(*slow, steps_key)) : std::nullopt;
}

// Makes one of two series of equilibria that follow each other, if their steps fit together.
bool join(List& first, List& second, Problems& problems) {
  const double begin = real_of(first, "Initial Time").value_or(0);
  const auto middle = real_of(first, "Final Time");
  const auto next = real_of(second, "Initial Time"), end = real_of(second, "Final Time");
  const auto one = load_steps(first), other = load_steps(second);
  if (!one || !other || !middle || !next || !end || *middle != *next) return false;
  std::vector<double> times;
  for (int n = 0; n <= *one; ++n) times.push_back(begin + (*middle - begin) * n / *one);
  for (int n = 1; n <= *other; ++n) times.push_back(*next + (*end - *next) * n / *other);
  const auto count = equal_steps(times);
  if (!count) return false;
  problems.note(second.name, "goes on where " + first.name + " ends: both are one series of " + std::to_string(*count) +
                                 " equal load steps");
  set(first, "Final Time", "double", to_text(*end));
  set(*find_list(first, equilibria), steps_key, "int", std::to_string(*count));
  return true;
}

}  // namespace

void translate_solvers(List& deck, bool is_theirs, Problems& problems) {
  std::vector<List> solvers;
  for (List& one : deck.lists) {
    if (!one.name.starts_with("Solver")) continue;
    translate(one, problems);
    solvers.push_back(one);
  }
  if (solvers.empty() || !is_theirs) return;
  std::erase_if(deck.lists, [](const List& one) { return one.name.starts_with("Solver"); });
  std::ranges::stable_sort(solvers, {}, [](const List& one) { return real_of(one, "Initial Time").value_or(0); });
  std::vector<List> joined;
  for (List& one : solvers) {
    if (joined.empty() || !join(joined.back(), one, problems)) joined.push_back(one);
  }
  joined.front().name = "Solver";
  for (std::size_t n = 1; n < joined.size(); ++n) {
    const std::string name = joined[n].name;
    joined[n].name = "Solver " + std::to_string(n + 1);
    if (n != 1 || !find_list(joined[n], "Verlet") || find_parameter(joined[n], "Keep Velocities")) continue;
    set(joined[n], "Keep Velocities", "bool", "true");
    problems.note(name, "goes on from the last equilibrium, with the velocities of its load step, as in Peridigm");
  }
  deck.lists.insert(deck.lists.end(), joined.begin(), joined.end());
}

}  // namespace strut::deck
