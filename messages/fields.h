// The fields that messages share, both ways; reading checks each one and remembers what was wrong first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/clamped_spline.h"
#include "core/world/header.h"
#include "core/world/health.h"
#include "core/world/message_limits.h"
#include "tern_msgs/batch_t.hpp"
#include "tern_msgs/header_t.hpp"
#include "tern_msgs/message_name_t.hpp"
#include "tern_msgs/motion_t.hpp"
#include "tern_msgs/vec3_t.hpp"

namespace tern::wire {

/// The least number of an open range (0, …].
inline constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The largest double: a range up to it takes every finite number.
inline constexpr double kMaxNumber = std::numeric_limits<double>::max();
inline constexpr std::int64_t kMaxCounter = std::numeric_limits<std::int64_t>::max();

tern_msgs::vec3_t to_lcm(const Vec3& v);
tern_msgs::message_name_t to_lcm(const MessageName& name);
tern_msgs::header_t to_lcm(const Header& header);
tern_msgs::batch_t to_lcm(const BatchHeader& batch);
tern_msgs::motion_t to_lcm(const MotionSample& motion);
std::vector<tern_msgs::vec3_t> to_lcm(const Points& points);
void append(std::vector<std::uint8_t>& bytes, std::string_view text);
std::vector<std::uint8_t> to_lcm(std::string_view text);

/// An enumeration or a bool as a message carries it.
template <class Enum>
std::int8_t to_int8(Enum value) {
  return static_cast<std::int8_t>(value);
}

/// Hands out a flat array in pieces, one after the other.
template <class E>
class Slices {
 public:
  explicit Slices(const std::vector<E>& all) : rest_(all) {}

  /// The next n elements; fewer when there are no more, which complete() then says.
  std::span<const E> take(std::size_t n) {
    overrun_ = overrun_ || n > rest_.size();
    const std::span<const E> slice = rest_.first(std::min(n, rest_.size()));
    rest_ = rest_.subspan(slice.size());
    return slice;
  }

  /// True when exactly all elements were taken.
  [[nodiscard]] bool complete() const { return !overrun_ && rest_.empty(); }

 private:
  std::span<const E> rest_;
  bool overrun_ = false;
};

/// UTF-8 without control characters but tab and newline (U+0000 … U+001F, U+007F): safe to print and to put into JSON.
bool is_plain_text(std::string_view text);

/// Reads fields. A refused number, time or enumeration reads as the least legal one, so that later arithmetic is safe.
/// In the end accept() refuses the message, with the reason that comes first in the order of codec.h, whatever the
/// order of reading.
class FieldReader {
 public:
  /// low ≤ x ≤ high; never NaN. Number.
  double number(double x, double low, double high);
  template <class Integer>
  Integer integer(Integer x, Integer low, Integer high) {
    return note(low <= x && x <= high, Rejection::Number) ? x : low;
  }
  std::int64_t counter(std::int64_t x) { return integer<std::int64_t>(x, 0, kMaxCounter); }
  /// Each component within [low, high].
  Vec3 vec3(const tern_msgs::vec3_t& v, double low, double high);
  Vec3 position(const tern_msgs::vec3_t& v) { return vec3(v, -kMaxCoordinate, kMaxCoordinate); }
  Vec3 extents(const tern_msgs::vec3_t& v) { return vec3(v, 0.0, kMaxCoordinate); }
  /// A column for each, components within ±limit.
  Points points(const std::vector<tern_msgs::vec3_t>& list, double limit);
  MotionSample motion(const tern_msgs::motion_t& m);
  /// Enumerators count from 0 to `last`.
  template <class Enum>
  Enum enumeration(std::int8_t x, Enum last) {
    return static_cast<Enum>(note(0 <= x && x <= to_int8(last), Rejection::Enumeration) ? x : std::int8_t{0});
  }
  bool flag(std::int8_t x) { return note(x == 0 || x == 1, Rejection::Enumeration) && x == 1; }
  UTime time(std::int64_t us);
  Duration duration(std::int64_t us, Duration low, Duration high);
  /// Plain text; Number when a byte is not.
  std::string text(std::span<const std::uint8_t> bytes);
  MessageName name(const tern_msgs::message_name_t& n);
  Header header(const tern_msgs::header_t& h);
  BatchHeader batch(const tern_msgs::batch_t& b);
  /// Rules between fields.
  bool in_order(bool ok) { return note(ok, Rejection::Time); }
  bool consistent(bool ok) { return note(ok, Rejection::Inconsistent); }

  /// True while nothing was refused.
  [[nodiscard]] bool ok() const { return !refused_; }
  /// The value, or the first reason against it.
  template <class T>
  [[nodiscard]] tl::expected<T, Rejection> accept(T value) const {
    if (refused_) return tl::make_unexpected(*refused_);
    return value;
  }

 private:
  bool note(bool ok, Rejection reason) {
    if (!ok) refused_ = std::min(reason, refused_.value_or(reason));
    return ok;
  }

  std::optional<Rejection> refused_;
};

/// True when the values are strictly ascending once sorted: none occurs twice.
bool all_different(std::vector<std::int64_t> values);

}  // namespace tern::wire
