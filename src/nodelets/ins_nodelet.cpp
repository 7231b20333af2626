/// slipnav/Ins: mechanises IMU samples.
///
/// In: imu/data, initial_state, correction. Out: ins_steps.

#include <sensor_msgs/Imu.h>
#include <slipnav/FilterCorrection.h>
#include <slipnav/InsSteps.h>
#include <slipnav/StartState.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <optional>

#include "slipnav/ins/ins_engine.h"
#include "slipnav/navigator/health.h"
#include "slipnav/navigator/jump_filter.h"
#include "slipnav/ros/conversions.h"
#include "slipnav/ros/core_nodelet.h"
#include "slipnav/ros/health_report.h"
#include "slipnav/ros/internal_messages.h"
#include "slipnav/ros/internal_topics.h"

namespace slipnav {

class InsNodelet : public CoreNodelet {
 private:
  void begin(const Config& config) override {
    mount_.emplace(config.imu.mount);
    engine_.emplace(Planet::byName(config.planet), config.imu.input);
    health_.emplace(config.navigation().filter);
  }

  void subscribe(const Config& config) override {
    listen<sensor_msgs::Imu>(config.topics.imu, &InsNodelet::onImu);
    listen<StartState>(kInitialStateTopic, &InsNodelet::onInitialState);
    listen<FilterCorrection>(kCorrectionTopic, &InsNodelet::onCorrection);
  }

  void advertise(const Config&) override { steps_publisher_ = publisher<InsSteps>(kInsStepsTopic); }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    jumps_.push(toImuSample(*message, *mount_), [this](const ImuSample& sample) { use(sample); });
    startIfDue();
    mechanise();
  }

  void use(const ImuSample& sample) {
    ImuVerdict verdict = engine_->push(sample);
    health_->noteImu(sample.stamp, verdict);
    if (verdict == ImuVerdict::kTimeWentBack) {
      NODELET_WARN("the clock of the IMU went back: starting anew");
      engine_->reset();
      ++session_;
      verdict = engine_->push(sample);
    }
    ++samples_;
    gaps_ += verdict == ImuVerdict::kAfterGap ? 1 : 0;
    if (!isAccepted(verdict)) {
      ++rejected_;
      NODELET_WARN_THROTTLE(1.0, "IMU sample at %.3f s left out: %s", toSeconds(sample.stamp), complaintOf(verdict));
    }
  }

  void onInitialState(const StartState::ConstPtr& message) {
    start_ = message->known ? message : StartState::ConstPtr();
    if (!message->known && message->session == session_) {
      engine_->release();
    }
    startIfDue();
    mechanise();
  }

  /// An initial state belongs to the session that counts as many restarts of the clock, and is used once the samples
  /// have reached it.
  void startIfDue() {
    if (!start_ || start_->session != session_ || engine_->newestStamp() < toNanoseconds(start_->state.stamp)) {
      return;
    }
    engine_->initialise(fromMessage(start_->state));
    start_count_ = start_->start;
    last_step_ = toNanoseconds(start_->state.stamp);
    run_until_ = last_step_ + 1;
    start_.reset();
    is_answered_ = false;
    unanswered_.reset();
  }

  void onCorrection(const FilterCorrection::ConstPtr& message) {
    if (message->start != start_count_ || !engine_->isInitialised()) {
      return;
    }
    is_answered_ = true;
    unanswered_.reset();
    if (message->corrects) {
      if (!engine_->correct(fromMessage(*message))) {
        NODELET_ERROR("correction for step %lu, which is not there any more",
                      static_cast<unsigned long>(message->sequence));
        return;
      }
      last_step_ = toNanoseconds(message->state.stamp);
    }
    run_until_ = toNanoseconds(message->run_until);
    mechanise();
  }

  /// Mechanises what the filter has use for; the rest waits in the engine, so that a correction costs little.
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
    }
    if (!batch->steps.empty()) {
      batch->start = start_count_;
      steps_publisher_.publish(batch);
      unanswered_ = is_answered_ ? nullptr : batch;
    }
  }

  /// The filter may be loaded later.
  void onTick() override {
    if (unanswered_) {
      steps_publisher_.publish(unanswered_);
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const double span_s = engine_ ? toSeconds(engine_->newestStamp() - diagnosed_stamp_) : 0.0;
    const double rate_hz = span_s > 0.0 ? static_cast<double>(samples_ - diagnosed_samples_) / span_s : 0.0;
    const bool running = engine_ && engine_->isInitialised();
    status.summary(running ? DiagnosticStatus::OK : DiagnosticStatus::WARN, running ? "mechanising"
                                                                            : samples_ > 0
                                                                                ? "waiting for the initial state"
                                                                                : "no IMU samples");
    status.add("IMU samples", samples_);
    status.addf("IMU rate [Hz]", "%.1f", rate_hz);
    status.add("gaps", gaps_);
    status.add("rejected samples", rejected_);
    status.add("samples with a wrong stamp", jumps_.leftOut());
    status.add("restarts", session_);
    if (health_) {
      report(*health_, engine_->newestStamp(), status);
    }
    diagnosed_samples_ = samples_;
    diagnosed_stamp_ = engine_ ? engine_->newestStamp() : 0;
  }

  std::optional<ImuMount> mount_;
  JumpFilter<ImuSample> jumps_;
  std::optional<InsEngine> engine_;
  std::optional<HealthMonitor> health_;
  StartState::ConstPtr start_;     ///< not yet used
  std::uint32_t session_ = 0;      ///< restarts of the IMU's clock
  std::uint32_t start_count_ = 0;  ///< of the initial state in use
  bool is_answered_ = false;       ///< the filter has the steps from this initial state on
  boost::shared_ptr<const InsSteps> unanswered_;
  Nanoseconds last_step_ = 0;  ///< end of the newest step
  Nanoseconds run_until_ = 0;  ///< what the filter has use for
  std::uint64_t samples_ = 0;
  std::uint64_t gaps_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t diagnosed_samples_ = 0;
  Nanoseconds diagnosed_stamp_ = 0;
  SharedPublisher<InsSteps> steps_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InsNodelet, nodelet::Nodelet)
