/// slipnav/LegacyBridge: publishes what the core_nav node of the paper's software would, for its subscribers.
///
/// In: nav_state, slip. Out: core_nav/core_nav/{position, llh, ecef, enu, velocity, attitude, cn_odom, slip}.

#include <geometry_msgs/PointStamped.h>
#include <nav_msgs/Odometry.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <optional>

#include "ros/messages/legacy_messages.h"
#include "ros/runtime/nodelet_base.h"

namespace slipnav {

namespace {

constexpr double kSilence_s = 2.0;  // without an estimate

}  // namespace

class LegacyBridgeNodelet : public NodeletBase {
 public:
  ~LegacyBridgeNodelet() override { stop(); }

 private:
  using PointStamped = geometry_msgs::PointStamped;

  void begin(const Config& config) override {
    messages_.emplace(config.frames, Planet::byName(config.planet), config.wheels);
  }

  bool needsExtrinsics() const override { return false; }

  void subscribe(const Config& config) override {
    listen<NavState>(config.topics.nav_state, &LegacyBridgeNodelet::onNavState);
    listen<Slip>(config.topics.slip, &LegacyBridgeNodelet::onSlip);
  }

  void advertise(const Config&) override {
    position_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/position");
    llh_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/llh");
    ecef_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/ecef");
    enu_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/enu");
    velocity_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/velocity");
    attitude_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/attitude");
    slip_ = publisher<geometry_msgs::PointStamped>("core_nav/core_nav/slip");
    odometry_ = publisher<nav_msgs::Odometry>("core_nav/core_nav/cn_odom");
  }

  void onNavState(const NavState::ConstPtr& state) {
    ++states_;
    watch_.heard(clocks());
    publish(position_, messages_->position(*state));
    publish(llh_, messages_->llh(*state));
    publish(ecef_, messages_->ecef(*state));
    publish(enu_, messages_->enu(*state));
    publish(velocity_, messages_->velocity(*state));
    publish(attitude_, messages_->attitude(*state));
    publish(odometry_, messages_->odometry(*state));
  }

  void onSlip(const Slip::ConstPtr& slip) {
    if (const std::optional<PointStamped> message = messages_->slip(*slip)) {
      publish(slip_, *message);
    }
  }

  template <class Message>
  static void publish(const SharedPublisher<Message>& publisher, const Message& message) {
    publisher.publish(boost::make_shared<Message>(message));
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool silent = watch_.isSilent(clocks());
    status.summary(silent ? DiagnosticStatus::STALE : DiagnosticStatus::OK, silent        ? "estimates have stopped"
                                                                            : states_ > 0 ? "translating"
                                                                                          : "waiting for estimates");
    status.add("estimates", states_);
  }

  std::optional<LegacyMessages> messages_;
  std::uint64_t states_ = 0;
  SilenceWatch watch_{kSilence_s};
  SharedPublisher<PointStamped> position_;
  SharedPublisher<PointStamped> llh_;
  SharedPublisher<PointStamped> ecef_;
  SharedPublisher<PointStamped> enu_;
  SharedPublisher<PointStamped> velocity_;
  SharedPublisher<PointStamped> attitude_;
  SharedPublisher<PointStamped> slip_;
  SharedPublisher<nav_msgs::Odometry> odometry_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::LegacyBridgeNodelet, nodelet::Nodelet)
