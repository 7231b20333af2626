#pragma once
/// Offers parameters of a running nodelet to the tools of dynamic_reconfigure.
///
/// Names, ranges and meanings are those of the configuration, so there are no .cfg files beside it.

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <boost/function.hpp>
#include <string>
#include <vector>

#include "config/tuning.h"
#include "ros/runtime/shared_publisher.h"

namespace slipnav {

/// Topics and service of one nodelet.
class TuningServer {
 public:
  using Service =
      boost::function<bool(dynamic_reconfigure::Reconfigure::Request&, dynamic_reconfigure::Reconfigure::Response&)>;

  /// @param node the namespace of the nodelets; @param own that of this nodelet
  /// @param nodelet what it is called in the table of tunable parameters; @param loaded as it was read
  /// @param service answers `set_parameters`, with the functions below
  TuningServer(ros::NodeHandle& node, ros::NodeHandle& own, const std::string& nodelet, const Config& loaded,
               const Service& service);

  /// The configuration with what a request wants. Throws std::invalid_argument of one line; also for a parameter that
  /// this nodelet does not offer.
  Config requested(const dynamic_reconfigure::Config& request, const Config& present) const;

  /// The configuration has changed: tells the other nodelets. @return what differs from the last time
  std::vector<ParameterDifference> take(const Config& present);

  /// Tells the tools how things stand. @return the same, for the answer to a request
  dynamic_reconfigure::Config announce();

  /// What differs from the configuration as it was loaded, in words; "" for nothing.
  std::string changes() const { return toText(differences(loaded_, present_)); }

 private:
  std::string nodelet_;
  std::vector<ParameterInfo> loaded_;
  std::vector<ParameterInfo> present_;
  SharedPublisher<dynamic_reconfigure::Config> updates_;
  SharedPublisher<dynamic_reconfigure::ConfigDescription> descriptions_;
  SharedPublisher<dynamic_reconfigure::Config> others_;
  ros::ServiceServer service_;
};

/// Puts changed parameters into the tree `name` of the parameter server, so that a nodelet which is loaded later has
/// them. Does not wait for a master that is gone.
void store(const std::vector<ParameterDifference>& changed, const std::string& tree);

}  // namespace slipnav
