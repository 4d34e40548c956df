// How the forces of a block's bonds follow from its deformation, and how much each bond counts.
#pragma once

namespace strut {

// ω(r), r = |ξ|/δ: 1; 1 − r; 1 − 3r² + 2r³.
enum class Influence { one, linear_decay, cubic_decay };

// How the forces of a block's bonds follow from its deformation.
//   correspondence: the family gives F, the law a stress, and the stress the force of each bond
//   ordinary: the linear elastic solid of Silling et al. (2007), with forces along the bonds; it takes only the elastic
//   moduli of the law
//   quadratic: the family gives F and its gradient over the cell of the point, the law stresses at four integration
//   points of the cell, and these the force of each bond (quadratic_fit.hpp)
enum class Formulation { correspondence, ordinary, quadratic };

// Measured cost of a step of a point by quadratic correspondence, relative to a point by another formulation
// (docs/decisions.md, Cost of subcycling), for the partition weights and for the choice of substeps.
constexpr double cost_of_quadratic = 4;

}  // namespace strut
