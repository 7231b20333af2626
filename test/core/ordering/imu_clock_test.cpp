#include "slipnav/core/ordering/imu_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace slipnav {
namespace {

constexpr double kGapFactor = 1.6;
constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
/// What passes until the pace is known.
constexpr double kSettled_s = 4.0;

/// A stamped sample, and when it was taken.
struct Stamped {
  double true_s = 0.0;
  double stamp_s = 0.0;
};

std::vector<Stamped> evenSamples(double rate_hz, double duration_s) {
  std::vector<Stamped> samples;
  for (int i = 0; i < static_cast<int>(duration_s * rate_hz); ++i) {
    samples.push_back({i / rate_hz, i / rate_hz});
  }
  return samples;
}

ImuSample imuAt(double stamp_s, double number) {
  ImuSample sample;
  sample.stamp = kStart + fromSeconds(stamp_s);
  sample.f_ib_b.x() = number;
  return sample;
}

/// Samples through a clock; their stamps are compared with the times when they were taken.
class ImuClockTest : public ::testing::Test {
 protected:
  void feed(const std::vector<Stamped>& samples) {
    for (const Stamped& sample : samples) {
      clock_.push(imuAt(sample.stamp_s, static_cast<double>(fed_.size())));
      fed_.push_back(sample);
      while (const std::optional<ImuSample> corrected = clock_.pop()) {
        const auto number = static_cast<std::size_t>(corrected->f_ib_b.x());
        corrected_.push_back({fed_[number].true_s, toSeconds(corrected->stamp - kStart)});
        unchanged_ = unchanged_ && corrected->stamp == kStart + fromSeconds(fed_[number].stamp_s);
      }
    }
  }

  std::vector<double> errors() const {
    std::vector<double> errors;
    for (const Stamped& sample : corrected_) {
      if (sample.true_s > kSettled_s) {
        errors.push_back(sample.stamp_s - sample.true_s);
      }
    }
    return errors;
  }
  double spread() const {
    const std::vector<double> all = errors();
    const auto [least, greatest] = std::minmax_element(all.begin(), all.end());
    return *greatest - *least;
  }

  ImuClock clock_{kGapFactor};
  std::vector<Stamped> fed_;
  std::vector<Stamped> corrected_;
  bool unchanged_ = true;
};

TEST_F(ImuClockTest, EvenStampsStayAsTheyAreAtAnyRate) {
  for (const double rate_hz : {10.0, 30.0, 50.0, 200.0, 1000.0}) {
    clock_ = ImuClock(kGapFactor);
    fed_.clear();
    feed(evenSamples(rate_hz, 60.0));
    EXPECT_TRUE(unchanged_) << rate_hz;
    EXPECT_FALSE(clock_.faults().scatters()) << rate_hz;
  }
  EXPECT_EQ(clock_.faults().lost, 0U);
}

TEST_F(ImuClockTest, LostSamplesAmongEvenStampsChangeNothing) {
  std::vector<Stamped> samples = evenSamples(50.0, 60.0);
  samples.erase(samples.begin() + 2000, samples.begin() + 2150);
  samples.erase(samples.begin() + 1000);
  feed(samples);
  EXPECT_TRUE(unchanged_);
  EXPECT_EQ(corrected_.size(), samples.size());
  EXPECT_EQ(clock_.faults().lost, 151U);
}

TEST_F(ImuClockTest, ScatteredStampsBecomeEven) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.003, 0.003);
  for (const double rate_hz : {50.0, 200.0}) {
    clock_ = ImuClock(kGapFactor);
    fed_.clear();
    corrected_.clear();
    std::vector<Stamped> samples = evenSamples(rate_hz, 60.0);
    double last_s = -1.0;
    for (Stamped& sample : samples) {
      sample.stamp_s = last_s = std::max(last_s + 5e-5, sample.true_s + uniform(random));
    }
    feed(samples);
    EXPECT_EQ(corrected_.size(), samples.size());
    EXPECT_LT(spread(), 1e-3) << rate_hz;
    EXPECT_TRUE(clock_.faults().scatters());
    EXPECT_NEAR(clock_.faults().scatter_s, 0.003, 3e-4);
    EXPECT_EQ(clock_.faults().lost, 0U);
  }
}

