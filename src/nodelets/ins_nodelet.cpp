/// slipnav/Ins: mechanizes IMU samples.
///
/// In: imu/data, initial_state, correction. Out: ins_steps.

#include <sensor_msgs/Imu.h>
#include <slipnav/FilterCorrection.h>
#include <slipnav/InsSteps.h>
#include <slipnav/StartState.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <optional>

#include "core/navigation/mechanizer.h"
#include "core/ordering/imu_sequence.h"
#include "ros/messages/conversions.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/internal_messages.h"
#include "ros/replay/latency_meter.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/runtime/sensor_watch.h"
#include "slipnav/core/navigation/health.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

namespace {

/// [s] of real time after which unanswered messages to the filter are repeated: it may have been loaded only now.
constexpr double kRepeatInterval_s = 0.5;
/// [s] without a usable sample, of an IMU of 20 Hz or more.
constexpr double kSilence_s = 0.5;

}  // namespace

class InsNodelet : public NodeletBase {
 public:
  ~InsNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    imu_input_.emplace(config);
    clock_.emplace(config.imu.input.gap_factor);
    mechanizer_.emplace(Planet::byName(config.planet), config.imu.input);
    health_.emplace(config.navigation().filter);
    imu_topic_ = config.topics.imu;
  }

  std::string usualThread() const override { return kNavigationThread; }

  void subscribe(const Config& config) override {
    listen<sensor_msgs::Imu>(config.topics.imu, &InsNodelet::onImu);
    listen<StartState>(kInitialStateTopic, &InsNodelet::onInitialState);
    listen<FilterCorrection>(kCorrectionTopic, &InsNodelet::onCorrection);
  }

  void advertise(const Config&) override { steps_publisher_ = publisher<InsSteps>(kInsStepsTopic); }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    const std::optional<ImuSample> taken = imu_input_->take(*message);
    if (!taken) {
      ++rejected_;
      watch_.refused(imu_input_->problem(), clocks());
      health_->note(imu_input_->problem(), mechanizer_->engine().newestStamp());
      complain(imu_input_->problem());
      return;
    }
    std::size_t steps = time().steps().size();
    sequence_.push(*taken, [this, &steps](ImuSample sample, Nanoseconds continuous) {
      sample.stamp = continuous;
      if (time().steps().size() > steps) {
        NODELET_WARN("the clock was set back by %.3f s: the estimate continues", *time().newestStep_s());
        health_->noteSetBack(*time().newestStep_s(), sample.stamp);
      }
      steps = time().steps().size();
      correctStamp(sample);
    });
    mechanize();
  }

  void correctStamp(const ImuSample& sample) {
    clock_->push(sample);
    while (const std::optional<ImuSample> corrected = clock_->pop()) {
      use(*corrected);
    }
    health_->noteStamps(clock_->faults(), sample.stamp);
  }

  void use(const ImuSample& sample) {
    arrivals_.note(sample.stamp, now());
    const ImuVerdict verdict = mechanizer_->push(sample, now());
    health_->noteImu(sample.stamp, verdict);
    if (verdict == ImuVerdict::kTimeWentBack) {
      NODELET_WARN("the clock of the IMU has restarted: a new start");
    }
    ++samples_;
    gaps_ += verdict == ImuVerdict::kAfterGap ? 1 : 0;
    if (isAccepted(verdict)) {
      watch_.used(clocks());
    } else {
      ++rejected_;
      watch_.refused(complaintOf(verdict), clocks());
      complain(std::string("IMU sample rejected: ") + complaintOf(verdict));
    }
  }

  void onInitialState(const StartState::ConstPtr& message) {
    mechanizer_->take(fromMessage(*message), now());
    mechanize();
  }

  void onCorrection(const FilterCorrection::ConstPtr& message) {
    if (message->start == mechanizer_->start()) {
      unanswered_.reset();
    }
    if (!mechanizer_->take(fromMessage(*message))) {
      NODELET_WARN("resuming from the filter's state at %.3f s", message->state.stamp.toSec());
    }
    mechanize();
  }

  /// Mechanizes what the filter needs; the rest waits, so that a correction costs little.
  void mechanize() {
    const boost::shared_ptr<InsSteps> batch = boost::make_shared<InsSteps>();
    mechanizer_->run([this, &batch](const InsStep& step) {
      batch->epoch = step.epoch;
      batch->steps.push_back(toMessage(step));
      batch->steps.back().came_s = arrivals_.of(step.state.stamp);
    });
    if (!batch->steps.empty()) {
      batch->start = mechanizer_->start();
      fill(time(), *batch);
      unanswered_ = batch;
      send();
    }
  }

  void send() {
    steps_publisher_.publish(unanswered_);
    published_s_ = now();
    published_at_ = samples_;
  }

  void onTick() override {
    if (unanswered_ && samples_ > published_at_ && now() - published_s_ >= kRepeatInterval_s) {
      send();
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const Nanoseconds newest = mechanizer_ ? mechanizer_->engine().newestStamp() : 0;
    const double span_s = toSeconds(newest - diagnosed_stamp_);
    const double rate_hz = span_s > 0.0 ? static_cast<double>(samples_ - diagnosed_samples_) / span_s : 0.0;
    const bool running = mechanizer_ && mechanizer_->isRunning();
    status.summary(running ? DiagnosticStatus::OK : DiagnosticStatus::WARN, running ? "mechanizing"
                                                                            : samples_ > 0
                                                                                ? "waiting for the initial state"
                                                                                : "no IMU samples");
    const std::string failure = failureOfImu();
    if (!failure.empty()) {
      status.summary(DiagnosticStatus::ERROR, failure);
    }
    status.add("IMU samples", samples_);
    status.addf("IMU rate [Hz]", "%.1f", rate_hz);
    status.add("gaps", gaps_);
    status.add("rejected samples", rejected_);
    status.add("samples with a wrong stamp", sequence_.leftOut());
    status.add("samples put back in order", sequence_.overtaken());
    status.add("restarts", mechanizer_ ? mechanizer_->session() : 0);
    if (health_) {
      alarms_.add(*health_, now(), status);
    }
    diagnosed_samples_ = samples_;
    diagnosed_stamp_ = newest;
  }

  /// A failure that makes navigation impossible.
  std::string failureOfImu() const {
    const std::string problem = watch_.problem(imu_topic_, clocks());
    const bool is_frozen = mechanizer_ && mechanizer_->engine().isImuFrozen();
    return problem.empty() && is_frozen ? "the IMU repeats exactly the same values" : problem;
  }

  const ContinuousTime& time() const { return sequence_.time(); }

  std::optional<ImuInput> imu_input_;
  std::string imu_topic_;
  SensorWatch watch_{"IMU", kSilence_s};
  HealthReport alarms_;
  Arrivals arrivals_;
  ImuSequence sequence_;
  std::optional<ImuClock> clock_;
  std::optional<Mechanizer> mechanizer_;
  std::optional<HealthMonitor> health_;
  InsSteps::ConstPtr unanswered_;  ///< the newest steps, until the filter answers
  double published_s_ = 0.0;
  std::uint64_t published_at_ = 0;  ///< count of samples
  std::uint64_t samples_ = 0;
  std::uint64_t gaps_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t diagnosed_samples_ = 0;
  Nanoseconds diagnosed_stamp_ = 0;
  SharedPublisher<InsSteps> steps_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InsNodelet, nodelet::Nodelet)
