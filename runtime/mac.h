// Keyed BLAKE2b (RFC 7693) and SHA-256: the one door to libsodium.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "messages/trailer.h"

namespace tern {

inline constexpr std::size_t kKeyBytes = 32;

/// A secret. Its memory is overwritten when it ends.
class Key {
 public:
  /// @pre kKeyBytes of them
  explicit Key(std::span<const std::uint8_t> bytes);
  Key(const Key&) = default;
  Key& operator=(const Key&) = default;
  ~Key();
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }
  friend bool operator==(const Key&, const Key&) = default;

 private:
  std::array<std::uint8_t, kKeyBytes> bytes_ = {};
};

/// From the kernel's random numbers. Like all that makes keys and tags: @throws std::runtime_error when libsodium
/// cannot start.
Key random_key();

/// BLAKE2b of `label`, 32 bytes, under `master`: who has it can find neither the master nor another label's key.
Key derive_key(const Key& master, std::string_view label);

/// The tag of a message: BLAKE2b, 16 bytes, under `key`. It covers the channel's name on the wire, after one byte with
/// its length, and `signed_bytes`, the message with its trailer's head. Time grows with the length, 1 µs per kB.
/// @pre wire_name has at most 255 bytes
Tag make_tag(const Key& key, std::string_view wire_name, std::span<const std::uint8_t> signed_bytes);

/// Whether both are equal, in a time that does not depend on where they differ.
bool equal_tags(const Tag& a, const Tag& b);

/// SHA-256 (FIPS 180-4), which MAVLink's signatures ask for.
std::array<std::uint8_t, 32> sha256(std::span<const std::uint8_t> bytes);

/// Overwrites memory that held a secret; never optimized away.
void wipe(std::span<std::uint8_t> bytes);

}  // namespace tern
