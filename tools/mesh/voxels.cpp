#include "mesh/voxels.hpp"

#include <algorithm>
#include <cmath>

namespace strut::mesh {

namespace {

using Triple = Eigen::Array3i;

// The faces, in the order of other bodies: zmin and zmax first.
struct Face {
  const char* name;
  int axis;
  bool upper;
};
constexpr std::array<Face, 6> faces = {{{"zmin", 2, false},
                                        {"zmax", 2, true},
                                        {"xmin", 0, false},
                                        {"xmax", 0, true},
                                        {"ymin", 1, false},
                                        {"ymax", 1, true}}};

}  // namespace

VoxelGrid grid_of(const Vector& size, double spacing, int factor) {
  VoxelGrid grid{size, Eigen::Array3i::Ones()};
  for (int k = 0; k < 3; ++k) {
    grid.cells[k] = factor * std::max(1, static_cast<int>(std::lround(size[k] / spacing)));
  }
  return grid;
}

io::Mesh empty_mesh() {
  io::Mesh mesh;
  for (const Face& face : faces) mesh.node_sets.push_back({face.name, {}});
  mesh.blocks.push_back({"", "HEX8", {}, {}, {}});
  return mesh;
}

void add_to_sets(io::Mesh& mesh, int number, const Triple& at, const Triple& last) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const int axis = faces[f].axis;
    if (at[axis] == (faces[f].upper ? last[axis] : 0)) mesh.node_sets[f].nodes.push_back(number);
  }
}

io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid,
                    const std::function<Vector(const Triple&)>& place) {
  io::Mesh mesh = empty_mesh();
  const std::ptrdiff_t row = grid.cells[0] + 1, layer = row * (grid.cells[1] + 1);
  std::vector<int> numbers(2 * layer, -1);  // as the corners occur; of the two layers of corners of a layer of voxels
  int top = 1;                              // the upper one
  for (const int voxel : voxels) {
    for (; top <= grid.cell(voxel)[2]; ++top) std::fill_n(numbers.begin() + (top + 1) % 2 * layer, layer, -1);
    for (const Triple& corner : hexahedron_corners) {
      const Triple at = grid.cell(voxel) + corner;
      int& number = numbers[at[2] % 2 * layer + at[1] * row + at[0]];
      if (number < 0) {
        number = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(place(at));
        add_to_sets(mesh, number, at, grid.cells);
      }
      mesh.blocks[0].nodes.push_back(number);
    }
  }
  return mesh;
}

io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid) {
  return voxel_mesh(voxels, grid, [&](const Triple& at) -> Vector {
    return grid.size.array() * at.cast<double>() / grid.cells.cast<double>();
  });
}

}  // namespace strut::mesh
