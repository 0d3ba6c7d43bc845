// Writing and reading of message fields. Reading checks every field and remembers the first reason for a refusal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <type_traits>
#include <vector>

#include "core/base/plain_text.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/clamped_spline.h"
#include "core/wire/header.h"
#include "core/wire/health.h"
#include "core/wire/message_limits.h"
#include "tern_msgs/batch_t.hpp"
#include "tern_msgs/header_t.hpp"
#include "tern_msgs/message_name_t.hpp"
#include "tern_msgs/motion_t.hpp"
#include "tern_msgs/vec3_t.hpp"

namespace tern::wire {

/// The smallest number > 0: the lower end of a range (0, …].
inline constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The largest finite number: a range up to it accepts every finite number.
inline constexpr double kMaxNumber = std::numeric_limits<double>::max();
inline constexpr std::int64_t kMaxCounter = std::numeric_limits<std::int64_t>::max();

tern_msgs::vec3_t to_lcm(const Vec3& v);
tern_msgs::message_name_t to_lcm(const MessageName& name);
tern_msgs::header_t to_lcm(const Header& header);
tern_msgs::batch_t to_lcm(const BatchHeader& batch);
tern_msgs::motion_t to_lcm(const MotionSample& motion);
std::vector<tern_msgs::vec3_t> to_lcm(const Points& points);
void append(std::vector<std::uint8_t>& bytes, std::string_view text);

/// Returns an enumerator or a bool as a message carries it.
template <class Enum>
std::int8_t to_int8(Enum value) {
  return static_cast<std::int8_t>(value);
}

/// Writes fields. Its functions have the same names and arguments as those of FieldReader, so a message lists its
/// fields once for both directions. The arguments are the field's name, the field on the wire, the value and its range.
/// Name and range are not used.
class FieldWriter {
 public:
  template <class M, class T>
  void any(const char*, M& m, T x) {
    m = static_cast<M>(x);
  }
  void number(const char*, double& m, double x, double, double) { m = x; }
  template <class M, class Integer>
  void integer(const char*, M& m, Integer x, std::type_identity_t<Integer>, std::type_identity_t<Integer>) {
    m = static_cast<M>(x);
  }
  void counter(const char*, std::int64_t& m, std::int64_t x) { m = x; }
  void vec3(const char*, tern_msgs::vec3_t& m, const Vec3& x, double, double) { m = to_lcm(x); }
  void position(const char*, tern_msgs::vec3_t& m, const Vec3& x) { m = to_lcm(x); }
  void extents(const char*, tern_msgs::vec3_t& m, const Vec3& x) { m = to_lcm(x); }
  void points(const char*, std::vector<tern_msgs::vec3_t>& m, const Points& x, double) { m = to_lcm(x); }
  void motion(const char*, tern_msgs::motion_t& m, const MotionSample& x) { m = to_lcm(x); }
  template <class Enum>
  void enumeration(const char*, std::int8_t& m, Enum x, Enum) {
    m = to_int8(x);
  }
  void flag(const char*, std::int8_t& m, bool x) { m = to_int8(x); }
  void time(const char*, std::int64_t& m, UTime x) { m = x.us; }
  void duration(const char*, std::int64_t& m, Duration x, Duration, Duration) { m = x.us; }
  void text(const char*, std::vector<std::uint8_t>& m, std::string_view x) { m.assign(x.begin(), x.end()); }
  void name(const char*, tern_msgs::message_name_t& m, const MessageName& x) { m = to_lcm(x); }
  void header(const char*, tern_msgs::header_t& m, const Header& x) { m = to_lcm(x); }
  void batch(const char*, tern_msgs::batch_t& m, const BatchHeader& x) { m = to_lcm(x); }
  template <class M, class T, class Each>
  void list(const char*, std::vector<M>& m, const std::vector<T>& values, const Each& each) {
    for (const T& value : values) each(m.emplace_back(), value);
  }
  template <class M, class T, class Each>
  void list_of_placed(const char* name, std::vector<M>& m, const std::vector<T>& values, const Each& each) {
    list(name, m, values, each);
  }
};

/// Gives out a flat array in consecutive slices.
template <class E>
class Slices {
 public:
  explicit Slices(const std::vector<E>& all) : rest_(all) {}

