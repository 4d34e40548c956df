// When output is due: by steps, by time, and in spite of the round-off of times that are sums of steps.
#include <gtest/gtest.h>

#include "output/schedule.hpp"

namespace strut {
namespace {

// How often a run of equal steps finds the schedule due, the initial time included.
int count(Schedule schedule, double initial_time, double dt, int steps) {
  int found = 0;
  double time = initial_time;
  for (int step = 0; step <= steps; ++step, time += dt) {
    if (!schedule.is_scheduled(step, time)) continue;
    schedule.done(time);
    ++found;
  }
  return found;
}

TEST(Schedule, NothingIsDueUnlessEnabled) {
  EXPECT_EQ(count(Schedule(false, 1, std::nullopt, 0), 0, 1e-7, 100), 0);
  EXPECT_EQ(count(Schedule(false, std::nullopt, 1e-7, 0), 0, 1e-7, 100), 0);
}

TEST(Schedule, FrequencyCountsStepsFromTheFirst) {
  const Schedule schedule(true, 3, std::nullopt, 0);
  for (int step = 0; step < 20; ++step) EXPECT_EQ(schedule.is_scheduled(step, 1e-7 * step), step % 3 == 0) << step;
  EXPECT_EQ(count(schedule, 0, 1e-7, 9), 4);
}

TEST(Schedule, AskingTwiceChangesNothing) {
  const Schedule schedule(true, std::nullopt, 1.0, 0);
  EXPECT_TRUE(schedule.is_scheduled(0, 0));
  EXPECT_TRUE(schedule.is_scheduled(0, 0));
}

TEST(Schedule, IntervalIsDueOnceInEach) {
  Schedule schedule(true, std::nullopt, 1.0, 0);
  EXPECT_TRUE(schedule.is_scheduled(0, 0));
  schedule.done(0);
  EXPECT_FALSE(schedule.is_scheduled(1, 0.25));
  EXPECT_FALSE(schedule.is_scheduled(3, 0.99));
  EXPECT_TRUE(schedule.is_scheduled(4, 1.1));
  schedule.done(1.1);
  EXPECT_FALSE(schedule.is_scheduled(5, 1.99));
  EXPECT_TRUE(schedule.is_scheduled(6, 2.0));  // multiples of the interval, not an interval after the last
}

TEST(Schedule, IntervalsThatAStepJumpsOverAreNotMadeUpFor) {
  Schedule schedule(true, std::nullopt, 1.0, 0);
  schedule.done(0);
  EXPECT_TRUE(schedule.is_scheduled(1, 3.5));
  schedule.done(3.5);
  EXPECT_FALSE(schedule.is_scheduled(2, 3.9));
  EXPECT_TRUE(schedule.is_scheduled(3, 4.0));
}

TEST(Schedule, IntervalsStartAtTheInitialTime) {
  Schedule schedule(true, std::nullopt, 1.0, 0.3);
  EXPECT_TRUE(schedule.is_scheduled(0, 0.3));
  schedule.done(0.3);
  EXPECT_FALSE(schedule.is_scheduled(1, 1.0));
  EXPECT_TRUE(schedule.is_scheduled(2, 1.3));
}

// Ten steps of 0.1 add up to a little less than 1, other sums to a little more: no interval may be lost or found twice.
// 1,000 steps gather a round-off of about 1e-13 of the time, far below the part in 1e9 that the schedule forgives.
TEST(Schedule, RoundOffNeitherLosesNorRepeatsAnInterval) {
  for (const double dt : {0.1, 1e-7, 1.0 / 3, 6.609e-8}) {
    for (const double initial_time : {0.0, 0.7 * dt, -500 * dt}) {
      for (const int ratio : {1, 3, 10}) {
        const Schedule schedule(true, std::nullopt, ratio * dt, initial_time);
        EXPECT_EQ(count(schedule, initial_time, dt, 1000), 1000 / ratio + 1)
            << dt << " " << initial_time << " " << ratio;
      }
    }
  }
}

// The one that a run goes on with, from a checkpoint of another one.
Schedule restored(Schedule from, Schedule to, int step, double time) {
  Snapshot kept;
  Archive saves = Archive::saving_to(kept), restores = Archive::loading_from(kept);
  from.serialize(saves, "rows", step, time);
  to.serialize(restores, "rows", step, time);
  return to;
}

// The checkpoint at a time comes before the output of that time.
TEST(Schedule, OutputThatIsDueAtACheckpointStaysDueUnderAnotherSchedule) {
  const auto at_interval = [](double interval) { return Schedule(true, std::nullopt, interval, 0); };
  const auto every = [](int frequency) { return Schedule(true, frequency, std::nullopt, 0); };
  for (Schedule before : {at_interval(2), every(4)}) {
    for (const Schedule& now : {at_interval(2), at_interval(1), at_interval(4), at_interval(3), every(4), every(3)}) {
      before.done(2);
      Schedule schedule = restored(before, now, 4, 4);
      EXPECT_TRUE(schedule.is_scheduled(4, 4));
      schedule.done(4);
      EXPECT_FALSE(schedule.is_scheduled(5, 4.5));
    }
    before.done(4);
    EXPECT_FALSE(restored(before, at_interval(3), 5, 5).is_scheduled(5, 5));
    EXPECT_TRUE(restored(before, at_interval(3), 5, 5).is_scheduled(6, 6));
  }
}

}  // namespace
}  // namespace strut