/// Early stamps are as wrong as late ones.
TEST_F(ImuClockTest, OneSampleThatComesEarlyIsScatter) {
  constexpr double kEarly_s = 0.004;
  std::vector<Stamped> samples = evenSamples(100.0, 20.0);
  samples[1900].stamp_s -= kEarly_s;
  feed(samples);
  EXPECT_GT(clock_.faults().scatter_s, 0.4 * kEarly_s);
  EXPECT_LT(clock_.faults().scatter_s, 0.8 * kEarly_s);
}

TEST_F(ImuClockTest, SamplesThatComeTogetherAreSpreadOut) {
  for (const double rate_hz : {100.0, 200.0, 1000.0}) {
    for (const std::size_t burst : {2U, 3U, 4U, 5U, 7U, 10U, 16U}) {
      clock_ = ImuClock(kGapFactor);
      fed_.clear();
      corrected_.clear();
      std::vector<Stamped> samples = evenSamples(rate_hz, 30.0);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t last = std::min(i - i % burst + burst - 1, samples.size() - 1);
        samples[i].stamp_s = samples[last].true_s + 0.04 / rate_hz * static_cast<double>(i % burst);
      }
      feed(samples);
      EXPECT_LT(spread(), 1e-6) << rate_hz << " Hz, " << burst;
      EXPECT_EQ(clock_.faults().lost, 0U) << rate_hz << " Hz, " << burst;
      EXPECT_TRUE(clock_.faults().scatters()) << rate_hz << " Hz, " << burst;
    }
  }
}

TEST_F(ImuClockTest, OfEqualStampsBothAreUsed) {
  std::vector<Stamped> samples = evenSamples(200.0, 60.0);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
    samples[i].stamp_s = samples[i + 1].true_s;
  }
  feed(samples);
  EXPECT_LT(spread(), 1e-6);
  EXPECT_EQ(clock_.faults().equal, samples.size() / 2);
}

TEST_F(ImuClockTest, AHostThatHangsLosesNothing) {
  std::vector<Stamped> samples = evenSamples(100.0, 60.0);
  for (std::size_t i = 3000; i < 3020; ++i) {
    samples[i].stamp_s = samples[3019].true_s + 1e-4 * static_cast<double>(i - 3000);
  }
  feed(samples);
  EXPECT_LT(spread(), 1e-6);
  EXPECT_EQ(clock_.faults().lost, 0U);
  EXPECT_EQ(corrected_.size(), samples.size());
}

TEST_F(ImuClockTest, LossesAmongScatteredStampsAreCounted) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.001, 0.001);
  std::vector<Stamped> samples = evenSamples(100.0, 60.0);
  samples.erase(samples.begin() + 4000, samples.begin() + 4003);
  samples.erase(samples.begin() + 2000);
  for (Stamped& sample : samples) {
    sample.stamp_s += uniform(random);
  }
  feed(samples);
  EXPECT_LT(spread(), 1e-3);
  EXPECT_EQ(clock_.faults().lost, 4U);
}

/// One sample less among stamps that scatter by nearly a period may show in a whole block only. It is no scatter.
TEST_F(ImuClockTest, ALossThatScatterHidesIsFoundSoonAfter) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.004, 0.004);
    clock_ = ImuClock(kGapFactor);
    fed_.clear();
    corrected_.clear();
    std::vector<Stamped> samples = evenSamples(100.0, 32.0);
    samples.erase(samples.begin() + 3000);
    for (Stamped& sample : samples) {
      sample.stamp_s += uniform(random);
    }
    feed(samples);
    EXPECT_GE(clock_.faults().lost, 1U) << seed;
    EXPECT_LT(clock_.faults().scatter_s, 0.01) << seed;
    EXPECT_LT(std::abs(errors().back() - errors().front()), 1e-3) << seed;
  }
}