  /// Returns the next n elements, or all that are left if there are fewer; complete() is false from then on.
  std::span<const E> take(std::size_t n) {
    overrun_ = overrun_ || n > rest_.size();
    const std::span<const E> slice = rest_.first(std::min(n, rest_.size()));
    rest_ = rest_.subspan(slice.size());
    return slice;
  }

  /// True if exactly all elements were taken.
  [[nodiscard]] bool complete() const { return !overrun_ && rest_.empty(); }

 private:
  std::span<const E> rest_;
  bool overrun_ = false;
};

/// Reads fields and checks them. A refused number, time or enumeration is read as its smallest legal value, so later
/// arithmetic is safe. At the end accept() refuses the message with the smallest Rejection noted, in whatever order
/// the fields were read.
class FieldReader {
 public:
  /// The functions of FieldWriter. Their arguments are the field's name, the field, its value and its range. `any`
  /// accepts every value; `list` calls each(element, value).
  template <class M, class T>
  void any(const char*, M m, T& x) {
    x = static_cast<T>(m);
  }
  void number(const char* name, double m, double& x, double low, double high) { x = named(name).number(m, low, high); }
  template <class M, class Integer>
  void integer(const char* name, M m, Integer& x, std::type_identity_t<Integer> low,
               std::type_identity_t<Integer> high) {
    static_assert(sizeof(M) <= sizeof(Integer));
    x = named(name).integer<Integer>(static_cast<Integer>(m), low, high);
  }
  void counter(const char* name, std::int64_t m, std::int64_t& x) { x = named(name).counter(m); }
  void vec3(const char* name, const tern_msgs::vec3_t& m, Vec3& x, double low, double high) {
    x = named(name).vec3(m, low, high);
  }
  void position(const char* name, const tern_msgs::vec3_t& m, Vec3& x) { x = named(name).position(m); }
  void extents(const char* name, const tern_msgs::vec3_t& m, Vec3& x) { x = named(name).extents(m); }
  /// Reads a column per point, with components in [−limit, limit].
  void points(const char* name, const std::vector<tern_msgs::vec3_t>& list, Points& x, double limit);
  void motion(const char* name, const tern_msgs::motion_t& m, MotionSample& x);
  /// Accepts the enumerators 0 … last.
  template <class Enum>
  void enumeration(const char* name, std::int8_t m, Enum& x, Enum last) {
    const bool ok = named(name).note(0 <= m && m <= to_int8(last), Rejection::Enumeration, m);
    x = static_cast<Enum>(ok ? m : std::int8_t{0});
  }
  void flag(const char* name, std::int8_t m, bool& x) { x = named(name).flag(m); }
  void time(const char* name, std::int64_t us, UTime& x);
  void duration(const char* name, std::int64_t m, Duration& x, Duration low, Duration high) {
    x = named(name).duration(m, low, high);
  }
  void text(const char* name, const std::vector<std::uint8_t>& m, std::string& x) { x = named(name).text(m); }
  void name(const char* name, const tern_msgs::message_name_t& m, MessageName& x);
  void header(const char* name, const tern_msgs::header_t& m, Header& x);
  void batch(const char* name, const tern_msgs::batch_t& m, BatchHeader& x);
  template <class M, class T, class Each>
  void list(const char* name, const std::vector<M>& m, std::vector<T>& values, const Each& each) {
    values.resize(m.size());
    for (std::size_t i = 0; i < m.size(); ++i) {
      enter(name, i);
      each(m[i], values[i]);
    }
    leave();
  }
  /// As list(), for elements with a `position`. An element whose position is refused is at no place: it is left out and
  /// counted, and the message may be accepted without it. If all are at no place, the message is refused.
  template <class M, class T, class Each>
  void list_of_placed(const char* name, const std::vector<M>& m, std::vector<T>& values, const Each& each) {
    values.reserve(m.size());
    for (std::size_t i = 0; i < m.size(); ++i) {
      enter(name, i);
      if (is_placed(m[i].position)) each(m[i], values.emplace_back());
    }
    left_out_ = static_cast<std::int32_t>(m.size() - values.size());
    if (values.empty() && left_out_ > 0) {
      enter(name, 0);
      each(m[0], values.emplace_back());
    }
    leave();
  }

