// The content of a result for a comparison: named variables with a value per frame and entity.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace strut::compare {

struct Variable {
  std::string name;
  std::string place;                        // the entity that an index within a frame counts: "node", "element", "row"
  std::vector<std::vector<double>> frames;  // [frame][place]
};

struct Series {
  std::vector<double> times;  // of the frames; empty if a frame has no time
  // x, y, z of the undeformed nodes, m; empty for a history.
  std::array<std::vector<double>, 3> places = {};
  std::vector<Variable> variables;
  // Names and numbers of elements, in the order of the file; without empty ones, which say nothing of a point.
  std::vector<std::pair<std::string, std::int64_t>> blocks = {};
};

// An Exodus result: a frame per time step. A CSV history (with the suffix ".csv"): one frame, whose entities are the
// rows, so that a value is compared with the largest of its column.
Series read_series(const std::filesystem::path& path);

}  // namespace strut::compare
