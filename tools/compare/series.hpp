// What two results are compared by: named variables with a value per frame and place.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace strut::compare {

struct Variable {
  std::string name;
  std::string place;                        // what an index within a frame counts: "node", "element", "row"
  std::vector<std::vector<double>> frames;  // [frame][place]
};

struct Series {
  std::vector<double> times;  // of the frames; none where a frame has no time
  // x, y, z of the undeformed nodes, m; none of a history.
  std::array<std::vector<double>, 3> places = {};
  std::vector<Variable> variables;
};

// An Exodus result: a frame a time step. A CSV history (by its ending ".csv"): one frame, whose places are the rows, so
// that a value is measured against the largest of its column.
Series read_series(const std::filesystem::path& path);

}  // namespace strut::compare
