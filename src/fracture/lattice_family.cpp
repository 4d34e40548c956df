#include "fracture/separation.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

std::vector<LatticeBond> family_of(const PulledLattice& lattice) {
  const double h = lattice.spacing;
  const int reach = static_cast<int>(lattice.horizon / h * (1 + 1e-9));
  std::vector<LatticeBond> family;
  bonds::with_influence(lattice.influence, [&]<class Weight>(Weight) {
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const Vector xi = h * Vector(x, y, z);
          if (xi.norm() == 0 || !bonded(lattice.horizon, lattice.horizon, xi)) continue;
          const double weight = Weight::of(xi.norm() / lattice.horizon) * h * h * h;
          family.push_back({xi, weight, z < 0 ? xi.squaredNorm() / -xi[2] : 0, -z});
        }
      }
    }
  });
  return family;
}

}  // namespace strut
