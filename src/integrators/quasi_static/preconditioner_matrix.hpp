// A sparse matrix that resembles the tangent of a body, for the preconditioner: springs between near neighbors, with
// the present stiffness of their ends' material. The tangent couples points over two horizons and is never assembled.
#pragma once

#include "integrators/quasi_static/constraints.hpp"
#include "mechanics/formulation/tangent.hpp"

namespace strut {

// Collective. The rows of this rank's points; `first`: global number of the first of them. `extra`: stiffness of each
// point besides that of its bonds, N/m.
BlockRows preconditioner_matrix(Body& body, const std::vector<PointTangent>& tangents, const Constraints& held,
                                const std::vector<Tensor>& extra, std::int64_t first);

// Collective. Translations, and small rotations about the center of the present positions.
std::vector<Field> rigid_motions(const Body& body);

}  // namespace strut
