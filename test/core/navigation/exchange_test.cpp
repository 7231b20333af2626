/// What Starter, Mechanizer and Estimator make of each other's messages: late, lost, of another start or session.

#include "core/navigation/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "core/navigation/estimator.h"
#include "core/navigation/mechanizer.h"
#include "core/navigation/starter.h"
#include "recorded_drive.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

constexpr std::uint32_t kNumber = 7;

const Config& config() {
  static const Config config = driveConfig(6.0);
  return config;
}

const RecordedDrive& drive() {
  static const RecordedDrive drive = recordDrive(config());
  return drive;
}

Planet planet() { return Planet::byName("earth"); }

/// A Mechanizer and an Estimator whose messages arrive in order, but late by a random number of samples.
class Exchange {
 public:
  Exchange() { start({kNumber, 0, drive().initial}); }

  void start(const Start& start) {
    estimator.take(start);
    mechanizer.take(start);
  }

  void push(const DriveSample& sample) {
    sample.is_imu ? static_cast<void>(mechanizer.push(sample.imu)) : static_cast<void>(estimator.push(sample.wheels));
    mechanizer.run([this](const InsStep& step) { steps.emplace_back(mechanizer.start(), step); });
    while (!steps.empty() && random_.uniform() < 0.9) {
      verdicts.push_back(estimator.push(steps.front().first, steps.front().second));
      steps.pop_front();
    }
    if (const std::optional<Reply> reply = estimator.advance(sink)) {
      replies.push_back(*reply);
    }
    while (!replies.empty() && random_.uniform() < 0.3) {
      resumed += mechanizer.take(replies.front()) ? 0 : 1;
      replies.pop_front();
    }
  }

  Mechanizer mechanizer{planet(), config().navigation().imu_input};
  Estimator estimator{planet(), config().navigation().filter};
  std::deque<std::pair<std::uint32_t, InsStep>> steps;
  std::deque<Reply> replies;
  std::vector<StepVerdict> verdicts;
  int resumed = 0;
  EstimateLog log;
  FilterEngine::EstimateSink sink = [this](const Estimate& estimate, const ErrorCovariance& P) {
    log.push_back({estimate, P});
  };

 private:
  sim::RandomStream random_{1, "exchange"};
};

TEST(Exchange, LateMessagesMakeNoDifference) {
  Exchange exchange;
  for (const DriveSample& sample : drive().samples) {
    exchange.push(sample);
  }
  EstimateLog sequential = runNavigator(config(), drive().initial, drive().samples);
  ASSERT_GT(exchange.log.size(), sequential.size() - 100);
  sequential.resize(exchange.log.size());
  EXPECT_TRUE(sameEstimates(exchange.log, sequential));
  EXPECT_EQ(exchange.resumed, 0);
}

TEST(Exchange, AReloadedMechanizerResumesFromTheEstimate) {
  Exchange exchange;
  const std::size_t half = drive().samples.size() / 2;
  for (std::size_t i = 0; i < drive().samples.size(); ++i) {
    if (i == half) {
      exchange.mechanizer = Mechanizer(planet(), config().navigation().imu_input);
      exchange.mechanizer.take(Start{kNumber, 0, drive().initial});
      exchange.steps.clear();
      exchange.replies.clear();
    }
    exchange.push(drive().samples[i]);
  }
  EXPECT_EQ(std::count(exchange.verdicts.begin(), exchange.verdicts.end(), StepVerdict::kRestarted), 1);
  EXPECT_EQ(exchange.resumed, 1);
  const NavigationState& last = exchange.log.back().estimate.nav;
  EXPECT_GT(last.stamp, drive().samples.back().stamp() - kSecond);
  const ErrorCovariance& P = exchange.log.back().P;
  const EstimateLog sequential = runNavigator(config(), drive().initial, drive().samples);
  const ErrorVector error = errorBetween(planet(), last, sequential.back().estimate.nav);
  EXPECT_LT(error.segment<2>(kPosition).norm(), 3.0 * std::sqrt(P(kPosition, kPosition)) + 1.0);
}

TEST(Exchange, AReloadedEstimatorNeedsANewStart) {
  Exchange exchange;
  const std::size_t half = drive().samples.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    exchange.push(drive().samples[i]);
  }
  exchange.estimator = Estimator(planet(), config().navigation().filter);
  exchange.estimator.take(Start{kNumber, 0, drive().initial});
  exchange.mechanizer.take(Reply{kNumber, std::nullopt, drive().samples.back().stamp()});
  exchange.verdicts.clear();
  for (std::size_t i = half; i < half + 50; ++i) {
    exchange.push(drive().samples[i]);
  }
  ASSERT_GT(exchange.verdicts.size(), 10U);
  EXPECT_EQ(exchange.verdicts.front(), StepVerdict::kLost);
  EXPECT_FALSE(exchange.estimator.hasSteps());
}

