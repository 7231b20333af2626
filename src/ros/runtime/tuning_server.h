#pragma once
/// Offers parameters of a running nodelet to the dynamic_reconfigure tools.
///
/// Names, ranges and meanings are those of the configuration, so there are no .cfg files.

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
  /// @param nodelet its name in the table of tunable parameters; @param loaded the configuration as read
  /// @param service answers `set_parameters`, with the functions below
  TuningServer(ros::NodeHandle& node, ros::NodeHandle& own, const std::string& nodelet, const Config& loaded,
               const Service& service);

  /// The configuration with the requested changes. Throws std::invalid_argument with one line; also for a parameter
  /// that this nodelet does not offer.
  Config requested(const dynamic_reconfigure::Config& request, const Config& present) const;

  /// The configuration has changed: tells the other nodelets. @return the differences to the last time
  std::vector<ParameterDifference> take(const Config& present);

  /// Tells the tools the current values. @return the same, for the answer to a request
  dynamic_reconfigure::Config announce();

  /// Differences to the configuration as loaded, in words; "" if there are none.
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

/// Writes changed parameters to the tree `name` of the parameter server, for nodelets that are loaded
/// later. Does not wait for a master that is gone.
void store(const std::vector<ParameterDifference>& changed, const std::string& tree);

}  // namespace slipnav
