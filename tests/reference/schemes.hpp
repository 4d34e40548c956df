// The schemes whose struts are put beside the references. One more is one more line.
#pragma once

#include <array>
#include <string>

#include "mechanics/mechanics.hpp"
#include "points/partition.hpp"

namespace strut::reference {

struct Scheme {
  const char* name;
  double horizon;  // spacings
  double stabilization = 0, mean_stabilization = 0;
  Formulation formulation = Formulation::correspondence;
};

inline const std::array<Scheme, 4> schemes = {{
    {.name = "quadratic", .horizon = 1.75, .formulation = Formulation::quadratic},
    {.name = "mean gradient 0.01, horizon 1.75", .horizon = 1.75, .mean_stabilization = 0.01},
    {.name = "Silling 0.0005, horizon 3.015", .horizon = 3.015, .stabilization = 0.0005},
    {.name = "no stabilization, horizon 1.75", .horizon = 1.75},
}};

// Density 1 kg/m³.
inline Body body_by(const Scheme& scheme, const PointCloud& cloud, const materials::AnyLaw& law,
                    const Communicator& world) {
  const BlockMaterial material{.density = 1,
                               .law = law,
                               .stabilization = scheme.stabilization,
                               .formulation = scheme.formulation,
                               .mean_stabilization = scheme.mean_stabilization};
  BlockBonds bonds = BlockBonds::per_spacing(scheme.horizon);
  if (scheme.formulation == Formulation::quadratic) bonds.touching = true, bonds.families = FamilyKind::lists;
  return make_body(make_domain(partitioned(cloud, world), {bonds}, world), Influence::one, {material});
}

}  // namespace strut::reference
