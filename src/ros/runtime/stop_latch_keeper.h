#pragma once
/// Where emergency stop and override are kept, and whether that worked.

#include <string>

#include "core/navigation/checkpoint.h"
#include "core/stopping/stop_latch.h"

namespace slipnav {

/// The place is `checkpoint.stop_file`, else next to the checkpoint, else a file in ROS_HOME named after the node.
class StopLatchKeeper {
 public:
  /// @param node full name of the nodelet
  StopLatchKeeper(const CheckpointParams& params, const std::string& node);

  /// "" if nothing is kept.
  const std::string& file() const { return file_; }

  /// What was kept. Never throws; problem() says what was wrong.
  StopLatch load();

  /// @return why it is not kept, otherwise "". problem() says the same until something is kept.
  std::string save(const StopLatch& latch);

  const std::string& problem() const { return problem_; }

 private:
  std::string file_;
  std::string problem_;
};

}  // namespace slipnav
