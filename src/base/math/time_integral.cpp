#include "base/math/time_integral.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace strut {

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char *here = text.data(), *end = here + text.size();
  while (here != end) {
    double number = 0;
    const bool begins = std::isdigit(static_cast<unsigned char>(*here)) != 0 || *here == '.';
    const auto [rest, failure] = std::from_chars(here, end, number);
    const bool is_number = begins && failure == std::errc();
    if (is_number) numbers.push_back(number);
    here = is_number ? rest : here + 1;
  }
  std::ranges::sort(numbers);
  return numbers;
}

double time_integral(const Function& value, const Vector& X, double from, double to, const std::vector<double>& turns) {
  if (!value.depends_on_time() || from == to) return (to - from) * value(X, from);
  constexpr int parts = 64;
  constexpr double off = 0.7745966692414834, outer = 5.0 / 18, inner = 8.0 / 18;  // three points, exact to t⁵
  auto turn = std::ranges::upper_bound(turns, from);
  double sum = 0, begin = from;
  for (int part = 1; part <= parts;) {
    double end = part == parts ? to : from + (to - from) * part / parts;
    const bool turns_here = turn != turns.end() && *turn < end;
    if (turns_here) end = *turn++;
    if (!turns_here) ++part;
    const double middle = 0.5 * (begin + end), reach = 0.5 * off * (end - begin);
    sum += (end - begin) * (outer * (value(X, middle - reach) + value(X, middle + reach)) + inner * value(X, middle));
    begin = end;
  }
  return sum;
}

}  // namespace strut
