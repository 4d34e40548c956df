// A C-like expression in x, y, z, t, or statements that assign to `value`, compiled to a list of instructions. What a
// deck can say here is arithmetic and nothing else: no loops, no recursion, no arrays, no files. Each instruction is
// done at most once, so that an evaluation takes no longer than its text is long.
#pragma once

#include <string>
#include <vector>

namespace strut {

struct Instruction {
  enum class Do {
    push_number,
    push_variable,
    pop_variable,
    truncate,
    negate,
    invert,
    add,
    subtract,
    multiply,
    divide,
    power,
    less,
    greater,
    less_or_equal,
    greater_or_equal,
    equal,
    different,
    both,
    either,
    call,
    skip,         // as many instructions as `place` says
    skip_if_zero  // the same, where what is popped is 0
  };
  Do what;
  double number = 0;
  int place = 0;  // of a variable, of a function in its table, or how far to skip
};

class Expression {
 public:
  // Throws Error with the character at which `text` is wrong, and what was expected there.
  static Expression compile(const std::string& text);

  double operator()(double x, double y, double z, double t) const;

  bool uses_place() const { return uses_place_; }  // x, y or z
  bool uses_time() const { return uses_time_; }

  // Decks are written by hand, and their expressions by programs at worst.
  static constexpr std::size_t longest = 10000;  // characters
  static constexpr int deepest = 100;            // brackets, signs and blocks within each other
  static constexpr int most_variables = 32;      // x y z t value among them

 private:
  friend class ExpressionParser;
  std::vector<Instruction> program_;
  bool uses_place_ = false, uses_time_ = false;
};

// The place of a variable that is there from the start.
enum class Given { x, y, z, t, value };

struct MathFunction {
  const char* name;
  int arguments;
  double (*of_one)(double) = nullptr;
  double (*of_two)(double, double) = nullptr;
};
const std::vector<MathFunction>& math_functions();

}  // namespace strut
