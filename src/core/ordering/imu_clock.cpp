#include "slipnav/core/ordering/imu_clock.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

constexpr int kBlockSamples = 16;
constexpr double kBlock_s = 0.5;
/// Stamps in whole microseconds, and the arithmetic of a driver, do not count as scatter.
constexpr double kExact_s = 5e-6;
/// Relative to the usual interval: clocks read at the time of sampling scatter by less.
constexpr double kQuietScatter = 0.05;
/// Relative to the usual interval: a sample that follows sooner has waited together with its predecessor.
constexpr double kTogether = 0.5;
constexpr double kTooEarly = 0.5;
constexpr std::size_t kMostHeld = 64;
/// Relative to the usual interval, per sample: how fast the line converges to its new place.
constexpr double kSlew = 0.01;
/// Relative to the usual interval: minimum distance of corrected stamps.
constexpr double kLeastStep = 0.25;
/// Relative difference of two measures of the usual interval, above which samples are missing in between.
constexpr double kSamePace = 0.01;
constexpr double kNewPace = 0.2;

}  // namespace

bool StampFaults::scatters() const { return scatter_s > kQuietScatter * usual_interval_s; }

void LineFit::add(double number, double time_s) {
  count_ += 1.0;
  const double from_mean = number - mean_number_;
  mean_number_ += from_mean / count_;
  mean_time_s_ += (time_s - mean_time_s_) / count_;
  spread_ += from_mean * (number - mean_number_);
  product_ += from_mean * (time_s - mean_time_s_);
}

SampleLine LineFit::line() const {
  const double period_s = product_ / spread_;
  return {mean_time_s_ - period_s * mean_number_, period_s};
}

void ImuClock::restart() {
  while (!held_.empty()) {
    decide();
  }
  ImuClock fresh(1.0 + late_limit_);
  fresh.ready_ = ready_;
  fresh.faults_.equal = faults_.equal;
  fresh.faults_.lost = faults_.lost;
  *this = fresh;
}

std::optional<ImuSample> ImuClock::pop() {
  if (ready_.empty()) {
    return std::nullopt;
  }
  const ImuSample sample = ready_.front();
  ready_.pop_front();
  return sample;
}

void ImuClock::start(const ImuSample& sample) {
  anchor_ = sample.stamp;
  newest_ = sample;
  release(sample, sample.stamp);
}

void ImuClock::push(const ImuSample& sample) {
  if (newest_ && sample.stamp <= newest_->stamp - kSecond) {  // a source that has restarted
    restart();
  }
  if (!newest_) {
    start(sample);
    return;
  }
  const bool equal = sample.stamp == newest_->stamp;
  const bool repeated = equal && sample.f_ib_b == newest_->f_ib_b && sample.omega_ib_b == newest_->omega_ib_b;
  if (sample.stamp < newest_->stamp || repeated) {
    ready_.push_back(sample);
    ready_.back().stamp = std::min(sample.stamp, released_);
    return;
  }
  faults_.equal += equal ? 1 : 0;
  usual_.add(toSeconds(sample.stamp - newest_->stamp));
  faults_.usual_interval_s = usual_.value();
  const bool together = toSeconds(sample.stamp - newest_->stamp) < kTogether * period_s_;
  newest_ = sample;
  if (!following_) {
    use(sample, 0.0);
  } else if (held_.empty()) {
    follow(sample);
  } else {
    held_.push_back(sample);
    if (!together || held_.size() >= kMostHeld) {
      decide();
    }
  }
}

/// Uses a sample at once, or holds it until the reason for its delay is known.
void ImuClock::follow(const ImuSample& sample) {
  if (isLate(timeOf(sample) - (line_s_ + period_s_))) {
    held_.push_back(sample);
  } else {
    use(sample, 0.0);
  }
}

/// Samples that were held up have caught up; after lost ones all stay late.
void ImuClock::decide() {
  if (held_.empty()) {
    return;
  }
  double earliest_s = timeOf(held_.front());
  for (std::size_t i = 0; i < held_.size(); ++i) {
    earliest_s = std::min(earliest_s, timeOf(held_[i]) - period_s_ * static_cast<double>(i));
  }
  const ImuSample first = held_.front();
  held_.pop_front();
  use(first, lost(earliest_s - (line_s_ + period_s_)));
  while (held_.size() > 1) {
    use(held_.front(), 0.0);
    held_.pop_front();
  }
  if (!held_.empty()) {
    const ImuSample last = held_.front();
    held_.pop_front();
    follow(last);
  }
}

bool ImuClock::isExact() const { return late_s_ <= kExact_s && early_s_ <= kExact_s; }

double ImuClock::lost(double earliest_s) const { return isLate(earliest_s) ? std::round(earliest_s / period_s_) : 0.0; }

