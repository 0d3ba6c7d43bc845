// Where the rays of a picture enter and leave a box.
#pragma once

#include <algorithm>
#include <optional>

#include "core/base/types.h"
#include "perception/depth_picture.h"

namespace tern {

/// Pixels first_column … last_column (modulo the number of columns) of rows first_row … last_row.
struct PixelRectangle {
  int first_column, last_column, first_row, last_row;
};

/// Returns a rectangle of pixels. It contains every pixel whose ray meets the box within the range. nullopt: no ray
/// does.
std::optional<PixelRectangle> pixels_around(const DepthPicture& picture, const Box& box);

/// The slab method for all rays of a picture. Prepared once per pose; memory is kept.
class SlabTest {
 public:
  void prepare(const DepthPicture& picture);

  /// Calls visit(first pixel, count, enter, leave) for rows of pixels around a box. Ray k meets the box between the
  /// depths enter[k] and leave[k] if enter[k] ≤ leave[k] and leave[k] ≥ 0. @pre prepare(picture)
  template <class Visit>
  void visit(const DepthPicture& picture, const Box& box, Visit&& visit);

 private:
  /// Computes enter_ and leave_ of `count` pixels for a box relative to the sensor.
  void test(int first_pixel, int count, const Eigen::Array3f& low, const Eigen::Array3f& high);

  Eigen::ArrayX3f inverse_;  ///< 1 / ray, axes of W
  Eigen::ArrayXf enter_, leave_;
};

template <class Visit>
void SlabTest::visit(const DepthPicture& picture, const Box& box, Visit&& visit) {
  const std::optional<PixelRectangle> around = pixels_around(picture, box);
  if (!around) return;
  const Eigen::Array3f low = (box.min() - picture.pose().position).cast<float>();
  const Eigen::Array3f high = (box.max() - picture.pose().position).cast<float>();
  const int columns = picture.shape().columns;
  for (int v = around->first_row; v <= around->last_row; ++v) {
    for (int u = around->first_column; u <= around->last_column;) {
      const int from = ((u % columns) + columns) % columns;
      const int count = std::min(columns - from, around->last_column - u + 1);
      test(v * columns + from, count, low, high);
      visit(v * columns + from, count, enter_.data(), leave_.data());
      u += count;
    }
  }
}

}  // namespace tern
