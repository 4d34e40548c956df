// The stiffness of the energy of one point: a small dense matrix over the point and its family, as that of a finite
// element over its nodes. Their sum over all points is the tangent that apply_tangent() applies without a matrix, but
// for the springs on the gradients of both ends, which each end has here by its own gradient.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/formulation/tangent.hpp"

namespace strut {

struct PointStiffness {
  std::vector<int> points;  // the point, then its family: owned points and ghosts
  Eigen::MatrixXd matrix;   // 3n × 3n, N/m: row 3 a + r, column 3 b + c: minus the force on a along r for b along c
};

// Whether all blocks have such a matrix: those by correspondence and by quadratic correspondence, not ordinary ones.
bool have_point_stiffness(const Body& body);

// Of block.points[k], with the tangents of point_tangents(). No points where it carries no stress.
void take_point_stiffness(const Body& body, const MaterialBlock& block, int k,
                          const std::vector<PointTangent>& tangents, PointStiffness& result);

}  // namespace strut
