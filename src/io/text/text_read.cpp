#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/distribute.hpp"
#include "io/exodus/exodus.hpp"

namespace strut::io {

namespace {

struct Line {
  Vector position;
  int block = 0;
  double volume = 0;
};

// A number that fills the word: "1.0e-3", but neither "1,5" nor "nan".
bool read_number(const std::string& word, double& value) {
  std::istringstream stream(word);
  return stream >> value && stream.eof() && std::isfinite(value);
}

// What is wrong with the line, or "".
std::string parse(const std::string& text, Line& line) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.size() != 5) return "expected 5 columns (x y z block volume), found " + std::to_string(words.size());
  double numbers[5] = {};
  for (int i = 0; i < 5; ++i) {
    if (!read_number(words[i], numbers[i])) return "'" + words[i] + "' is not a finite number";
  }
  if (numbers[3] != std::floor(numbers[3]) || std::abs(numbers[3]) > 1e9) {
    return "block '" + words[3] + "' is not an integer";
  }
  if (numbers[4] <= 0) return "volume " + words[4] + " m³ is not positive";
  line = {Vector(numbers[0], numbers[1], numbers[2]), static_cast<int>(numbers[3]), numbers[4]};
  return "";
}

std::vector<Line> read_lines(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw Error(path.string() + ": cannot open it: it is a directory");
  std::ifstream file(path);
  if (!file) throw Error(path.string() + ": cannot open it: no such file, or it may not be read");
  std::vector<Line> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    const std::string content = text.substr(0, text.find('#'));
    if (content.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string problem = parse(content, lines.emplace_back());
    if (problem.empty()) continue;
    throw Error(path.string() + ", line " + std::to_string(number) + ": " + problem + ": \"" + text.substr(0, 120) +
                "\"");
  }
  if (lines.empty()) throw Error(path.string() + ": the file has no points");
  return lines;
}

// Blocks in the order of their numbers, points in the order of the lines.
PointCloud cloud_of(const std::vector<Line>& lines) {
  PointCloud cloud;
  std::map<int, int> index;
  for (const Line& line : lines) index[line.block] = 0;
  for (auto& [number, place] : index) {
    place = static_cast<int>(cloud.block_names.size());
    cloud.block_names.push_back("block_" + std::to_string(number));
  }
  for (const Line& line : lines) {
    cloud.positions.push_back(line.position);
    cloud.volumes.push_back(line.volume);
    cloud.spacings.push_back(std::cbrt(line.volume));
    cloud.blocks.push_back(index[line.block]);
  }
  cloud.sets.assign(lines.size(), 0);
  cloud.ids.resize(lines.size());
  std::iota(cloud.ids.begin(), cloud.ids.end(), 0);
  cloud.element_ids.resize(lines.size());
  std::iota(cloud.element_ids.begin(), cloud.element_ids.end(), 1);
  return cloud;
}

}  // namespace

PointCloud read_text(const std::filesystem::path& file, const Communicator& communicator) {
  PointCloud whole;
  run_on_root(communicator, [&] { whole = cloud_of(read_lines(file)); });
  return distribute(whole, communicator);
}

}  // namespace strut::io
