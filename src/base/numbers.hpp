// Converts text to numbers, strictly: the whole text must be a number. "1.5e9 Pa" is none, and "1.5" is no integer.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strut {

std::string_view trimmed(std::string_view text);

// Without the byte order mark that some editors put before the first line of a text.
std::string_view without_mark(std::string_view line);

std::optional<int> to_integer(std::string_view text);
std::optional<double> to_real(std::string_view text);  // may be infinite or NaN: "inf", "1e999", "nan"
std::optional<double> to_finite(std::string_view text);
std::optional<bool> to_boolean(std::string_view text);

// "0 0 1", "0, 0, 1" or, as Teuchos writes arrays, "{0, 0, 1}".
std::optional<std::vector<double>> to_reals(std::string_view text);

std::vector<std::string> to_words(std::string_view text);  // separated by blanks
std::vector<std::string> to_cells(std::string_view text);  // by commas, without blanks around them

// The shortest text that reads back as `value`.
std::string to_text(double value);

}  // namespace strut
