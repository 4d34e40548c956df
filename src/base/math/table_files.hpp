// Tables of expressions whose numbers stand in a file: table(t, 'pull.csv'). Texts get the numbers before they are
// compiled, so that an expression itself reads no file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strut {

// The names of files in the tables of an expression.
std::vector<std::string> table_files(const std::string& expression);

// `text` with these numbers wherever a table names this file.
std::string with_table(const std::string& text, const std::string& name, const std::string& numbers);

// Rows of two numbers, a place and a value there, as a table has them: "0, 0, 1e-3, 5". Lines that begin with # are
// comments; the first other line may be a header. Throws Error with file and line.
std::string numbers_in_table(const std::filesystem::path& file);

}  // namespace strut
