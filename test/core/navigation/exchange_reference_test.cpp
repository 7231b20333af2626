/// Starter, mechanizer and estimator whose messages come late, get lost, or are of another session, each of them
/// reloaded now and then, with an operator who moves the estimate: no change of what they tell each other goes without
/// being noticed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/navigation/estimator.h"
#include "core/navigation/mechanizer.h"
#include "core/navigation/starter.h"
#include "recorded_drive.h"
#include "reference_trace.h"

namespace slipnav::test {
namespace {

Config config() {
  Config config = driveConfig(15.0);
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 2.0;
  config.gnss.use = "always";
  return config;
}

class Troubled {
 public:
  explicit Troubled(std::uint64_t seed) : dice_(seed) {}

  void run(const std::vector<DriveSample>& samples, ReferenceTrace& trace) {
    Nanoseconds second = samples.front().stamp();
    for (const DriveSample& sample : samples) {
      now_s_ += 0.01;
      if (sample.stamp() >= second) {
        second += kSecond;
        note(trace);
        happen();
      }
      push(sample);
      exchange();
    }
    note(trace);
  }

 private:
  void push(DriveSample sample) {
    if (sample.is_imu) {
      sample.imu.stamp += offset_;
      starter_.push(sample.imu);
      mechanizer_.push(sample.imu, now_s_);
      if (sample.stamp() > fix_ + kSecond) {
        fix_ = sample.stamp();
        refused_ += estimator_.push(AntennaFix(fix())) ? 0 : 1;
        estimator_.push(AntennaFix(VelocityFix{fix_, Vector3::Zero(), Vector3::Constant(0.25)}));
        starter_.push(AntennaFix(fix()));
      }
    } else if (!dice_.oneIn(200)) {
      sample.wheels.stamp += offset_;
      starter_.push(sample.wheels);
      refused_ += estimator_.push(sample.wheels) ? 0 : 1;
    }
  }

  PositionFix fix() const {
    PositionFix fix{fix_, {0.692, -1.39, 300.0}, Vector3(4.0, 4.0, 9.0)};
    if (estimator_.isStarted()) {
      fix.position = estimator_.engine().state().position;
    }
    return fix;
  }

  void exchange() {
    if (const std::optional<Starter::News> news = starter_.takeNews()) {
      start_ = news->start;
      estimator_.take(start_);
      mechanizer_.take(start_, now_s_);
      told_ += static_cast<int>(news->how.size());
    }
    mechanizer_.run([this](const InsStep& step) { steps_.emplace_back(mechanizer_.start(), step); });
    while (!steps_.empty() && !dice_.oneIn(10)) {
      const StepVerdict verdict = estimator_.push(steps_.front().first, steps_.front().second, now_s_);
      ++verdicts_[static_cast<std::size_t>(verdict)];
      if (verdict == StepVerdict::kLost) {
        starter_.replace(estimator_.start(), starter_.newestStamp());
      }
      steps_.pop_front();
    }
    const auto sink = [this](const Estimate& estimate, const ErrorCovariance& P) { add(estimate, P); };
    if (const std::optional<Reply> reply = estimator_.advance(sink, now_s_)) {
      replies_.push_back(*reply);
    }
    while (!replies_.empty() && !dice_.oneIn(3)) {
      run_until_s_ += 1e-3 * toSeconds(replies_.front().run_until % (1000 * kSecond));
      unknown_ += mechanizer_.take(replies_.front()) ? 0 : 1;
      replies_.pop_front();
    }
  }

  void add(const Estimate& estimate, const ErrorCovariance& P) {
    ++estimates_;
    size_ += estimate.nav.v_eb_n.norm() + std::abs(estimate.nav.q_b_to_n.z()) + std::sqrt(P.diagonal().head<9>().sum());
    if (const std::optional<Start> present = estimator_.handOver()) {
      ++handed_over_;
      starter_.offer(*present);
    }
  }

