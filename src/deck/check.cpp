#include "deck/check.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

namespace {

const std::vector<std::string> types = {"bool",  "int",  "double",    "string", "Array(int)",   "Array(double)",
                                        "short", "long", "long long", "float",  "Array(float)", "Array(string)"};

Numbers numbers_of(const std::string& type) {
  if (type == "int" || type == "short" || type == "long" || type == "long long") return Numbers::integer;
  if (type == "double" || type == "float") return Numbers::real;
  const bool is_array = type == "Array(int)" || type == "Array(double)" || type == "Array(float)";
  return is_array ? Numbers::several : Numbers::none;
}

// True if the value is of the type that the deck states with it.
bool conforms(const Parameter& parameter) {
  const Numbers numbers = numbers_of(parameter.type);
  if (parameter.type == "bool") return to_boolean(parameter.value).has_value();
  if (numbers == Numbers::integer) return to_integer(parameter.value).has_value();
  if (numbers == Numbers::real) return to_real(parameter.value).has_value();
  return numbers != Numbers::several || to_reals(parameter.value).has_value();
}

bool suits(const std::string& type, Kind kind) {
  if (type == "string") return true;
  if (type == "bool") return kind == Kind::boolean;
  return numbers_of(type) != Numbers::none && numbers_of(type) <= facts_of(kind).numbers;
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

// Converts one parameter to the value that its key declares. Throws Error with the value and what was expected. An
// integer is accepted as a real, and a string that contains a number as that number.
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

// ---- Sections

template <class Named>
const Named* find(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

bool has_any_section(const Section& section) {
  return section.sections.size() == 1 && section.sections.front().name == any_name;
}

class Checker {
 public:
  Checker(const List& list, const Section& section, const std::string& path, Problems& problems)
      : list_(list), section_(section), path_(path), problems_(problems), values_(list.name, path, section) {}

  Values run() {
    read_keys(section_.keys);
    if (const std::string* choice = std::get_if<std::string>(values_.value(section_.selector))) {
      case_ = find(section_.cases, *choice);
      values_.choose(case_);
      if (case_) read_keys(case_->keys);
    }
    read_any_keys();
    read_sections(section_);
    if (case_) read_sections(*case_);
    report_unknown();
    return std::move(values_);
  }

 private:
  void set(const Key& key, const Parameter& parameter, bool given) {
    Value value;
    try {
      value = convert(parameter, key);
    } catch (const Error& error) {
      problems_.add(path_to(path_, parameter.name), error.what());
    }
    values_.set(parameter.name, std::move(value), given);
  }

  void tell_if_without_effect(const Key& key, const Parameter& parameter) {
    if (key.no_effect.empty() || parameter.value == key.fallback) return;
    problems_.note(path_to(path_, key.name), "has no effect here: " + key.no_effect);
  }

  void read_keys(const std::vector<Key>& keys) {
    for (const Key& key : keys) {
      if (const Parameter* parameter = find(list_.parameters, key.name)) {
        set(key, *parameter, true);
        tell_if_without_effect(key, *parameter);
      } else if (key.fallback) {
        set(key, {key.name, "string", *key.fallback}, false);
      } else if (find(list_.lists, key.name)) {
        values_.set(key.name, {}, true);  // a section instead of a key: report_unknown reports it
      } else if (key.required) {
        problems_.add(path_to(path_, key.name), "missing; " + expected(key));
      }
    }
  }

  void read_any_keys() {
    if (!section_.any_key) return;
    for (const Parameter& parameter : list_.parameters) {
      check_given_name(parameter.name);
      set(*section_.any_key, parameter, true);
    }
  }

  // References to a name have no blanks around it.
  void check_given_name(const std::string& name) {
    if (!name.empty() && trimmed(name) == name) return;
    problems_.add(path_to(path_, "'" + name + "'"),
                  name.empty() ? "a section without a name; expected one" : "blanks around a name; expected none");
  }

  void read_sections(const Section& parent) {
    if (has_any_section(parent)) return read_any_sections(parent.sections.front());
    for (const Section& section : parent.sections) {
      const List* list = find(list_.lists, section.name);
      const auto required = [](const auto& one) { return one.required; };
      const bool as_good_as_empty = std::none_of(section.keys.begin(), section.keys.end(), required) &&
                                    std::none_of(section.sections.begin(), section.sections.end(), required);
      if (list) {
        values_.add(check(*list, section, path_to(path_, section.name), problems_), true);
      } else if (section.required) {
        problems_.add(path_to(path_, section.name), "missing section");
      } else if (as_good_as_empty) {
        values_.add(check({section.name, {}, {}}, section, path_to(path_, section.name), problems_), false);
      }
    }
  }

  void read_any_sections(const Section& section) {
    for (const List& list : list_.lists) {
      check_given_name(list.name);
      values_.add(check(list, section, path_to(path_, list.name), problems_), true);
    }
    if (section.required && list_.lists.empty()) {
      problems_.add(path_, "empty; expected at least one section, named as you like");
    }
  }

  void report_unknown() {
    std::vector<std::string> keys = names_of(section_.keys), sections = names_of(section_.sections);
    for (const Section* one : chosen_cases()) {
      for (const Key& key : one->keys) keys.push_back(key.name);
      for (const Section& section : one->sections) sections.push_back(section.name);
    }
    if (!section_.any_key) {
      for (const Parameter& parameter : list_.parameters) report_unless_known(parameter.name, "key", keys, sections);
    }
    if (!has_any_section(section_)) {
      for (const List& list : list_.lists) report_unless_known(list.name, "section", sections, keys);
    }
  }

  // All cases if the selector is missing or wrong, because unknown keys cannot be identified then.
  std::vector<const Section*> chosen_cases() const {
    if (case_) return {case_};
    std::vector<const Section*> all;
    for (const Section& one : section_.cases) all.push_back(&one);
    return all;
  }

  void report_unless_known(const std::string& name, const std::string& what, const std::vector<std::string>& valid,
                           const std::vector<std::string>& other) {
    const auto among = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (among(valid)) return;
    const std::string path = path_to(path_, name);
    if (const Hint* hint = find(section_.hints, name)) return problems_.add(path, hint->text);
    if (among(other)) {
      return problems_.add(path, what == "key" ? "is a <Parameter>; expected a section (<ParameterList>)"
                                               : "is a section; expected a <Parameter>");
    }
    const std::string owners = cases_with(name);
    if (!owners.empty()) {
      return problems_.add(
          path, "unknown " + what + " for " + section_.selector + " '" + case_->name + "'; it belongs to " + owners);
    }
    const std::string guess = did_you_mean(name, valid);
    const std::vector<std::string> useful = with_effect(valid);
    const bool list_them = guess.empty() && useful.size() <= few;
    const std::string expected = useful.empty() ? "; expected none here" : "; expected one of " + joined(useful);
    problems_.add(path, "unknown " + what + guess + (list_them ? expected : ""));
  }

  std::vector<std::string> with_effect(std::vector<std::string> names) const {
    std::erase_if(names, [&](const std::string& name) {
      const Key* key = find(section_.keys, name);
      return key && !key->no_effect.empty();
    });
    return names;
  }

  // The other cases that have a key or section of this name: "'Linear', 'Voce'".
  std::string cases_with(const std::string& name) const {
    std::vector<std::string> owners;
    for (const Section& one : section_.cases) {
      if (find(one.keys, name) || find(one.sections, name)) owners.push_back("'" + one.name + "'");
    }
    return joined(owners);
  }

  static constexpr std::size_t few = 8;  // number of names that a reader can take in

  const List& list_;
  const Section& section_;
  const std::string& path_;
  Problems& problems_;
  Values values_;
  const Section* case_ = nullptr;  // the case that the selector names
};

}  // namespace

void report_duplicates(const List& list, const std::string& path, Problems& problems) {
  for (const List& section : list.lists) report_duplicates(section, path_to(path, section.name), problems);
  std::multiset<std::string> names;
  for (const Parameter& parameter : list.parameters) names.insert(parameter.name);
  for (const List& section : list.lists) names.insert(section.name);
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    const std::size_t count = names.count(name);
    if (count > 1) problems.add(path_to(path, name), "given " + std::to_string(count) + " times; expected once");
  }
}

Values check(const List& list, const Section& section, const std::string& path, Problems& problems) {
  return Checker(list, section, path, problems).run();
}

}  // namespace strut::deck
