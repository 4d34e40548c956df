#include "verification/lattice.hpp"

#include <cmath>
#include <random>

#include "topology/partition.hpp"
#include "verification/add_point.hpp"

namespace strut {

materials::AnyLaw elastic(double young, double poisson) {
  return materials::Elastic{young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

PointCloud lattice_cloud(const LatticeSpec& spec, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"block"};
  if (world.rank() != 0) return cloud;
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> shift(-spec.perturbation, spec.perturbation);
  for (int k = 0; k < spec.cells[2]; ++k) {
    for (int j = 0; j < spec.cells[1]; ++j) {
      for (int i = 0; i < spec.cells[0]; ++i) {
        const double dx = shift(engine), dy = shift(engine), dz = shift(engine);
        if (spec.is_filled && !spec.is_filled({i, j, k})) continue;
        add_point(cloud, static_cast<std::int64_t>(cloud.size()),
                  spec.spacing * Vector(i + 0.5 + dx, j + 0.5 + dy, k + 0.5 + dz), std::pow(spec.spacing, 3),
                  spec.spacing);
      }
    }
  }
  return cloud;
}

Body lattice_body(const LatticeSpec& spec, const Communicator& world) {
  PointCloud cloud = partitioned(lattice_cloud(spec, world), world);
  BlockBonds bonds(spec.horizon * spec.spacing);
  const bool by_lists = spec.material.formulation != Formulation::correspondence;
  bonds.families = by_lists ? FamilyKind::lists : spec.families;
  bonds.may_lose_bonds = spec.material.damage || !spec.cracks.empty();
  Domain domain = make_domain(std::move(cloud), {bonds}, world, spec.cracks);
  return make_body(std::move(domain), spec.influence, {spec.material});
}

void deform(Body& body, const std::function<Vector(const Vector&)>& place) {
  for (int i = 0; i < body.owned(); ++i) {
    body.domain.sites[i].current.head<3>() = place(body.domain.reference(i)).array();
  }
}

bool is_deep(const LatticeSpec& spec, const Vector& X, double margin) {
  const Vector size = spec.spacing * spec.cells.cast<double>().matrix();
  const double rim = margin * spec.spacing;
  return (X.array() > rim).all() && (X.array() < size.array() - rim).all();
}

}  // namespace strut
