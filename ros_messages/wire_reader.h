// Reads LCM's encoding value by value, as a definition (message_types.h) names them.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>

namespace tern::ros {

/// Big-endian values, one after the other, behind the fingerprint.
class WireReader {
 public:
  explicit WireReader(std::span<const std::uint8_t> bytes) : rest_(bytes) { take(kFingerprintBytes); }

  /// @throws std::out_of_range if fewer bytes are left
  std::span<const std::uint8_t> take(std::size_t n) {
    if (n > rest_.size()) throw std::out_of_range("a message ends before its fields do");
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }
  std::uint64_t unsigned_integer(std::size_t n) {
    std::uint64_t x = 0;
    for (const std::uint8_t byte : take(n)) x = x << 8U | byte;
    return x;
  }

 private:
  static constexpr std::size_t kFingerprintBytes = 8;
  std::span<const std::uint8_t> rest_;
};

}  // namespace tern::ros
