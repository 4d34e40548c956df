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

std::vector<Vector> places_of(const std::filesystem::path& path, const ExodusFile& file) {
  const std::int64_t count = file.sizes().nodes;
  const auto axes = file.coordinates(0, count);
  std::vector<Vector> places;
  for (std::int64_t n = 0; n < count; ++n) {
    if (!places.emplace_back(axes[0][n], axes[1][n], axes[2][n]).allFinite())
      throw Error(path.string() + ": node " + std::to_string(n + 1) + ": a coordinate is not a finite number");
  }
  return places;
}

// Refuses elements that can be read, but not in their intended sense.
std::vector<ExodusFile::Block> checked_blocks(const std::filesystem::path& path, const ExodusFile& file) {
  if (const std::int64_t axes = file.sizes().dimensions; axes != 3)
    throw Error(path.string() + ": the mesh has " + std::to_string(axes) + " dimensions, expected 3");
  std::vector<ExodusFile::Block> blocks = file.blocks();
  for (ExodusFile::Block& block : blocks) {
    if (block.name.empty()) block.name = "block_" + std::to_string(block.id);
  }
  if (const std::string twice = said_twice("block", blocks, blocks); !twice.empty())
    throw Error(path.string() + ": " + twice);
  return blocks;
}

// Twice the triangle's area as a vector along its normal; zero if round-off may have made it.
Vector area_of(const Triangle& one) {
  const Vector u = one[1] - one[0], v = one[2] - one[0], area = u.cross(v);
  const double size = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  return area.norm() > 1e-12 * size ? area : Vector::Zero();
}

// A quadrilateral is two triangles with the diagonal from its first node, or one if two corners are at one place.
// "" or the reason why an element is no surface; `corners`: of the element.
std::string add_triangles(const std::vector<Vector>& corners, std::vector<Triangle>& triangles) {
  Vector first = Vector::Zero();
  for (std::size_t third = 2; third < corners.size(); ++third) {
    const Triangle one{corners[0], corners[third - 1], corners[third]};
    const Vector area = area_of(one);
    if (first.dot(area) < 0) return "its corners cross, or one is re-entrant; expected them in their order around it";
    if (area.isZero(0)) continue;
    first = area;
    triangles.push_back(one);
  }
  return first.isZero(0) ? "it has no area" : "";
}

std::vector<Triangle> triangles_of(const std::filesystem::path& path) {
  const ExodusFile file = ExodusFile::open(path);
  const std::vector<ExodusFile::Block> blocks = checked_blocks(path, file);
  const std::vector<Vector> places = places_of(path, file);
  std::vector<Triangle> triangles;
  for (const ExodusFile::Block& block : blocks) {
    if (block.elements == 0) continue;
    const int count = corners_of(path, block);
    const auto fail = [&](const std::string& what) {
      throw Error(path.string() + ": block '" + block.name + "' " + what);
    };
    std::vector<Vector> corners;
    std::int64_t elements = 0;
    for (const std::int64_t node : file.connectivity(block, 0, block.elements)) {
      if (node < 1 || node > std::ssize(places))
        fail("names node " + std::to_string(node) + " of " + std::to_string(places.size()));
      corners.push_back(places[static_cast<std::size_t>(node - 1)]);
      if (std::ssize(corners) < count) continue;
      const std::string wrong = add_triangles(corners, triangles);
      if (++elements; !wrong.empty()) fail("element " + std::to_string(elements) + ": " + wrong);
      corners.clear();
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
