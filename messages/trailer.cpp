#include "messages/trailer.h"

#include <algorithm>

#include "messages/wire.h"

namespace tern {
namespace {

constexpr std::uint8_t kMagic[] = {'T', 'M', 'A', 'C', 1};
constexpr std::size_t kRoleAt = sizeof(kMagic);
constexpr std::size_t kEpochAt = 8, kSequenceAt = 16, kTimeAt = 24;

void append_integer(Bytes& bytes, std::int64_t value) {
  for (int shift = 56; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> static_cast<unsigned>(shift)));
  }
}

}  // namespace

std::optional<Trailer> read_trailer(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kTrailerBytes) return std::nullopt;
  const auto trailer = bytes.last(kTrailerBytes);
  const bool is_one = std::equal(std::begin(kMagic), std::end(kMagic), trailer.begin()) && trailer[kRoleAt + 1] == 0 &&
                      trailer[kRoleAt + 2] == 0;
  if (!is_one) return std::nullopt;
  Trailer read;
  read.role = trailer[kRoleAt];
  read.name = {wire::read_integer<std::int64_t>(trailer, kEpochAt),
               wire::read_integer<std::int64_t>(trailer, kSequenceAt)};
  read.utime = UTime{wire::read_integer<std::int64_t>(trailer, kTimeAt)};
  std::copy_n(trailer.begin() + kTrailerHeadBytes, kTagBytes, read.tag.begin());
  return read;
}

void append_trailer_head(Bytes& bytes, const Trailer& trailer) {
  bytes.reserve(bytes.size() + kTrailerBytes);
  bytes.insert(bytes.end(), std::begin(kMagic), std::end(kMagic));
  bytes.insert(bytes.end(), {trailer.role, 0, 0});
  append_integer(bytes, trailer.name.sender_epoch_us);
  append_integer(bytes, trailer.name.sequence);
  append_integer(bytes, trailer.utime.us);
}

}  // namespace tern
