#pragma once
/// Finds where to start: levels, finds the heading, and hands over state and covariance at a definite stamp.
///
/// Sources:
///   gnss    rest (leveling, gyro bias), then a drive under satellite positions that gives the heading; the
///           recording is then run through the filter itself, so that the covariance handed over contains
///           every correlation
///   given   position and heading from the parameters, leveled from the first seconds
///   motion  position zero, heading from the parameters, leveled from the first seconds even when moving
///   truth   pose given from outside, leveled likewise

#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ins/ins_engine.h"
#include "slipnav/core/navigation/drive_fit.h"
#include "slipnav/core/navigation/input_check.h"
#include "slipnav/core/navigation/start_recording.h"

namespace slipnav {

/// Block `initialization`.
struct InitializationParams {
  std::string source = "gnss";
  double heading_deg = 0.0;
  double heading_std_deg = 1.0;
  double latitude_deg = 39.65;
  double longitude_deg = -79.9;
  double height_m = 300.0;
  double position_std_m = 0.01;
  double min_rest_s = 5.0;
  double max_rest_s = 60.0;
  double drive_distance_m = 10.0;
  double drive_heading_std_deg = 1.0;
  double leveling_window_s = 10.0;
  double moving_level_std_deg = 1.0;
  double moving_speed_std_mps = 0.1;
  double fix_stamp_offset_s = 0.0;
  std::vector<double> gyro_bias_deg_per_h = {0.0, 0.0, 0.0};
  std::vector<double> accel_bias_ug = {0.0, 0.0, 0.0};
  void visit(ParameterVisitor& v);
};

/// Everything the navigation is configured with.
struct NavigationSetup {
  ImuInputParams imu_input;
  InitializationParams initialization;
  FilterSetup filter;
};

/// Collects samples in order of stamp until there is a start.
class Initializer {
 public:
  Initializer(const Planet& planet, const InitializationParams& params, const ImuInputParams& imu,
              const FilterSetup& setup);

  /// Discards all samples.
  void reset();

  /// Samples in order of stamp, of all sensors together.
  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);
  void push(const AntennaFix& fix) { recording_.push(fix); }

  /// The same once there is a start: only complaint() still looks at it.
  void watch(const ImuSample& sample) { check_.push(sample); }
  void watch(const WheelMotion& wheels) { check_.push(wheels); }

  /// What makes the samples unusable, in one line with cause and remedy; otherwise "". No start is found then.
  const std::string& complaint() const { return check_.complaint().empty() ? clock_complaint_ : check_.complaint(); }
  /// The state for the source `truth`. Without attitude, it is leveled and takes the configured heading.
  void setTruth(const NavigationState& truth, bool has_attitude);

  /// The initial state once it is known; ask after every sample.
  std::optional<InitialState> result() const;

  /// Replaces gates, measurement noise and standstill limits; the rest of the setup must be the same.
  void retune(const FilterSetup& setup);

  /// Whether satellite positions are needed, and have stopped arriving.
  bool missesFixes() const;

  /// What it is waiting for, in words.
  std::string progress() const;

 private:
  std::optional<InitialState> fromDrive() const;
  std::optional<InitialState> fromWindow() const;
  std::optional<InitialState> fromTruth() const;
  /// Until when a drive is known: stamps of a fix and of the first IMU sample from it on.
  struct DriveEnd {
    Nanoseconds fix = 0;
    Nanoseconds imu = 0;
  };

  std::optional<DriveEnd> newestKnownFix() const;
  std::optional<DriveFit> fitOfDrive(Nanoseconds begin, Nanoseconds end, bool at_rest) const;
  InitialState beginOfDrive(Nanoseconds begin, const DriveFit& fit, bool at_rest) const;
  InitialState leveled(Nanoseconds begin, Nanoseconds end, bool at_rest, double heading_rad) const;
  void levelAtRestInto(const ImuSample& mean, double heading_rad, InitialState& initial) const;
  void levelOnTheMoveInto(Nanoseconds begin, Nanoseconds end, double heading_rad, InitialState& initial) const;
  InitialState runFilter(const InitialState& start, Nanoseconds until) const;

  Planet planet_;
  InitializationParams params_;
  ImuInputParams imu_params_;
  FilterSetup setup_;
  ErrorVector prior_variance_;
  StartRecording recording_;
  InputCheck check_;
  mutable Nanoseconds judged_fix_ = 0;   ///< the drive has been examined up to there
  mutable std::string clock_complaint_;  ///< about fixes stamped by another clock
  std::optional<NavigationState> truth_;
  bool truth_has_attitude_ = false;
};

}  // namespace slipnav
