// Nodes on periodic sides, where a mesh may have several at one place.
#pragma once

#include "io/exodus/mesh_slice.hpp"
#include "topology/mirror.hpp"

namespace strut::io {

// Collective. For each node of the slice, what tells it from others at its place on a periodic side (shared_node_at); 0
// where each side has one node there, or none. Bodies that touch, the faces of a crack and parts of hexahedra that are
// partly filled have nodes of their own: such nodes are one behind the side only if faces join them that lie over each
// other there. `planes`: the sides, and symmetry planes; `spacings`: of the elements, m.
std::vector<std::int64_t> seams_at_sides(const MeshSlice& slice, const std::vector<Mirror>& planes,
                                         const std::vector<double>& spacings, const Communicator& communicator);

}  // namespace strut::io
