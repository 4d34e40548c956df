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

// Numbers the corners of voxels as they occur. Voxels are processed layer by layer, so that only the numbers of the
// corners below and above a layer are stored.
class Corners {
 public:
  Corners(io::Mesh& mesh, const VoxelGrid& grid) : mesh_(mesh), grid_(grid) {
    for (std::vector<int>& plane : planes_) plane.assign(static_cast<std::size_t>(width()) * (grid.cells[1] + 1), -1);
  }

  int number(const Triple& at) {
    int& number = planes_[at[2] - layer_][static_cast<std::size_t>(at[1]) * width() + at[0]];
    if (number < 0) {
      number = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.emplace_back(grid_.size.array() * at.cast<double>() / grid_.cells.cast<double>());
      add_to_sets(mesh_, number, at, grid_.cells);
    }
    return number;
  }

  void go_to(int layer) {
    for (; layer_ < layer; ++layer_) {
      planes_[0].swap(planes_[1]);
      std::fill(planes_[1].begin(), planes_[1].end(), -1);
    }
  }

 private:
  int width() const { return grid_.cells[0] + 1; }

  io::Mesh& mesh_;
  const VoxelGrid& grid_;
  int layer_ = 0;
  std::array<std::vector<int>, 2> planes_;
};

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

io::Mesh voxel_mesh(const std::vector<int>& voxels, const VoxelGrid& grid) {
  io::Mesh mesh = empty_mesh();
  Corners numbers(mesh, grid);
  for (const int voxel : voxels) {
    const Triple cell = grid.cell(voxel);
    numbers.go_to(cell[2]);
    for (const Triple& corner : hexahedron_corners) mesh.blocks[0].nodes.push_back(numbers.number(cell + corner));
  }
  return mesh;
}

}  // namespace strut::mesh
