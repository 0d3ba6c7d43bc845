// Writes JSON text directly: the page gets thousands of numbers, thirty times a second.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/types.h"

namespace tern {

/// Writes one JSON value. It inserts the commas; the caller is responsible for the nesting. Numbers are rounded to
/// 1e-4, 0.1 mm on the screen; infinite values and NaN become null.
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
  JsonWriter& text(std::string_view utf8);  ///< escaped
  JsonWriter& point(const Vec3& p);         ///< adds three numbers to the open list
  JsonWriter& points(const Points& p);      ///< adds three numbers per point to the open list
  JsonWriter& vec3(const Vec3& p);          ///< [x, y, z]
  JsonWriter& raw(std::string_view json);   ///< a value that is JSON already
  [[nodiscard]] std::string take();

 private:
  void separate();
  std::string out_;
};

}  // namespace tern