TEST_F(ImuClockTest, FollowsADeviceWhoseClockDrifts) {
  constexpr double kDrift = 2e-4;
  std::mt19937 random(7);
  std::exponential_distribution<double> delay(1e3);
  std::vector<Stamped> samples = evenSamples(100.0, 300.0);
  for (Stamped& sample : samples) {
    sample.true_s *= 1.0 + kDrift;
    sample.stamp_s = sample.true_s + std::min(delay(random), 0.008);
  }
  feed(samples);
  EXPECT_LT(spread(), 1e-3);
  EXPECT_LT(std::abs(errors().back()), 5e-4);
}

TEST_F(ImuClockTest, RepeatedAndOlderSamplesAreForOthersToRefuse) {
  feed(evenSamples(50.0, 10.0));
  const double end_s = corrected_.back().stamp_s;
  clock_.push(imuAt(end_s, static_cast<double>(fed_.size() - 1)));
  EXPECT_LE(clock_.pop().value().stamp, kStart + fromSeconds(end_s));
  clock_.push(imuAt(end_s - 0.1, 0.0));
  EXPECT_LE(clock_.pop().value().stamp, kStart + fromSeconds(end_s - 0.1));
  EXPECT_EQ(clock_.faults().equal, 0U);
}

TEST_F(ImuClockTest, FollowsASourceThatStartsAgain) {
  feed(evenSamples(50.0, 10.0));
  clock_.push(imuAt(-1000.0, 0.0));
  EXPECT_EQ(clock_.pop().value().stamp, kStart - 1000 * kSecond);
}

TEST_F(ImuClockTest, ASourceThatStartsAgainIsLikeANewOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.003, 0.003);
  std::vector<Stamped> samples = evenSamples(100.0, 12.0);
  samples.erase(samples.begin() + 900, samples.begin() + 910);
  for (Stamped& sample : samples) {
    sample.stamp_s += uniform(random);
  }
  ImuClock fresh(kGapFactor);
  const auto stampsOf = [&samples](ImuClock& clock) {
    std::vector<Nanoseconds> stamps;
    for (const Stamped& sample : samples) {
      clock.push(imuAt(0.9 * sample.stamp_s - 1000.0, sample.true_s));
      while (const std::optional<ImuSample> corrected = clock.pop()) {
        stamps.push_back(corrected->stamp);
      }
    }
    return stamps;
  };
  feed(samples);
  feed({{12.2, 12.2}});  // late: held back until it is known why
  const std::vector<Nanoseconds> expected = stampsOf(fresh);
  std::vector<Nanoseconds> stamps = stampsOf(clock_);
  ASSERT_GT(stamps.size(), expected.size()) << "first what was held back";
  stamps.erase(stamps.begin(), stamps.end() - static_cast<std::ptrdiff_t>(expected.size()));
  EXPECT_EQ(stamps, expected);
  EXPECT_GT(clock_.faults().lost, fresh.faults().lost) << "counted over both";
}

TEST_F(ImuClockTest, FollowsAnotherRate) {
  std::vector<Stamped> samples = evenSamples(100.0, 20.0);
  for (const double rate_hz : {50.0, 200.0}) {
    const double begin_s = samples.back().true_s + 1.0 / rate_hz;
    for (const Stamped& sample : evenSamples(rate_hz, 20.0)) {
      samples.push_back({begin_s + sample.true_s, begin_s + sample.true_s});
    }
  }
  feed(samples);
  EXPECT_GE(corrected_.size(), samples.size() - 1);
  EXPECT_LT(std::abs(errors().back()), 1e-6);
}

/// A host that never says why it was late: sixty-four samples are enough to wait for.
TEST_F(ImuClockTest, SamplesThatComeTogetherAreNotHeldForever) {
  feed(evenSamples(100.0, 5.0));
  const std::size_t before = corrected_.size();
  for (int i = 1; i <= 64; ++i) {
    EXPECT_EQ(corrected_.size(), before) << i;
    feed({{5.0 + 0.01 * i, 6.0 + 1e-4 * i}});
  }
  EXPECT_GT(corrected_.size(), before + 60);
}

}  // namespace
}  // namespace slipnav
