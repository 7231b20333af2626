#include "evaluation/tum.h"

#include <fstream>
#include <iomanip>
#include <stdexcept>

#include "core/base/atomic_file.h"
#include "io/fields.h"

namespace slipnav {
namespace {

constexpr std::size_t kFields = 8;
/// Largest departure of a quaternion's norm from one explained by rounding to a few decimals.
constexpr double kUnitTolerance = 1e-2;

TumPose parsePose(const std::vector<std::string>& fields) {
  if (fields.size() != kFields) {
    throw std::invalid_argument(std::to_string(fields.size()) + " fields instead of " + std::to_string(kFields));
  }
  TumPose pose;
  pose.stamp = secondsField(fields[0]);
  pose.position_enu_m = {numberField(fields[1]), numberField(fields[2]), numberField(fields[3])};
  pose.q_flu_to_enu =
      Quaternion(numberField(fields[7]), numberField(fields[4]), numberField(fields[5]), numberField(fields[6]));
  if (std::abs(pose.q_flu_to_enu.norm() - 1.0) > kUnitTolerance) {
    throw std::invalid_argument("the quaternion has not length one");
  }
  pose.q_flu_to_enu.normalize();
  return pose;
}

}  // namespace

std::vector<TumPose> tumPoses(const EstimateTrack& estimates) {
  std::vector<TumPose> poses;
  poses.reserve(estimates.size());
  for (const EstimateSample& estimate : estimates) {
    poses.push_back({estimate.stamp, estimate.position_enu_m, estimate.q_flu_to_enu});
  }
  return poses;
}

std::vector<TumPose> tumPoses(const TruthTrack& truth) {
  std::vector<TumPose> poses;
  poses.reserve(truth.samples().size());
  for (const TruthSample& sample : truth.samples()) {
    poses.push_back({sample.stamp, sample.position_enu_m, sample.q_flu_to_enu.value_or(Quaternion::Identity())});
  }
  return poses;
}

void writeTum(const std::string& path, const std::vector<TumPose>& poses) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << std::fixed << std::setprecision(9);
  for (const TumPose& pose : poses) {
    const Vector3& p = pose.position_enu_m;
    const Quaternion& q = pose.q_flu_to_enu;
    out << formatSeconds(pose.stamp) << ' ' << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << q.x() << ' ' << q.y()
        << ' ' << q.z() << ' ' << q.w() << '\n';
  }
  file.commit();
}

std::vector<TumPose> readTum(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  std::vector<TumPose> poses;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::vector<std::string> fields = splitFields(line);
    if (fields.empty() || fields.front().front() == '#') {
      continue;
    }
    try {
      poses.push_back(parsePose(fields));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return poses;
}

}  // namespace slipnav
