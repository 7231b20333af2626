/// Messages of joints as robots send them, right and wrong, drawn at random: no rate, complaint or remark changes
/// without being noticed.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/sensors/wheel_decoder.h"
#include "reference_trace.h"

namespace slipnav::test {
namespace {

constexpr int kDecoders = 24;
constexpr int kMessages = 30;
constexpr double kMaxSpeed_mps = 5.0;

/// A robot with two wheels and other joints.
class Robot {
 public:
  explicit Robot(std::uint64_t seed)
      : dice_(seed),
        wraps_at_rad_(dice_.from<double>({1e9, 0.5 * kTurn_rad, kTurn_rad})),
        fills_in_(dice_.oneIn(3)),
        named_(!dice_.oneIn(4)) {}

  void addLine(ReferenceTrace& trace) {
    draw();
    const std::optional<WheelSample> sample = decoder_.decode({stamp_, names_, position_rad_, velocity_radps_});
    if (sample) {
      trace.note(sample->count, sample->rate_radps[0], sample->rate_radps[1], decoder_.problem(), decoder_.remark());
    } else {
      trace.note("none:", decoder_.problem(), decoder_.remark());
    }
  }

 private:
  static constexpr double kTurn_rad = 2.0 * kPi;

  double wrapped(double angle_rad) const {
    if (wraps_at_rad_ > kTurn_rad) {
      return angle_rad;
    }
    return angle_rad - kTurn_rad * std::ceil((angle_rad - wraps_at_rad_) / kTurn_rad);
  }

  void draw() {
    const double interval_s = dice_.from<double>({0.1, 0.1, 0.1, 0.0, 0.4});
    stamp_ += fromSeconds(dice_.oneIn(25) ? -dice_.from<double>({0.5, 1.0, 2.0}) : interval_s);
    const double rate_radps = dice_.from<double>({3.0, 3.0, 0.0, -1.0, 40.0});
    angle_rad_ += interval_s * rate_radps;
    const std::vector<double> angles = {wrapped(angle_rad_), wrapped(-angle_rad_), 0.25};
    const std::vector<double> rates = fills_in_ && !dice_.oneIn(20) ? std::vector<double>{0.0, 0.0, 0.0}
                                                                    : std::vector<double>{rate_radps, -rate_radps, 7.0};
    const std::vector<std::size_t> order =
        dice_.from<std::vector<std::size_t>>({{0, 1}, {0, 1}, {0, 1}, {1, 0}, {2, 0, 1}, {0, 1, 2}, {0}, {2}});
    const std::vector<std::string> joints = {"left", "right", "arm"};
    names_.clear();
    position_rad_.clear();
    velocity_radps_.clear();
    for (const std::size_t joint : order) {
      names_.push_back(joints[joint]);
      position_rad_.push_back(angles[joint]);
      velocity_radps_.push_back(rates[joint]);
    }
    spoil();
  }

  void spoil() {
    const int event = dice_.roll(30);
    if (event < 8) {
      velocity_radps_.clear();
    } else if (event < 10) {
      position_rad_.clear();
    } else if (event == 10) {
      velocity_radps_.pop_back();
    } else if (event == 11) {
      position_rad_.pop_back();
    } else if (event == 12) {
      velocity_radps_.back() = std::numeric_limits<double>::quiet_NaN();
    } else if (event == 13) {
      position_rad_.front() = std::numeric_limits<double>::infinity();
    } else if (event == 14) {
      velocity_radps_.front() = 51.0;
    } else if (event == 15) {
      position_rad_.front() += 100.0;
    } else if (event == 16) {
      velocity_radps_.push_back(1.0);
    }
    if (!named_) {
      names_.clear();
    }
  }

  Dice dice_;
  double wraps_at_rad_;
  bool fills_in_;
  bool named_;
  WheelDecoder decoder_{{{"left", 0.1, 0.0, 0.3, 1.0}, {"right", 0.1, 0.0, -0.3, -1.0}}, kMaxSpeed_mps};
  Nanoseconds stamp_ = 100 * kSecond;
  double angle_rad_ = 0.0;
  std::vector<std::string> names_;
  std::vector<double> position_rad_;
  std::vector<double> velocity_radps_;
};

TEST(WheelDecoderReference, RatesAndComplaintsAreTheSame) {
  ReferenceTrace trace("wheel_decoder");
  for (std::uint64_t seed = 1; seed <= kDecoders; ++seed) {
    Robot robot(seed);
    for (int message = 0; message < kMessages; ++message) {
      robot.addLine(trace);
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
