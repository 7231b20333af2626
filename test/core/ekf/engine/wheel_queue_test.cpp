#include "slipnav/core/ekf/engine/wheel_queue.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

WheelMotion sample(Nanoseconds stamp_ms) {
  WheelMotion wheels;
  wheels.stamp = stamp_ms * kMillisecond;
  return wheels;
}

/// Has taken regular samples of 100 ms up to 1000 ms.
class WheelQueueTest : public ::testing::Test {
 protected:
  WheelQueueTest() {
    queue_.start(0);
    for (Nanoseconds stamp_ms = 100; stamp_ms <= 1000; stamp_ms += 100) {
      push(stamp_ms);
      queue_.take();
    }
  }

  bool push(Nanoseconds stamp_ms, Nanoseconds processed_until_ms = 0) {
    return queue_.push(sample(stamp_ms), processed_until_ms * kMillisecond);
  }
  Nanoseconds knownUntil_ms() const { return queue_.knownUntil() / kMillisecond; }

  WheelQueue queue_{0.5};
};

TEST_F(WheelQueueTest, SamplesLeaveInTheOrderOfTheirStamps) {
  for (const Nanoseconds stamp_ms : {1300, 1100, 1200}) {
    EXPECT_TRUE(push(stamp_ms));
  }
  for (const Nanoseconds stamp_ms : {1100, 1200, 1300}) {
    EXPECT_EQ(queue_.take().stamp, stamp_ms * kMillisecond);
  }
}

TEST_F(WheelQueueTest, ARepeatedSampleAndOneOfThePastAreRefused) {
  EXPECT_TRUE(push(1100));
  EXPECT_FALSE(push(1100));
  EXPECT_FALSE(push(1000));
  EXPECT_FALSE(push(1150, 1160));
  EXPECT_TRUE(push(1150, 1140));
}

TEST_F(WheelQueueTest, KnowledgeEndsAtAHole) {
  push(1100);
  push(1400);
  EXPECT_EQ(knownUntil_ms(), 1100);
  push(1200);
  push(1300);
  EXPECT_EQ(knownUntil_ms(), 1400);
}

TEST_F(WheelQueueTest, NoneIsDueSoonAfterTheLast) {
  EXPECT_EQ(queue_.knownUntil(), 1090 * kMillisecond - 1);
  push(1050);
  EXPECT_FALSE(queue_.hasUpTo(1089 * kMillisecond));
  EXPECT_TRUE(queue_.hasUpTo(1090 * kMillisecond));
  EXPECT_EQ(queue_.take().stamp, 1090 * kMillisecond);
}

TEST_F(WheelQueueTest, WhatSomebodySaysIsCompleteIsKnown) {
  queue_.assumeCompleteUpTo(2000 * kMillisecond);
  EXPECT_EQ(knownUntil_ms(), 2000);
  queue_.clear();
  queue_.start(1000 * kMillisecond);
  EXPECT_LE(knownUntil_ms(), 1000);
}

TEST(WheelQueue, AStartDropsWhatLiesBeforeAndTellsOfASampleOfItsOwnStamp) {
  WheelQueue queue(0.5);
  for (const Nanoseconds stamp_ms : {100, 200, 300}) {
    EXPECT_TRUE(queue.push(sample(stamp_ms), 0));
  }
  EXPECT_FALSE(queue.start(150 * kMillisecond));
  EXPECT_TRUE(queue.start(200 * kMillisecond));
  EXPECT_EQ(queue.take().stamp, 300 * kMillisecond);
}

/// As one that has never started, whatever it held.
TEST_F(WheelQueueTest, AClearedQueueWaitsForAStart) {
  push(1100);
  queue_.assumeCompleteUpTo(5000 * kMillisecond);
  queue_.clear();
  EXPECT_TRUE(push(200, 1000)) << "nothing is too late before a start";
  EXPECT_TRUE(push(1100));
  queue_.start(100 * kMillisecond);
  EXPECT_EQ(knownUntil_ms(), 100) << "and no interval is known";
  EXPECT_EQ(queue_.take().stamp, 200 * kMillisecond);
  EXPECT_EQ(queue_.take().stamp, 1100 * kMillisecond);
  EXPECT_FALSE(queue_.hasUpTo(9000 * kMillisecond));
}

/// Those of a rover that waits for its start for long.
TEST(WheelQueue, BeforeAStartTheNewestSamplesAreKept) {
  constexpr Nanoseconds kTenMinutes_ms = 600'000;
  WheelQueue queue(0.5);
  for (Nanoseconds stamp_ms = 100; stamp_ms <= kTenMinutes_ms; stamp_ms += 100) {
    EXPECT_TRUE(queue.push(sample(stamp_ms), 0));
  }
  queue.start(0);
  EXPECT_EQ(queue.take().stamp, (kTenMinutes_ms - 4095 * 100) * kMillisecond) << "4096 of them";
}

TEST(WheelQueue, OnceStartedNoneIsDropped) {
  WheelQueue queue(0.5);
  queue.start(0);
  for (Nanoseconds stamp_ms = 1; stamp_ms <= 5000; ++stamp_ms) {
    queue.push(sample(100 * stamp_ms), 0);
  }
  EXPECT_EQ(queue.take().stamp, 100 * kMillisecond);
}

}  // namespace
}  // namespace slipnav
