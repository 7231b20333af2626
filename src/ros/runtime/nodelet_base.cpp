#include "ros/runtime/nodelet_base.h"

#include <algorithm>
#include <cstdint>

#include "ros/runtime/extrinsics.h"
#include "ros/runtime/fit_to_drive.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/parameters.h"
#include "ros/runtime/topic_graph.h"
#include "ros/runtime/tuning_messages.h"

namespace slipnav {
namespace {

constexpr double kDiagnosticsInterval_s = 0.5;
constexpr std::uint32_t kMostDiagnostics = 100;  // that wait to be sent
constexpr double kReminderInterval_s = 5.0;
constexpr std::size_t kMaxWaiting = 200000;

}  // namespace

void NodeletBase::onInit() {
  const std::lock_guard<std::mutex> lock(mutex_);
  chooseThread();
  try {
    tree_ = node_.resolveName(private_node_.param<std::string>("config", "slipnav"));
    config_ = configFromParameters(node_, tree_);
    if (config_.frames.extrinsicsFromTf() && needsExtrinsics()) {
      tf_buffer_ = std::make_unique<tf2_ros::Buffer>();
      tf_listener_ = std::make_unique<tf2_ros::TransformListener>(*tf_buffer_);
    } else {
      begin(config_);
      begun_ = true;
    }
    subscribe(config_);
    listen(kTuningTopic, &NodeletBase::onTuning);
    // All nodelets of a process share the queue of whoever publishes first, and the updater's is for one message: of
    // several at a time only the last would leave the process.
    diagnostics_queue_ =
        node_.advertise<diagnostic_msgs::DiagnosticArray>(config_.topics.diagnostics, kMostDiagnostics);
    // The updater has a fixed name for its topic; only its own node handle can remap it.
    const ros::NodeHandle renamed(node_, "", {{"/diagnostics", config_.topics.diagnostics}});
    updater_ = std::make_unique<diagnostic_updater::Updater>(renamed, private_node_, getName());
    updater_->setHardwareID(kHardwareId);
    updater_->add(getName(), [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      diagnose(status);
      if (tuning_) {
        status.add("changed while running", tuning_->changes());
      }
      diagnoseClock(status);
    });
    addDiagnoses(*updater_);
    advertise(config_);
    ticks_ = thread_->repeat(tickInterval_s(), [this] { tick(); });
    diagnostics_ = thread_->repeat(kDiagnosticsInterval_s, [this] { guarded([this] { updater_->force_update(); }); });
  } catch (const std::exception& error) {
    subscribers_.clear();
    services_.clear();
    tuning_.reset();
    NODELET_ERROR("%s stays idle: %s", getName().c_str(), error.what());
  }
}

void NodeletBase::chooseThread() {
  node_ = getNodeHandle();
  private_node_ = getPrivateNodeHandle();
  const auto name = private_node_.param<std::string>("thread", usualThread());
  thread_ =
      name.empty() ? std::make_shared<CallbackThread>() : CallbackThread::shared(node_.getNamespace() + "/" + name);
  node_.setCallbackQueue(&thread_->queue());
  private_node_.setCallbackQueue(&thread_->queue());
}

void NodeletBase::stop() {
  ticks_ = {};
  diagnostics_ = {};
  subscribers_.clear();
  services_.clear();
  tuning_.reset();
}

bool NodeletBase::isConnected() const {
  return std::all_of(subscribers_.begin(), subscribers_.end(),
                     [](const ros::Subscriber& subscriber) { return subscriber.getNumPublishers() > 0; });
}

std::size_t NodeletBase::publishersOf(const std::string& topic) const {
  const std::string name = node_.resolveName(topic);
  std::size_t publishers = 0;
  for (const ros::Subscriber& subscriber : subscribers_) {
    publishers += subscriber.getTopic() == name ? subscriber.getNumPublishers() : 0;
  }
  return publishers;
}

void NodeletBase::diagnoseClock(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool still = clock_watch_.standsStill(ros::Time::isSimTime(), ros::Time::now().toSec());
  if (still && endsOf("/clock").publishers.empty()) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::ERROR, "use_sim_time is set, but nobody publishes /clock");
  }
}

void NodeletBase::complain(const std::string& complaint) {
  const std::string line = complaints_.add(complaint, now());
  if (!line.empty()) {
    NODELET_WARN("%s", line.c_str());
  }
}

void NodeletBase::guarded(const std::function<void()>& work) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    work();
  } catch (const std::exception& error) {
    NODELET_ERROR_THROTTLE(1.0, "%s: %s", getName().c_str(), error.what());
  }
}

std::string NodeletBase::answer(const std::function<void()>& work) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!begun_) {
    return getName() + " still waits for the extrinsics";
  }
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

void NodeletBase::offerTuning(const std::string& nodelet) {
  const TuningServer::Service service = [this](auto& request, auto& response) {
    return setParameters(request, response);
  };
  tuning_ = std::make_unique<TuningServer>(node_, private_node_, nodelet, config_, service);
}

std::vector<ParameterDifference> NodeletBase::tune(const Config& next) {
  retune(next);
  config_ = next;
  return tuning_ ? tuning_->take(config_) : std::vector<ParameterDifference>();
}

bool NodeletBase::setParameters(dynamic_reconfigure::Reconfigure::Request& request,
                                dynamic_reconfigure::Reconfigure::Response& response) {
  std::vector<ParameterDifference> changed;
  const std::string refusal = answer([&] { changed = tune(tuning_->requested(request.config, config_)); });
  if (!refusal.empty()) {
    NODELET_WARN("%s: parameters stay as they are: %s", getName().c_str(), refusal.c_str());
  } else if (!changed.empty()) {
    NODELET_INFO("%s: changed while running: %s", getName().c_str(), toText(changed).c_str());
  }
  response.config = tuning_->announce();
  store(changed, tree_);
  return true;
}

/// A change made in another nodelet. A nodelet hears itself as well, and finds nothing new.
void NodeletBase::onTuning(const dynamic_reconfigure::Config::ConstPtr& message) {
  tune(withChanges(config_, changesOf(*message)));
}

void NodeletBase::handle(const std::function<void()>& work) {
  guarded([this, &work] {
    clock_watch_.heard();
    if (begun_) {
      work();
      return;
    }
    waiting_.push_back(work);
    if (waiting_.size() > kMaxWaiting) {
      waiting_.pop_front();
    }
  });
}

void NodeletBase::tick() {
  guarded([this] {
    if (!begun_) {
      waitForExtrinsics();
    }
    if (begun_) {
      onTick();
    }
  });
}

void NodeletBase::waitForExtrinsics() {
  const std::string missing = takeExtrinsics(*tf_buffer_, config_.initialization.source == "gnss", config_);
  if (!missing.empty()) {
    NODELET_INFO_THROTTLE(kReminderInterval_s, "%s waits: %s", getName().c_str(), missing.c_str());
    return;
  }
  tf_listener_.reset();
  begin(config_);
  begun_ = true;
  while (!waiting_.empty()) {
    waiting_.front()();
    waiting_.pop_front();
  }
}

}  // namespace slipnav
