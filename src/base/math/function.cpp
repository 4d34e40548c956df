#include "base/math/function.hpp"

#include <cctype>
#include <charconv>
#include <optional>

#include "base/errors.hpp"
#include "base/math/expression.hpp"

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

// For an error: what is long cut off, and no characters that would end the line or the text.
std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::string shown = text.substr(0, longest);
  for (char& c : shown) c = std::iscntrl(static_cast<unsigned char>(c)) != 0 ? '?' : c;
  return text.size() <= longest ? shown : shown + "…";
}

}  // namespace

Function::Function(double constant) : constant_(constant), text_(std::to_string(constant)) {}

Function Function::parse(const std::string& text) {
  Function function;
  function.text_ = text;
  if (const auto number = as_number(text)) {
    function.constant_ = *number;
    return function;
  }
  try {
    function.program_ = std::make_shared<Expression>(Expression::compile(text));
  } catch (const Error& error) {
    throw Error("'" + shortened(text) + "' is not an expression in x, y, z, t: " + error.what());
  }
  return function;
}

double Function::operator()(double x, double y, double z, double t) const {
  return is_constant() ? constant_ : (*program_)(x, y, z, t);
}

bool Function::depends_on_time() const { return program_ && program_->uses_time(); }

bool Function::depends_on_place() const { return program_ && program_->uses_place(); }

std::vector<std::string> functions_in_expressions() {
  std::vector<std::string> names;
  for (const MathFunction& one : math_functions()) names.emplace_back(one.name);
  return names;
}

}  // namespace strut
