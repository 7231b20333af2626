#include "core/base/silence_watch.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

TEST(SilenceWatch, WantsBothClocksToAgree) {
  SilenceWatch watch(2.0);
  EXPECT_FALSE(watch.isSilent({1000.0, 1000.0}));
  watch.heard({10.0, 500.0});
  EXPECT_FALSE(watch.isSilent({13.0, 501.0})) << "a simulation that runs fast";
  EXPECT_FALSE(watch.isSilent({11.0, 503.0})) << "one that runs slowly";
  EXPECT_TRUE(watch.isSilent({13.0, 503.0}));
  watch.heard({13.0, 503.0});
  EXPECT_FALSE(watch.isSilent({13.0, 503.0}));
}

}  // namespace
}  // namespace slipnav