TEST(Exchange, StepsOfAnotherStartAreVoid) {
  Exchange exchange;
  exchange.estimator.take(Start{kNumber + 1, 0, drive().initial});
  for (std::size_t i = 0; i < 100; ++i) {
    exchange.push(drive().samples[i]);
  }
  ASSERT_FALSE(exchange.verdicts.empty());
  EXPECT_EQ(std::count(exchange.verdicts.begin(), exchange.verdicts.end(), StepVerdict::kVoid),
            static_cast<std::ptrdiff_t>(exchange.verdicts.size()));
  EXPECT_FALSE(exchange.estimator.take(Start{kNumber, 0, drive().initial}));  // older
}

/// Enough for another estimator to continue.
TEST(Exchange, HandsOverTheEstimateEverySecond) {
  Exchange exchange;
  std::vector<Start> handed_over;
  exchange.sink = [&](const Estimate& estimate, const ErrorCovariance& P) {
    if (const std::optional<Start> present = exchange.estimator.handOver()) {
      EXPECT_EQ(present->state->nav.stamp, estimate.nav.stamp);
      EXPECT_EQ(present->state->P, P);
      handed_over.push_back(*present);
    }
  };
  for (const DriveSample& sample : drive().samples) {
    exchange.push(sample);
  }
  const double duration_s = toSeconds(drive().samples.back().stamp() - drive().initial.nav.stamp);
  EXPECT_NEAR(static_cast<double>(handed_over.size()), duration_s, 2.0);
  EXPECT_EQ(handed_over.front().number, kNumber);
  EXPECT_EQ(handed_over.front().state->origin.latitude_rad, drive().initial.origin.latitude_rad);
}

/// A rover whose wheels are silent, with all messages at the same real time.
class SilentWheels {
 public:
  explicit SilentWheels(const Config& config) : estimator_(planet(), config.navigation().filter, kPatience_s) {
    const Start start{kNumber, 0, drive().initial};
    mechanizer_.take(start);
    estimator_.take(start);
    for (const DriveSample& sample : drive().samples) {
      if (sample.is_imu && sample.stamp() < drive().initial.nav.stamp + 3 * kSecond) {
        mechanizer_.push(sample.imu);
        newest_ = sample.stamp();
        estimatesAt(0.0);
      }
    }
  }

  /// Stamp of the newest estimate at that real time; 0 if there is none.
  Nanoseconds estimatesAt(double now_s) {
    std::optional<Reply> reply;
    do {
      if (reply) {
        mechanizer_.take(*reply);
      }
      mechanizer_.run([this](const InsStep& step) { estimator_.push(kNumber, step, 0.0); });
      reply = estimator_.advance([this](const Estimate& e, const ErrorCovariance&) { told_ = e.nav.stamp; }, now_s);
    } while (reply);
    return told_;
  }

  Nanoseconds newest() const { return newest_; }

 private:
  Mechanizer mechanizer_{planet(), config().navigation().imu_input};
  Estimator estimator_;
  Nanoseconds newest_ = 0;
  Nanoseconds told_ = 0;
};

TEST(Estimator, SilenceCountsOnceItHasLastedInRealTimeAsWell) {
  SilentWheels rover(config());
  EXPECT_EQ(rover.estimatesAt(0.9 * kPatience_s), 0);
  const Nanoseconds told = rover.estimatesAt(1.1 * kPatience_s);
  EXPECT_GT(told, drive().initial.nav.stamp + kSecond);
  EXPECT_LE(told, rover.newest() - fromSeconds(config().filter.max_wait_s));
}

TEST(Estimator, WaitsForNothingWhereWheelsAreNotUsed) {
  Config free_inertial = config();
  free_inertial.filter.updates = {};
  SilentWheels rover(free_inertial);
  EXPECT_EQ(rover.estimatesAt(0.0), rover.newest());
}

TEST(Mechanizer, AStartOfAnotherSessionWaitsForIt) {
  Mechanizer mechanizer(planet(), config().navigation().imu_input);
  ImuSample sample;
  sample.f_ib_b = {0.0, 0.0, -9.8};
  sample.stamp = 100 * kSecond;
  mechanizer.push(sample);
  InitialState initial;
  initial.nav.stamp = 10 * kSecond;
  mechanizer.take(Start{1, 1, initial});
  EXPECT_FALSE(mechanizer.isRunning());
  sample.stamp = 9 * kSecond;
  EXPECT_EQ(mechanizer.push(sample), ImuVerdict::kTimeWentBack);
  EXPECT_EQ(mechanizer.session(), 1U);
  EXPECT_FALSE(mechanizer.isRunning());  // not there yet
  sample.stamp = 10 * kSecond;
  mechanizer.push(sample);
  EXPECT_TRUE(mechanizer.isRunning());
  EXPECT_EQ(mechanizer.start(), 1U);
  mechanizer.take(Start{2, 1, std::nullopt});
  EXPECT_FALSE(mechanizer.isRunning());
}

