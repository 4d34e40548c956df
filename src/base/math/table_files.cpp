#include "base/math/table_files.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/numbers.hpp"

namespace strut {

namespace {

namespace fs = std::filesystem;

constexpr const char* blanks = " \t\r\n";
// Bytes, some 300,000 rows: checkpoints and messages between ranks hold them.
constexpr std::uintmax_t largest = 10'000'000;

struct Quoted {
  std::size_t begin, end;  // of the name, without its quotes
};

// The next name in quotes that is the last word of a call: ", 'pull.csv')".
std::optional<Quoted> next_name(const std::string& text, std::size_t from) {
  for (std::size_t at = text.find('\'', from); at != std::string::npos; at = text.find('\'', at + 1)) {
    const std::size_t end = text.find('\'', at + 1);
    if (end == std::string::npos) return std::nullopt;
    const std::size_t before = at == 0 ? std::string::npos : text.find_last_not_of(blanks, at - 1);
    const std::size_t after = text.find_first_not_of(blanks, end + 1);
    if (before == std::string::npos || text[before] != ',') continue;
    if (after == std::string::npos || text[after] != ')') continue;
    return Quoted{at + 1, end};
  }
  return std::nullopt;
}

// Between commas or semicolons, else between blanks.
std::vector<std::string_view> cells(std::string_view line) {
  const bool by_mark = line.find_first_of(",;") != std::string_view::npos;
  std::vector<std::string_view> found;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(by_mark ? ",;" : blanks), line.size());
    found.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (!by_mark) line = trimmed(line);
  }
  return found;
}

// True for a number in any spelling (1.D0, "1", nan), which a header does not have.
bool seems_a_number(std::string_view word) {
  for (const std::string_view before : {"\"", "'", "+", "-", "−"}) {
    if (word.starts_with(before)) word.remove_prefix(before.size());
  }
  if (!word.empty() && std::string_view("0123456789.").find(word[0]) != std::string_view::npos) {
    return word.find_first_not_of("0123456789.,+-eEdD_\"'") == std::string_view::npos;  // "2nd" and "0deg" are words
  }
  std::string lower(word);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

}  // namespace

std::vector<std::string> table_files(const std::string& expression) {
  std::vector<std::string> names;
  for (auto name = next_name(expression, 0); name; name = next_name(expression, name->end + 1))
    names.push_back(expression.substr(name->begin, name->end - name->begin));
  return names;
}

std::string with_table(const std::string& text, const std::string& name, const std::string& numbers) {
  std::string filled;
  std::size_t from = 0;
  for (auto next = next_name(text, 0); next; next = next_name(text, next->end + 1)) {
    if (text.compare(next->begin, next->end - next->begin, name) != 0) continue;
    filled += text.substr(from, next->begin - 1 - from) + numbers;
    from = next->end + 1;
  }
  return filled + text.substr(from);
}

std::string numbers_in_table(const fs::path& file) {
  if (const std::string reason = unreadable(file); !reason.empty()) throw Error(reason);
  const std::string expected = "; expected two numbers, the place (the time, s) and the value";
  if (fs::file_size(file) > largest) {
    throw Error(file.string() + " has " + std::to_string(fs::file_size(file)) + " bytes; expected at most " +
                std::to_string(largest));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string numbers;
  std::optional<double> before;
  bool has_header = false;
  int row = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string_view all = ++row == 1 ? without_mark(line) : line,
                           content = trimmed(all.substr(0, all.find('#')));
    if (content.empty()) continue;
    const std::vector<std::string_view> words = cells(content);
    const std::string where = file.string() + ", line " + std::to_string(row) + ": ";
    const auto place = to_finite(words[0]), value = words.size() == 2 ? to_finite(words[1]) : std::nullopt;
    const bool is_header = !before && !has_header && std::ranges::none_of(words, seems_a_number);
    if (has_header |= is_header; is_header) continue;
    if (!place || !value) throw Error(where + "'" + std::string(content.substr(0, 60)) + "'" + expected);
    if (before && !(*place > *before))
      throw Error(where + to_text(*place) + " after " + to_text(*before) + "; expected places that rise");
    numbers += (before ? ", " : "") + to_text(*place) + ", " + to_text(*value);
    before = place;
  }
  if (!before) throw Error(file.string() + " has no row" + expected);
  return numbers;
}

}  // namespace strut
