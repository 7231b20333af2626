#include "ros/bag/bag_tuning.h"

#include "ros/bag/bag_evaluation.h"
#include "ros/bag/bag_reader.h"

namespace slipnav {

TuningDrive readTuningDrive(const std::string& path, const Config& config) {
  const BagReader reader(path, config);
  TuningDrive drive;
  drive.name = runName(path);
  drive.config = reader.config();
  const auto keep = [&drive](const Sample& sample) { drive.samples.push_back(sample); };
  BagSink sink;
  sink.imu = keep;
  sink.wheels = keep;
  sink.fix = [&keep](const GnssFix& fix) { keep(toPositionFix(fix)); };
  sink.velocity = keep;
  sink.truth_start = [](const NavigationState&, bool) {};
  sink.truth_fix = [](const GnssFix&) {};
  sink.truth_pose = [](const TruthSample&) {};
  sink.problem = [](const std::string&, Nanoseconds) {};
  reader.read(sink);
  return drive;
}

}  // namespace slipnav
