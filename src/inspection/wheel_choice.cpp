#include "inspection/wheel_choice.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace slipnav {
namespace {

/// A joint that has turned by less over a whole drive is not a driven wheel.
constexpr double kLeastTurned_rad = 1.0;

const std::array<const char*, 8> kLeftWords = {"l", "fl", "lf", "rl", "bl", "lb", "ml", "cl"};
const std::array<const char*, 8> kRightWords = {"r", "fr", "rf", "rr", "br", "rb", "mr", "cr"};

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

template <class Words>
bool hasWord(const std::vector<std::string>& words, const Words& wanted) {
  return std::any_of(words.begin(), words.end(), [&wanted](const std::string& word) {
    return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
  });
}

bool isCalledWheel(const std::string& name) {
  const std::string lower = lowerCase(name);
  const bool steers = lower.find("steer") != std::string::npos || lower.find("caster") != std::string::npos;
  return lower.find("wheel") != std::string::npos && !steers;
}

/// By positions or velocities, whichever it has.
bool hasTurned(const JointRecord& record, std::size_t joint) {
  double turned_rad = 0.0;
  const RawJointSample* before = nullptr;
  for (const RawJointSample& sample : record.samples) {
    if (before != nullptr && joint < sample.position_rad.size() && joint < before->position_rad.size()) {
      turned_rad += std::abs(sample.position_rad[joint] - before->position_rad[joint]);
    }
    if (before != nullptr && joint < sample.velocity_radps.size() && std::isfinite(sample.velocity_radps[joint])) {
      turned_rad += std::abs(sample.velocity_radps[joint]) * toSeconds(sample.time.received - before->time.received);
    }
    before = &sample;
  }
  return turned_rad > kLeastTurned_rad;
}

template <class Condition>
std::vector<WheelJoint> jointsThat(const JointRecord& record, std::size_t count, Condition condition) {
  std::vector<WheelJoint> wheels;
  for (std::size_t i = 0; i < count && wheels.size() < kMaxWheels; ++i) {
    if (condition(i)) {
      const std::string name = i < record.names.size() ? record.names[i] : "";
      wheels.push_back({i, name, sideOf(name)});
    }
  }
  return wheels;
}

}  // namespace

Side sideOf(const std::string& name) {
  const std::string lower = lowerCase(name);
  const bool left = lower.find("left") != std::string::npos;
  const bool right = lower.find("right") != std::string::npos;
  if (left != right) {
    return left ? Side::kLeft : Side::kRight;
  }
  const std::vector<std::string> words = wordsOf(lower);
  const bool left_word = hasWord(words, kLeftWords);
  const bool right_word = hasWord(words, kRightWords);
  if (left_word == right_word) {
    return Side::kUnknown;
  }
  return left_word ? Side::kLeft : Side::kRight;
}

std::vector<WheelJoint> wheelsByName(const JointRecord& record) {
  std::size_t count = record.names.size();
  if (count == 0 && !record.samples.empty()) {
    count = std::max(record.samples.front().position_rad.size(), record.samples.front().velocity_radps.size());
  }
  if (record.names.empty()) {
    return jointsThat(record, count, [&record](std::size_t i) { return hasTurned(record, i); });
  }
  std::vector<WheelJoint> wheels =
      jointsThat(record, count, [&record](std::size_t i) { return isCalledWheel(record.names[i]); });
  if (wheels.empty()) {
    wheels = jointsThat(record, count, [&record](std::size_t i) {
      return sideOf(record.names[i]) != Side::kUnknown && hasTurned(record, i);
    });
  }
  if (wheels.empty()) {
    wheels = jointsThat(record, count, [&record](std::size_t i) { return hasTurned(record, i); });
  }
  return wheels;
}

std::vector<WheelJoint> wheelsByConfiguration(const JointRecord& record, const std::vector<WheelParams>& wheels) {
  std::vector<WheelJoint> found;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const WheelParams& wheel = wheels[i];
    const auto name = std::find(record.names.begin(), record.names.end(), wheel.name);
    const bool by_place = record.names.empty() || wheel.name.empty();
    if (!by_place && name == record.names.end()) {
      continue;
    }
    const std::size_t index = by_place ? i : static_cast<std::size_t>(name - record.names.begin());
    const Side side = wheel.y_m > 0.0 ? Side::kLeft : wheel.y_m < 0.0 ? Side::kRight : sideOf(wheel.name);
    found.push_back({index, wheel.name, side, wheel.sign, wheel.radius_m, wheel.y_m});
  }
  return found;
}

}  // namespace slipnav