/// Loaded in the second session, it counts from zero.
TEST(Mechanizer, AReloadedOneBelievesTheCountOfOthersAfterAWhile) {
  Mechanizer mechanizer(planet(), config().navigation().imu_input);
  ImuSample sample;
  sample.f_ib_b = {0.0, 0.0, -9.8};
  sample.stamp = 100 * kSecond;
  mechanizer.push(sample, 0.0);
  InitialState initial;
  initial.nav.stamp = 50 * kSecond;
  mechanizer.take(Start{1, 4, initial}, 1.0);
  sample.stamp += kSecond / 50;
  mechanizer.push(sample, 2.9);
  EXPECT_FALSE(mechanizer.isRunning());
  sample.stamp += kSecond / 50;
  mechanizer.push(sample, 3.1);
  EXPECT_TRUE(mechanizer.isRunning());
  EXPECT_EQ(mechanizer.session(), 4U);
}

/// A starter that needs a second of rest.
class StarterTest : public ::testing::Test {
 protected:
  static NavigationSetup setup() {
    NavigationSetup setup = config().navigation();
    setup.initialization.source = "given";
    setup.initialization.leveling_window_s = 1.0;
    return setup;
  }

  /// @return the news that came, in order
  std::vector<Starter::News> rest(double from_s, double until_s) {
    std::vector<Starter::News> all;
    for (int i = 0; from_s + 0.02 * i < until_s; ++i) {
      ImuSample sample;
      sample.stamp = fromSeconds(from_s + 0.02 * i);
      const Vector3 noise(i % 7, i % 5, i % 3);
      sample.f_ib_b = Vector3(0.0, 0.0, -9.8) + 1e-3 * noise;
      sample.omega_ib_b = 1e-5 * noise;
      starter_.push(sample);
      if (const std::optional<Starter::News> news = starter_.takeNews()) {
        all.push_back(*news);
      }
    }
    return all;
  }

  Starter starter_{planet(), setup(), {}, 10};
};

TEST_F(StarterTest, NumbersStartsAndCountsSessions) {
  const std::vector<Starter::News> first = rest(100.0, 103.0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].start.number, 11U);
  EXPECT_EQ(first[0].start.session, 0U);
  EXPECT_TRUE(first[0].start.state.has_value());
  const std::vector<Starter::News> second = rest(50.0, 53.0);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_FALSE(second[0].start.state.has_value());  // the estimate has ended
  EXPECT_EQ(second[0].start.session, 1U);
  EXPECT_EQ(second[1].start.number, 13U);
  EXPECT_TRUE(second[1].start.state.has_value());
  EXPECT_EQ(starter_.session(), 1U);
  EXPECT_EQ(starter_.starts(), 3U) << "two starts, and an end between them";
}

TEST_F(StarterTest, ContinuesWithAnEstimateThatIsRunning) {
  InitialState state;
  state.nav.stamp = 99 * kSecond;
  starter_.offer(Start{5, 2, state});
  starter_.resumeAt(100 * kSecond);
  const std::optional<Starter::News> news = starter_.takeNews();
  ASSERT_TRUE(news.has_value());
  EXPECT_EQ(news->start.number, 5U);
  EXPECT_EQ(news->start.session, 2U);
  EXPECT_TRUE(rest(100.0, 103.0).empty());
  EXPECT_TRUE(starter_.isDone());
  starter_.replace(5, 104 * kSecond);
  EXPECT_TRUE(starter_.takeNews().value().start.state.has_value()) << "lost again, it resumes from that";
}

TEST_F(StarterTest, AnEstimateFromBeforeTheClockWentBackIsNotContinued) {
  InitialState state;
  state.nav.stamp = 200 * kSecond;
  starter_.offer(Start{5, 2, state});
  starter_.resumeAt(100 * kSecond);
  EXPECT_FALSE(starter_.takeNews().has_value());
  EXPECT_EQ(rest(100.0, 103.0).size(), 1U);
}

TEST_F(StarterTest, AFilterThatLostTheEstimateResumesFromWhatItHandedOver) {
  Start start = rest(100.0, 103.0).at(0).start;
  start.state->nav.stamp = fromSeconds(102.26);
  starter_.offer(start);
  starter_.replace(start.number + 1, 104 * kSecond);  // not about the present start
  EXPECT_FALSE(starter_.takeNews().has_value());
  starter_.replace(start.number, 104 * kSecond);
  const std::optional<Starter::News> news = starter_.takeNews();
  ASSERT_TRUE(news.has_value());
  EXPECT_EQ(news->start.number, start.number + 1);
  ASSERT_TRUE(news->start.state.has_value());
  EXPECT_EQ(news->start.state->nav.stamp, 104 * kSecond);
  EXPECT_EQ(news->how, "resumed 1.7 s after the last known state");
}

TEST_F(StarterTest, WithoutAStateToResumeFromItSearchesAgain) {
  const Start start = rest(100.0, 103.0).at(0).start;
  starter_.replace(start.number, 104 * kSecond);
  const std::optional<Starter::News> news = starter_.takeNews();
  ASSERT_TRUE(news.has_value());
  EXPECT_FALSE(news->start.state.has_value());
  EXPECT_EQ(starter_.takeWarnings().size(), 1U);
  EXPECT_TRUE(starter_.takeWarnings().empty());
  EXPECT_EQ(rest(104.0, 107.0).size(), 1U);
}

}  // namespace
}  // namespace slipnav::test
