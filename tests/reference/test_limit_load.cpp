// The plastic hinges of a strut a few points thick, against refined finite elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "limit_load.hpp"
#include "mechanics/expected_error.hpp"

namespace strut::reference {
namespace {

struct Strut {
  PointsAt points;
  int across;
  double first, tenth, rise;  // tolerances
};

// F over 2 M_p/L of refined finite elements (README.md, C3D20R): 0.925 at the deflection 1; 1.158 at 10.
//   at 1: elastic stiffness of a strut a few points thick, 3 % at three across
//   at 10: what was aimed at, 10, 5 and 3 % with 2, 3 and 4 across. By the fit of elastic cells it was 26, 9 and 6 %
//   too much at nodes, 12 and 9 % at elements; two at elements were 22 % too strong with the penalty of thicker ones
//   from 5 to 10 theirs rise by 0.3 %; with a volume of its own at each law point (volumetric locking) 4 across at
//   nodes rose by 2.8 %
// Energy: what cells lose as they begin to flow is work of what holds them; without it 4e-3 were missing.
//   Users are told of no smaller error, and of one at most twice as large as that of some strut or, with 2 across, of
// a sheared node, with 3 and 4 of Kelvin's foam, beside finite elements (README.md).
TEST(QuadraticCorrespondence, PlasticHingesCarryTheLimitLoadAndNoMoreThanIsTold) {
  std::map<int, double> largest = {{2, 0.15}, {3, 0.06}, {4, 0.06}};
  for (const Strut& strut :
       {Strut{PointsAt::nodes, 2, 0.07, 0.1, 0.02}, Strut{PointsAt::nodes, 3, 0.03, 0.05, 0.03},
        Strut{PointsAt::nodes, 4, 0.02, 0.03, 0.02}, Strut{PointsAt::elements, 2, 0.17, 0.1, 0.03},
        Strut{PointsAt::elements, 3, 0.05, 0.05, 0.03}, Strut{PointsAt::elements, 4, 0.02, 0.03, 0.03}}) {
    SCOPED_TRACE(std::to_string(strut.across) + " across, " + word(strut.points) + "s");
    std::map<int, double> force;
    double imbalance = 0;
    bend_to_limit(schemes[0], strut.points, strut.across, 10, 20, [&](double deflection, double F, double balance) {
      force[static_cast<int>(2 * deflection + 0.5)] = F, imbalance = balance;
    });
    EXPECT_NEAR(force[2], 0.925, strut.first * 0.925);
    EXPECT_NEAR(force[20], 1.158, strut.tenth * 1.158);
    EXPECT_LT(force[20] / force[10], 1 + strut.rise);
    const double error = force[20] / 1.158 - 1;
    EXPECT_LT(error, expected_error(strut.across).above);
    EXPECT_GT(error, -expected_error(strut.across).below);
    largest[strut.across] = std::max(largest[strut.across], std::abs(error));
    EXPECT_LT(imbalance, 1e-3) << force[20];
  }
  for (const auto& [across, error] : largest) {
    EXPECT_LT(std::max(expected_error(across).above, expected_error(across).below), 2 * error) << across;
  }
}

}  // namespace
}  // namespace strut::reference
