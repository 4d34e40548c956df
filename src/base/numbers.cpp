#include "base/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <type_traits>

namespace strut {

namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number number{};
  const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool too_large = std::is_floating_point_v<Number> && failure == std::errc::result_out_of_range;
  if (too_large) number = static_cast<Number>(std::strtod(std::string(text).c_str(), nullptr));  // infinite, or 0
  if ((failure != std::errc() && !too_large) || rest != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::string_view without_mark(std::string_view line) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return line.substr(line.starts_with(mark) ? mark.size() : 0);
}

std::string_view trimmed(std::string_view text) {
  const std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::optional<int> to_integer(std::string_view text) { return parse<int>(text); }

std::optional<double> to_real(std::string_view text) { return parse<double>(text); }

std::optional<double> to_finite(std::string_view text) {
  const auto number = to_real(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<bool> to_boolean(std::string_view text) {
  std::string word(trimmed(text));
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word == "true" || word == "yes" || word == "1") return true;
  if (word == "false" || word == "no" || word == "0") return false;
  return std::nullopt;
}

std::optional<std::vector<double>> to_reals(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('{') && text.ends_with('}')) text = text.substr(1, text.size() - 2);
  std::string list(text);
  std::replace(list.begin(), list.end(), ',', ' ');
  std::vector<double> numbers;
  for (const std::string& word : to_words(list)) {
    const auto number = to_real(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::string> to_words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> to_cells(std::string_view text) {
  std::istringstream stream{std::string(text) + ','};  // with a comma behind each, the last one, too
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) cells.emplace_back(trimmed(cell));
  return cells;
}

std::string to_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace strut
