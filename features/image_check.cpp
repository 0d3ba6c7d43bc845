#include "features/image_check.h"

#include <algorithm>

namespace tern {
namespace {

bool has_size(const GrayImage& image, const ImageCheck::Size& size) {
  return image.width == size.width && image.height == size.height;
}

bool is_dark(const GrayImage& image) {
  return std::ranges::count_if(image.pixels, [](auto p) { return p > kDarkest; }) * 100 < std::ssize(image.pixels);
}

bool is_saturated(const GrayImage& image) {
  return std::ranges::count_if(image.pixels, [](auto p) { return p < kBrightest; }) * 100 < std::ssize(image.pixels);
}

}  // namespace

std::string to_text(ImageTrouble trouble) {
  switch (trouble) {
    case ImageTrouble::WrongSize: return "images have another size than the calibration: calibrate at this resolution";
    case ImageTrouble::TimeBack: return "images are not newer than those before them: their clock stepped back";
    case ImageTrouble::Repeated: return "images are equal to those before them: the camera is stuck";
    case ImageTrouble::Dark: return "an image is black: check lens cap, exposure and light";
    case ImageTrouble::Saturated: return "an image is white: reduce exposure or gain";
  }
  return "unknown";
}

std::optional<ImageTrouble> ImageCheck::check(UTime at, const GrayImage& left, const GrayImage& right) {
  if (!has_size(left, left_size_) || !has_size(right, right_size_)) return ImageTrouble::WrongSize;
  if (newest_ && at <= *newest_) return ImageTrouble::TimeBack;
  newest_ = at;
  // Black images are equal as well, and the camera may yet be alive.
  if (is_dark(left) || is_dark(right)) return ImageTrouble::Dark;
  if (is_saturated(left) || is_saturated(right)) return ImageTrouble::Saturated;
  if (left == left_ && right == right_) return ImageTrouble::Repeated;
  left_ = left;
  right_ = right;
  return std::nullopt;
}

}  // namespace tern
