#include "core/base/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace slipnav {
namespace {

TEST(Statistics, percentileInterpolatesBetweenOrderStatistics) {
  const std::vector<double> values = {40.0, 10.0, 30.0, 20.0};
  EXPECT_DOUBLE_EQ(percentile(values, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(percentile(values, 25.0), 17.5);
  EXPECT_DOUBLE_EQ(percentile(values, 50.0), 25.0);
  EXPECT_DOUBLE_EQ(percentile(values, 99.0), 39.7);
  EXPECT_DOUBLE_EQ(percentile(values, 100.0), 40.0);
  EXPECT_DOUBLE_EQ(percentile({3.0}, 73.0), 3.0);
}

TEST(Statistics, medianOfOddCountIsTheMiddle) { EXPECT_DOUBLE_EQ(median({9.0, 1.0, 4.0}), 4.0); }

TEST(Statistics, moments) {
  const std::vector<double> values = {1.0, 3.0, 5.0, 7.0};
  EXPECT_DOUBLE_EQ(mean(values), 4.0);
  EXPECT_DOUBLE_EQ(standardDeviation(values), std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(rootMeanSquare(values), std::sqrt(21.0));
}

TEST(Statistics, refusesWhatHasNoAnswer) {
  EXPECT_THROW(percentile({}, 50.0), std::invalid_argument);
  EXPECT_THROW(percentile({1.0}, 100.5), std::invalid_argument);
  EXPECT_THROW(percentile({1.0}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(mean({}), std::invalid_argument);
  EXPECT_THROW(rootMeanSquare({}), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
