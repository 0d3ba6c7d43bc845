// The layout of every message: the fingerprint, all counts at fixed offsets, fixed fields, flat arrays.
//
// The exact length of a message therefore follows from its first bytes, and it is checked before a generated decoder
// runs. (With a hostile count, generated decoders throw or read beyond their buffer.) A message states its arrays
// once, as a Layout.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <tl/expected.hpp>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/wire/header.h"
#include "core/wire/health.h"
#include "messages/codec.h"
#include "messages/trailer.h"

namespace tern::wire {

inline constexpr std::size_t kFingerprintBytes = 8;
inline constexpr std::size_t kCountBytes = 4;

/// Returns the big-endian integer at `offset`. @pre it lies within `bytes`
template <class Integer>
Integer read_integer(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::make_unsigned_t<Integer> x = 0;
  for (const std::uint8_t byte : bytes.subspan(offset, sizeof(Integer))) {
    x = static_cast<std::make_unsigned_t<Integer>>(static_cast<std::uint64_t>(x) << 8U | byte);
  }
  return static_cast<Integer>(x);
}

/// One array of the generated type M, and its count.
template <class M, class E>
struct Array {
  std::int32_t M::*count;
  std::vector<E> M::*items;
  std::int32_t min_count, max_count;  ///< legal counts

  /// Returns the size of one element on the wire, bytes.
  static std::size_t element_bytes() {
    if constexpr (std::is_class_v<E>) {
      return static_cast<std::size_t>(E{}._getEncodedSizeNoHash());
    } else {
      return sizeof(E);
    }
  }
};
template <class M, class E>
Array(std::int32_t M::*, std::vector<E> M::*, std::int32_t, std::int32_t) -> Array<M, E>;

/// All arrays of M, in the order in which M declares their counts (at its start) and the arrays (at its end).
template <class M, class... E>
struct Layout {
  std::tuple<Array<M, E>...> arrays;

  constexpr explicit Layout(Array<M, E>... of) : arrays(of...) {}

  /// Calls visit(array) for each array.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const auto&... array) { (visit(array), ...); }, arrays);
  }

  /// Returns the size of fingerprint and counts, bytes.
  static constexpr std::size_t head_bytes() { return kFingerprintBytes + kCountBytes * sizeof...(E); }
};

/// Sets the counts from the arrays' sizes and encodes the message.
/// @throws std::invalid_argument if a count is out of its range or the message is longer than kMaxMessageBytes
template <class M, class... E>
Bytes encode(M message, const Layout<M, E...>& layout) {
  layout.for_each([&](const auto& array) {
    const std::size_t n = (message.*array.items).size();
    if (n < static_cast<std::size_t>(array.min_count) || n > static_cast<std::size_t>(array.max_count)) {
      throw std::invalid_argument(std::string(M::getTypeName()) + ": an array of " + std::to_string(n) +
                                  ", legal are " + std::to_string(array.min_count) + " to " +
                                  std::to_string(array.max_count));
    }
    message.*array.count = static_cast<std::int32_t>(n);
  });
  const int size = message.getEncodedSize();
  if (size > kMaxMessageBytes) {
    throw std::invalid_argument(std::string(M::getTypeName()) + ": " + std::to_string(size) + " bytes, at most " +
                                std::to_string(kMaxMessageBytes) + " are sent");
  }
  Bytes bytes(static_cast<std::size_t>(size));
  message.encode(bytes.data(), 0, size);
  return bytes;
}

/// Returns the size of the message at the start of `bytes`, from its fingerprint and its counts: all bytes, or all but
/// one trailer. If the bytes cannot be an M, returns the reason. Allocates an empty message only.
template <class M, class... E>
tl::expected<std::size_t, Rejection> message_bytes(std::span<const std::uint8_t> bytes, const Layout<M, E...>& layout) {
  if (bytes.size() < kFingerprintBytes) return tl::make_unexpected(Rejection::Length);
  if (read_integer<std::int64_t>(bytes, 0) != M::getHash()) return tl::make_unexpected(Rejection::Fingerprint);
  if (bytes.size() < layout.head_bytes()) return tl::make_unexpected(Rejection::Length);
  std::size_t offset = kFingerprintBytes;
  auto expected_bytes = static_cast<std::size_t>(M{}.getEncodedSize());
  bool counts_legal = true;
  layout.for_each([&](const auto& array) {
    const auto count = read_integer<std::int32_t>(bytes, offset);
    offset += kCountBytes;
    counts_legal = counts_legal && count >= array.min_count && count <= array.max_count;
    if (counts_legal) expected_bytes += static_cast<std::size_t>(count) * array.element_bytes();
  });
  if (!counts_legal) return tl::make_unexpected(Rejection::Count);
  const bool has_trailer = bytes.size() == expected_bytes + kTrailerBytes && read_trailer(bytes);
  if ((bytes.size() != expected_bytes && !has_trailer) || expected_bytes > kMaxMessageBytes) {
    return tl::make_unexpected(Rejection::Length);
  }
  return expected_bytes;
}

}  // namespace tern::wire
