// A 64-bit digest of bytes (FNV-1a). It names map versions and configurations; it gives no protection against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tern {

inline constexpr std::uint64_t kDigestSeed = 0xcbf29ce484222325ULL;

/// Returns the FNV-1a digest of `bytes`. A digest over several texts is made by passing the last one as the next
/// `seed`.
constexpr std::uint64_t digest(std::string_view bytes, std::uint64_t seed = kDigestSeed) {
  std::uint64_t h = seed;
  for (const char c : bytes) {
    h ^= static_cast<unsigned char>(c);
    h *= 0x100000001b3ULL;
  }
  return h;
}

}  // namespace tern
