// The frame W on the earth: east, north, up at an origin of known latitude, longitude and height.
#pragma once

#include <memory>
#include <string>

#include "core/base/geodetic_point.h"
#include "core/base/result.h"
#include "core/base/types.h"

namespace tern {

/// Converts between geodetic coordinates (WGS84) and W, the local Cartesian frame at `origin`: x east, y north, z up.
///
/// The conversion is exact to 1e-8 m (Karney, GeographicLib: geodetic → geocentric → rotation). The earth's curvature
/// is part of it: a place 5 km away at the origin's height has z = −2 m. All heights, that of the origin included, may
/// count from sea level in place of the ellipsoid. A difference of 50 m between both moves a place 5 km away by 4 cm.
class LocalFrame {
 public:
  /// @return an Error if a coordinate is out of range or not finite, or if Tern was built without GeographicLib
  static Result<LocalFrame> at(const GeodeticPoint& origin);

  /// Returns a place in W, m. The longitude is reduced to −180 … 180. @pre all finite, |latitude| ≤ 90
  [[nodiscard]] Vec3 to_world(const GeodeticPoint& place) const;
  /// Returns the geodetic coordinates of p (W, m).
  [[nodiscard]] GeodeticPoint from_world(const Vec3& p) const;
  [[nodiscard]] const GeodeticPoint& origin() const { return origin_; }

 private:
  struct Impl;
  LocalFrame(const GeodeticPoint& origin, std::shared_ptr<const Impl> impl);
  GeodeticPoint origin_;
  std::shared_ptr<const Impl> impl_;  // shared, since it never changes
};

/// Returns why these coordinates do not exist on the earth, such as "latitude 91 is out of range [-90, 90]"; "" if they
/// do.
std::string why_not_on_earth(const GeodeticPoint& place);

/// Largest height of a place above or below the ellipsoid, m.
inline constexpr double kMaxGeodeticHeight = 1e5;

}  // namespace tern
