#include "semantic_mapper/sources/lzf.h"

namespace tern {
namespace {

/// A repetition of three bytes gives at most 264: LZF's best ratio.
constexpr std::size_t kMaxRatio = 88;
/// A control byte below this one announces that many bytes and one more, copied from the stream.
constexpr std::size_t kFirstRepetition = 32;

}  // namespace

std::optional<std::vector<std::uint8_t>> lzf_decompress(std::span<const std::uint8_t> stream, std::size_t size) {
  if (size / kMaxRatio > stream.size()) return std::nullopt;
  std::vector<std::uint8_t> out;
  out.reserve(size);
  std::size_t at = 0;
  while (at < stream.size()) {
    const std::size_t control = stream[at++];
    if (control < kFirstRepetition) {
      const std::size_t length = control + 1;
      if (length > stream.size() - at || length > size - out.size()) return std::nullopt;
      const auto begin = stream.begin() + static_cast<std::ptrdiff_t>(at);
      out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
      at += length;
      continue;
    }
    // Three bits of length, more of it in the next byte if all are set; then 13 bits of distance.
    std::size_t length = (control >> 5) + 2;
    const bool is_long = control >> 5 == 7;
    if (stream.size() - at < (is_long ? 2u : 1u)) return std::nullopt;
    if (is_long) length += stream[at++];
    const std::size_t distance = ((control & 0x1f) << 8 | stream[at++]) + 1;
    if (distance > out.size() || length > size - out.size()) return std::nullopt;
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace tern
