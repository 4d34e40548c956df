#include "base/math/function.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/errors.hpp"
#include "base/math/expression.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"

namespace strut {

namespace {

std::optional<double> as_number(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n+");
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
  double number = 0;
  const auto [rest, failure] = std::from_chars(text.data() + begin, text.data() + end, number);
  if (failure != std::errc() || rest != text.data() + end) return std::nullopt;
  return number;
}

// Shortens text for an error message and replaces control characters.
std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::string shown = text.substr(0, longest);
  for (char& c : shown) c = c == '\n' ? ' ' : std::iscntrl(static_cast<unsigned char>(c)) != 0 ? '?' : c;
  return text.size() <= longest ? shown : shown + "…";
}

}  // namespace

struct Function::NotFinite {
  std::atomic<bool> taken = false, complete = false;
  double x, y, z, t, value;
};

Function::Function(double constant) : constant_(constant), text_(to_text(constant)) {}

Function Function::parse(const std::string& text) {
  Function function;
  function.text_ = text;
  if (const auto number = as_number(text)) {
    function.constant_ = *number;
    return function;
  }
  try {
    function.program_ = std::make_shared<Expression>(Expression::compile(text));
    function.not_finite_ = std::make_shared<NotFinite>();
  } catch (const Error& error) {
    throw Error("'" + shortened(text) + "' is not an expression in x, y, z, t: " + error.what());
  }
  return function;
}

double Function::operator()(double x, double y, double z, double t) const {
  if (is_constant()) return constant_;
  const double value = (*program_)(x, y, z, t);
  if (!std::isfinite(value) && !not_finite_->taken.exchange(true)) {
    NotFinite& first = *not_finite_;
    first.x = x, first.y = y, first.z = z, first.t = t, first.value = value;
    first.complete = true;
  }
  return value;
}

double Function::evaluate(double x, double y, double z, double t) const {
  return is_constant() ? constant_ : (*program_)(x, y, z, t);
}

std::string Function::describe(double x, double y, double z, double t, double value) const {
  return text_of(path_.empty() ? "" : path_ + ": ", "'", shortened(text_), "' is ", value, " at (", x, ", ", y, ", ", z,
                 ") m, t = ", t, " s; expected a number everywhere");
}

std::string Function::first_not_finite() const {
  if (!not_finite_ || !not_finite_->complete) return "";
  const NotFinite& first = *not_finite_;
  return describe(first.x, first.y, first.z, first.t, first.value);
}

bool Function::depends_on_time() const { return program_ && program_->uses_time(); }

bool Function::depends_on_position() const { return program_ && program_->uses_position(); }

std::vector<double> Function::turns(const Vector& X, const std::vector<double>& samples) const {
  if (!depends_on_time()) return {};
  std::vector<double> times = program_->turns(X[0], X[1], X[2], samples);
  std::erase_if(times, [&](double t) { return !(t > samples.front() && t < samples.back()); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<std::string> functions_in_expressions() {
  std::vector<std::string> names;
  for (const MathFunction& one : math_functions()) names.emplace_back(one.name);
  return names;
}

double finite_value(const Function& function, const Vector& X, double t) {
  const double value = function.evaluate(X, t);
  if (!std::isfinite(value)) throw Error(function.describe(X[0], X[1], X[2], t, value));
  return value;
}

}  // namespace strut
