#include "compare/series.hpp"

#include <algorithm>
#include <fstream>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/numbers.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"

namespace strut::compare {

namespace {

void read_row(const std::string& line, std::vector<Variable>& columns) {
  const std::vector<std::string> words = to_cells(line);
  if (words.size() != columns.size()) {
    throw Error(std::to_string(words.size()) + " values for " + std::to_string(columns.size()) + " columns");
  }
  for (std::size_t c = 0; c < words.size(); ++c) {
    const auto number = to_real(words[c]);
    if (!number) throw Error("'" + words[c] + "' is not a number");
    columns[c].frames[0].push_back(*number);
  }
}

std::vector<Variable> columns_of(const std::string& header, const std::filesystem::path& path) {
  std::vector<Variable> columns;
  for (const std::string& name : to_cells(header)) {
    if (std::ranges::find(columns, name, &Variable::name) != columns.end()) {
      throw Error(path.string() + ": two columns have the name '" + name + "'; expected a name for each column");
    }
    columns.push_back({name, "row", {{}}});
  }
  return columns;
}

Series read_history(const std::filesystem::path& path) {
  if (const std::string why = unreadable(path); !why.empty()) throw Error(why);
  std::ifstream file(path);
  std::string line;
  int row = 0;
  do {  // skips lines that begin with #, which describe the writer
    if (!std::getline(file, line)) throw Error(path.string() + ": it is empty");
    ++row;
  } while (line.starts_with("#"));
  Series series;
  series.variables = columns_of(line, path);
  while (std::getline(file, line)) {
    ++row;
    try {
      read_row(line, series.variables);
    } catch (const Error& error) {
      throw Error(path.string() + ", line " + std::to_string(row) + ": " + error.what());
    }
  }
  return series;
}

Series read_exodus(const std::filesystem::path& path) {
  io::ExodusResult result = io::read_result(path);
  Series series{std::move(result.times), std::move(result.places), {}};
  for (std::size_t v = 0; v < result.nodal.size(); ++v) {
    series.variables.push_back({result.nodal_names[v], "node", std::move(result.nodal[v])});
  }
  for (std::size_t v = 0; v < result.element.size(); ++v) {
    series.variables.push_back({result.element_names[v], "element", std::move(result.element[v])});
  }
  for (const io::ExodusFile::Block& block : io::ExodusFile::open(path).blocks()) {
    const std::string name = block.name.empty() ? "block_" + std::to_string(block.id) : block.name;
    if (block.elements > 0) series.blocks.emplace_back(name, block.elements);
  }
  return series;
}

}  // namespace

Series read_series(const std::filesystem::path& path) {
  return path.extension() == ".csv" ? read_history(path) : read_exodus(path);
}

}  // namespace strut::compare
