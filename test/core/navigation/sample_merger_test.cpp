#include "core/navigation/sample_merger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace slipnav {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr double kMaxWait_s = 1.0;

ImuSample imuAt(Nanoseconds ms) {
  ImuSample sample;
  sample.stamp = ms * kMillisecond;
  return sample;
}

WheelMotion wheelsAt(Nanoseconds ms) {
  WheelMotion sample;
  sample.stamp = ms * kMillisecond;
  return sample;
}

PositionFix fixAt(Nanoseconds ms) {
  PositionFix sample;
  sample.stamp = ms * kMillisecond;
  return sample;
}

/// "i20" for an IMU sample at 20 ms, w for wheels, f for positions, v for velocities.
std::string describe(const Sample& sample) {
  return std::string(1, "iwfv"[sample.index()]) + std::to_string(stampOf(sample) / kMillisecond);
}

class SampleMergerTest : public ::testing::Test {
 protected:
  std::string advance() {
    std::string text;
    merger_.advance([&text](const Sample& sample) { text += describe(sample) + " "; });
    return text;
  }
  std::string flush() {
    std::string text;
    merger_.flush([&text](const Sample& sample) { text += describe(sample) + " "; });
    return text;
  }

  SampleMerger merger_{kMaxWait_s};
};

TEST_F(SampleMergerTest, LetsGoWhatTheImuHasGoneOnFromByTheWait) {
  merger_.push(imuAt(2000));
  merger_.push(wheelsAt(2010));
  merger_.push(fixAt(2015));
  merger_.push(imuAt(2020));
  merger_.push(imuAt(2999));
  EXPECT_EQ(advance(), "");
  merger_.push(imuAt(3000));
  EXPECT_EQ(advance(), "i2000 ");
  merger_.push(imuAt(3015));
  EXPECT_EQ(advance(), "w2010 f2015 ");
}

TEST_F(SampleMergerTest, OtherSensorsThatAreAheadDoNotHurryIt) {
  merger_.push(imuAt(2000));
  merger_.push(wheelsAt(2500));
  merger_.push(wheelsAt(3400));
  EXPECT_EQ(advance(), "");
}

TEST_F(SampleMergerTest, OfEqualStampsTheImuIsLast) {
  merger_.push(imuAt(2000));
  merger_.push(wheelsAt(2000));
  merger_.push(fixAt(2000));
  EXPECT_EQ(flush(), "f2000 w2000 i2000 ");
}

TEST_F(SampleMergerTest, OvertakenSamplesAreBroughtIntoOrder) {
  merger_.push(imuAt(2000));
  merger_.push(wheelsAt(2300));
  merger_.push(wheelsAt(2100));
  merger_.push(wheelsAt(2200));
  merger_.push(fixAt(2250));
  merger_.push(fixAt(2050));
  EXPECT_EQ(flush(), "i2000 f2050 w2100 w2200 f2250 w2300 ");
}

