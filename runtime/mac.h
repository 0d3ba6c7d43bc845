// Keyed BLAKE2b (RFC 7693) and SHA-256: the only use of libsodium.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "messages/trailer.h"

namespace tern {

inline constexpr std::size_t kKeyBytes = 32;

/// A secret key. Its memory is overwritten by the destructor.
class Key {
 public:
  /// @pre bytes.size() == kKeyBytes
  explicit Key(std::span<const std::uint8_t> bytes);
  Key(const Key&) = default;
  Key& operator=(const Key&) = default;
  ~Key();
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }
  friend bool operator==(const Key&, const Key&) = default;

 private:
  std::array<std::uint8_t, kKeyBytes> bytes_ = {};
};

/// A key from the kernel's random numbers. This function and all that make keys or tags throw std::runtime_error if
/// libsodium cannot start.
Key random_key();

/// BLAKE2b of `label`, 32 bytes, keyed with `master`. Its holder can compute neither the master nor the key of another
/// label.
Key derive_key(const Key& master, std::string_view label);

/// The tag of a message: BLAKE2b, 16 bytes, keyed with `key`. It covers the length of the channel's name on the wire
/// (one byte), that name, and `signed_bytes`. The latter is the message with the head of its trailer. Cost: 1 µs per
/// kB.
/// @pre wire_name has at most 255 bytes
Tag make_tag(const Key& key, std::string_view wire_name, std::span<const std::uint8_t> signed_bytes);

/// Whether both tags are equal. The time taken does not depend on where they differ.
bool equal_tags(const Tag& a, const Tag& b);

/// SHA-256 (FIPS 180-4), which MAVLink's signatures use.
std::array<std::uint8_t, 32> sha256(std::span<const std::uint8_t> bytes);

/// Overwrites memory that held a secret; the compiler cannot remove it.
void wipe(std::span<std::uint8_t> bytes);

}  // namespace tern
