// A place on the earth.
#pragma once

namespace tern {

/// A place by geodetic coordinates, on the ellipsoid of WGS84.
struct GeodeticPoint {
  double latitude = 0.0;   ///< degrees, −90 … 90, north positive
  double longitude = 0.0;  ///< degrees, −180 … 180, east positive
  double height = 0.0;     ///< m. Above the ellipsoid, or above mean sea level if all heights in use are
};

}  // namespace tern
