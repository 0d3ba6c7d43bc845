// A 64-bit digest (FNV-1a) of bytes: names a map version or a configuration; not a defence against an adversary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tern {

inline constexpr std::uint64_t kDigestSeed = 0xcbf29ce484222325ULL;

/// FNV-1a over `size` bytes, continued from `seed`.
constexpr std::uint64_t digest(std::string_view bytes, std::uint64_t seed = kDigestSeed) {
  std::uint64_t h = seed;
  for (const char c : bytes) {
    h ^= static_cast<unsigned char>(c);
    h *= 0x100000001b3ULL;
  }
  return h;
}

}  // namespace tern
