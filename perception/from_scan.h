// Depth pictures of real sensors: from DEPTH_IMAGE and POINT_CLOUD.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/world/scan.h"
#include "perception/depth_picture.h"

namespace tern {

/// Larger images are reduced to at most this many columns. With a field of view of 85° a pixel is then 0.11 m wide at
/// 10 m. A cube of 0.35 m there has the kLeastPixels (detector.h) of a sighting.
inline constexpr int kMostColumns = 160;
/// Larger images are refused: more than a 1920 × 1080 image.
inline constexpr std::int64_t kMostImagePixels = 2'097'152;
/// So are images that stay larger than this when reduced: they are too narrow.
inline constexpr int kMostPicturePixels = 51'200;

/// Returns the picture of a depth image of `height` rows. Its rows may have come in several messages of one time;
/// missing rows count as not measured. With more than kMostColumns columns, blocks of equal size become one pixel: the
/// measured one that is nearest to the middle of the block.
/// @param parts   the messages of one image
/// @param noise   of the depths, per pixel of the image
/// @param least_range_m  nearer depths are not measured, for instance those of the vehicle's own body, ≥ 0
/// @return an Error that names the trouble, if
///   - there is no message, or messages are of different images;
///   - rows lie beyond the height, or the pixels are too many;
///   - the range is within least_range_m, or no pixel was measured
Result<DepthPicture> picture_of(std::span<const DepthImage> parts, int height, const DepthNoise& noise,
                                double least_range_m);

/// Returns the picture of a point cloud: 360 × 180 steps of one degree, each with its nearest point. Steps without a
/// point count as not measured: a cloud does not contain the rays without a return. Points that are more than a step
/// apart are not connected. Of a lidar whose rows are 2° apart, each row is a cluster of its own.
/// @return an Error as above
Result<DepthPicture> picture_of(std::span<const CloudScan> parts, const DepthNoise& noise, double least_range_m);

}  // namespace tern
