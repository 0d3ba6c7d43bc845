// Messages with one error, and the reason for which decode() refuses them.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "tests/messages/messages_under_test.h"
#include "tests/support/generators.h"

namespace tern {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr std::int64_t kFarFuture = std::numeric_limits<std::int64_t>::max();
inline constexpr std::int64_t kFarPast = std::numeric_limits<std::int64_t>::min();

/// A valid value with at least two elements in every array.
template <class T>
T rich_message() {
  Rng rng(6);
  for (;;) {
    auto value = support::random_message<T>(rng);
    const auto sizes = array_sizes(value);
    if (std::all_of(sizes.begin(), sizes.end(), [](std::int32_t n) { return n >= 2; })) return value;
  }
}

template <class T>
std::string verdict(const Bytes& bytes) {
  static constexpr const char* kNames[] = {"Length",      "Fingerprint", "Count",       "Number",
                                           "Enumeration", "Time",        "Inconsistent"};
  const auto decoded = decode<T>(bytes);
  return decoded ? "accepted" : kNames[static_cast<int>(decoded.error())];
}

/// Returns the reason for the refusal of a valid value that `spoil` has changed.
template <class T>
std::string after(const std::function<void(T&)>& spoil) {
  T value = rich_message<T>();
  spoil(value);
  return verdict<T>(encode(value));
}

/// The same for the generated type M, for errors that our own values cannot express.
template <class T, class M>
std::string after_on_wire(const std::function<void(M&)>& spoil) {
  Bytes bytes = encode(rich_message<T>());
  M message{};
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  spoil(message);
  bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return verdict<T>(bytes);
}

/// Returns the reason for the refusal of a message whose byte of a bool is 2. That byte is the one that differs
/// between true and false.
template <class T>
std::string after_flag_of_two(const std::function<void(T&, bool)>& set) {
  T value = rich_message<T>();
  set(value, false);
  Bytes bytes = encode(value);
  set(value, true);
  const Bytes other = encode(value);
  *std::mismatch(bytes.begin(), bytes.end(), other.begin()).first = 2;
  return verdict<T>(bytes);
}

}  // namespace tern
