// JSON for the page, written straight to text: thousands of numbers, thirty times a second.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/types.h"

namespace tern {

/// Writes one JSON value; commas are its own business, the nesting is the caller's. Numbers are rounded to 0.1 mm (or
/// their own 1e-4): what a screen shows; not finite ones become null.
class JsonWriter {
 public:
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_list();
  JsonWriter& end_list();
  JsonWriter& key(std::string_view name);  ///< escaped
  JsonWriter& number(double x);
  JsonWriter& integer(std::int64_t x);
  JsonWriter& flag(bool x);
  JsonWriter& text(std::string_view utf8);  ///< likewise
  JsonWriter& point(const Vec3& p);         ///< three numbers of the list that is open
  JsonWriter& points(const Points& p);      ///< likewise, one point after the other
  JsonWriter& vec3(const Vec3& p);          ///< [x, y, z]
  JsonWriter& raw(std::string_view json);   ///< a value that is JSON already
  [[nodiscard]] std::string take();

 private:
  void separate();
  std::string out_;
};

}  // namespace tern
