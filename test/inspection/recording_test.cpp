/// A good drive gives no complaint; each way to spoil it gives its own.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "inspection/configuration_proposal.h"
#include "inspection/inspection.h"
#include "synthetic_recording.h"

namespace slipnav {
namespace {

/// The finding whose text has `words`, or nullptr.
const Finding* find(const Inspection& inspection, const std::string& words) {
  for (const Finding& finding : inspection.findings) {
    if (finding.text.find(words) != std::string::npos) {
      return &finding;
    }
  }
  return nullptr;
}

Inspection inspectSpoilt(const std::function<void(Recording&)>& spoil, const InspectionOptions& options = {}) {
  static Recording recording;  // findings point into it
  recording = test::syntheticRecording();
  spoil(recording);
  return inspect(recording, options);
}

void expectFinding(const Inspection& inspection, const std::string& words, Severity severity) {
  const Finding* finding = find(inspection, words);
  ASSERT_NE(finding, nullptr) << words << "\n" << toText(inspection.findings);
  EXPECT_EQ(finding->severity, severity) << toText(inspection.findings);
  EXPECT_FALSE(finding->remedy.empty());
}

TEST(InspectionOfRecording, FindsNothingWrongWithAGoodDrive) {
  const Inspection inspection = inspectSpoilt([](Recording&) {});
  EXPECT_EQ(statusOf(inspection.findings), 0) << toText(inspection.findings);
  EXPECT_TRUE(inspection.mounting.is_sure);
  EXPECT_TRUE(inspection.mounting.nearest.isIdentity());
  EXPECT_NEAR(inspection.scale.value, 0.1, 0.002);
  EXPECT_NEAR(inspection.mounting.turn_per_rate * 0.1, 0.6, 0.03);
  EXPECT_NEAR(inspection.clock.wheels_ahead_s, 0.0, 0.05);
}

TEST(InspectionOfRecording, NamesUnitsAndGravity) {
  const auto scaleForce = [](double factor) {
    return [factor](Recording& recording) {
      for (RawImuSample& sample : recording.imus[0].samples) {
        sample.specific_force *= factor;
      }
    };
  };
  expectFinding(inspectSpoilt(scaleForce(1.0 / 9.80665)), "in g?", Severity::kUnusable);
  expectFinding(inspectSpoilt(scaleForce(-1.0)), "opposite directions", Severity::kUnusable);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (RawImuSample& sample : recording.imus[0].samples) {
                    sample.specific_force.z() -= 9.806;
                  }
                }),
                "gravity taken out?", Severity::kUnusable);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (RawImuSample& sample : recording.imus[0].samples) {
                    sample.angular_rate *= 180.0 / kPi;
                  }
                }),
                "in deg/s?", Severity::kUnusable);
}

TEST(InspectionOfRecording, NamesWhatIsAbsentOrTwice) {
  expectFinding(
      inspectSpoilt([](Recording& recording) { recording.imus[0].without_force = recording.imus[0].samples.size(); }),
      "covariance[0] is -1", Severity::kUnusable);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  recording.imus.push_back(recording.imus[0]);
                  recording.imus[1].frame = "other";
                  recording.imus[1].samples.resize(100);
                }),
                "comes from two sensors", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) { recording.topics[0].publishers = 2; }),
                "comes from 2 publishers", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) { recording.imus.clear(); }), "has no IMU", Severity::kUnusable);
  expectFinding(inspectSpoilt([](Recording& recording) { recording.joints.clear(); }), "has no wheels",
                Severity::kUnusable);
}

TEST(InspectionOfRecording, NamesClocksApartByReceiptAndByMotion) {
  const Inspection by_both = inspectSpoilt([](Recording& recording) {
    for (RawJointSample& sample : recording.joints[0].samples) {
      sample.time.stamp += 3 * kSecond;
    }
  });
  expectFinding(by_both, "are 3.0 s apart", Severity::kUnusable);
  expectFinding(by_both, "s ahead of those of /imu/data, by the motion", Severity::kUnusable);
  EXPECT_NEAR(by_both.clock.wheels_ahead_s, 3.0, 0.1);
  const Inspection small = inspectSpoilt([](Recording& recording) {
    for (RawJointSample& sample : recording.joints[0].samples) {
      sample.time.stamp += 3 * kSecond / 10;
    }
  });
  expectFinding(small, "s ahead of those of /imu/data, by the motion", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (RawFixSample& sample : recording.fixes[0].samples) {
                    sample.time.stamp -= 18 * kSecond;
                  }
                }),
                "is one of them GPS time?", Severity::kUnusable);
}

