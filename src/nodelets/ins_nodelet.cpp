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

#include "core/ordering/continuous_time.h"
#include "core/ordering/imu_sorter.h"
#include "core/ordering/jump_filter.h"
#include "ros/messages/conversions.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/internal_messages.h"
#include "ros/replay/latency_meter.h"
#include "ros/runtime/core_nodelet.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/sensor_watch.h"
#include "slipnav/core/ins/ins_engine.h"
#include "slipnav/core/navigation/health.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

namespace {

/// [s] of real time after which unanswered messages to the filter are repeated: it may have been loaded only now.
constexpr double kRepeatInterval_s = 0.5;
/// [s] of real time after which an initial state of a session that never started here is assumed to be of the present
/// one: this nodelet may have been loaded in the middle of it.
constexpr double kSessionPatience_s = 2.0;
/// [s] without a usable sample, of an IMU of 20 Hz or more.
constexpr double kSilence_s = 0.5;

}  // namespace

class InsNodelet : public CoreNodelet {
 public:
  ~InsNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    imu_input_.emplace(config);
    clock_.emplace(config.imu.input.gap_factor);
    engine_.emplace(Planet::byName(config.planet), config.imu.input);
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
      health_->note(imu_input_->problem(), engine_->newestStamp());
      NODELET_WARN_THROTTLE(10.0, "%s", imu_input_->problem().c_str());
      return;
    }
    jumps_.push(*taken, [this](const ImuSample& passed) {
      sorter_.push(passed, [this](const ImuSample& sample) { correctStamp(sample); });
    });
    startIfDue();
    mechanise();
  }

  void correctStamp(ImuSample sample) {
    const std::size_t steps = time_.steps().size();
    sample.stamp = time_.add(sample.stamp);
    if (time_.steps().size() > steps) {
      NODELET_WARN("the clock was set back by %.3f s: the estimate continues", *time_.newestStep_s());
      health_->noteSetBack(*time_.newestStep_s(), sample.stamp);
    }
    clock_->push(sample);
    while (const std::optional<ImuSample> corrected = clock_->pop()) {
      use(*corrected);
    }
    health_->noteStamps(clock_->faults(), sample.stamp);
  }

  void use(const ImuSample& sample) {
    arrivals_.note(sample.stamp, now());
    ImuVerdict verdict = engine_->push(sample);
    health_->noteImu(sample.stamp, verdict);
    if (verdict == ImuVerdict::kTimeWentBack) {
      NODELET_WARN("the clock of the IMU has restarted: a new start");
      engine_->reset();
      ++session_;
      verdict = engine_->push(sample);
    }
    ++samples_;
    gaps_ += verdict == ImuVerdict::kAfterGap ? 1 : 0;
    if (isAccepted(verdict)) {
      watch_.used(clocks());
    } else {
      ++rejected_;
      watch_.refused(complaintOf(verdict), clocks());
      NODELET_WARN_THROTTLE(1.0, "IMU sample at %.3f s rejected: %s", toSeconds(sample.stamp), complaintOf(verdict));
    }
  }

  void onInitialState(const StartState::ConstPtr& message) {
    if (message->start <= newest_start_) {
      return;
    }
    newest_start_ = message->start;
    start_ = message->known ? message : StartState::ConstPtr();
    start_came_s_ = now();
    if (!message->known && message->session == session_) {
      engine_->release();
    }
    startIfDue();
    mechanise();
  }

  /// An initial state belongs to the session with the same count of clock restarts, and is used once the samples
  /// have reached it.
  void startIfDue() {
    if (!start_ || !isOfThisSession(*start_) || engine_->newestStamp() < toNanoseconds(start_->state.stamp)) {
      return;
    }
    engine_->initialise(fromMessage(start_->state));
    start_count_ = start_->start;
    last_step_ = toNanoseconds(start_->state.stamp);
    run_until_ = last_step_ + 1;
    start_.reset();
    unanswered_.reset();
  }

  bool isOfThisSession(const StartState& start) {
    const bool never_started = start_count_ == 0;
    if (never_started && start.session > session_ && now() - start_came_s_ >= kSessionPatience_s) {
      session_ = start.session;
    }
    return start.session == session_;
  }

  void onCorrection(const FilterCorrection::ConstPtr& message) {
    if (message->start != start_count_ || !engine_->isInitialised()) {
      return;
    }
    unanswered_.reset();
    if (message->corrects) {
      const Correction correction = fromMessage(*message);
      if (!engine_->correct(correction)) {
        NODELET_WARN("resuming from the filter's state at %.3f s", toSeconds(correction.state.stamp));
        engine_->adopt(correction);
      }
      last_step_ = toNanoseconds(message->state.stamp);
    }
    run_until_ = toNanoseconds(message->run_until);
    mechanise();
  }

  /// Mechanizes what the filter needs; the rest waits in the engine, so that a correction costs little.
  void mechanise() {
    const boost::shared_ptr<InsSteps> batch = boost::make_shared<InsSteps>();
    while (last_step_ < run_until_) {
      const std::optional<InsStep> step = engine_->step();
      if (!step) {
        break;
      }
      last_step_ = step->state.stamp;
      batch->epoch = step->epoch;
      batch->steps.push_back(toMessage(*step));
      batch->steps.back().came_s = arrivals_.of(last_step_);
    }
    if (!batch->steps.empty()) {
      batch->start = start_count_;
      fill(time_, *batch);
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
    const double span_s = engine_ ? toSeconds(engine_->newestStamp() - diagnosed_stamp_) : 0.0;
    const double rate_hz = span_s > 0.0 ? static_cast<double>(samples_ - diagnosed_samples_) / span_s : 0.0;
    const bool running = engine_ && engine_->isInitialised();
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
    status.add("samples with a wrong stamp", jumps_.leftOut());
    status.add("samples put back in order", sorter_.overtaken());
    status.add("restarts", session_);
    if (health_) {
      alarms_.add(*health_, now(), status);
    }
    diagnosed_samples_ = samples_;
    diagnosed_stamp_ = engine_ ? engine_->newestStamp() : 0;
  }

  /// A failure that makes navigation impossible.
  std::string failureOfImu() const {
    const std::string problem = watch_.problem(imu_topic_, clocks());
    return problem.empty() && engine_ && engine_->isImuFrozen() ? "the IMU repeats exactly the same values" : problem;
  }

  std::optional<ImuInput> imu_input_;
  std::string imu_topic_;
  SensorWatch watch_{"IMU", kSilence_s};
  HealthReport alarms_;
  Arrivals arrivals_;
  JumpFilter<ImuSample> jumps_;
  ImuSorter sorter_;
  ContinuousTime time_;
  std::optional<ImuClock> clock_;
  std::optional<InsEngine> engine_;
  std::optional<HealthMonitor> health_;
  StartState::ConstPtr start_;  ///< not yet used
  double start_came_s_ = 0.0;
  std::uint32_t newest_start_ = 0;  ///< count of the newest received initial state
  std::uint32_t session_ = 0;       ///< restarts of the IMU clock
  std::uint32_t start_count_ = 0;   ///< of the initial state in use
  InsSteps::ConstPtr unanswered_;   ///< the newest steps, until the filter answers
  double published_s_ = 0.0;
  std::uint64_t published_at_ = 0;  ///< count of samples
  Nanoseconds last_step_ = 0;       ///< end of the newest step
  Nanoseconds run_until_ = 0;       ///< limit of what the filter needs
  std::uint64_t samples_ = 0;
  std::uint64_t gaps_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t diagnosed_samples_ = 0;
  Nanoseconds diagnosed_stamp_ = 0;
  SharedPublisher<InsSteps> steps_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InsNodelet, nodelet::Nodelet)
