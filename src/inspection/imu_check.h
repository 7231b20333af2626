#pragma once
/// Checks of the IMU: units, gravity, absent measurements, two sensors on one topic, its mounting.

#include "inspection/finding.h"
#include "inspection/mounting.h"
#include "inspection/recording.h"
#include "inspection/rest.h"

namespace slipnav {

/// Factors that convert the samples of a record to m/s² and rad/s, as far as they can be determined.
struct ImuUnits {
  double force = 1.0;
  double rate = 1.0;
  bool has_gravity = true;
};

/// Findings about measurements that are missing or not finite.
void checkImuMeasurements(const ImuRecord& record, Findings& findings);

/// By the magnitude of the mean specific force, and by how fast a rover can turn.
ImuUnits checkImuUnits(const ImuRecord& record, Findings& findings);

/// The record in m/s² and rad/s.
ImuRecord inProperUnits(ImuRecord record, const ImuUnits& units);

/// What wheels and gravity say about the axes. @param wheels reference for the motion
/// @param configured rotation from the sensor to forward-left-up by a configuration, if there is one
void checkMounting(const std::string& topic, const Mounting& mounting, const WheelTrack& wheels,
                   const std::optional<Matrix3>& configured, Findings& findings);

}  // namespace slipnav
