#pragma once
/// Simulated drives for the tuning, with noise that is known.

#include "tuning/drive_likelihood.h"

namespace slipnav::test {

/// Drive on paved ground with a given start and a stop every 8 s; slip configured as small as it is there.
Config tuningConfig(int seed, double distance_m);

/// Drives it, and reads the samples with that configuration.
TuningDrive simulateTuningDrive(const Config& config);

/// Adds white noise of so much to each wheel speed [m/s], 1σ.
void addWheelNoise(double std_mps, TuningDrive& drive);

}  // namespace slipnav::test
