// Whether a pair of images can be used.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "features/gray_image.h"

namespace tern {

/// A fault of a pair of images.
///
/// | trouble   | condition                                                | effect                              |
/// |-----------|----------------------------------------------------------|-------------------------------------|
/// | WrongSize | an image has another size than its calibration           | the pair is not used                |
/// | TimeBack  | the pair is as old as the last one, or older             | the pair is not used                |
/// | Repeated  | both images are equal to the last ones                   | the pair is not used                |
/// | Dark      | fewer than 1 % of an image's pixels are above kDarkest   | all tracks end; a frame without any |
/// | Saturated | fewer than 1 % of an image's pixels are below kBrightest | all tracks end; a frame without any |
enum class ImageTrouble : std::uint8_t { WrongSize, TimeBack, Repeated, Dark, Saturated };

inline constexpr std::uint8_t kDarkest = 16, kBrightest = 239;

/// Returns what is wrong and what to do, in words.
std::string to_text(ImageTrouble trouble);

/// Compares each pair of images with the calibration and with the pair before it.
class ImageCheck {
 public:
  /// Sizes of the images, pixels.
  struct Size {
    int width = 0, height = 0;
  };
  ImageCheck(Size left, Size right) : left_size_(left), right_size_(right) {}
  /// Returns the first trouble of the table that the pair has. A pair that is Repeated has still advanced the time.
  std::optional<ImageTrouble> check(UTime at, const GrayImage& left, const GrayImage& right);

 private:
  Size left_size_, right_size_;
  std::optional<UTime> newest_;
  GrayImage left_, right_;
};

}  // namespace tern
