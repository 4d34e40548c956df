// A sparse matrix that resembles the tangent of a body, for the preconditioner: springs between near neighbors, as
// stiff as the material of their ends is now. The tangent itself couples points over two horizons and is never formed.
#pragma once

#include "integrators/quasi_static/constraints.hpp"
#include "mechanics/formulation/tangent.hpp"

namespace strut {

// Collective. The rows of this rank's points; `first`: the number of the first of them among those of all ranks.
// `extra`: stiffness of each point beside that of its bonds, N/m.
BlockRows preconditioner_matrix(Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                                const std::vector<Tensor>& extra, std::int64_t first);

// Collective. Translations, and small rotations about the middle of the present places.
std::vector<Field> rigid_motions(const Body& body);

}  // namespace strut
