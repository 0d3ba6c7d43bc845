// A calibrated camera: from a direction to a pixel and back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/types.h"

namespace tern {

/// The model of a lens, as OpenCV, Kalibr and EuRoC define it.
enum class LensModel : std::uint8_t {
  RadialTangential,  ///< coefficients k1, k2, p1, p2, k3
  Equidistant,       ///< coefficients k1, k2, k3, k4
};

/// A pinhole camera with a distorting lens. The camera looks along z, with x to the right and y down. The centre of the
/// top left pixel is (0, 0).
///
///     (u, v) = (fx x_d + cx, fy y_d + cy),   (x, y) = (X/Z, Y/Z),   r² = x² + y²,   θ = atan r
///     radial-tangential:  x_d = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), y_d alike
///     equidistant:        (x_d, y_d) = (x, y) θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸) / r
struct CameraModel {
  int width = 0, height = 0;                      ///< pixels
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< pixels; fx, fy > 0
  LensModel lens = LensModel::RadialTangential;
  std::array<double, 5> coefficients{};

  /// Returns the pixel of a direction, inside the image or not. nullopt: Z ≤ 0, or beyond the angle at which the model
  /// folds back.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(const Vec3& direction) const;
  /// Returns (x, y) of a pixel, by Newton's method. nullopt if it does not converge: the pixel has no direction.
  [[nodiscard]] std::optional<Eigen::Vector2d> coordinates_of(const Eigen::Vector2d& pixel) const;
};

}  // namespace tern
