// The form of every message: counts at fixed offsets right behind the fingerprint, then fixed fields, then flat arrays.
//
// So the exact length of a message follows from its first bytes, before a generated decoder sees it. Those throw, or
// wrap a hostile count and read beyond their buffer. A message states its arrays once, as a Layout, and encoder and
// decoder do the rest.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <tl/expected.hpp>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/world/header.h"
#include "core/world/health.h"
#include "messages/codec.h"
#include "messages/trailer.h"

namespace tern::wire {

inline constexpr std::size_t kFingerprintBytes = 8;
inline constexpr std::size_t kCountBytes = 4;

/// The big-endian integer at `offset`. @pre it lies within `bytes`.
template <class Integer>
Integer read_integer(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::make_unsigned_t<Integer> x = 0;
  for (const std::uint8_t byte : bytes.subspan(offset, sizeof(Integer))) {
    x = static_cast<std::make_unsigned_t<Integer>>(static_cast<std::uint64_t>(x) << 8U | byte);
  }
  return static_cast<Integer>(x);
}

/// One variable array of the generated type M and the count that rules it alone.
template <class M, class E>
struct Array {
  std::int32_t M::*count;
  std::vector<E> M::*items;
  std::int32_t min_count, max_count;  ///< legal counts

  /// Bytes of one element on the wire.
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

/// All arrays of M, in the order in which M declares their counts (first) and the arrays (last).
template <class M, class... E>
struct Layout {
  std::tuple<Array<M, E>...> arrays;

  constexpr explicit Layout(Array<M, E>... of) : arrays(of...) {}

  /// Calls visit(array) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const auto&... array) { (visit(array), ...); }, arrays);
  }

  /// Bytes up to the end of the counts.
  static constexpr std::size_t head_bytes() { return kFingerprintBytes + kCountBytes * sizeof...(E); }
};

/// Sets the counts from the arrays' sizes and encodes.
/// @throws std::invalid_argument when a count is out of its range or the whole is longer than kMaxMessageBytes.
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

/// How many of the bytes are an M, judged by fingerprint, counts and length: all, or all but one trailer. Or why they
/// cannot be one. Allocates nothing beyond an empty message.
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
