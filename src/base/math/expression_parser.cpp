// Compilation, by recursive descent:
// clang-format off
//   statements:  { [double | int] name = expression ; | if ( expression ) { statements } [else if …] [else { statements }] }
//   expression:  or [? expression : expression]
//   or, and, equality, order, sum, product: operands with operators of one rank between, from the left
//   power:       {- | + | !} primary [^ power]
//   primary:     number | name | function ( … ) | ( expression ) | table ( expression {, place, value} )
// (table ( expression , 'file' ) has become that before: table_files.hpp)
// clang-format on
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/errors.hpp"
#include "base/math/expression.hpp"
#include "base/math/expression_text.hpp"
#include "base/math/function.hpp"

namespace strut {

namespace {

using Do = Instruction::Do;

// Longer operators first, if one begins with another.
struct Operator {
  const char* text;
  Do what;
  int rank;
};
constexpr Operator operators[] = {
    {"||", Do::either, 0},    {"&&", Do::both, 1},          {"==", Do::equal, 2},
    {"!=", Do::different, 2}, {"<=", Do::less_or_equal, 3}, {">=", Do::greater_or_equal, 3},
    {"<", Do::less, 3},       {">", Do::greater, 3},        {"+", Do::add, 4},
    {"-", Do::subtract, 4},   {"*", Do::multiply, 5},       {"/", Do::divide, 5}};
constexpr int rank_of_equality = 2, rank_of_order = 3, ranks = 6;

const std::string table_word = "table";

}  // namespace

class ExpressionParser : ExpressionText {
 public:
  explicit ExpressionParser(const std::string& text) : ExpressionText(text) {}

  Expression parse() {
    if (mentions_value()) {
      while (!at_end()) statement();
    } else {
      expression();
      if (!at_end()) fail("expected an operator");
      emit(Do::pop_variable, static_cast<int>(Given::value));
    }
    const std::size_t executed = text_.size() - in_tables_;
    if (executed > Expression::longest) {
      throw Error("it has " + std::to_string(executed) + " characters besides the numbers of tables, at most " +
                  std::to_string(Expression::longest) + " are possible");
    }
    return std::move(result_);
  }

 private:
  struct Variable {
    std::string name;
    bool whole = false;  // an int
  };

  // Counts the nesting depth while it exists, because the parser recurses.
  class Level {
   public:
    explicit Level(ExpressionParser& parser) : parser_(parser) {
      if (++parser_.depth_ > Expression::deepest) {
        parser_.fail("more than " + std::to_string(Expression::deepest) + " brackets or signs within each other");
      }
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    ExpressionParser& parser_;
  };

  // ---- instructions

  void emit(Do what, int index = 0, double number = 0) { result_.program_.push_back({what, number, index}); }

  // Emits a skip; land() later sets its length, so that it skips everything in between.
  std::size_t emit_skip(Do what) {
    emit(what);
    return result_.program_.size() - 1;
  }
  void land(std::size_t skip) { result_.program_[skip].index = static_cast<int>(result_.program_.size() - skip - 1); }

  // ---- statements

  void statement() {
    const std::string word = coming_name();
    if (word == "if") return condition();
    if (word == "for" || word == "while") fail("there are no loops");
    if (word == "double" || word == "float" || word == "int") {
      name();
      return declaration(word == "int");
    }
    if (word.empty()) fail("expected a statement such as 'value = x;'");
    assignment(assignable());
  }

  void declaration(bool whole) {
    const std::string fresh = name();
    if (place_of(fresh) >= 0 || function_of(fresh) >= 0) fail("the name '" + fresh + "' is taken");
    if (variables_.size() == Expression::most_variables)
      fail("too many variables: " + std::to_string(Expression::most_variables - 5) + " may be declared");
    variables_.push_back({fresh, whole});
    emit(Do::push_number);
    emit(Do::pop_variable, static_cast<int>(variables_.size()) - 1);  // 0, also if a branch is not taken
    if (next() == '=') return assignment(static_cast<int>(variables_.size()) - 1);
    end_statement();
  }

  int assignable() {
    const std::size_t here = at_;
    const int index = variable(name());
    if (index >= static_cast<int>(Given::value)) return index;
    at_ = here;
    fail("x, y, z and t cannot be changed");
  }

  void assignment(int index) {
    expect("=");
    expression();
    if (variables_[index].whole) emit(Do::truncate);
    emit(Do::pop_variable, index);
    end_statement();
  }

  // The last statement needs no semicolon.
  void end_statement() {
    if (!at_end()) expect(";");
  }

  void condition() {
    const Level level(*this);
    name();
    expect("(");
    expression();
    expect(")");
    const std::size_t to_else = emit_skip(Do::skip_if_zero);
    block();
    if (coming_name() != "else") return land(to_else);
    name();
    const std::size_t to_end = emit_skip(Do::skip);
    land(to_else);
    coming_name() == "if" ? condition() : block();
    land(to_end);
  }

  void block() {
    const Level level(*this);
    expect("{");
    while (!at_end() && next() != '}') statement();
    expect("}");
  }

  // ---- expressions

  const Operator* coming_operator(int rank) {
    skip_blanks();
    for (const Operator& one : operators) {
      if (text_.compare(at_, std::char_traits<char>::length(one.text), one.text) == 0) {
        return one.rank == rank ? &one : nullptr;
      }
    }
    return nullptr;
  }

