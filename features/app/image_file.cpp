#include "features/app/image_file.h"

#include <opencv2/imgcodecs.hpp>

namespace tern {

Result<GrayImage> read_gray_image(const std::string& file) {
  cv::Mat image;
  try {
    image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception& e) {  // a header that asks for too many pixels
    return fail(file + ": " + e.err);
  }
  if (image.empty()) return fail(file + ": missing, or no image");
  return GrayImage{image.cols, image.rows, {image.begin<std::uint8_t>(), image.end<std::uint8_t>()}};
}

}  // namespace tern