TEST(InspectionOfRecording, FindsASmallDelayOfTheWheels) {
  for (const double delay_s : {-0.06, 0.05}) {
    const Inspection late = inspectSpoilt([delay_s](Recording& recording) {
      for (RawJointSample& sample : recording.joints[0].samples) {
        sample.time.stamp += fromSeconds(delay_s);
      }
    });
    EXPECT_NEAR(late.clock.wheels_ahead_s, delay_s, 0.01);
    EXPECT_LT(late.clock.std_s, 0.01);
    expectFinding(late, "those of /imu/data, by the motion", Severity::kRemark);
    InspectionOptions options;
    options.wheel_radius_m = 0.1;
    EXPECT_NE(proposedYaml(late, options, "drive.bag").find("stamp_delay_s: " + std::string(delay_s < 0.0 ? "-" : "")),
              std::string::npos);
  }
}

TEST(InspectionOfRecording, NamesATruthOfAnotherClockByItsTrack) {
  InspectionOptions options;
  options.wheel_radius_m = 0.1;
  const auto lateTruth = [](Recording& recording) {
    for (RawFixSample& sample : recording.fixes[0].samples) {
      sample.time.stamp += 18 * kSecond;
      sample.time.received += 18 * kSecond;
    }
  };
  expectFinding(inspectSpoilt(lateTruth, options), "18 s: GPS time instead of UTC?", Severity::kUnusable);
  options.config = Config();
  options.config->wheels = {{"front_left_wheel", 0.1, 0.0, 0.3, 1.0}, {"front_right_wheel", 0.1, 0.0, -0.3, 1.0}};
  options.config->truth.stamp_offset_s = -18.0;
  EXPECT_EQ(find(inspectSpoilt(lateTruth, options), "GPS time"), nullptr);
}

TEST(InspectionOfRecording, NamesStampsThatAreNotSetOrSetBack) {
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (RawJointSample& sample : recording.joints[0].samples) {
                    sample.time.stamp = 0;
                  }
                }),
                "are zero", Severity::kUnusable);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  auto& samples = recording.imus[0].samples;
                  for (std::size_t i = samples.size() / 2; i < samples.size(); ++i) {
                    samples[i].time.stamp -= 5 * kSecond;
                  }
                }),
                "set back 1 time, by up to 5.00 s", Severity::kDoubtful);
}

TEST(InspectionOfRecording, NamesVelocitiesThatAreOfNoUse) {
  const auto setVelocities = [](const std::function<double(double)>& change) {
    return [change](Recording& recording) {
      for (RawJointSample& sample : recording.joints[0].samples) {
        for (double& velocity : sample.velocity_radps) {
          velocity = change(velocity);
        }
      }
    };
  };
  expectFinding(inspectSpoilt(setVelocities([](double) { return 0.0; })), "always 0 while positions move",
                Severity::kDoubtful);
  expectFinding(inspectSpoilt(setVelocities([](double) { return std::numeric_limits<double>::quiet_NaN(); })),
                "not finite numbers", Severity::kDoubtful);
  expectFinding(inspectSpoilt(setVelocities([](double v) { return 30.0 / kPi * v; })), "velocity is 9.549 times",
                Severity::kDoubtful);
  expectFinding(inspectSpoilt(setVelocities([](double v) { return -v; })), "velocity is -1.000 times",
                Severity::kUnusable);
}

TEST(InspectionOfRecording, NamesBadPositions) {
  expectFinding(inspectSpoilt([](Recording& recording) { recording.fixes[0].samples[50].fix.latitude_deg += 1e-3; }),
                "1 outlier", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  recording.fixes[0].samples[3].is_nowhere = true;
                  recording.fixes[0].samples[3].is_usable = false;
                }),
                "latitude 0, longitude 0", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (std::size_t i = 0; i < 100; ++i) {
                    recording.fixes[0].samples[i].fix.covariance_ned_m2 *= 1e5;
                  }
                }),
                "mixed quality", Severity::kDoubtful);
  expectFinding(inspectSpoilt([](Recording& recording) {
                  for (RawFixSample& sample : recording.fixes[0].samples) {
                    sample.time.stamp += 86400 * kSecond;
                    sample.time.received += 86400 * kSecond;
                  }
                }),
                "no time in common", Severity::kUnusable);
}

