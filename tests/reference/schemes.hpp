// The schemes whose struts are compared with the references. A new scheme is one line.
#pragma once

#include <array>
#include <string>

#include "mechanics/make_body.hpp"
#include "mechanics/mechanics.hpp"
#include "topology/partition.hpp"

namespace strut::reference {

struct Scheme {
  const char* name;
  double horizon;  // spacings
  Stabilization stabilization = NoStabilization();
  Formulation formulation = Formulation::correspondence;
};

inline const std::array<Scheme, 4> schemes = {{
    {.name = "quadratic", .horizon = 1.75, .formulation = Formulation::quadratic},
    {.name = "mean gradient 0.01, horizon 1.75", .horizon = 1.75, .stabilization = MeanGradientStabilization{0.01}},
    {.name = "Silling 0.0005, horizon 3.015", .horizon = 3.015, .stabilization = SillingStabilization{0.0005}},
    {.name = "no stabilization, horizon 1.75", .horizon = 1.75},
}};

// Density 1 kg/m³.
inline Body body_by(const Scheme& scheme, const PointCloud& cloud, const materials::AnyLaw& law,
                    const Communicator& world) {
  const BlockMaterial material{
      .density = 1, .law = law, .stabilization = scheme.stabilization, .formulation = scheme.formulation};
  BlockBonds bonds = BlockBonds::per_spacing(scheme.horizon);
  if (scheme.formulation == Formulation::quadratic) bonds.touching = true, bonds.families = FamilyKind::lists;
  return make_body(make_domain(partitioned(cloud, world), {bonds}, world), Influence::one, {material});
}

}  // namespace strut::reference
