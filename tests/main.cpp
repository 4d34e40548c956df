// main() of every GoogleTest program: starts the run time, lets rank 0 speak, and fails on all ranks when one fails.
#include <gtest/gtest.h>

#include "base/communicator.hpp"

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  const strut::Communicator world;
  if (world.rank() != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const int failed = RUN_ALL_TESTS();
  return world.max(static_cast<double>(failed)) > 0 ? 1 : 0;
}
