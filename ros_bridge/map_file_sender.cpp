#include "ros_bridge/map_file_sender.h"

#include <algorithm>
#include <utility>

namespace tern::ros {

const MapFile* MapFileSender::due(UTime now) {
  constexpr std::int64_t kHeadBytes = 100;
  if (at_ == 0 && newest_) {
    sent_ = *std::exchange(newest_, std::nullopt);
    next_ = earliest_;
  }
  if (sent_.empty() || now < next_) return nullptr;
  if (at_ == 0) began_ = now;
  const MapFile& part = sent_[at_];
  const std::int64_t bytes = kHeadBytes + std::ssize(part.bytes);
  earliest_ = now + Duration{bytes * 1'000'000 / kMapFileBytesPerSecond};
  at_ = (at_ + 1) % sent_.size();
  next_ = at_ == 0 ? std::max(earliest_, began_ + kMapFilePeriod) : earliest_;
  return &part;
}

}  // namespace tern::ros
