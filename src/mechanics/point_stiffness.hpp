// The stiffness of the energy of one point: a small dense matrix over the point and its family, like the stiffness of a
// finite element over its nodes. The sum over all points is the tangent that apply_tangent() applies without a matrix,
// except that springs on the gradients of both ends act here on each end's own gradient.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/formulation/tangent.hpp"

namespace strut {

struct PointStiffness {
  std::vector<int> points;  // the point, then its family: owned points and ghosts
  Eigen::MatrixXd matrix;   // 3n × 3n, N/m: row 3 a + r, column 3 b + c: minus the force on a along r for b along c
};

// True if all blocks have such a matrix: those by correspondence and by quadratic correspondence do, ordinary ones not.
bool have_point_stiffness(const Body& body);

// The matrix of block.points[k], with the tangents of point_tangents(). No points if it carries no stress.
void take_point_stiffness(const Body& body, const MaterialBlock& block, int k,
                          const std::vector<PointTangent>& tangents, PointStiffness& result);

}  // namespace strut
