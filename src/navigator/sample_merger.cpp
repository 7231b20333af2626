#include "slipnav/navigator/sample_merger.h"

#include <algorithm>

#include "slipnav/ins/imu_screen.h"

namespace slipnav {

void SampleMerger::push(const Sample& sample) {
  Stream& stream = streams_[sample.index()];
  Instant instant{stream.newest.session, stampOf(sample)};
  if (instant.stamp <= stream.newest.stamp - kRestartBackstep) {
    ++instant.session;
  }
  stream.waiting.push_back({instant, sample});
  stream.newest = std::max(stream.newest, instant);
  newest_ = std::max(newest_, instant);
}

SampleMerger::Stream* SampleMerger::earliest() {
  Stream* first = nullptr;
  // Of equal stamps the IMU sample is the last: it closes the interval that the others lie in.
  for (auto stream = streams_.rbegin(); stream != streams_.rend(); ++stream) {
    if (!stream->waiting.empty() &&
        (first == nullptr || stream->waiting.front().instant < first->waiting.front().instant)) {
      first = &*stream;
    }
  }
  return first;
}

bool SampleMerger::isCertain(const Entry& entry, const Instant& trusted) const {
  const bool silence_counts =
      trusted.session > entry.instant.session ||
      (trusted.session == entry.instant.session && trusted.stamp - entry.instant.stamp >= max_wait_);
  return silence_counts || std::none_of(streams_.begin(), streams_.end(), [&entry](const Stream& stream) {
           return stream.waiting.empty() && stream.newest < entry.instant;
         });
}

void SampleMerger::advance(const Instant& trusted, const Sink& sink) {
  for (Stream* stream = earliest(); stream != nullptr && isCertain(stream->waiting.front(), trusted);
       stream = earliest()) {
    const Sample sample = stream->waiting.front().sample;
    stream->waiting.pop_front();
    sink(sample);
  }
}

void SampleMerger::flush(const Sink& sink) {
  for (Stream* stream = earliest(); stream != nullptr; stream = earliest()) {
    const Sample sample = stream->waiting.front().sample;
    stream->waiting.pop_front();
    sink(sample);
  }
}

}  // namespace slipnav