TEST_F(SampleMergerTest, WhileTheImuIsSilentTheNewestSamplesAreKept) {
  constexpr Nanoseconds kSamples = 120'000;
  for (Nanoseconds ms = 1; ms <= kSamples; ++ms) {
    merger_.push(wheelsAt(ms));
  }
  std::vector<Nanoseconds> kept;
  merger_.flush([&kept](const Sample& sample) { kept.push_back(stampOf(sample) / kMillisecond); });
  EXPECT_EQ(kept.size(), 100'000U);
  EXPECT_EQ(kept.back(), kSamples);
}

TEST_F(SampleMergerTest, WrongStampsAreLeftOut) {
  merger_.push(imuAt(5000));
  merger_.push(imuAt(0));
  merger_.push(imuAt(5020));
  merger_.push(wheelsAt(5010));
  merger_.push(wheelsAt(1000));
  merger_.push(wheelsAt(5110));
  EXPECT_EQ(flush(), "i5000 w5010 i5020 w5110 ");
  EXPECT_EQ(merger_.leftOut(), 2U);
}

TEST_F(SampleMergerTest, SilenceIsJudgedBySettledStampsAlone) {
  merger_.push(imuAt(2000));
  merger_.push(imuAt(2900));
  merger_.push(imuAt(3800));
  std::string text;
  const auto note = [&text](const Sample& sample) { text += describe(sample); };
  merger_.advanceTrusting(2999 * kMillisecond, note);
  EXPECT_EQ(text, "");
  merger_.advanceTrusting(3000 * kMillisecond, note);
  EXPECT_EQ(text, "i2000");
}

TEST_F(SampleMergerTest, ImuSamplesThatOvertakeEachOtherAreBroughtIntoOrderOnceTheirIntervalIsKnown) {
  for (const int ms : {2000, 2020, 2040, 2060, 2080, 2100, 2140, 2120, 2160}) {
    merger_.push(imuAt(ms));
  }
  EXPECT_EQ(flush(), "i2000 i2020 i2040 i2060 i2080 i2100 i2120 i2140 i2160 ");
}

TEST_F(SampleMergerTest, UntilThenTheImuKeepsItsOrder) {
  merger_.push(imuAt(2020));
  merger_.push(imuAt(2000));
  merger_.push(imuAt(2040));
  EXPECT_EQ(flush(), "i2020 i2000 i2040 ");
}

TEST_F(SampleMergerTest, WhatFollowsARestartComesAfterTheRest) {
  merger_.push(wheelsAt(95000));
  merger_.push(imuAt(95000));
  merger_.push(imuAt(10));
  merger_.push(wheelsAt(20));
  merger_.push(imuAt(30));
  merger_.push(wheelsAt(120));
  EXPECT_EQ(flush(), "w95000 i95000 i10 w20 i30 w120 ");
}

/// With a clock set back, wheel samples before and after are distinguished, and time continues.
TEST_F(SampleMergerTest, TimeGoesOnWhenTheClockIsSetBack) {
  for (Nanoseconds ms = 1000; ms <= 9980; ms += 20) {
    merger_.push(imuAt(ms));
  }
  for (Nanoseconds ms = 1065; ms <= 9965; ms += 100) {
    merger_.push(wheelsAt(ms));
  }
  merger_.push(wheelsAt(5065));  // by the clock that was set back, and here before the IMU
  merger_.push(wheelsAt(5165));
  for (Nanoseconds ms = 5000; ms <= 5180; ms += 20) {
    merger_.push(imuAt(ms));
  }
  EXPECT_EQ(merger_.newestImuStamp(), 5180 * kMillisecond);
  EXPECT_EQ(merger_.newestImuTime(), 10180 * kMillisecond);
  const std::string merged = flush();
  EXPECT_NE(merged.find("i9960 w9965 i9980 i10000 i10020 i10040 i10060 w10065 i10080"), std::string::npos) << merged;
  EXPECT_NE(merged.find("i10160 w10165 i10180"), std::string::npos) << merged;
}

TEST_F(SampleMergerTest, ArrivalOrderDoesNotMatter) {
  const auto merged = [](unsigned seed) {
    std::vector<std::vector<Sample>> sensors(3);
    for (Nanoseconds ms = 1000; ms < 4000; ms += 20) {
      sensors[0].push_back(imuAt(ms));
      if (ms % 100 == 0) {
        sensors[1].push_back(wheelsAt(ms + 7));
        sensors[2].push_back(fixAt(ms));
      }
    }
    std::mt19937 random(seed);
    SampleMerger merger(kMaxWait_s);
    std::string text;
    const auto note = [&text](const Sample& sample) { text += describe(sample) + " "; };
    std::vector<std::size_t> next(3, 0);
    // Any sensor may be ahead of the others, by less than what counts as silence.
    while (next[0] < sensors[0].size() || next[1] < sensors[1].size() || next[2] < sensors[2].size()) {
      const std::size_t chosen = random() % 3;
      const auto stampOfNext = [&](std::size_t i) {
        return next[i] < sensors[i].size() ? stampOf(sensors[i][next[i]]) : 5000 * kMillisecond;
      };
      const Nanoseconds slowest = std::min({stampOfNext(0), stampOfNext(1), stampOfNext(2)});
      if (next[chosen] < sensors[chosen].size() && stampOfNext(chosen) - slowest < 900 * kMillisecond) {
        merger.push(sensors[chosen][next[chosen]++]);
        merger.advance(note);
      }
    }
    merger.flush(note);
    return text;
  };
  const std::string expected = merged(1);
  EXPECT_EQ(std::count(expected.begin(), expected.end(), ' '), 210);
  for (unsigned seed = 2; seed < 20; ++seed) {
    EXPECT_EQ(merged(seed), expected) << "seed " << seed;
  }
}

}  // namespace
}  // namespace slipnav
