// A value of a deck that may depend on place and time: "2.5", "-50", "1.0e-3*t", "value = 0; if (t < 1e-3) { value =
// sin(x); }". Text that is more than a number is compiled (expression.hpp).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace strut {

class Expression;

class Function {
 public:
  explicit Function(double constant = 0);

  // `text`: a number, an expression in x y z t, or statements that assign to `value`.
  // Throws Error where it does not compile: which character, and what was expected there.
  static Function parse(const std::string& text);

  // x, y, z in m (reference position), t in s. Not finite where the arithmetic is not (log of a negative number): the
  // first such value is remembered, by all copies. By any thread.
  double operator()(double x, double y, double z, double t) const;
  double evaluate(double x, double y, double z, double t) const;  // the same, for a look: nothing is remembered

  // Where it stands in the deck, for errors: "Boundary Conditions > pull > Value".
  void set_path(std::string path) { path_ = std::move(path); }
  const std::string& path() const { return path_; }
  // What an error says of such a value, with its path; of the one that is remembered, "" where there was none.
  std::string describe(double x, double y, double z, double t, double value) const;
  std::string first_not_finite() const;

  bool is_constant() const { return program_ == nullptr; }  // the same everywhere and always
  bool depends_on_time() const;
  bool depends_on_place() const;
  const std::string& text() const { return text_; }

 private:
  std::shared_ptr<const Expression> program_;
  double constant_ = 0;
  std::string text_, path_;

  struct NotFinite;
  std::shared_ptr<NotFinite> not_finite_;  // where there is a program
};

// The functions that expressions know, and no others (not abs, min, max, floor; nothing random, which would make a run
// depend on the number of ranks).
std::vector<std::string> functions_in_expressions();

}  // namespace strut
