#include "ros/replay/endurance_watch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

constexpr double kImuInterval_s = 0.02;
constexpr int kImuPerFix = 5;

/// A rover that stands at the origin, and an estimate that is off to the east.
class EnduranceWatchTest : public ::testing::Test {
 protected:
  EnduranceWatchTest() {
    char name[] = "/tmp/slipnav_test_XXXXXX";
    if (mkdtemp(name) == nullptr) {
      throw std::runtime_error("no temporary folder can be made");
    }
    folder_ = name;
    watch_ = std::make_unique<EnduranceWatch>(Planet::byName("earth"), 0.25, folder_, [this] { return memory_kb_; });
    Initialization start;
    start.done = 1;
    watch_->add(start);
  }
  ~EnduranceWatchTest() override { std::filesystem::remove_all(folder_); }

  /// @return how long it lasted, at most `longest_s`
  double drive(double longest_s) {
    const Nanoseconds begin = stamp_;
    while (!watch_->hasSeenEnough() && toSeconds(stamp_ - begin) < longest_s) {
      stamp_ += fromSeconds(kImuInterval_s);
      sim::Measurements measurements;
      measurements.imu.stamp = stamp_;
      if (++intervals_ % kImuPerFix == 0) {
        measurements.truth.emplace();
        measurements.truth->stamp = stamp_ - fromSeconds(0.5 * kImuInterval_s);
        measurements.truth->covariance_ned_m2.setZero();
      }
      watch_->add(measurements, sim::TruthState());
      if (estimates_come_) {
        estimate();
      }
    }
    return toSeconds(stamp_ - begin);
  }

  void estimate() {
    nav_msgs::Odometry message;
    message.header.stamp = toRosTime(stamp_);
    message.pose.pose.position.x = error_m_;
    message.pose.pose.orientation.w = 1.0;
    for (const std::size_t axis : {0U, 7U, 14U}) {
      message.pose.covariance[axis] = 1.0;
    }
    watch_->add(message);
    EXPECT_EQ(watch_->newestStamp(), stamp_);
  }

  std::vector<std::string> rows() const {
    std::vector<std::string> lines;
    std::ifstream file(folder_ + "/soak.csv");
    for (std::string line; std::getline(file, line);) {
      lines.push_back(line);
    }
    return {lines.begin() + 1, lines.end()};
  }

  std::string folder_;
  std::unique_ptr<EnduranceWatch> watch_;
  Nanoseconds stamp_ = fromSeconds(1e9);
  int intervals_ = 0;
  double memory_kb_ = 30.0 * 1024.0;
  double error_m_ = 1.5;
  bool estimates_come_ = true;
};

TEST_F(EnduranceWatchTest, KeepsARowForEveryMinuteUntilItHasSeenEnough) {
  EXPECT_NEAR(drive(2000.0), 900.0, 0.2);
  ASSERT_EQ(rows().size(), 15U);
  const std::string& row = rows()[11];
  EXPECT_NE(row.find(",30720,"), std::string::npos) << row;
  EXPECT_NE(row.find(",1.500,3.000,0.750,0"), std::string::npos) << row;
}

TEST_F(EnduranceWatchTest, LimitsThatAreKeptAreNotMissed) {
  drive(2000.0);
  const std::string verdict = watch_->verdict();
  for (const char* const figure : {"longest interval", "its growth", "within 3 sigma", "NEES"}) {
    const std::string line = verdict.substr(verdict.find(figure), 80);
    EXPECT_EQ(line.substr(0, line.find('\n')).find("MISSED"), std::string::npos) << line;
  }
  std::ifstream file(folder_ + "/soak.txt");
  EXPECT_EQ(verdict, std::string(std::istreambuf_iterator<char>(file), {}));
}

TEST_F(EnduranceWatchTest, MemoryThatGrowsIsSeen) {
  drive(700.0);
  memory_kb_ += 2.5 * 1024.0;
  drive(2000.0);
  EXPECT_NE(watch_->verdict().find("2.50  at most 2  MISSED"), std::string::npos) << watch_->verdict();
}

TEST_F(EnduranceWatchTest, AMissingEstimateIsSeen) {
  drive(700.0);
  estimates_come_ = false;
  drive(0.2);
  estimates_come_ = true;
  drive(2000.0);
  EXPECT_NE(watch_->verdict().find("0.22  at most 0.1  MISSED"), std::string::npos) << watch_->verdict();
}

TEST_F(EnduranceWatchTest, ACovarianceThatIsTooSmallIsSeen) {
  error_m_ = 4.0;
  drive(2000.0);
  const std::string verdict = watch_->verdict();
  EXPECT_NE(verdict.find("0.00  at least 99  MISSED"), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("5.33  at most 3.78  MISSED"), std::string::npos) << verdict;
}

TEST_F(EnduranceWatchTest, WithoutAStartThereIsNothingToJudge) {
  watch_ = std::make_unique<EnduranceWatch>(Planet::byName("earth"), 0.25, folder_, [this] { return memory_kb_; });
  drive(1000.0);
  EXPECT_TRUE(rows().empty());
  EXPECT_THROW(watch_->verdict(), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
