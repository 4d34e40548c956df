// The formulations and neighbor lists by which a body is tested, for parametrized tests.
#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include "verification/lattice.hpp"

namespace strut {

struct Case {
  const char* name;
  Formulation formulation;
  Stabilization stabilization;
  FamilyKind families;
};
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

inline const auto each_formulation = ::testing::Values(
    Case{"ordinary", Formulation::ordinary, NoStabilization(), FamilyKind::lists},
    Case{"lists", Formulation::correspondence, MeanGradientStabilization{0.01}, FamilyKind::lists},
    Case{"lattice", Formulation::correspondence, MeanGradientStabilization{0.01}, FamilyKind::stencil},
    Case{"silling", Formulation::correspondence, SillingStabilization{0.01}, FamilyKind::lists},
    Case{"quadratic", Formulation::quadratic, NoStabilization(), FamilyKind::lists});

}  // namespace strut
