// All that mechanics knows of the points of one rank: the dictionary of fields.
#pragma once

#include <string>
#include <vector>

#include "base/tensors.hpp"
#include "materials/laws.hpp"
#include "points/domain.hpp"
#include "points/site.hpp"

namespace strut {

// ω(r), r = |ξ|/δ: 1; 1 − r; 1 − 3r² + 2r³.
enum class Influence { one, linear_decay, cubic_decay };

// What the force of a bond reads of an end: A = P K⁻¹ − C F (columns), and C in the fourth lane of the first column.
struct alignas(32) ForceState {
  Eigen::Array4d column[3];
};

// What only the point itself reads.
struct MaterialPoint {
  Tensor deformation_gradient = Tensor::Identity();  // F
  Tensor rotation = Tensor::Identity();              // R
  Symmetric stress = Symmetric::Zero();              // unrotated Cauchy stress, Pa
  Symmetric shape_inverse = Symmetric::Zero();       // K⁻¹, 1/m⁵
  double stabilization = 0;                          // C, Pa/m⁵
};

struct BlockMaterial {
  double density = 0;  // kg/m³
  materials::AnyLaw law;
  double stabilization = 0;  // in units of (λ + 2μ)/(tr K/3); 0: none
};

// The points of one block of the mesh on this rank, with their law's state in columns.
struct MaterialBlock {
  std::string name;
  BlockMaterial material;
  std::vector<int> points;    // owned points, ascending
  int interior = 0;           // so many of them need no ghost
  std::vector<double> state;  // state[column * points.size() + k] of points[k]
};

struct Body {
  Domain domain;
  Influence influence = Influence::one;
  std::vector<MaterialBlock> blocks;  // as domain.cloud.block_names

  // Owned points and ghosts.
  std::vector<Site> sites;
  std::vector<ForceState> force_states;

  // Owned points.
  std::vector<MaterialPoint> points;
  std::vector<double> density;             // kg/m³
  std::vector<Vector> velocity;            // at mid-step, m/s
  std::vector<Vector> previous_velocity;   // at the mid-step before, m/s
  std::vector<Vector> force_density;       // N/m³ of reference volume
  std::vector<double> stabilization_work;  // energy of the stabilisation, J/m³; current after a step with energies

  int owned() const { return domain.owned; }
  double mass(int i) const { return density[i] * domain.volumes[i]; }
  Vector current(int i) const { return sites[i].current.head<3>().matrix(); }
  Vector displacement(int i) const { return current(i) - domain.positions[i]; }
};

// Shape tensors, stabilisation and undeformed state. `materials`: one for each block name of the cloud.
Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials);

// Bytes that a point and a bond take, for predictions.
struct Footprint {
  double per_point, per_bond;
};
Footprint footprint(const BlockMaterial& material);

}  // namespace strut
