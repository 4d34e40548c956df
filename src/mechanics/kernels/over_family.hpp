// The family of one point, bond by bond, where SIMD is not worthwhile.
#pragma once

#include "mechanics/kernels/bonds.hpp"

namespace strut {

// Calls visit(j, ω V_j, ξ) for each bond of point i.
template <class Visit>
void over_family(const Body& body, int i, const Visit& visit) {
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), weight,
                [&](int j, double w, const auto& xi, double) { visit(j, w, Vector(xi.c[0], xi.c[1], xi.c[2])); });
  });
}

}  // namespace strut
