#include "ros/runtime/clock_watch.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

TEST(ClockWatch, NoticesMessagesWithoutTime) {
  ClockWatch watch;
  EXPECT_FALSE(watch.standsStill(true, 0.0)) << "nothing to compare with";
  EXPECT_FALSE(watch.standsStill(true, 0.0)) << "a recording that has not begun";
  watch.heard();
  EXPECT_TRUE(watch.standsStill(true, 0.0));
  EXPECT_FALSE(watch.standsStill(true, 0.0)) << "paused";
  watch.heard();
  EXPECT_FALSE(watch.standsStill(true, 1.0)) << "time passes";
  watch.heard();
  EXPECT_FALSE(watch.standsStill(false, 1.0)) << "the time of a rover";
}

}  // namespace
}  // namespace slipnav
