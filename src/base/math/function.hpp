// A value of a deck that may depend on position and time: "2.5", "-50", "1.0e-3*t", "value = 0; if (t < 1e-3) { value =
// sin(x); }". Text that is not a number is compiled (expression.hpp).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut {

class Expression;

class Function {
 public:
  explicit Function(double constant = 0);

  // `text`: a number, an expression in x y z t, or statements that assign to `value`.
  // Throws Error if it does not compile, with the character and what was expected there.
  static Function parse(const std::string& text);

  // x, y, z in m (reference position), t in s. The result may be infinite or NaN (log of a negative number): the first
  // such value is stored, shared by all copies. Thread-safe.
  double operator()(double x, double y, double z, double t) const;
  double operator()(const Vector& X, double t) const { return (*this)(X[0], X[1], X[2], t); }
  double evaluate(double x, double y, double z, double t) const;  // the same, without storing such values
  double evaluate(const Vector& X, double t) const { return evaluate(X[0], X[1], X[2], t); }

  // Its path in the deck, for errors: "Boundary Conditions > pull > Value".
  void set_path(std::string path) { path_ = std::move(path); }
  const std::string& path() const { return path_; }
  // The error message, with the path, for a value that is not finite; for the stored value, "" if there is none.
  std::string describe(double x, double y, double z, double t, double value) const;
  std::string first_not_finite() const;

  bool is_constant() const { return program_ == nullptr; }  // the same at all positions and times
  bool depends_on_time() const;
  bool depends_on_position() const;
  // Times between the first and the last sample (s, in order) near which the value may turn, jump or peak, in order, as
  // Expression::turns finds them.
  std::vector<double> turns(const Vector& X, const std::vector<double>& samples) const;
  const std::string& text() const { return text_; }

 private:
  std::shared_ptr<const Expression> program_;
  double constant_ = 0;
  std::string text_, path_;

  struct NotFinite;
  std::shared_ptr<NotFinite> not_finite_;  // only with a program
};

// The functions allowed in expressions (not floor; no random numbers, which would make a run depend on
// the number of ranks).
std::vector<std::string> functions_in_expressions();

// The value at X (m) and t (s). Throws Error if it is not finite (the root of a negative number, a division by
// zero).
double finite_value(const Function& function, const Vector& X, double t);

}  // namespace strut
