#include "deck/convert.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

namespace {

const std::vector<std::string> types = {"bool",  "int",  "double",    "string", "Array(int)",   "Array(double)",
                                        "short", "long", "long long", "float",  "Array(float)", "Array(string)"};

bool is_integer_type(const std::string& type) {
  return type == "int" || type == "short" || type == "long" || type == "long long";
}

bool is_real_type(const std::string& type) { return type == "double" || type == "float"; }

bool is_array_of_numbers(const std::string& type) {
  return type == "Array(int)" || type == "Array(double)" || type == "Array(float)";
}

// True if the value is of the type that the deck states with it.
bool conforms(const Parameter& parameter) {
  if (parameter.type == "bool") return to_boolean(parameter.value).has_value();
  if (is_integer_type(parameter.type)) return to_integer(parameter.value).has_value();
  if (is_real_type(parameter.type)) return to_real(parameter.value).has_value();
  if (is_array_of_numbers(parameter.type)) return to_reals(parameter.value).has_value();
  return true;
}

bool suits(const std::string& type, Kind kind) {
  if (type == "string") return true;
  switch (kind) {
    case Kind::boolean:
      return type == "bool";
    case Kind::integer:
      return is_integer_type(type);
    case Kind::real:
    case Kind::expression:
      return is_integer_type(type) || is_real_type(type);
    case Kind::reals:
    case Kind::vector:
      return is_integer_type(type) || is_real_type(type) || is_array_of_numbers(type);
    case Kind::text:
    case Kind::choice:
    case Kind::axes:
    case Kind::names:
      return false;
  }
  return false;
}

[[noreturn]] void refuse(const Parameter& parameter, const Key& key, const std::string& because = "") {
  throw Error("'" + parameter.value + "'" + because + "; " + expected(key));
}

double in_range(double value, const Parameter& parameter, const Key& key) {
  if (!std::isfinite(value)) refuse(parameter, key, " is not finite");
  if (!key.range.contains(value)) refuse(parameter, key);
  return value;
}

std::vector<double> convert_reals(const Parameter& parameter, const Key& key) {
  const auto numbers = to_reals(parameter.value);
  if (!numbers || numbers->empty() || (key.kind == Kind::vector && numbers->size() != 3)) refuse(parameter, key);
  for (const double number : *numbers) in_range(number, parameter, key);
  return *numbers;
}

Function convert_expression(const Parameter& parameter, const Key& key) {
  if (trimmed(parameter.value).empty()) refuse(parameter, key);
  if (const auto number = to_real(parameter.value)) in_range(*number, parameter, key);
  try {
    return Function::parse(parameter.value);
  } catch (const std::exception& error) {  // the expression compiler throws other exceptions, too
    throw Error(std::string(trimmed(error.what())) + "; " + expected(key));
  }
}

std::string convert_choice(const Parameter& parameter, const Key& key) {
  const std::string& choice = parameter.value;
  if (std::find(key.choices.begin(), key.choices.end(), choice) != key.choices.end()) return choice;
  for (const Hint& hint : key.hints) {
    if (hint.name == choice) refuse(parameter, key, " (" + hint.text + ")");
  }
  refuse(parameter, key, did_you_mean(choice, key.choices));
}

// "zx": 0 and 2, in any order.
std::vector<int> convert_axes(const Parameter& parameter, const Key& key) {
  const std::string& text = parameter.value;
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = "xyz"[axis];
    const auto times = std::count(text.begin(), text.end(), letter);
    if (times > 1) refuse(parameter, key, std::string(" has ") + letter + " more than once");
    if (times == 1) axes.push_back(axis);
  }
  if (axes.empty() || axes.size() != text.size()) refuse(parameter, key);
  return axes;
}

Value convert_text(const Parameter& parameter, const Key& key) {
  const std::string text(trimmed(parameter.value));
  if (text.empty()) refuse(parameter, key, " is empty");
  if (key.kind == Kind::names) return to_words(text);
  return text;
}

template <class T>
T or_refuse(const std::optional<T>& value, const Parameter& parameter, const Key& key) {
  if (!value) refuse(parameter, key);
  return *value;
}

}  // namespace

Value convert(const Parameter& parameter, const Key& key) {
  if (parameter.type.empty()) throw Error("has no type; expected the attributes name, type and value");
  if (std::find(types.begin(), types.end(), parameter.type) == types.end()) {
    throw Error("unknown type '" + parameter.type + "'" + did_you_mean(parameter.type, types) + "; expected one of " +
                joined(types));
  }
  if (!suits(parameter.type, key.kind)) refuse(parameter, key, " of type " + parameter.type);
  if (!conforms(parameter)) refuse(parameter, key, " is not of type " + parameter.type);
  switch (key.kind) {
    case Kind::boolean:
      return or_refuse(to_boolean(parameter.value), parameter, key);
    case Kind::integer: {
      const int value = or_refuse(to_integer(parameter.value), parameter, key);
      in_range(value, parameter, key);
      return value;
    }
    case Kind::real:
      return in_range(or_refuse(to_real(parameter.value), parameter, key), parameter, key);
    case Kind::reals:
      return convert_reals(parameter, key);
    case Kind::vector: {
      const std::vector<double> numbers = convert_reals(parameter, key);
      return Vector(numbers[0], numbers[1], numbers[2]);
    }
    case Kind::expression:
      return convert_expression(parameter, key);
    case Kind::choice:
      return convert_choice(parameter, key);
    case Kind::axes:
      return convert_axes(parameter, key);
    case Kind::text:
    case Kind::names:
      return convert_text(parameter, key);
  }
  return {};
}

}  // namespace strut::deck
