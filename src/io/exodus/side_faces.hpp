// Faces on periodic sides, where the body continues, or ends.
#pragma once

#include "io/exodus/surface.hpp"

namespace strut::io {

// Collective. The faces, except those on a periodic side that a face on the opposite side meets. `planes`: the sides,
// and symmetry planes; `seams`: of the nodes (side_nodes.hpp).
std::vector<Face> without_continued(const std::vector<Face>& faces, const MeshSlice& slice,
                                    const std::vector<Mirror>& planes, const std::vector<std::int64_t>& seams,
                                    const Communicator& communicator);

}  // namespace strut::io
