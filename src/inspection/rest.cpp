#include "inspection/rest.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace slipnav {
namespace {

constexpr double kShortest_s = 2.0;
/// At either end of a rest the vehicle is still swaying.
constexpr double kMargin_s = 0.5;
/// Two neighboring samples of white noise differ by this many standard deviations.
constexpr double kDifferenceFactor = 1.4142135623730951;
/// Not still: somebody moves the vehicle, or an engine shakes it.
constexpr double kStillForce_mps2 = 0.3;
constexpr double kStillRate_radps = 0.03;
constexpr double kLargeBias_radps = 0.001;
/// Even the cheapest gyros are not further off: 5 °/s.
constexpr double kLargestGyroBias_radps = 0.087;
constexpr double kBlock_s = 0.5;
constexpr double kPerSqrtHour = 60.0;
/// Noise known to a sixth is not worth a word below this ratio to the configured one.
constexpr double kClearlyMore = 1.3;
/// Gravity on Earth is within this.
constexpr double kGravity_mps2 = 9.806;
constexpr double kGravitySpan_mps2 = 0.03;
/// Beyond, it is another unit or another planet.
constexpr double kLargestBias_mps2 = 1.0;

class Deviation {
 public:
  void add(const Vector3& deviation) {
    sum_ += deviation.cwiseAbs2();
    ++count_;
  }
  Vector3 std() const { return count_ > 0.0 ? Vector3((sum_ / count_).cwiseSqrt()) : Vector3::Zero(); }

 private:
  Vector3 sum_ = Vector3::Zero();
  double count_ = 0.0;
};

bool isIn(const std::vector<StillTime>& rests, double from_s, double to_s) {
  return std::any_of(rests.begin(), rests.end(),
                     [=](const StillTime& rest) { return to_s >= rest.begin_s && from_s <= rest.end_s; });
}

/// A vehicle turning on the spot has zero forward speed, too.
bool isTurning(const ImuTrack& imu, const StillTime& rest) {
  const Vector3 mean = imu.meanRate(rest.begin_s, rest.end_s);
  bool changes = false;
  for (double t_s = rest.begin_s; t_s + kBlock_s <= rest.end_s; t_s += kBlock_s) {
    changes = changes || (imu.meanRate(t_s, t_s + kBlock_s) - mean).norm() > kStillRate_radps;
  }
  return changes || mean.norm() > kLargestGyroBias_radps;
}

void noteRests(const ImuTrack& imu, RestPicture& picture) {
  Deviation force;
  Deviation rate;
  double count = 0.0;
  picture.force.setZero();
  for (const StillTime& rest : picture.rests) {
    const Vector3 mean_force = imu.meanForce(rest.begin_s, rest.end_s);
    const Vector3 mean_rate = imu.meanRate(rest.begin_s, rest.end_s);
    for (std::size_t i = imu.firstAfter(rest.begin_s); i < imu.firstAfter(rest.end_s); ++i) {
      force.add(imu.force(i) - mean_force);
      rate.add(imu.rate(i) - mean_rate);
      picture.force += imu.force(i);
      picture.rate += imu.rate(i);
      count += 1.0;
    }
  }
  picture.known = count > 1.0;
  picture.force = picture.known ? Vector3(picture.force / count) : imu.meanForce(imu.begin() - 1.0, imu.end());
  picture.rate = picture.known ? Vector3(picture.rate / count) : Vector3::Zero();
  picture.force_std = force.std();
  picture.rate_std = rate.std();
}

void noteDriving(const ImuTrack& imu, RestPicture& picture) {
  Deviation force;
  Deviation rate;
  for (std::size_t i = 1; i < imu.size(); ++i) {
    if (!isIn(picture.rests, imu.times()[i - 1] - kMargin_s, imu.times()[i] + kMargin_s)) {
      force.add((imu.force(i) - imu.force(i - 1)) / kDifferenceFactor);
      rate.add((imu.rate(i) - imu.rate(i - 1)) / kDifferenceFactor);
    }
  }
  picture.driving_force_std = force.std();
  picture.driving_rate_std = rate.std();
}

std::string noiseText(const Vector3& force_std, const Vector3& rate_std) {
  return decimal(force_std.maxCoeff(), 3) + " m/s² and " + decimal(radToDeg(rate_std.maxCoeff()), 3) + " °/s (1σ)";
}

void describeRests(const std::string& topic, const RestPicture& picture, Findings& findings) {
  double total_s = 0.0;
  for (const StillTime& rest : picture.rests) {
    total_s += rest.end_s - rest.begin_s + 2.0 * kMargin_s;
  }
  findings.push_back({Severity::kRemark, topic,
                      counted(picture.rests.size(), "rest") + " of 2 s or more, " + decimal(total_s, 0) +
                          " s in all; samples scatter by " + noiseText(picture.force_std, picture.rate_std) +
                          " there, from one to the next by " +
                          noiseText(picture.driving_force_std, picture.driving_rate_std) + " while driving",
                      "nothing: it is learned; imu.noise takes the data sheet's values"});
  if (picture.force_std.maxCoeff() > kStillForce_mps2 || picture.rate_std.maxCoeff() > kStillRate_radps) {
    findings.push_back({Severity::kDoubtful, topic, "the vehicle is not still while its wheels are at rest",
                        "do not touch it at rest; with an engine running, raise stationary.accel_std_mps2 and "
                        "stationary.gyro_std_deg_per_s"});
  }
}

void sayNoise(const std::string& topic, const LeastNoise& noise, Findings& findings) {
  if (noise.gyro_noise_deg_per_sqrt_h > 0.0) {
    findings.push_back(
        {Severity::kRemark, topic,
         "at rest the angle random walk of the gyros is " + decimal(noise.gyro_noise_deg_per_sqrt_h, 2) + " °/√h",
         "imu.noise.gyro_noise_deg_per_sqrt_h not below that, whatever the data sheet says"});
  }
  if (noise.accel_noise_mps_per_sqrt_h > 0.0) {
    findings.push_back({Severity::kRemark, topic,
                        "at rest the velocity random walk of the accelerometers is " +
                            decimal(noise.accel_noise_mps_per_sqrt_h, 3) + " m/s/√h",
                        "imu.noise.accel_noise_mps_per_sqrt_h not below that, whatever the data sheet says"});
  }
}

}  // namespace

