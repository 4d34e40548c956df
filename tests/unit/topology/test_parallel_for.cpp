#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "topology/parallel_for.hpp"

namespace strut {
namespace {

// Not inline: the compiler could contract its product with a sum (FMA), which has other bits.
__attribute__((noinline)) double value(int i) { return std::sin(12.9898 * i) * 43758.5453; }

// Tests ranges that are and are not long enough to be shared by threads, from any first index.
template <class Test>
void over_ranges(const Test& test) {
  for (const int begin : {0, 7}) {
    for (const int size : {0, 1, 15, 16, 31, 32, 33, 1000, 12345}) test(begin, begin + size);
  }
}

class Loops : public testing::TestWithParam<int> {
 protected:
  Loops() { EXPECT_EQ(set_threads(GetParam()), ""); }
  ~Loops() override { set_threads(1); }
};

TEST_P(Loops, ComeToEachPointOnce) {
  over_ranges([](int begin, int end) {
    std::vector<int> visits(static_cast<std::size_t>(end) + 10, 0);
    for_each_point(begin, end, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
    for (int i = 0; i < end + 10; ++i) EXPECT_EQ(visits[static_cast<std::size_t>(i)], i >= begin && i < end ? 1 : 0);
  });
}

// The bits of a loop that is written out.
TEST_P(Loops, FindTheLargestAndTheTotalOfOneThread) {
  over_ranges([](int begin, int end) {
    double sum = 0, most = -1;
    for (int i = begin; i < end; ++i) sum += value(i), most = std::max(most, value(i));
    EXPECT_EQ(largest(begin, end, -1, value), most);
    EXPECT_EQ(total(begin, end, value), sum);
  });
  const double above = largest(0, 1000, 1e9, value);
  EXPECT_EQ(above, 1e9);
}

TEST_P(Loops, PassOverWhatIsNoNumber) {
  const auto with_hole = [](int i) { return i == 500 ? std::numeric_limits<double>::quiet_NaN() : i; };
  EXPECT_EQ(largest(0, 1000, 0, with_hole), 999);
}

INSTANTIATE_TEST_SUITE_P(OnThreads, Loops, testing::Values(1, 2, 4));

}  // namespace
}  // namespace strut
