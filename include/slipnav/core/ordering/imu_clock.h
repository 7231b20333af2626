#pragma once
/// When IMU samples were taken, given when a host stamped them.
///
/// An IMU samples at a steady rate; a host stamps when it gets around to it: late, in bursts, several at once. An
/// integral over such intervals would be wrong by the stamp scatter times the specific force. The model is a
/// line through sample number and time, along the lower edge of the stamps (no sample is stamped before it was taken),
/// fitted over the last seconds. Numbers are skipped where samples were lost: where stamps stay late by whole intervals
/// and do not catch up. Stamps already on such a line are kept, to the bit; see doc/time.md.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ordering/usual_interval.h"

namespace slipnav {

/// Problems of the stamps of an IMU.
struct StampFaults {
  double scatter_s = 0.0;         ///< half of the span of the stamps about a steady interval, over the last seconds
  double usual_interval_s = 0.0;  ///< 0: not known yet
  std::uint64_t equal = 0;        ///< samples with the previous stamp but other values
  std::uint64_t lost = 0;         ///< missing samples

  /// Whether they scatter more than a clock read at the time of sampling.
  bool scatters() const;
};

/// Time over the number of a sample.
struct SampleLine {
  double time_s = 0.0;  ///< at number 0
  double period_s = 0.0;
};

/// A least-squares line; sums are taken about a running mean.
class LineFit {
 public:
  void add(double number, double time_s);
  SampleLine line() const;

 private:
  double count_ = 0.0;
  double mean_number_ = 0.0;
  double mean_time_s_ = 0.0;
  double spread_ = 0.0;
  double product_ = 0.0;
};

/// For one source, whose samples come in order. Depends only on stamps; no allocation while stamps are steady.
class ImuClock {
 public:
  /// @param gap_factor a sample that is late by more usual intervals than this, less one, may follow lost ones
  explicit ImuClock(double gap_factor) : late_limit_(gap_factor - 1.0) {}

  void push(const ImuSample& sample);

  /// The next sample, with its stamp corrected. One that is older than its predecessors, or repeated, is left to the
  /// caller to reject: its stamp is not newer than the previous one.
  std::optional<ImuSample> pop();

  const StampFaults& faults() const { return faults_; }

 private:
  /// The sample of a block stamped earliest relative to the line, and how the block lies about it.
  struct Block {
    double index = 0.0;
    double time_s = 0.0;
    double least_s = 0.0;     ///< deviation of that sample
    double greatest_s = 0.0;  ///< of the latest one
    double begin_s = 0.0;
    int samples = 0;
  };

  static constexpr std::size_t kBlocks = 16;

  void restart();
  void start(const ImuSample& sample);
  void follow(const ImuSample& sample);
  void decide();
  double lost(double earliest_s) const;
  void use(const ImuSample& sample, double lost_before);
  void learn(double time_s, double deviation_s);
  void closeBlock();
  void beginToFollow(double time_s);
  void refit();
  bool isExact() const;
  void release(ImuSample sample, Nanoseconds stamp);
  double greatestLateness() const;
  double greatestEarliness() const;
  double timeOf(const ImuSample& sample) const { return toSeconds(sample.stamp - anchor_); }
  bool isLate(double deviation_s) const { return deviation_s > late_limit_ * period_s_ + late_s_; }

  double late_limit_;
  UsualInterval usual_;
  RingQueue<ImuSample> held_;   ///< late; later ones tell whether samples are missing before them
  RingQueue<ImuSample> ready_;  ///< corrected
  std::optional<ImuSample> newest_;
  Nanoseconds anchor_ = 0;  ///< time 0 of the line
  Nanoseconds released_ = 0;
  bool following_ = false;  ///< the line is known
  double index_ = 0.0;      ///< of the newest used sample, including lost ones
  double line_s_ = 0.0;     ///< its time by the line
  double period_s_ = 0.0;
  std::optional<SampleLine> target_;  ///< the line to converge to
  double late_s_ = 0.0;               ///< greatest lateness over the blocks
  double early_s_ = 0.0;              ///< likewise relative to the line
  std::array<Block, kBlocks> blocks_ = {};
  std::size_t block_count_ = 0;  ///< closed since the line was last restarted
  Block open_;
  std::vector<double> first_s_;  ///< times of the first samples
  StampFaults faults_;
};

}  // namespace slipnav
