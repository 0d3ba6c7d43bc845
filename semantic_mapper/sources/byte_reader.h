// Reads numbers of either byte order from a file's bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace tern {

/// Returns the number at `offset`, stored in byte order `order`. @pre offset + sizeof(T) ≤ bytes.size()
template <class T>
T read_number(std::span<const std::uint8_t> bytes, std::size_t offset, std::endian order = std::endian::little) {
  static_assert(std::is_arithmetic_v<T>);
  std::uint8_t raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[i] = bytes[offset + (order == std::endian::native ? i : sizeof(T) - 1 - i)];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

}  // namespace tern
