// Reads geofences from plans of QGroundControl and from GeoJSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/world/fence.h"
#include "geodesy/local_frame.h"

namespace tern {

/// Reads the fences of a file, in latitude and longitude. Without fences the result is empty.
///
/// | name ends in    | fences                                                                                        |
/// |-----------------|-----------------------------------------------------------------------------------------------|
/// | .plan           | polygons and circles of `geoFence` (QGroundControl, "Plan File Format"), unbounded in height   |
/// | .geojson, .json | features whose property `fence` is inclusion or exclusion                                     |
///
/// A feature is a Polygon without holes, or a Point with `radius_m`. It may have `floor`, `ceiling` (m above the
/// origin) and `name`. Files may be hostile. An Error names `file`, the fence, value and limit.
Result<std::vector<Fence>> parse_fences(std::string_view text, const std::string& file);

/// Returns the fence in W. Corners and centre lie at the origin's height. @return an Error for coordinates that do not
/// exist on the earth. @pre fence.is_geodetic
Result<Fence> to_world(Fence fence, const LocalFrame& frame);

/// The largest file, bytes, and the most fences and corners.
inline constexpr std::size_t kMaxFenceBytes = 4'000'000;
inline constexpr std::size_t kMaxFencesOfFile = 1'000;
inline constexpr std::size_t kMaxFenceCorners = 1'000;
/// The largest radius of a circle, m.
inline constexpr double kMaxFenceRadius = 1e5;

}  // namespace tern
