// For comparison: explicit steps of eight-node hexahedra of an ideally plastic metal, as many side by side as a
// register has lanes. One integration point with a stiffness against hourglass modes (Flanagan & Belytschko 1981, Int.
// J. Numer. Meth. Eng. 17:679), or eight with the mean dilatation (Hughes 1980, ibid. 15:1413). Updated Lagrangian at
// the middle of a step, rotated as Hughes & Winget (1980, ibid. 15:1862) do, J2 by radial return.
#pragma once

#include <array>
#include <vector>

#include "voxel_elements.hpp"

namespace strut::reference {

// Pa, –, kg/m³, Pa
struct IdealMetal {
  double young, poisson, density, yield_stress;
};

// The node moves at this velocity, m/s.
struct HeldNode {
  int node;
  Vector velocity;
};

struct Impact {
  VoxelMesh body;
  std::vector<Vector> velocities;  // of all nodes at the start
  std::vector<HeldNode> held;
  double duration;  // s
};

class Hexahedra {
 public:
  // hourglass: the stiffness of hourglass modes over μ, above 0; 0: eight points. Throws Error without elements.
  Hexahedra(const Impact& impact, const IdealMetal& metal, double hourglass);

  // One step of the length that elements allow at their present shape; its length in s, 0 where one is inside out.
  double step();
  double work() const { return work_; }  // J, what the held nodes have done

 private:
  using Tensor = std::array<std::array<small::Lanes, 3>, 3>;
  struct Group {
    Side nodes;                                            // lanes without an element take a cube beside the body
    std::vector<Tensor> stresses;                          // of the integration points
    std::array<std::array<small::Lanes, 3>, 4> hourglass;  // forces of the four modes
  };

  // Both return the largest Σ b² of the lanes, 1/m², infinite where an element is inside out.
  double add_one_point(Group& group, double dt);
  double add_eight_points(Group& group, double dt);
  void update(Tensor& stress, const Tensor& increment, const Tensor& rotation) const;
  small::Lanes viscosity(const small::Lanes& volume, const small::Lanes& dilatation, double dt) const;

  double lambda_, mu_, density_, yield_, hourglass_, speed_;
  std::vector<HeldNode> held_;
  std::vector<Group> groups_;
  NodeField places_, velocities_, forces_;
  Eigen::VectorXd masses_;
  double steepest_, work_ = 0;
};

}  // namespace strut::reference
