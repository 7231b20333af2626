#pragma once
/// Truth as it arrives, aligned with the estimate as in the evaluation.

#include <deque>
#include <optional>
#include <variant>
#include <vector>

#include "config/truth_params.h"
#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// Truth and estimate of one epoch.
struct TruthPair {
  TruthSample truth;
  EstimateSample estimate;
};

/// The topics that may carry truth, the preferred one first.
enum class TruthSource { kFix, kOdometry, kPose };

/// Of several sources the most preferred one heard is followed. Truth waits for the estimate of its epoch;
/// the estimate waits for nothing.
class TruthFollower {
 public:
  /// @param lever_flu_m from base_link to the point tracked by the truth
  TruthFollower(const TruthParams& params, const Vector3& lever_flu_m);

  /// Discards everything, including the start.
  void clear();
  /// @param frame the map frame of the estimate; @param stamp where the estimate begins
  void start(const LocalFrame& frame, Nanoseconds stamp);

  /// Stamps of a source that go back by a second or more discard what waits.
  void add(const GnssFix& fix);
  void add(TruthSource source, const TruthSample& pose);

  /// The truth between two neighboring estimates, aligned; with align: heading nothing until the heading is known.
  std::vector<TruthPair> follow(const EstimateSample& earlier, const EstimateSample& later);

 private:
  using Waiting = std::variant<GnssFix, TruthSample>;

  static Nanoseconds stampOf(const Waiting& truth);
  bool prefers(TruthSource source, Nanoseconds stamp);
  void push(const Waiting& truth);
  TruthSample inMap(const Waiting& truth) const;
  void place(const TruthPair& pair, std::vector<TruthPair>& placed);
  TruthPair aligned(const TruthPair& pair) const;
  void collectHeading(const TruthPair& pair, std::vector<TruthPair>& placed);

  TruthParams params_;
  Vector3 lever_flu_m_;
  std::optional<TruthSource> source_;
  Nanoseconds newest_ = 0;
  std::deque<Waiting> waiting_;
  std::optional<LocalFrame> frame_;
  Nanoseconds start_ = 0;
  std::optional<TruthPair> anchor_;           ///< the first pair
  std::vector<TruthPair> heading_pairs_;      ///< of align: heading, until it is known
  double heading_distance_m_ = 0.0;           ///< covered by them
  std::optional<double> heading_offset_rad_;  ///< of align: heading
};

}  // namespace slipnav