std::vector<StillTime> restsOf(const WheelTrack& wheels) {
  std::vector<StillTime> rests;
  StillTime open;
  bool is_open = false;
  const auto close = [&] {
    if (is_open && open.end_s - open.begin_s >= kShortest_s) {
      rests.push_back({open.begin_s + kMargin_s, open.end_s - kMargin_s});
    }
    is_open = false;
  };
  for (const WheelRow& row : wheels.rows) {
    if (is_open && row.time_s - open.end_s > kShortest_s) {
      close();  // the motion in between is unknown
    }
    if (row.largest > wheels.rest_speed) {
      close();
      continue;
    }
    if (!is_open) {
      open.begin_s = row.time_s;
      is_open = true;
    }
    open.end_s = row.time_s;
  }
  close();
  return rests;
}

RestPicture pictureOf(const ImuTrack& imu, const std::vector<StillTime>& rests) {
  RestPicture picture;
  std::copy_if(rests.begin(), rests.end(), std::back_inserter(picture.rests),
               [&imu](const StillTime& rest) { return !isTurning(imu, rest); });
  noteRests(imu, picture);
  picture.noise = restNoise(imu, picture.rests);
  noteDriving(imu, picture);
  return picture;
}

LeastBias leastBias(const RestPicture& picture) {
  LeastBias bias;
  if (!picture.known) {
    return bias;
  }
  const double off_mps2 = std::abs(picture.force.norm() - kGravity_mps2);
  bias.force_mps2 = off_mps2 > kGravitySpan_mps2 && off_mps2 < kLargestBias_mps2 ? off_mps2 : 0.0;
  bias.rate_radps = picture.rate.norm() > kLargeBias_radps ? picture.rate.norm() : 0.0;
  return bias;
}

LeastNoise leastNoise(const RestPicture& picture, const ImuNoiseParams& assumed) {
  LeastNoise noise;
  const double accel = picture.noise.force * kPerSqrtHour;
  const double gyro = radToDeg(picture.noise.rate) * kPerSqrtHour;
  noise.accel_noise_mps_per_sqrt_h = accel > kClearlyMore * assumed.accel_noise_mps_per_sqrt_h ? accel : 0.0;
  noise.gyro_noise_deg_per_sqrt_h = gyro > kClearlyMore * assumed.gyro_noise_deg_per_sqrt_h ? gyro : 0.0;
  return noise;
}

void checkRests(const std::string& topic, const RestPicture& picture, const ImuNoiseParams& assumed,
                Findings& findings) {
  if (!picture.known) {
    findings.push_back({Severity::kRemark, topic,
                        "no rest of 2 s or more: biases and level are not known from the start",
                        "stand for 30 s before driving, and for 3 s now and then; initialization.source: motion "
                        "starts without a rest"});
    return;
  }
  describeRests(topic, picture, findings);
  sayNoise(topic, leastNoise(picture, assumed), findings);
  const LeastBias bias = leastBias(picture);
  if (bias.rate_radps > 0.0) {
    findings.push_back(
        {Severity::kRemark, topic, "at rest the gyros turn by " + decimal(radToDeg(bias.rate_radps), 2) + " °/s",
         "imu.noise.gyro_bias_std_deg_per_h not below " + decimal(3600.0 * radToDeg(bias.rate_radps), 0)});
  }
  if (bias.force_mps2 > 0.0) {
    findings.push_back({Severity::kRemark, topic,
                        "at rest the specific force is " + decimal(picture.force.norm(), 2) + " m/s²: a bias of " +
                            decimal(bias.force_mps2, 2) + " m/s² or more",
                        "imu.noise.accel_bias_std_ug not below " + decimal(bias.force_mps2 / kMicroG, 0)});
  }
}

}  // namespace slipnav
