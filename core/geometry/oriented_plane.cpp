#include "core/geometry/oriented_plane.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>

namespace tern {
namespace {

using Int128 = __int128;
using Coordinates = std::array<double, 12>;

constexpr int kMantissaBits = 52;
constexpr std::int64_t kInfiniteExponent = 0x7ff;
// 53 bits shifted by this stay below 2⁶¹, their differences below 2⁶², 2×2 minors below 2¹²⁵ and the determinant below
// 2¹⁸⁹.
constexpr std::int64_t kMaxShift = 8;

std::int64_t exponent_of(double x) {
  return static_cast<std::int64_t>((std::bit_cast<std::uint64_t>(x) >> kMantissaBits) & 0x7ffU);
}

// Returns the coordinates in units of the last bit of the smallest one; nullopt if they differ too much in size.
std::optional<std::array<std::int64_t, 12>> integers(const Coordinates& coordinates) {
  std::int64_t least = kInfiniteExponent;
  std::int64_t greatest = 0;
  for (const double x : coordinates) {
    if (x == 0.0) continue;
    least = std::min(least, exponent_of(x));
    greatest = std::max(greatest, exponent_of(x));
  }
  if (least == 0 || greatest - least > kMaxShift) return std::nullopt;
  std::array<std::int64_t, 12> result{};
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    if (coordinates[k] == 0.0) continue;
    const auto bits = std::bit_cast<std::uint64_t>(coordinates[k]);
    constexpr std::uint64_t kImplicit = std::uint64_t{1} << kMantissaBits;
    const auto mantissa = static_cast<std::int64_t>((bits & (kImplicit - 1)) | kImplicit);
    const std::int64_t magnitude = mantissa << (exponent_of(coordinates[k]) - least);
    result[k] = std::signbit(coordinates[k]) ? -magnitude : magnitude;
  }
  return result;
}

Int128 minor(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) { return Int128{a} * d - Int128{b} * c; }

// The sum of three products of 126 and 62 bits: high · 2⁶⁴ + low.
class Sum192 {
 public:
  void add_product(Int128 a, std::int64_t b) {
    const Int128 low = Int128{static_cast<std::uint64_t>(a)} * b;
    high_ += (a >> 64) * b + (low >> 64);
    const std::uint64_t before = low_;
    low_ += static_cast<std::uint64_t>(low);
    if (low_ < before) ++high_;
  }
  [[nodiscard]] CGAL::Sign sign() const {
    if (high_ < 0) return CGAL::NEGATIVE;
    return high_ == 0 && low_ == 0 ? CGAL::ZERO : CGAL::POSITIVE;
  }

 private:
  Int128 high_ = 0;
  std::uint64_t low_ = 0;
};

}  // namespace

CGAL::Sign OrientedPlane::side_in_doubt(const HullPoint& s) const {
  const auto x =
      integers({p_.x(), p_.y(), p_.z(), q_.x(), q_.y(), q_.z(), r_.x(), r_.y(), r_.z(), s.x(), s.y(), s.z()});
  if (!x) return CGAL::orientation(p_, q_, r_, s);
  const auto difference = [&x](std::size_t point, std::size_t axis) { return (*x)[3 * point + axis] - (*x)[axis]; };
  const std::int64_t ux = difference(1, 0), uy = difference(1, 1), uz = difference(1, 2);
  const std::int64_t vx = difference(2, 0), vy = difference(2, 1), vz = difference(2, 2);
  Sum192 det;
  det.add_product(minor(uy, uz, vy, vz), difference(3, 0));
  det.add_product(minor(uz, ux, vz, vx), difference(3, 1));
  det.add_product(minor(ux, uy, vx, vy), difference(3, 2));
  return det.sign();
}

}  // namespace tern
