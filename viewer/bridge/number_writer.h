// Collects the numbers of messages for charts. It has the interface of JsonWriter, so both are written by the same
// code.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// The numbers of messages by channel and field: {"PLAN_TIMING.total_ms", 12.5}, …
using NumberFields = std::vector<std::pair<std::string, double>>;

/// Collects numbers and flags (0 or 1). A vector becomes three fields, which end in ".x", ".y" and ".z". The text of
/// the key "channel" begins the names of the fields after it; other texts and times in µs (keys that end in "_us") are
/// skipped. Infinite values become NaN.
class NumberWriter {
 public:
  NumberWriter& begin_object() { return *this; }
  NumberWriter& end_object() { return *this; }
  NumberWriter& key(std::string_view name) {
    key_ = name;
    return *this;
  }
  NumberWriter& number(double x) { return add("", x); }
  NumberWriter& integer(std::int64_t x) { return key_.ends_with("_us") ? *this : add("", static_cast<double>(x)); }
  NumberWriter& flag(bool x) { return add("", x ? 1.0 : 0.0); }
  NumberWriter& text(std::string_view utf8) {
    if (key_ == "channel") channel_ = utf8;
    return *this;
  }
  NumberWriter& vec3(const Vec3& p) { return add(".x", p.x()).add(".y", p.y()).add(".z", p.z()); }
  [[nodiscard]] NumberFields take() { return std::move(fields_); }

 private:
  NumberWriter& add(const char* axis, double x) {
    fields_.emplace_back(channel_ + '.' + key_ + axis, std::isfinite(x) ? x : std::numeric_limits<double>::quiet_NaN());
    return *this;
  }

  std::string channel_, key_;
  NumberFields fields_;
};

}  // namespace tern
