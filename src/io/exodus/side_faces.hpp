// Faces on periodic sides, where the body continues, or ends.
#pragma once

#include "io/exodus/surface.hpp"

namespace strut::io {

// Collective. The faces, except those on a periodic side that a face on the opposite side meets. `planes`: the sides,
// and symmetry planes.
std::vector<Face> without_continued(const std::vector<Face>& faces, const MeshSlice& slice,
                                    const std::vector<Mirror>& planes, const Communicator& communicator);

}  // namespace strut::io
