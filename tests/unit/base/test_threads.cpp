#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/parallel/threads.hpp"

namespace strut {
namespace {

// Before any other test asks for more.
TEST(AThread, IsAloneUnlessMoreAreAskedFor) {
  EXPECT_EQ(threads(), 1);
  EXPECT_TRUE(goes_alone());
}

class Threads : public testing::Test {
 protected:
  Threads() { EXPECT_EQ(set_threads(4), ""); }
  ~Threads() override { set_threads(1); }
};

TEST_F(Threads, DoEachWorkOnce) {
  std::vector<std::atomic<int>> done(1000);
  side_by_side(1000, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
  for (const auto& times : done) EXPECT_EQ(times, 1);
}

// Works that wait for each other: one thread alone would wait for ever.
TEST_F(Threads, AreSeveralAtATimeWithNumbersOfTheirOwn) {
  std::atomic<int> here = 0;
  std::vector<int> numbers(4);
  side_by_side(4, [&](int i) {
    numbers[static_cast<std::size_t>(i)] = this_thread();
    ++here;
    while (here < 4) {
    }
  });
  EXPECT_EQ(std::set<int>(numbers.begin(), numbers.end()), (std::set<int>{0, 1, 2, 3}));
  EXPECT_EQ(this_thread(), 0);
}

TEST_F(Threads, GoOneByOneInAWork) {
  std::vector<int> mistakes(8, 0);
  side_by_side(8, [&](int i) {
    const int mine = this_thread();
    int next = 0;
    side_by_side(100, [&](int k) {
      if (k != next++ || this_thread() != mine) ++mistakes[static_cast<std::size_t>(i)];
    });
    if (!goes_alone() || next != 100) ++mistakes[static_cast<std::size_t>(i)];
  });
  EXPECT_EQ(mistakes, std::vector<int>(8, 0));
  EXPECT_FALSE(goes_alone());
}

TEST_F(Threads, HandOnTheErrorOfTheLeastWork) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    try {
      side_by_side(64, [](int i) {
        if (i % 8 == 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::string("3"));
    }
  }
  std::atomic<int> done = 0;
  side_by_side(10, [&](int) { ++done; });  // they go on
  EXPECT_EQ(done, 10);
}

TEST_F(Threads, HaveAValueEach) {
  PerThread<int> counts;
  side_by_side(1000, [&](int) { ++counts.mine(); });
  int sum = 0;
  for (const int count : counts.all()) sum += count;
  EXPECT_EQ(counts.all().size(), 4u);
  EXPECT_EQ(sum, 1000);
}

}  // namespace
}  // namespace strut
