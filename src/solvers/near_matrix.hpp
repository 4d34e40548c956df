// A sparse matrix that resembles the tangent of a body, for the preconditioner: springs between near neighbours, as
// stiff as the material of their ends is now. The tangent itself couples points over two horizons and is never formed.
#pragma once

#include "mechanics/tangent.hpp"
#include "solvers/held.hpp"

namespace strut {

// Collective. The rows of this rank's points; `first`: the number of the first of them among those of all ranks.
// `extra`: stiffness of each point beside that of its bonds, N/m.
BlockRows near_matrix(Body& body, const std::vector<PointTangent>& tangents, const Held& held,
                      const std::vector<Tensor>& extra, std::int64_t first);

// Collective. Translations, and small rotations about the middle of the present places.
std::vector<Field> rigid_motions(const Body& body);

}  // namespace strut