/// Every fourth stretch between two stops is driven in reverse, with wheels that report how fast they turn, not which
/// way.
TEST(InspectionOfRecording, NamesWheelsWithoutSign) {
  const Inspection inspection = inspectSpoilt([](Recording& recording) {
    const Nanoseconds begin = recording.begin;
    for (RawImuSample& sample : recording.imus[0].samples) {
      if (std::fmod(toSeconds(sample.time.stamp - begin), 60.0) > 45.0) {
        sample.specific_force.head<2>() *= -1.0;
      }
    }
  });
  expectFinding(inspection, "the wheel speed has no sign", Severity::kUnusable);
}

/// What the sensor of a slow rover on rough ground feels is mostly tilt, and in some pieces it looks like driving
/// backwards.
TEST(InspectionOfRecording, TakesNoTiltForReverse) {
  test::SyntheticDrive drive;
  drive.duration_s = 1800.0;
  Recording recording = test::syntheticRecording(drive);
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0.0, 0.02);
  Vector3 tilt = Vector3::Zero();
  for (RawImuSample& sample : recording.imus[0].samples) {
    tilt = 0.98 * tilt + Vector3(normal(generator), normal(generator), 0.0);
    sample.specific_force.head<2>() *= 0.1;
    sample.specific_force += tilt;
    sample.angular_rate *= 0.1;
  }
  for (RawJointSample& sample : recording.joints[0].samples) {
    for (std::size_t wheel = 0; wheel < 4; ++wheel) {
      sample.velocity_radps[wheel] *= 0.1;
      sample.position_rad[wheel] *= 0.1;
    }
  }
  const Inspection inspection = inspect(recording, {});
  EXPECT_GE(inspection.mounting.batches_backward, 2U) << "the case is no test";
  EXPECT_EQ(find(inspection, "has no sign"), nullptr) << toText(inspection.findings);
}

TEST(InspectionOfRecording, HoldsAConfigurationAgainstTheData) {
  InspectionOptions options;
  options.config = Config();
  options.config->topics.imu = "imu/raw";
  options.config->wheels = {{"left", 0.1, 0.0, 0.3, 1.0}, {"front_right_wheel", 0.1, 0.0, -0.3, 1.0}};
  const Inspection names = inspectSpoilt([](Recording&) {}, options);
  expectFinding(names, "is not in the recording; it has /imu/data", Severity::kUnusable);
  expectFinding(names, "has no joint 'left'; it has front_left_wheel", Severity::kUnusable);
  options.config->topics.imu = "imu/data";
  options.config->wheels = {{"front_left_wheel", 0.1, 0.0, 0.3, -1.0}, {"front_right_wheel", 0.1, 0.0, -0.3, 1.0}};
  expectFinding(inspectSpoilt([](Recording&) {}, options), "turn opposite", Severity::kUnusable);
  options.config->wheels[0].sign = 1.0;
  options.config->imu.mount.yaw_deg = 90.0;
  expectFinding(inspectSpoilt([](Recording&) {}, options), "imu.mount does not match", Severity::kUnusable);
  options.config->imu.mount.yaw_deg = 180.0;
  expectFinding(inspectSpoilt([](Recording&) {}, options), "disagree on the direction", Severity::kUnusable);
}

TEST(InspectionOfRecording, ProposesAConfigurationThatIsReadBack) {
  test::SyntheticDrive drive;
  drive.C_sensor_to_flu = Vector3(1.0, -1.0, -1.0).asDiagonal();
  Recording recording = test::syntheticRecording(drive);
  for (RawJointSample& sample : recording.joints[0].samples) {
    for (const std::size_t left : {0, 2}) {
      sample.velocity_radps[left] *= -1.0;
      sample.position_rad[left] *= -1.0;
    }
  }
  recording.imus[0].topic = "/sensors/imu";
  const InspectionOptions options;
  const std::string yaml = proposedYaml(inspect(recording, options), options, "drive.bag");
  const std::string path = testing::TempDir() + "proposed.yaml";
  FILE* file = std::fopen(path.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs(yaml.c_str(), file);
  std::fclose(file);
  const Config config = Config::load({path});
  EXPECT_EQ(config.topics.imu, "sensors/imu");
  EXPECT_NEAR(std::abs(config.imu.mount.roll_deg), 180.0, 1e-9);
  ASSERT_EQ(config.wheels.size(), 4U);
  EXPECT_EQ(config.wheels[0].sign, -1.0);
  EXPECT_EQ(config.wheels[1].sign, 1.0);
  EXPECT_NEAR(config.wheels[0].radius_m, 0.1, 0.002);
  EXPECT_NEAR(config.wheels[0].y_m, 0.3, 0.02);
  EXPECT_EQ(config.initialization.source, "motion");
}

}  // namespace
}  // namespace slipnav
