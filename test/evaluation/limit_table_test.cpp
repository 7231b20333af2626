#include "evaluation/limit_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace slipnav {
namespace {

bool missed(const LimitTable& table) { return table.text().find("MISSED") != std::string::npos; }

TEST(LimitTable, SaysWhatIsMissed) {
  LimitTable table;
  table.add("driven [h]", 24.0);
  table.addAtMost("growth [MB]", 2.0, 2.0);
  table.addAtLeast("coverage [%]", 99.0, 99.0);
  EXPECT_FALSE(missed(table)) << table.text();
  LimitTable above = table;
  above.addAtMost("growth [MB]", 2.1, 2.0);
  EXPECT_TRUE(missed(above)) << above.text();
  LimitTable below = table;
  below.addAtLeast("coverage [%]", 98.9, 99.0);
  EXPECT_TRUE(missed(below)) << below.text();
}

TEST(LimitTable, WhatIsNoNumberKeepsNoLimit) {
  LimitTable most;
  most.addAtMost("growth [MB]", std::numeric_limits<double>::quiet_NaN(), 2.0);
  EXPECT_TRUE(missed(most));
  LimitTable least;
  least.addAtLeast("coverage [%]", std::numeric_limits<double>::quiet_NaN(), 99.0);
  EXPECT_TRUE(missed(least));
}

}  // namespace
}  // namespace slipnav
