/// Stamps of hosts that lose, repeat, delay and scatter them, restart and change their rate: no change of a corrected
/// stamp goes without being noticed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference_trace.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000 * kSecond;
constexpr int kSeconds = 90;

/// A host that stamps the samples of an IMU.
class Host {
 public:
  explicit Host(std::uint64_t seed) : dice_(seed) {}

  /// A second of samples, with what goes wrong in it.
  void addLine(ReferenceTrace& trace) {
    const int event = dice_.roll(14);
    released_ = 0;
    moved_s_ = moved_most_s_ = 0.0;
    if (event == 0) {
      period_s_ = dice_.from<double>({0.01, 0.02, 0.005, 0.1});
    } else if (event == 1) {
      now_s_ += period_s_ * (1 + dice_.roll(40));  // lost
    } else if (event == 2) {
      scatter_s_ = dice_.from<double>({0.0, 1e-6, 0.001, 0.004});
    } else if (event == 3) {
      now_s_ -= dice_.from<double>({1.0, 200.0});  // restarts
    }
    const int count = static_cast<int>(std::lround(1.0 / period_s_));
    const int hangs_from = event == 4 ? dice_.roll(20) : count;
    const int hangs_for = 2 + dice_.roll(90);
    for (int i = 0; i < count; ++i) {
      now_s_ += period_s_;
      const bool hangs = i >= hangs_from && i < hangs_from + hangs_for;
      const double free_s = now_s_ + period_s_ * (hangs_from + hangs_for - 1 - i);
      push(hangs ? free_s + 1e-4 * (i - hangs_from) : now_s_ + scatter_s_ * dice_.normal());
      if (event >= 5 && event <= 7 && dice_.oneIn(20)) {
        push(event == 5 ? newest_s_ : event == 6 ? newest_s_ - 0.1 : newest_s_, event == 7);
      }
    }
    const StampFaults& faults = clock_.faults();
    trace.note(released_, moved_s_, moved_most_s_, faults.lost, faults.equal, faults.scatter_s, faults.usual_interval_s,
               faults.scatters());
  }

 private:
  /// @param is_new another sample, even if its stamp is not
  void push(double stamp_s, bool is_new = true) {
    number_ += is_new ? 1 : 0;
    newest_s_ = stamp_s;
    ImuSample sample;
    sample.stamp = kStart + fromSeconds(stamp_s);
    sample.f_ib_b.x() = number_;
    sample.omega_ib_b.x() = stamp_s;
    clock_.push(sample);
    while (const std::optional<ImuSample> corrected = clock_.pop()) {
      ++released_;
      const double moved_s = std::abs(toSeconds(corrected->stamp - kStart) - corrected->omega_ib_b.x());
      moved_s_ += moved_s < 1e-7 ? 0.0 : moved_s;
      moved_most_s_ = std::max(moved_most_s_, moved_s < 1e-7 ? 0.0 : moved_s);
    }
  }

  Dice dice_;
  ImuClock clock_{1.6};
  double period_s_ = 0.01;
  double scatter_s_ = 0.0;
  double now_s_ = 0.0;
  double newest_s_ = 0.0;
  double number_ = 0.0;
  int released_ = 0;
  double moved_s_ = 0.0;
  double moved_most_s_ = 0.0;
};

TEST(ImuClockReference, CorrectedStampsAreTheSame) {
  ReferenceTrace trace("imu_clock");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Host host(seed);
    for (int second = 0; second < kSeconds; ++second) {
      host.addLine(trace);
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