  void expression() {
    binary(0);
    if (!take("?")) return;
    const Level level(*this);
    const std::size_t to_other = emit_skip(Do::skip_if_zero);
    expression();
    expect(":");
    const std::size_t to_end = emit_skip(Do::skip);
    land(to_other);
    expression();
    land(to_end);
  }

  void binary(int rank) {
    if (rank == ranks) return power();
    binary(rank + 1);
    for (bool first = true; const Operator* one = coming_operator(rank); first = false) {
      // In a < b < c, the second comparison would get 1 or 0 from the first one.
      if (!first && (rank == rank_of_order || rank == rank_of_equality)) fail("write a < b && b < c for a < b < c");
      take(one->text);
      binary(rank + 1);
      emit(one->what);
    }
  }

  void power() {
    const Level level(*this);
    const std::vector<Do> before = signs();
    primary();
    // Languages differ here: the sign or the power may bind more strongly.
    if (next() == '^' && !before.empty()) fail("write -(a^b) or (-a)^b: which of the two is meant?");
    for (auto one = before.rbegin(); one != before.rend(); ++one) emit(*one);
    if (!take("^")) return;
    power();
    emit(Do::power);
  }

  // The operations of signs, to be applied to the number after them from right to left.
  std::vector<Do> signs() {
    std::vector<Do> all;
    for (;;) {
      if (take("-")) {
        all.push_back(Do::negate);
      } else if (take("!")) {
        all.push_back(Do::invert);
      } else if (!take("+")) {
        return all;
      }
    }
  }

  void primary() {
    const char c = next();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (begins_name(c)) return named();
    if (!take("(")) fail("expected a number, a name or '('");
    expression();
    expect(")");
  }

  void number() {
    double value = 0;
    const char *begin = text_.data() + at_, *end = text_.data() + text_.size();
    const auto [rest, failure] = std::from_chars(begin, end, value);
    if (failure != std::errc()) fail("expected a number that a double can hold");
    if (rest != end && (in_name(*rest) || *rest == '.')) fail("expected a number");
    at_ += static_cast<std::size_t>(rest - begin);
    emit(Do::push_number, 0, value);
  }

  void named() {
    const std::size_t here = at_;
    const std::string word = name();
    if (next() == '(') return word == table_word ? table() : call(word, here);
    at_ = here;
    const int index = variable(word);
    at_ = here + word.size();
    result_.uses_position_ = result_.uses_position_ || index <= static_cast<int>(Given::z);
    result_.uses_time_ = result_.uses_time_ || index == static_cast<int>(Given::t);
    emit(Do::push_variable, index);
  }

  double constant() {
    const bool negative = take("-");
    const char c = next();
    if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.')
      fail("expected a number, or instead of all of them the name of a file in single quotes");
    number();
    const double value = result_.program_.back().number;
    result_.program_.pop_back();
    return negative ? -value : value;
  }

  void table() {
    LookUp found;
    expect("(");
    expression();
    const std::size_t first = at_;
    do {
      expect(",");
      const std::size_t here = at_;
      found.arguments.push_back(constant());
      if (found.arguments.size() > 1 && !(found.arguments.back() > found.arguments[found.arguments.size() - 2])) {
        at_ = here;
        fail("the places of a table must rise");
      }
      expect(",");
      found.values.push_back(constant());
    } while (next() == ',');
    in_tables_ += at_ - first;
    expect(")");
    emit(Do::look_up, static_cast<int>(result_.tables_.size()));
    result_.tables_.push_back(std::move(found));
  }

  void call(const std::string& word, std::size_t here) {
    const int index = function_of(word);
    if (index < 0) {
      at_ = here;
      fail("there is no function '" + word + "'" + did_you_mean(word, functions_in_expressions()) + "; there are " +
           joined(functions_in_expressions()));
    }
    expect("(");
    expression();
    for (int n = 1; n < math_functions()[index].arguments; ++n) {
      expect(",");
      expression();
    }
    expect(")");
    emit(Do::call, index);
  }

  // ---- names

  int place_of(const std::string& word) const {
    const auto found =
        std::find_if(variables_.begin(), variables_.end(), [&](const auto& v) { return v.name == word; });
    return found == variables_.end() ? -1 : static_cast<int>(found - variables_.begin());
  }

  int variable(const std::string& word) const {
    const int index = place_of(word);
    if (index < 0) fail("'" + word + "' is not a variable" + (function_of(word) < 0 ? "" : " but a function"));
    return index;
  }

  static int function_of(const std::string& word) {
    const std::vector<MathFunction>& all = math_functions();
    const auto found = std::find_if(all.begin(), all.end(), [&](const MathFunction& one) { return word == one.name; });
    return found == all.end() ? -1 : static_cast<int>(found - all.begin());
  }

  int depth_ = 0;
  std::size_t in_tables_ = 0;  // characters of their numbers, which a look-up does not pass one by one
  std::vector<Variable> variables_{{"x"}, {"y"}, {"z"}, {"t"}, {"value"}};
  Expression result_;
};

Expression Expression::compile(const std::string& text) { return ExpressionParser(text).parse(); }

}  // namespace strut
