// A grey image as values.
#pragma once

#include <cstdint>
#include <vector>

namespace tern {

/// An image of 8-bit grey values. @invariant pixels.size() == width·height
struct GrayImage {
  int width = 0;                     ///< pixels per row
  int height = 0;                    ///< rows
  std::vector<std::uint8_t> pixels;  ///< row by row, from the top left; 0 is black

  friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

}  // namespace tern
