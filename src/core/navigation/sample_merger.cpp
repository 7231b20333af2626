#include "core/navigation/sample_merger.h"

#include <algorithm>
#include <type_traits>

namespace slipnav {
namespace {

constexpr std::size_t kMaxWaiting = 100000;  // while the IMU is silent

}  // namespace

void SampleMerger::push(const Sample& sample) {
  std::visit(
      [this](const auto& s) {
        using Kind = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<Kind, ImuSample>) {
          imu_.push(s, [this](const ImuSample& passed, Nanoseconds continuous) {
            const Instant instant = sessionOf(passed);
            Stream& stream = streams_.front();
            stream.waiting.push_back({instant, passed});
            newest_imu_ = stream.newest;
            offsets_.resize(instant.session + 1, continuous - instant.stamp);
          });
        } else {
          std::get<JumpFilter<Kind>>(filters_).push(s, [this](const Kind& passed) { insert(passed); });
        }
      },
      sample);
}

SampleMerger::Instant SampleMerger::sessionOf(const Sample& sample) {
  Instant& newest = streams_[sample.index()].newest;
  Instant instant{newest.session, stampOf(sample)};
  if (instant.stamp <= newest.stamp - kRestartBackstep) {
    newest = {instant.session + 1, instant.stamp};
    instant = newest;
  }
  newest = std::max(newest, instant);
  return instant;
}

void SampleMerger::insert(const Sample& sample) {
  const Instant instant = sessionOf(sample);
  Stream& stream = streams_[sample.index()];
  const auto later = [](const Instant& before, const Entry& entry) { return before < entry.instant; };
  stream.waiting.insert(std::upper_bound(stream.waiting.begin(), stream.waiting.end(), instant, later),
                        {instant, sample});
  if (stream.waiting.size() > kMaxWaiting) {
    stream.waiting.pop_front();
  }
}

SampleMerger::Stream* SampleMerger::earliest() {
  Stream* first = nullptr;
  // Of equal stamps the IMU sample is last: it closes the interval that contains the others.
  for (auto stream = streams_.rbegin(); stream != streams_.rend(); ++stream) {
    if (!stream->waiting.empty() &&
        (first == nullptr || stream->waiting.front().instant < first->waiting.front().instant)) {
      first = &*stream;
    }
  }
  return first;
}

bool SampleMerger::isCertain(const Instant& instant, const Instant& trusted) const {
  return trusted.session > instant.session ||
         (trusted.session == instant.session && trusted.stamp - instant.stamp >= max_wait_);
}

Nanoseconds SampleMerger::offsetAfter(std::size_t steps) const {
  return offsets_.empty() ? 0 : offsets_[std::min(steps, offsets_.size() - 1)];
}

void SampleMerger::release(Stream& stream, const Sink& sink) {
  Entry entry = stream.waiting.front();
  stream.waiting.pop_front();
  std::visit([offset = offsetAfter(entry.instant.session)](auto& sample) { sample.stamp += offset; }, entry.sample);
  sink(entry.sample);
}

void SampleMerger::advance(const Instant& trusted, const Sink& sink) {
  for (Stream* stream = earliest(); stream != nullptr && isCertain(stream->waiting.front().instant, trusted);
       stream = earliest()) {
    release(*stream, sink);
  }
}

void SampleMerger::flush(const Sink& sink) {
  for (Stream* stream = earliest(); stream != nullptr; stream = earliest()) {
    release(*stream, sink);
  }
}

std::uint64_t SampleMerger::leftOut() const {
  return imu_.leftOut() + std::apply([](const auto&... filter) { return (filter.leftOut() + ...); }, filters_);
}

}  // namespace slipnav
