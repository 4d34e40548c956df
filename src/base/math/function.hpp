// A value of a deck that may depend on place and time: "2.5", "-50", "1.0e-3*t", "value = 0; if (t < 1e-3) { value =
// sin(x); }". Text that is more than a number is compiled (expression.hpp).
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace strut {

class Expression;

class Function {
 public:
  explicit Function(double constant = 0);

  // `text`: a number, an expression in x y z t, or statements that assign to `value`.
  // Throws Error where it does not compile: which character, and what was expected there.
  static Function parse(const std::string& text);

  // x, y, z in m (reference position), t in s. Not finite where the arithmetic is not (log of a negative number).
  double operator()(double x, double y, double z, double t) const;

  bool is_constant() const { return program_ == nullptr; }  // the same everywhere and always
  bool depends_on_time() const;
  bool depends_on_place() const;
  const std::string& text() const { return text_; }

 private:
  std::shared_ptr<const Expression> program_;
  double constant_ = 0;
  std::string text_;
};

// The functions that expressions know, and no others (not abs, min, max, floor; nothing random, which would make a run
// depend on the number of ranks).
std::vector<std::string> functions_in_expressions();

}  // namespace strut
