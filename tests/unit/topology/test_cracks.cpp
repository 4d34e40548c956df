// Bonds that initial cracks cut.
#include <gtest/gtest.h>

#include "topology/neighbors/cracks.hpp"

namespace strut {
namespace {

// A crack through a layer of points cuts their bonds to both sides and none within the layer, although round-off puts
// each point a little to one side.
TEST(Cracks, ThroughALayerOfPointsCutAllItsBonds) {
  const double h = 1e-3;
  for (const double offset : {0.0, 0.3}) {
    const Crack crack = RectangularCrack{{1, offset + 0.1 * h, -1}, {0, 1, 0}, {0, 0, 1}, 2, 2};
    for (const double error : {-2e-16, 0.0, 2e-16}) {
      const Vector point(0, (offset + 0.1 * h) * (1 + error), 0);
      for (const double side : {-h, h}) {
        const Vector off(h, point.y() + side, 0), beside(h, offset + 0.1 * h, 0);
        EXPECT_TRUE(crosses(crack, point, off)) << offset << " " << error << " " << side;
        EXPECT_TRUE(crosses(crack, off, point)) << offset << " " << error << " " << side;
        EXPECT_FALSE(crosses(crack, point, beside)) << offset << " " << error;
        EXPECT_FALSE(crosses(crack, off, {0, off.y() + side, 0})) << offset << " " << error << " " << side;
      }
    }
  }
}

}  // namespace
}  // namespace strut
