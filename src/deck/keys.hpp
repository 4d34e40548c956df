// Typed keys. Each is declared once, as a constant beside its reader: it is listed among the keys of its section, and
// `values[key]` is its value.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "deck/schema.hpp"

namespace strut::deck {

template <class T>
struct KindOf;
template <Kind k>
using Is = std::integral_constant<Kind, k>;
template <>
struct KindOf<double> : Is<Kind::real> {};
template <>
struct KindOf<int> : Is<Kind::integer> {};
template <>
struct KindOf<bool> : Is<Kind::boolean> {};
template <>
struct KindOf<std::vector<double>> : Is<Kind::reals> {};
template <>
struct KindOf<Vector> : Is<Kind::vector> {};
template <>
struct KindOf<std::vector<int>> : Is<Kind::axes> {};
template <>
struct KindOf<std::string> : Is<Kind::text> {};
template <>
struct KindOf<std::vector<std::string>> : Is<Kind::names> {};
template <>
struct KindOf<Function> : Is<Kind::expression> {};

// A key with a default, or a required one.
template <class T>
struct TypedKey : Key {
  explicit TypedKey(Key key) : Key(std::move(key)) {
    kind = KindOf<T>::value;
    required = !fallback;
  }
};

using RealKey = TypedKey<double>;
using IntegerKey = TypedKey<int>;
using BooleanKey = TypedKey<bool>;
using RealsKey = TypedKey<std::vector<double>>;
using VectorKey = TypedKey<Vector>;
using AxesKey = TypedKey<std::vector<int>>;  // 0, 1, 2, each at most once, in this order
using TextKey = TypedKey<std::string>;
using NamesKey = TypedKey<std::vector<std::string>>;
using ExpressionKey = TypedKey<Function>;

// A key that may be left out and has no default.
template <class T>
struct OptionalKey : Key {
  explicit OptionalKey(Key key) : Key(std::move(key)) { kind = KindOf<T>::value; }
};

// The parameters of a section whose names the user chooses.
template <class T>
struct AnyKey : Key {
  explicit AnyKey(const std::string& meaning) : Key{.name = any_name, .kind = KindOf<T>::value, .meaning = meaning} {}
};

// A key with a few possible texts, each with its value in the program.
template <class T>
struct ChoiceKey : Key {
  ChoiceKey(Key key, std::vector<std::pair<std::string, T>> all) : Key(std::move(key)), values(std::move(all)) {
    kind = Kind::choice;
    required = !fallback;
    for (const auto& [text, value] : values) choices.push_back(text);
  }

  std::vector<std::pair<std::string, T>> values;
};

}  // namespace strut::deck
