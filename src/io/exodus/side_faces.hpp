// Faces on symmetry planes and periodic sides, where the body continues, or ends.
#pragma once

#include "io/exodus/surface.hpp"

namespace strut::io {

// Collective. The faces without those behind which the body continues: faces on symmetry planes, and on a periodic side
// those that another face of the mesh meets from behind the other side.
std::vector<Face> without_continued(const std::vector<Face>& faces, const MeshSlice& slice,
                                    const std::vector<Mirror>& planes, const Communicator& communicator);

}  // namespace strut::io
