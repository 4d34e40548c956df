// Points without a mesh file: the centers of the equal cells of a block.
#pragma once

#include <array>
#include <optional>

#include "topology/cloud.hpp"
#include "topology/mirror.hpp"

namespace strut {
class Communicator;
}

namespace strut::io {

// Collective. Makes `points` cells along x, y, z, x fastest, in the block "block_1"; each rank gets a contiguous slice.
// `with_cells`: also shapes, and shared nodes, which are the corners of the cells; faces on symmetry `planes` are no
// surface, and go to `apart`.
// `box`: the shared nodes then stand for boxes of cells, box + 1 cells along each axis, so that two cells have a shared
// node if they are within `box` cells of each other along each axis.
PointCloud make_grid(const Vector& origin, const Vector& length, const std::array<int, 3>& points,
                     const Communicator& communicator, bool with_cells = false, const std::vector<Mirror>& planes = {},
                     const std::optional<std::array<int, 3>>& box = {}, FacesOnPlanes* apart = nullptr);

}  // namespace strut::io
