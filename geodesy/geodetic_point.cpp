#include <fmt/format.h>

#include <cmath>

#include "geodesy/local_frame.h"

namespace tern {

std::string why_not_on_earth(const GeodeticPoint& place) {
  const auto check = [](const char* name, double value, double limit) {
    return std::abs(value) <= limit ? "" : fmt::format("{} {} is out of range [{}, {}]", name, value, -limit, limit);
  };
  if (const std::string why = check("latitude", place.latitude, 90.0); !why.empty()) return why;
  if (const std::string why = check("longitude", place.longitude, 180.0); !why.empty()) return why;
  return check("height", place.height, kMaxGeodeticHeight);
}

}  // namespace tern
