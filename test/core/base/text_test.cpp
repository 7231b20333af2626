#include "core/base/text.h"

#include <gtest/gtest.h>

#include <ctime>
#include <limits>
#include <string>
#include <vector>

namespace slipnav {
namespace {

TEST(ConfigText, FormattedNumbersAreShortAndReadBackExactly) {
  EXPECT_EQ(formatNumber(0.1), "0.1");
  EXPECT_EQ(formatNumber(50.0), "50");
  EXPECT_EQ(formatNumber(1e-9), "1e-09");
  for (const double value : {1.0 / 3.0, 7.292115e-5, 6378137.0, -2.5e300, std::numeric_limits<double>::min()}) {
    EXPECT_EQ(std::stod(formatNumber(value)), value);
  }
}

TEST(ConfigText, NumbersNeedNoDot) {
  EXPECT_EQ(parseNumber("1e-9"), 1e-9);
  EXPECT_EQ(parseNumber("-.5"), -0.5);
  EXPECT_EQ(parseNumber("+3"), 3.0);
}

TEST(ConfigText, WhatIsNoFiniteNumberIsRefused) {
  for (const char* text : {"", " 1", "1 ", "1x", "0x10", "nan", ".nan", "inf", ".inf", "1e999", "1,5"}) {
    EXPECT_EQ(parseNumber(text), std::nullopt) << "'" << text << "'";
  }
}

TEST(ConfigText, IntegersAreWholeAndFit) {
  EXPECT_EQ(parseInteger("-7"), -7);
  EXPECT_EQ(parseInteger("7.0"), std::nullopt);
  EXPECT_EQ(parseInteger("3000000000"), std::nullopt);
}

TEST(ConfigText, AlternativesInWords) {
  EXPECT_EQ(joinAlternatives({}), "");
  EXPECT_EQ(joinAlternatives({"a"}), "a");
  EXPECT_EQ(joinAlternatives({"a", "b", "c"}), "a, b or c");
}

TEST(ConfigText, EditDistanceCountsSingleCharacterEdits) {
  EXPECT_EQ(editDistance("", "abc"), 3U);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
  EXPECT_EQ(editDistance("updates", "upadtes"), 2U);
  EXPECT_EQ(editDistance("same", "same"), 0U);
}

TEST(ConfigText, NearestNameIsTheFirstOfTheClosest) {
  EXPECT_EQ(nearestName("upadtes", {"gate", "updates", "update"}), "updates");
  EXPECT_EQ(nearestName("x", {"a", "b"}), "a");
  EXPECT_EQ(nearestName("x", {}), "");
}

TEST(ConfigText, TheNearestOfAVeryLongNameIsFoundAtOnce) {
  const std::vector<std::string> candidates(400, "forecast.slip.max_evaluations");
  const std::clock_t begin = std::clock();
  EXPECT_EQ(nearestName(std::string(300000, 'x'), candidates), candidates.front());
  EXPECT_LT(std::clock() - begin, CLOCKS_PER_SEC / 2);
}

}  // namespace
}  // namespace slipnav
