// Peridigm moves points by the increments of a prescribed displacement: what its value is at the initial time is left
// out, unless it never changes or a checkpoint has the displacements so far (it is then taken whole).
#include <cctype>
#include <cmath>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "base/numbers.hpp"
#include "deck/peridigm/peridigm.hpp"

namespace strut::deck {

namespace {

// The expression with a number in place of t.
std::string at_time(const std::string& text, const std::string& time) {
  const auto of_name = [&text](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_t = text[at] == 't' && !of_name(at + 1) && (at == 0 || !of_name(at - 1));
    result += is_t ? "(" + time + ")" : std::string(1, text[at]);
  }
  return result;
}

// True if it is zero everywhere at this time; at places that no expression knows.
bool begins_with_zero(const Function& value, double time) {
  for (const double x : {-0.7391, 0.2837, 1.9173}) {
    if (value.evaluate(x, 0.6118 * x + 0.3571, 0.4243 - 1.2719 * x, time) != 0) return false;
  }
  return true;
}

void translate(List& condition, double time, Problems& problems) {
  Parameter* value = find_parameter(condition, "Value");
  if (!value || value_of(condition, "Type") != "Prescribed Displacement") return;
  if (value->value.find("value") != std::string::npos || value->value.find(';') != std::string::npos) return;
  try {
    const Function whole = Function::parse(value->value);
    if (!whole.depends_on_time() || begins_with_zero(whole, time)) return;
    const std::string less = "(" + value->value + ") - (" + at_time(value->value, to_text(time)) + ")";
    Function::parse(less);  // throws if the text is not what it seems
    value->value = less;
    problems.note(
        "Boundary Conditions > " + condition.name + " > Value",
        "is taken less its value at the initial time, as in Peridigm, which adds up its changes since then: " + less);
  } catch (const Error&) {
    return;  // reported when the deck is checked
  }
}

}  // namespace

void translate_displacements(List& deck, Problems& problems) {
  const List* solver = find_list(deck, "Solver");
  if (!solver || find_list(deck, "Start From")) return;
  const double time = real_of(*solver, "Initial Time").value_or(0);
  for (List& condition : sections_of(deck, {"Boundary Conditions"})) translate(condition, time, problems);
}

}  // namespace strut::deck
