// Evaluates an expression by a stack machine.
#include "base/math/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>

namespace strut {

namespace {

constexpr double largest_exponent = 709;  // exp of more is infinite, and the library's series do not converge there

double bessel_i(double order, double x) {
  return std::fabs(x) > largest_exponent ? INFINITY : std::cyl_bessel_i(order, std::fabs(x));
}

// NaN if one of them is.
double least(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double largest(double a, double b) { return std::isnan(a) || a > b ? a : b; }

double i0(double x) { return bessel_i(0, x); }
double i1(double x) { return std::copysign(bessel_i(1, x), x); }

using Do = Instruction::Do;

double combined(Do what, double a, double b) {
  switch (what) {
    case Do::add:
      return a + b;
    case Do::subtract:
      return a - b;
    case Do::multiply:
      return a * b;
    case Do::divide:
      return a / b;
    case Do::power:
      return std::pow(a, b);
    case Do::less:
      return a < b;
    case Do::greater:
      return a > b;
    case Do::less_or_equal:
      return a <= b;
    case Do::greater_or_equal:
      return a >= b;
    case Do::equal:
      return a == b;
    case Do::different:
      return a != b;
    case Do::both:
      return a != 0 && b != 0;
    default:
      return a != 0 || b != 0;
  }
}

constexpr std::size_t most_searched_rows = 1000;  // each costs some 60 evaluations

int row_of(const LookUp& table, double argument) {
  return static_cast<int>(std::ranges::upper_bound(table.arguments, argument) - table.arguments.begin());
}

class Machine {
 public:
  Machine(double x, double y, double z, double t, const std::vector<LookUp>& tables)
      : tables_(tables), variables_{x, y, z, t} {}

  // Returns the number of instructions to skip after this one.
  int execute(const Instruction& one) {
    switch (one.what) {
      case Do::push_number:
        push(one.number);
        return 0;
      case Do::push_variable:
        push(variables_[one.index]);
        return 0;
      case Do::pop_variable:
        variables_[one.index] = pop();
        return 0;
      case Do::truncate:
        push(std::trunc(pop()));
        return 0;
      case Do::negate:
        push(-pop());
        return 0;
      case Do::invert:
        push(pop() == 0);
        return 0;
      case Do::call:
        call(math_functions()[one.index]);
        return 0;
      case Do::look_up:
        push(tables_[one.index](pop()));
        return 0;
      case Do::skip:
        return one.index;
      case Do::skip_if_zero:
        return pop() == 0 ? one.index : 0;
      default: {
        const double b = pop(), a = pop();
        push(combined(one.what, a, b));
        return 0;
      }
    }
  }

  double value() const { return variables_[static_cast<int>(Given::value)]; }

  // execute(one). Also sets `sign`, which changes where the expression may turn: the sign of the result; of functions
  // of two arguments (min, max), of their difference; of truncation, of its remainder by 2; of a table, the row.
  int execute(const Instruction& one, int& sign) {
    const auto sign_of = [](double a) { return (a > 0 ? 1 : 0) - (a < 0 ? 1 : 0); };
    const bool compares = one.what == Do::call && math_functions()[one.index].arguments == 2;
    if (compares) sign = sign_of(stack_[height_ - 2] - stack_[height_ - 1]);
    const bool looks_up = one.what == Do::look_up && tables_[one.index].arguments.size() <= most_searched_rows;
    if (looks_up) sign = row_of(tables_[one.index], stack_[height_ - 1]);
    const int skipped = execute(one);
    if (compares || looks_up || height_ == 0) return skipped;
    const double result = stack_[height_ - 1];
    sign = sign_of(one.what == Do::truncate ? std::fmod(result, 2) : result);
    return skipped;
  }

 private:
  void push(double number) { stack_[height_++] = number; }
  double pop() { return stack_[--height_]; }

  void call(const MathFunction& function) {
    if (function.arguments == 1) return push(function.of_one(pop()));
    const double b = pop(), a = pop();
    push(function.of_two(a, b));
  }

  const std::vector<LookUp>& tables_;
  // Each level of brackets leaves at most one operand for each of the six kinds of operators.
  std::array<double, 8 * (Expression::deepest + 2)> stack_;
  int height_ = 0;
  std::array<double, Expression::most_variables> variables_;
};

}  // namespace

double LookUp::operator()(double argument) const {
  if (std::isnan(argument)) return argument;
  const auto next = std::upper_bound(arguments.begin(), arguments.end(), argument) - arguments.begin();
  if (next == 0) return values.front();
  if (next == std::ssize(arguments)) return values.back();
  const double fraction = (argument - arguments[next - 1]) / (arguments[next] - arguments[next - 1]);
  return values[next - 1] + fraction * (values[next] - values[next - 1]);
}

double Expression::operator()(double x, double y, double z, double t) const {
  Machine machine(x, y, z, t, tables_);
  for (std::size_t i = 0; i < program_.size(); ++i) i += machine.execute(program_[i]);
  return machine.value();
}

std::vector<double> Expression::turns(double x, double y, double z, const std::vector<double>& samples) const {
  constexpr int not_executed = 2;
  std::vector<double> found;
  for (const LookUp& table : tables_) {  // of longer tables all rows in the interval, as if t were their argument
    const auto& rows = table.arguments;
    if (rows.size() <= most_searched_rows) continue;
    found.insert(found.end(), std::ranges::lower_bound(rows, samples.front()),
                 std::ranges::upper_bound(rows, samples.back()));
  }
  const std::size_t most = found.size() + most_turns;
  using Signs = std::vector<int>;
  const auto signs_at = [&](double t) {
    Machine machine(x, y, z, t, tables_);
    Signs signs(program_.size(), not_executed);
    for (std::size_t i = 0; i < program_.size(); ++i) i += machine.execute(program_[i], signs[i]);
    return signs;
  };
  const double least = std::ldexp(samples.back() - samples.front(), -60);
  const std::function<void(double, double, const Signs&, const Signs&)> search =
      [&](double from, double to, const Signs& before, const Signs& after) {
        if (before == after || found.size() >= most) return;
        const double middle = std::midpoint(from, to);
        if (!(from < middle && middle < to && to - from > least)) return found.push_back(to);
        const Signs between = signs_at(middle);
        search(from, middle, before, between);
        search(middle, to, between, after);
      };
  Signs before = signs_at(samples.front());
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Signs after = signs_at(samples[k]);
    search(samples[k - 1], samples[k], before, after);
    before = after;
  }
  return found;
}

const std::vector<MathFunction>& math_functions() {
  using std::acos, std::asin, std::atan, std::cos, std::cosh, std::erf, std::erfc, std::exp, std::fabs, std::log,
      std::log10, std::sin, std::sinh, std::sqrt, std::tan, std::tanh, std::tgamma;
  static const std::vector<MathFunction> all{{"abs", 1, fabs},
                                             {"fabs", 1, fabs},
                                             {"min", 2, nullptr, least},
                                             {"max", 2, nullptr, largest},
                                             {"sqrt", 1, sqrt},
                                             {"pow", 2, nullptr, [](double a, double b) { return std::pow(a, b); }},
                                             {"exp", 1, exp},
                                             {"log", 1, log},
                                             {"log10", 1, log10},
                                             {"sin", 1, sin},
                                             {"cos", 1, cos},
                                             {"tan", 1, tan},
                                             {"asin", 1, asin},
                                             {"acos", 1, acos},
                                             {"atan", 1, atan},
                                             {"atan2", 2, nullptr, [](double a, double b) { return std::atan2(a, b); }},
                                             {"sinh", 1, sinh},
                                             {"cosh", 1, cosh},
                                             {"tanh", 1, tanh},
                                             {"erf", 1, erf},
                                             {"erfc", 1, erfc},
                                             {"gamma", 1, tgamma},
                                             {"j0", 1, ::j0},
                                             {"j1", 1, ::j1},
                                             {"i0", 1, i0},
                                             {"i1", 1, i1}};
  return all;
}

}  // namespace strut
