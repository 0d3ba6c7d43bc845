// Grey images from files.
#pragma once

#include <string>

#include "core/base/result.h"
#include "features/gray_image.h"

namespace tern {

/// Reads an image of any format and depth that OpenCV reads, as 8-bit grey values.
Result<GrayImage> read_gray_image(const std::string& file);

}  // namespace tern
