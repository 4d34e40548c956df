// Fields: one value for each point of a rank, or for each integration point. A field is declared once, as a member,
// with its name, unit and meaning. Checkpoints, migration to another rank, memory forecasts, output variables and their
// page follow from the declaration.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/archive.hpp"

namespace strut {

enum class At { point, integration_point };

// Numbers of a value that belong together: a scalar, a vector, a tensor; in a record, one of its members.
struct FieldPart {
  std::string name;         // in checkpoints
  std::string unit;         // SI; "1" for none
  std::string meaning;      // for the page of output variables
  bool persistent = false;  // in checkpoints: later steps depend on it
  std::string variable;     // its name as an output variable; empty: it is not one
  bool nodal = false;       // in the Exodus file: nodal, else of elements
  int width = 0;            // number of components; 0: given by the type
};

// The n-th number in a value: a number, a vector or tensor, or a record that lists its members as `numbers`. For other
// records overload this function.
template <class T>
requires std::is_arithmetic_v<T> T& number_of(T& value, int) { return value; }
template <class T>
requires requires(T& value) { value.data(); }
auto& number_of(T& value, int n) { return value.data()[n]; }

template <class Record>
requires requires { std::remove_const_t<Record>::numbers; }
auto& number_of(Record& record, int n) { return record.*(Record::numbers[n]); }

// The interface of a field for its set, independent of its type.
class AnyField {
 public:
  AnyField(At at, std::vector<FieldPart> parts) : at(at), parts(std::move(parts)) {}
  virtual ~AnyField() = default;
  virtual void resize(std::size_t size) = 0;  // resets all values: zero, or their type's default
  virtual double bytes() const = 0;
  virtual double number(std::size_t index, int n) const = 0;
  virtual void set_number(std::size_t index, int n, double number) = 0;

  const At at;
  std::vector<FieldPart> parts;
  bool in_use = true;  // the same on all ranks
};

// `Values`: a vector, or a container with bytes() and at(place, n).
template <class Values>
class FieldOf : public AnyField {
 public:
  using AnyField::AnyField;
  void resize(std::size_t size) override {
    if constexpr (requires { values.assign(size, values[0]); }) {
      using Value = std::remove_cvref_t<decltype(values[0])>;
      values.assign(size, start<Value>());
    }
  }
  double bytes() const override {
    if constexpr (requires { values.bytes(); }) {
      return values.bytes();
    } else {
      return static_cast<double>(values.size() * sizeof(values[0]));
    }
  }
  double number(std::size_t index, int n) const override { return static_cast<double>(at_index(values, index, n)); }
  void set_number(std::size_t index, int n, double number) override {
    using Number = std::remove_reference_t<decltype(at_index(values, index, n))>;
    if constexpr (!std::is_const_v<Number>) at_index(values, index, n) = static_cast<Number>(number);
  }

  Values values;

 private:
  template <class Value>
  static Value start() {
    if constexpr (requires { Value::Zero(); }) {
      return Value(Value::Zero());
    } else {
      return Value();
    }
  }
  template <class Own>
  static decltype(auto) at_index(Own& own, std::size_t index, int n) {
    if constexpr (requires { own.at(index, n); }) {
      return own.at(index, n);
    } else {
      return number_of(own[index], n);
    }
  }
};

// A member that is a field: refers to its values, which its set owns.
template <class Values>
class FieldRef {
 public:
  explicit FieldRef(FieldOf<Values>& field) : field_(&field) {}
  FieldRef(const FieldRef&) = default;
  FieldRef(FieldRef&&) = default;
  // `a = b` would make two members one field: write `a = *b` to copy values.
  FieldRef& operator=(const FieldRef&) = delete;
  FieldRef& operator=(FieldRef&&) = default;
  FieldRef& operator=(Values values) {
    field_->values = std::move(values);
    return *this;
  }
  operator Values&() { return field_->values; }
  operator const Values&() const { return field_->values; }
  Values& operator*() { return field_->values; }
  const Values& operator*() const { return field_->values; }
  Values* operator->() { return &field_->values; }
  const Values* operator->() const { return &field_->values; }
  decltype(auto) operator[](std::size_t i) { return field_->values[i]; }
  decltype(auto) operator[](std::size_t i) const { return std::as_const(field_->values)[i]; }
  auto begin() { return field_->values.begin(); }
  auto end() { return field_->values.end(); }
  auto begin() const { return std::as_const(field_->values).begin(); }
  auto end() const { return std::as_const(field_->values).end(); }
  auto* data() { return field_->values.data(); }
  const auto* data() const { return std::as_const(field_->values).data(); }
  std::size_t size() const { return field_->values.size(); }
  bool empty() const { return field_->values.empty(); }
  // Takes the field into use, to be called on all ranks; the arguments are those of the container's resize().
  template <class... Size>
  void use(Size&&... sizes) {
    field_->in_use = true;
    field_->values.resize(std::forward<Size>(sizes)...);
  }
  void set_parts(std::vector<FieldPart> parts) { field_->parts = std::move(parts); }

 private:
  FieldOf<Values>* field_;
};
template <class T>
using PointField = FieldRef<std::vector<T>>;

// Where a field has its values: place(k, q) is the index of the k-th point's q-th of `count` integration points.
struct FieldIndices {
  int count = 1;
  std::function<std::size_t(std::size_t k, int q)> index = [](std::size_t k, int) { return k; };
};

// `if_used`: the field exists only in scenes that use it.
enum class When { always, if_used };

class FieldSet {
 public:
  template <class Values>
  FieldRef<Values> add(At at, std::vector<FieldPart> parts, When when = When::always) {
    auto field = std::make_unique<FieldOf<Values>>(at, std::move(parts));
    field->in_use = when == When::always;
    FieldRef<Values> handle(*field);
    fields_.push_back(std::move(field));
    return handle;
  }
  template <class T>
  PointField<T> of_points(FieldPart part, When when = When::always) {
    if (part.width == 0) part.width = width_of<T>();
    return add<std::vector<T>>(At::point, {std::move(part)}, when);
  }

  const std::vector<std::unique_ptr<AnyField>>& all() const { return fields_; }
  void resize(std::size_t points);  // the fields of points that are in use
  double bytes() const;
  // Saves or restores the persistent fields; the archive must be at the group of the points.
  void serialize(Archive& archive, const FieldIndices& indices = {});

 private:
  template <class T>
  static constexpr int width_of() {
    if constexpr (requires { T::SizeAtCompileTime; }) {
      return T::SizeAtCompileTime;
    } else {
      return 1;
    }
  }

  std::vector<std::unique_ptr<AnyField>> fields_;
};

// Compiled once, in fields.cpp.
extern template class FieldOf<std::vector<double>>;
extern template class FieldOf<std::vector<std::uint8_t>>;

}  // namespace strut
