#pragma once
/// Positions from satellites and truth: quality, outliers, height, overlap in time, and what they say about the wheels.

#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/truth_track.h"
#include "inspection/finding.h"
#include "inspection/imu_track.h"
#include "inspection/wheel_track.h"

namespace slipnav {

/// Where and when the positions are; stamps in nanoseconds after the origin of the inspection.
TruthTrack positionsOf(const FixRecord& record, Nanoseconds origin);
TruthTrack positionsOf(const PoseRecord& record, Nanoseconds origin);

/// Fixes without a solution, at latitude 0 and longitude 0, without covariance, of mixed quality, with a wandering
/// height.
void checkFixes(const FixRecord& record, const TruthTrack& positions, Findings& findings);

/// Rows far off their neighbors.
void checkJumps(const std::string& topic, const TruthTrack& positions, Findings& findings);

/// @param imu_begin_s, imu_end_s stamps of the IMU after the origin
void checkTimeInCommon(const std::string& topic, const TruthTrack& positions, double imu_begin_s, double imu_end_s,
                       Findings& findings);

/// Dead reckoning in the plane by wheels and gyros, from zero heading north, once per row of the wheels. Empty where
/// the speed of the wheels is not known in meters.
/// @param up direction of the mean specific force in the sensor's axes; @param bias rate at rest
/// @param wheels_ahead_s stamps of the wheels less those of the IMU
PlanarTrack deadReckoning(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up, const Vector3& bias,
                          double wheels_ahead_s);

/// Positions that fit the drive of wheels and gyros only at another time.
void checkClockByTrack(const std::string& topic, const TruthTrack& positions, const PlanarTrack& drive,
                       Findings& findings);

/// Ground over wheels.
struct WheelScale {
  bool known = false;
  double value = 0.0;  ///< [m] over the unit of the track
  double std = 0.0;    ///< from piece to piece
  double distance_m = 0.0;
};

/// Over pieces of 10 m, the distance along chords of a meter against that of the wheels; the median.
WheelScale wheelScale(const TruthTrack& positions, const WheelTrack& wheels);

void checkWheelScale(const std::string& topic, const WheelScale& scale, const WheelTrack& wheels, Findings& findings);

}  // namespace slipnav
