#pragma once
/// Base of all nodelets of the package: configuration, safe callbacks, diagnostics.

#include <ros/ros.h>  // nodelet.h only declares NodeHandle

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/base/silence_watch.h"
#include "core/ordering/patience_limits.h"
#include "ros/runtime/callback_thread.h"
#include "ros/runtime/clock_watch.h"
#include "ros/runtime/complaint_log.h"
#include "ros/runtime/shared_publisher.h"
#include "ros/runtime/tuning_server.h"

namespace slipnav {

/// Reads the configuration from the parameter tree `slipnav` in the nodelet's namespace (another name: private
/// parameter `config`). With a wrong configuration the nodelet logs one line and stays idle.
///
/// With `extrinsics: tf`, messages wait until TF knows the sensors.
///
/// A nodelet subscribes first and advertises last: once the master knows its topics, it misses nothing.
///
/// Its callbacks run one at a time, in its own thread or one that it shares.
class NodeletBase : public nodelet::Nodelet {
 public:
  void onInit() final;

 protected:
  /// Builds what the configuration describes; called once, before any message is handled and, if the extrinsics must
  /// be waited for, after the two below. May throw std::invalid_argument.
  virtual void begin(const Config& config) = 0;
  /// Whether begin() must wait for the extrinsics if they come from TF.
  virtual bool needsExtrinsics() const { return true; }
  /// Calls listen() and serve().
  virtual void subscribe(const Config& config) = 0;
  /// Calls publisher(); the topic that shows others that this nodelet is ready comes last.
  virtual void advertise(const Config& config) = 0;
  /// Twice a second, and when reportNow() is called; may come before begin().
  virtual void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) = 0;
  /// Statuses in addition to that of diagnose().
  virtual void addDiagnoses(diagnostic_updater::Updater& /*updater*/) {}
  /// Some of the parameters that may be changed while running have changed; called between two messages. Does not
  /// throw.
  virtual void retune(const Config& /*config*/) {}
  /// Called regularly by the wall clock.
  virtual void onTick() {}
  /// How often [s].
  virtual double tickInterval_s() const { return 0.2; }
  /// Nodelets of one namespace with the same word here share a thread: messages between them need no context
  /// switch. "": its own thread. The private parameter `thread` overrides it.
  virtual std::string usualThread() const { return ""; }

  /// Its callbacks run on the thread that serves this nodelet.
  ros::NodeHandle& node() { return node_; }
  ros::NodeHandle& privateNode() { return private_node_; }

  /// Ends all calls and waits for running ones. The destructor of every nodelet must call it, as they use its members.
  void stop();

  /// No exception leaves the callback.
  template <class Message, class Self>
  void listen(const std::string& topic, void (Self::*handler)(const boost::shared_ptr<const Message>&)) {
    using Pointer = boost::shared_ptr<const Message>;
    const boost::function<void(const Pointer&)> callback = [this, handler](const Pointer& message) {
      handle([this, handler, message] { (static_cast<Self*>(this)->*handler)(message); });
    };
    subscribers_.push_back(
        node_.subscribe<Message>(topic, kQueueSize, callback, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }

  /// Whether each subscribed topic has a publisher.
  bool isConnected() const;
  /// Number of publishers of a subscribed topic.
  std::size_t publishersOf(const std::string& topic) const;

  template <class Message>
  SharedPublisher<Message> publisher(const std::string& topic, bool latch = false) {
    return {node_, topic, latch};
  }

  /// Offers a service in the nodelet's own namespace. Its response has `success` and `message`; an exception of the
  /// handler becomes the message of a failure.
  template <class Request, class Response, class Self>
  void serve(const std::string& name, void (Self::*handler)(const Request&, Response&)) {
    const boost::function<bool(Request&, Response&)> callback = [this, handler](Request& request, Response& response) {
      const std::string failure =
          answer([this, handler, &request, &response] { (static_cast<Self*>(this)->*handler)(request, response); });
      response.success = failure.empty();
      response.message = failure.empty() ? response.message : failure;
      return true;
    };
    services_.push_back(private_node_.advertiseService(name, callback));
  }

  /// Offers the parameters listed for `nodelet` in the table of tunable ones to dynamic_reconfigure. Called in
  /// subscribe().
  void offerTuning(const std::string& nodelet);

  /// How long silence must last in real time [s] before it counts.
  static double patience() { return ros::Time::isSimTime() ? kSimulatedPatience_s : kPatience_s; }

  /// Seconds of a monotonic clock, for patience.
  static double now() { return ros::SteadyTime::now().toSec(); }
  /// The same instant on both clocks.
  static SilenceWatch::Now clocks() { return {ros::Time::now().toSec(), now()}; }

  /// Into the log, however often it comes: once, and then every minute with a count. Call from a callback.
  void complain(const std::string& complaint);

  /// Publishes diagnostics at once, for urgent ones. Call from a callback.
  void reportNow() {
    if (updater_) {
      updater_->force_update();
    }
  }

 private:
  void chooseThread();
  void handle(const std::function<void()>& work);
  void guarded(const std::function<void()>& work);
  /// @return what went wrong, otherwise ""
  std::string answer(const std::function<void()>& work);
  std::vector<ParameterDifference> tune(const Config& next);
  bool setParameters(dynamic_reconfigure::Reconfigure::Request& request,
                     dynamic_reconfigure::Reconfigure::Response& response);
  void onTuning(const dynamic_reconfigure::Config::ConstPtr& message);
  void tick();
  void waitForExtrinsics();
  void diagnoseClock(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::shared_ptr<CallbackThread> thread_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  std::mutex mutex_;  ///< callbacks may come while onInit() is not done
  std::string tree_;  ///< of parameters
  Config config_;
  bool begun_ = false;
  std::deque<std::function<void()>> waiting_;  ///< messages before begin()
  std::unique_ptr<tf2_ros::Buffer> tf_buffer_;
  std::unique_ptr<tf2_ros::TransformListener> tf_listener_;
  ros::Publisher diagnostics_queue_;  ///< never used to publish
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ComplaintLog complaints_;
  std::unique_ptr<TuningServer> tuning_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ClockWatch clock_watch_;
  RepeatedWork ticks_;
  RepeatedWork diagnostics_;
};

}  // namespace slipnav
