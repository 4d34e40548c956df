// Surfaces of triangles and quadrilaterals.
#include <algorithm>
#include <array>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/exodus_words.hpp"
#include "io/on_root.hpp"

namespace strut::io {

namespace {

bool is_of_shells(const ExodusFile::Block& block) {
  const std::string type = upper(block.type);
  return type.starts_with("TRI") || type.starts_with("QUAD") || type.starts_with("SHELL");
}

int corners_of(const std::filesystem::path& path, const ExodusFile::Block& block) {
  const auto corners = static_cast<int>(block.nodes_per_element);
  if (is_of_shells(block) && (corners == 3 || corners == 4)) return corners;
  throw Error(path.string() + ": block '" + block.name + "' has elements '" + block.type + "' with " +
              std::to_string(corners) + " nodes; expected triangles of 3 or quadrilaterals of 4");
}

std::vector<Vector> places_of(const ExodusFile& file) {
  const std::int64_t count = file.sizes().nodes;
  const auto axes = file.coordinates(0, count);
  std::vector<Vector> places;
  for (std::int64_t n = 0; n < count; ++n) places.emplace_back(axes[0][n], axes[1][n], axes[2][n]);
  return places;
}

// A quadrilateral is two triangles with the diagonal from its first node.
std::vector<Triangle> triangles_of(const std::filesystem::path& path) {
  const ExodusFile file = ExodusFile::open(path);
  const std::vector<Vector> places = places_of(file);
  std::vector<Triangle> triangles;
  for (const ExodusFile::Block& block : file.blocks()) {
    if (block.elements == 0) continue;
    const int corners = corners_of(path, block);
    const std::vector<std::int64_t> nodes = file.connectivity(block, 0, block.elements);
    const auto place = [&](std::int64_t n) {
      const std::int64_t node = nodes[static_cast<std::size_t>(n)];
      if (node < 1 || node > static_cast<std::int64_t>(places.size()))
        throw Error(path.string() + ": block '" + block.name + "' names node " + std::to_string(node) + " of " +
                    std::to_string(places.size()));
      return places[static_cast<std::size_t>(node - 1)];
    };
    for (std::int64_t e = 0; e < block.elements; ++e) {
      const std::int64_t n = e * corners;
      for (int third = 2; third < corners; ++third)
        triangles.push_back({place(n), place(n + third - 1), place(n + third)});
    }
  }
  if (triangles.empty()) throw Error(path.string() + ": has no triangle and no quadrilateral");
  return triangles;
}

}  // namespace

std::vector<Triangle> read_shells(const std::filesystem::path& file, const Communicator& communicator) {
  std::vector<std::array<double, 9>> numbers;
  run_on_root(communicator, [&] {
    for (const Triangle& one : triangles_of(file)) {
      std::array<double, 9>& row = numbers.emplace_back();
      for (int n = 0; n < 9; ++n) row[n] = one[n / 3][n % 3];
    }
  });
  communicator.broadcast(numbers);
  std::vector<Triangle> triangles;
  for (const auto& row : numbers) {
    Triangle& one = triangles.emplace_back();
    for (int n = 0; n < 9; ++n) one[n / 3][n % 3] = row[n];
  }
  return triangles;
}

}  // namespace strut::io