void ImuClock::use(const ImuSample& sample, double lost_before) {
  const double time_s = timeOf(sample);
  if (!following_) {
    release(sample, sample.stamp);
    beginToFollow(time_s);
    return;
  }
  double ahead = 1.0 + lost_before;
  const double early_s = line_s_ + ahead * period_s_ - time_s;
  if (early_s > kTooEarly * period_s_ + early_s_) {  // those counted as lost arrive after all
    if (isExact()) {                                 // or here is one more than there is time for
      ready_.push_back(sample);
      ready_.back().stamp = released_;
      return;
    }
    ahead -= std::round(early_s / period_s_);
  }
  index_ += ahead;
  double line_s = line_s_ + ahead * period_s_;
  faults_.lost += static_cast<std::uint64_t>(lost_before);
  if (target_) {
    const double most_s = kSlew * period_s_;
    line_s += std::clamp(target_->time_s + target_->period_s * index_ - line_s, -most_s, most_s);
  }
  line_s_ = line_s;
  learn(time_s, time_s - line_s);
  release(sample, isExact() ? sample.stamp : anchor_ + fromSeconds(line_s_));
}

void ImuClock::release(ImuSample sample, Nanoseconds stamp) {
  if (following_) {
    stamp = std::max(stamp, released_ + fromSeconds(kLeastStep * period_s_));
  }
  released_ = sample.stamp = std::max(stamp, released_);
  ready_.push_back(sample);
}

void ImuClock::learn(double time_s, double deviation_s) {
  if (open_.samples == 0 || deviation_s < open_.least_s) {
    open_.index = index_;
    open_.time_s = time_s;
    open_.least_s = deviation_s;
  }
  open_.greatest_s = open_.samples == 0 ? deviation_s : std::max(open_.greatest_s, deviation_s);
  open_.begin_s = open_.samples == 0 ? time_s : open_.begin_s;
  ++open_.samples;
  late_s_ = std::max(late_s_, deviation_s);
  early_s_ = std::max(early_s_, -deviation_s);
  if (open_.samples >= kBlockSamples && time_s - open_.begin_s >= kBlock_s) {
    closeBlock();
  }
}

void ImuClock::closeBlock() {
  if (open_.least_s > late_limit_ * period_s_ + early_s_) {  // all of it: samples were lost among scattered stamps
    const double late = std::round(open_.least_s / period_s_);
    index_ += late;
    line_s_ += late * period_s_;
    faults_.lost += static_cast<std::uint64_t>(late);
    open_.index += late;
    open_.least_s -= late * period_s_;
    open_.greatest_s -= late * period_s_;
  }
  blocks_[block_count_++ % kBlocks] = open_;
  open_ = Block();
  refit();
}

/// Collects the first second, for a first line.
void ImuClock::beginToFollow(double time_s) {
  if (!usual_.isKnown()) {
    return;
  }
  first_s_.push_back(time_s);
  if (first_s_.size() < 2 * kBlockSamples || time_s - first_s_.front() < 2.0 * kBlock_s) {
    return;
  }
  LineFit all;
  for (std::size_t i = 0; i < first_s_.size(); ++i) {
    all.add(static_cast<double>(i), first_s_[i]);
  }
  const double pace_s = all.line().period_s;
  if (std::abs(pace_s - usual_.value()) > kSamePace * usual_.value()) {
    first_s_.erase(first_s_.begin(), first_s_.begin() + static_cast<std::ptrdiff_t>(first_s_.size() / 2));
    return;
  }
  double earliest_s = first_s_.front();
  for (std::size_t i = 0; i < first_s_.size(); ++i) {
    earliest_s = std::min(earliest_s, first_s_[i] - pace_s * static_cast<double>(i));
  }
  target_.reset();
  block_count_ = 0;
  open_ = Block();
  late_s_ = early_s_ = 0.0;
  period_s_ = pace_s;
  index_ = -1.0;
  for (const double first_s : first_s_) {
    index_ += 1.0;
    learn(first_s, first_s - pace_s * index_ - earliest_s);
  }
  following_ = target_.has_value();
  if (following_) {
    line_s_ = target_->time_s + target_->period_s * index_;
    first_s_.clear();
  }
}

void ImuClock::refit() {
  if (std::abs(usual_.value() - period_s_) > kNewPace * period_s_) {  // another rate
    following_ = false;
    target_.reset();
    return;
  }
  late_s_ = greatestLateness();
  early_s_ = greatestEarliness();
  faults_.scatter_s = 0.5 * (late_s_ + early_s_);
  if (block_count_ < 2) {
    return;
  }
  LineFit earliest;
  for (std::size_t i = 0; i < std::min(block_count_, kBlocks); ++i) {
    earliest.add(blocks_[i].index, blocks_[i].time_s);
  }
  target_ = earliest.line();
  period_s_ = target_->period_s;
}

double ImuClock::greatestLateness() const {
  double greatest = 0.0;
  for (std::size_t i = 0; i < std::min(block_count_, kBlocks); ++i) {
    greatest = std::max(greatest, blocks_[i].greatest_s);
  }
  return greatest;
}

double ImuClock::greatestEarliness() const {
  double greatest = 0.0;
  for (std::size_t i = 0; i < std::min(block_count_, kBlocks); ++i) {
    greatest = std::max(greatest, -blocks_[i].least_s);
  }
  return greatest;
}

}  // namespace slipnav
