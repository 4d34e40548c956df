// A value of a deck that may depend on place and time: "2.5", "-50", "1.0e-3*t", "value = 0; if (t < 1e-3) { value =
// sin(x); }". Text that is more than a number is compiled by the run-time compiler of Trilinos' Pamgen, whose language
// is C-like.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace strut {

class Function {
 public:
  explicit Function(double constant = 0);

  // `text`: a number, an expression in x y z t, or statements that assign to `value`.
  // Throws Error with the compiler's message where it does not compile.
  static Function parse(const std::string& text);

  // x, y, z in m (reference position), t in s.
  double operator()(double x, double y, double z, double t) const;

  bool is_constant() const { return program_ == nullptr; }  // the same everywhere and always
  bool depends_on_time() const { return depends_on_time_; }
  bool depends_on_place() const { return depends_on_place_; }
  const std::string& text() const { return text_; }

 private:
  struct Program;
  std::shared_ptr<Program> program_;
  double constant_ = 0;
  bool depends_on_time_ = false, depends_on_place_ = false;
  std::string text_;
};

// The functions that expressions know, and no others (not abs, min, max, floor). Not listed: rand() and drand(), which
// would make a run depend on the number of ranks.
const std::vector<std::string>& functions_in_expressions();

}  // namespace strut
