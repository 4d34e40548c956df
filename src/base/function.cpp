#include "base/function.hpp"

#include <RTC_FunctionRTC.hh>
#include <cctype>
#include <charconv>
#include <optional>
#include <regex>

#include "base/errors.hpp"

namespace strut {

namespace {

std::optional<double> as_number(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\n+");
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_last_not_of(" \t\n") + 1;
  double number = 0;
  const auto [rest, failure] = std::from_chars(text.data() + begin, text.data() + end, number);
  if (failure != std::errc() || rest != text.data() + end) return std::nullopt;
  return number;
}

bool mentions(const std::string& text, const std::string& name) {
  return std::regex_search(text, std::regex("\\b" + name + "\\b"));
}

}  // namespace

struct Function::Program {
  mutable PG_RuntimeCompiler::Function compiled{5, "value"};
};

Function::Function(double constant) : constant_(constant), text_(std::to_string(constant)) {}

Function Function::parse(const std::string& text) {
  Function function;
  function.text_ = text;
  if (const auto number = as_number(text)) {
    function.constant_ = *number;
    return function;
  }
  const std::string body = mentions(text, "value") ? text : "value = " + text;
  auto program = std::make_shared<Program>();
  for (const char* name : {"x", "y", "z", "t", "value"}) program->compiled.addVar("double", name);
  const bool closed = body.find_last_not_of(" \t\n") != std::string::npos &&
                      std::string(";}").find(body[body.find_last_not_of(" \t\n")]) != std::string::npos;
  std::string reason;
  try {
    if (!program->compiled.addBody(closed ? body : body + ";")) reason = program->compiled.getErrors();
  } catch (const std::exception& error) {  // the compiler lets numbers that do not fit a double through as exceptions
    reason = error.what();
  }
  if (!reason.empty()) {
    while (!reason.empty() && std::isspace(static_cast<unsigned char>(reason.back()))) reason.pop_back();
    if (reason.find("Function:") != std::string::npos) reason += " There are " + joined(functions_in_expressions());
    throw Error("'" + text + "' is not an expression in x, y, z, t: " + reason);
  }
  function.program_ = program;
  function.depends_on_time_ = mentions(text, "t");
  function.depends_on_place_ = mentions(text, "[xyz]");
  return function;
}

double Function::operator()(double x, double y, double z, double t) const {
  if (is_constant()) return constant_;
  PG_RuntimeCompiler::Function& compiled = program_->compiled;
  double value = 0;
  double arguments[] = {x, y, z, t};
  for (unsigned i = 0; i < 4; ++i) compiled.varValueFill(i, arguments[i]);
  compiled.varAddrFill(4, &value);
  if (!compiled.execute()) throw Error("'" + text_ + "' cannot be evaluated: " + compiled.getErrors());
  return value;
}

const std::vector<std::string>& functions_in_expressions() {
  static const std::vector<std::string> names{"fabs", "sqrt", "pow",   "exp",  "log",   "log10", "sin",  "cos",
                                              "tan",  "asin", "acos",  "atan", "atan2", "sinh",  "cosh", "tanh",
                                              "erf",  "erfc", "gamma", "j0",   "j1",    "i0",    "i1"};
  return names;
}

}  // namespace strut
