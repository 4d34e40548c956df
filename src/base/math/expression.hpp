// A C-like expression in x, y, z, t, or statements that assign to `value`, compiled to a list of instructions. It
// allows only arithmetic: no loops, no recursion, no arrays, no files. Each instruction is executed at most once, so
// that the time of an evaluation is bounded by the length of the text.
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
    look_up,      // in the table number `index`
    skip,         // the number of instructions in `index`
    skip_if_zero  // the same, if the popped number is 0
  };
  Do what;
  double number = 0;
  int index = 0;  // index of a variable, of a function or table, or number of instructions to skip
};

// Values at rising arguments, linear between them and constant beyond: table(t, 0, 0, 1e-3, 5).
struct LookUp {
  std::vector<double> arguments, values;
  double operator()(double argument) const;
};

class Expression {
 public:
  // Throws Error with the character at which `text` is wrong, and what was expected there.
  static Expression compile(const std::string& text);

  double operator()(double x, double y, double z, double t) const;

  // Times near which the value may turn, jump or peak: those at which an intermediate result changes its sign, such as
  // t - 0.3 and t < 0.3, as the samples show (s, in order), to the last bit, and all rows of tables. Only
  // the first `most_turns`, as each costs some 60 evaluations, and these rows.
  std::vector<double> turns(double x, double y, double z, const std::vector<double>& samples) const;

  bool uses_position() const { return uses_position_; }  // x, y or z
  bool uses_time() const { return uses_time_; }

  // Limits: decks are written by hand, or their expressions by programs at most.
  static constexpr std::size_t longest = 10000;  // characters, without the numbers of tables
  static constexpr int deepest = 100;            // nesting of brackets, signs and blocks
  static constexpr int most_variables = 64;      // including x y z t value
  static constexpr std::size_t most_turns = 10000;

 private:
  friend class ExpressionParser;
  std::vector<Instruction> program_;
  std::vector<LookUp> tables_;
  bool uses_position_ = false, uses_time_ = false;
};

// The indices of the predefined variables.
enum class Given { x, y, z, t, value };

struct MathFunction {
  const char* name;
  int arguments;
  double (*of_one)(double) = nullptr;
  double (*of_two)(double, double) = nullptr;
};
const std::vector<MathFunction>& math_functions();

}  // namespace strut