  /// The fields that are read next are those of element `index` of a list, until leave().
  void enter(const char* list, std::size_t index) {
    list_ = list;
    index_ = index;
    name_ = "";
  }
  void leave() { list_ = name_ = ""; }
  /// The field that is read next.
  FieldReader& named(const char* name) {
    name_ = name;
    return *this;
  }

  /// Accepts low ≤ x ≤ high, and refuses NaN, with the reason Number.
  double number(double x, double low, double high, const char* part = "");
  template <class Integer>
  Integer integer(Integer x, Integer low, Integer high) {
    return note(low <= x && x <= high, Rejection::Number, x) ? x : low;
  }
  std::int64_t counter(std::int64_t x) { return integer<std::int64_t>(x, 0, kMaxCounter); }
  /// Accepts components in [low, high].
  Vec3 vec3(const tern_msgs::vec3_t& v, double low, double high);
  Vec3 position(const tern_msgs::vec3_t& v) { return vec3(v, -kMaxCoordinate, kMaxCoordinate); }
  Vec3 extents(const tern_msgs::vec3_t& v) { return vec3(v, 0.0, kMaxCoordinate); }
  bool flag(std::int8_t x) { return note(x == 0 || x == 1, Rejection::Enumeration, x) && x == 1; }
  Duration duration(std::int64_t us, Duration low, Duration high);
  /// Accepts plain text (is_plain_text()), and refuses other bytes with the reason Number.
  std::string text(std::span<const std::uint8_t> bytes);
  /// Notes whether a rule between fields holds.
  /// @param broken  in words, if it does not
  bool in_order(bool ok, const char* broken = "") { return note(ok, Rejection::Time, broken); }
  bool consistent(bool ok, const char* broken = "") { return note(ok, Rejection::Inconsistent, broken); }

  /// Refuses the message if a value occurs twice.
  /// @param broken  text of the refusal, as "two tracks have the id"; the value is appended
  void all_different(std::vector<std::int64_t> values, const char* broken);

  /// True if every field so far was accepted.
  [[nodiscard]] bool ok() const { return !refused_; }
  /// The field with the reason that accept() returns, and its value: "detections[1].position.x is nan"; or the broken
  /// rule. If the message is accepted, the field for which an element was left out. Empty if nothing was refused, or a
  /// field without a name.
  [[nodiscard]] const std::string& refused_field() const { return refused_ ? refused_field_ : left_out_field_; }
  /// The number of elements that were left out.
  [[nodiscard]] std::int32_t left_out() const { return left_out_; }
  /// Returns the value, or the reason for its refusal.
  template <class T>
  [[nodiscard]] tl::expected<T, Rejection> accept(T value) const {
    if (refused_) return tl::make_unexpected(*refused_);
    return value;
  }

 private:
  template <class Value>
  bool note(bool ok, Rejection reason, Value value, const char* part = "") {
    if (!ok && (!refused_ || reason < *refused_)) {
      refused_ = reason;
      if constexpr (std::is_same_v<Value, const char*>) {
        refused_field_ = value;
      } else if constexpr (std::is_floating_point_v<Value>) {
        describe(part, static_cast<double>(value));
      } else {
        describe(part, static_cast<std::int64_t>(value));
      }
    }
    return ok;
  }
  static constexpr std::size_t kNoIndex = std::numeric_limits<std::size_t>::max();
  [[nodiscard]] std::string field(const char* part) const;
  /// Whether the element that is being read has this position; notes the first one that has none.
  bool is_placed(const tern_msgs::vec3_t& position);
  void describe(const char* part, double value);
  void describe(const char* part, std::int64_t value);

  std::optional<Rejection> refused_;
  std::string refused_field_;
  std::string left_out_field_;
  std::int32_t left_out_ = 0;
  const char *list_ = "", *name_ = "";  // of the field that is being read
  std::size_t index_ = 0;
};

}  // namespace tern::wire