  void happen() {
    switch (dice_.roll(16)) {
      case 0:
        mechanizer_ = Mechanizer(Planet::byName("earth"), config().navigation().imu_input);
        mechanizer_.take(start_, now_s_);
        break;
      case 1:
        estimator_ = Estimator(Planet::byName("earth"), config().navigation().filter, 0.05);
        estimator_.take(start_);
        break;
      case 2:
        starter_ = Starter(Planet::byName("earth"), config().navigation(), {}, estimator_.start());
        starter_.resumeAt(dice_.oneIn(3) ? 0 : mechanizer_.engine().newestStamp());
        break;
      case 3:
        starter_.searchAgain();
        break;
      case 4:
        offset_ -= dice_.from<Nanoseconds>({5, 500}) * kSecond;
        break;
      case 5:
        steps_.clear();
        break;
      case 6:
        replies_.clear();
        break;
      case 7:
        retune();
        break;
      case 8:
        estimator_.assumeCompleteUpTo(mechanizer_.engine().newestStamp() - kSecond);
        break;
      case 9:
        place();
        break;
      default:
        break;
    }
  }

  void retune() {
    FilterSetup setup = config().navigation().filter;
    setup.filter.gate_alpha = dice_.from<double>({0.001, 0.1});
    setup.filter.max_wait_s = dice_.from<double>({0.5, 1.0});
    setup.zero.velocity_std_mps = dice_.from<double>({0.001, 0.01});
    setup.stationary.hold_off_s = dice_.from<double>({0.2, 0.5});
    estimator_.retune(setup);
    starter_.retune(setup);
  }

  void place() {
    try {
      PoseOverride pose;
      pose.position = estimator_.engine().state().position;
      pose.position.height_m += dice_.roll(10);
      pose.position_std_m = dice_.from<double>({0.5, 1.0, 0.0});
      if (dice_.oneIn(2)) {
        pose.heading_rad = 0.5 * dice_.roll(6);
        pose.heading_std_rad = dice_.from<double>({0.1, 0.0});
      }
      replies_.push_back(estimator_.place(pose));
    } catch (const std::invalid_argument&) {
      ++refused_;
    }
  }

  void note(ReferenceTrace& trace) {
    trace.note(estimates_, size_, verdicts_[0], verdicts_[1], verdicts_[2], verdicts_[3], run_until_s_, unknown_,
               refused_, handed_over_, told_, starter_.starts(), starter_.session(), mechanizer_.session(),
               mechanizer_.start(), mechanizer_.isRunning(), estimator_.start(), estimator_.isStarted(),
               estimator_.hasSteps(), starter_.isDone(), starter_.takeWarnings().size(), estimator_.engine().epoch());
    estimates_ = 0;
    size_ = run_until_s_ = 0.0;
  }

  Dice dice_;
  Starter starter_{Planet::byName("earth"), config().navigation()};
  Mechanizer mechanizer_{Planet::byName("earth"), config().navigation().imu_input};
  Estimator estimator_{Planet::byName("earth"), config().navigation().filter, 0.05};
  Start start_;  ///< the newest, which whoever is loaded later is told as well
  std::deque<std::pair<std::uint32_t, InsStep>> steps_;
  std::deque<Reply> replies_;
  double now_s_ = 0.0;
  Nanoseconds offset_ = 0;
  Nanoseconds fix_ = 0;
  std::array<int, 4> verdicts_ = {};
  int estimates_ = 0;
  double size_ = 0.0;
  double run_until_s_ = 0.0;
  int unknown_ = 0;
  int refused_ = 0;
  int handed_over_ = 0;
  int told_ = 0;
};

TEST(ExchangeReference, WhatIsToldIsTheSame) {
  const RecordedDrive drive = recordDrive(config());
  ReferenceTrace trace("exchange");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Troubled(seed).run(drive.samples, trace);
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
