// The side of a plane through three points on which a fourth point lies, exact and fast. This is a part of
// convex_hull.cpp; it includes CGAL.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace tern {

using HullKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using HullPoint = HullKernel::Point_3;

/// The plane through p, q, r. Its positive side is the one from which p, q, r turn counter-clockwise. Results are
/// exact for |coordinates| < 1e90.
///
/// Three methods are tried in turn:
/// 1. Doubles, if the result exceeds its rounding error.
/// 2. Integers of 192 bits, if the nonzero coordinates of the four points are within a factor 2⁸ of each other.
/// 3. CGAL's exact predicate, which takes microseconds.
///
/// The second one exists because the sides of a swept box are parallelograms up to rounding, so four points of a side
/// are almost coplanar.
class OrientedPlane {
 public:
  OrientedPlane() = default;
  OrientedPlane(const HullPoint& p, const HullPoint& q, const HullPoint& r) : p_(p), q_(q), r_(r) {
    const double ux = q.x() - p.x(), uy = q.y() - p.y(), uz = q.z() - p.z();
    const double vx = r.x() - p.x(), vy = r.y() - p.y(), vz = r.z() - p.z();
    nx_ = uy * vz - uz * vy;
    ny_ = uz * vx - ux * vz;
    nz_ = ux * vy - uy * vx;
    wx_ = larger(std::abs(ux), vx);
    wy_ = larger(std::abs(uy), vy);
    wz_ = larger(std::abs(uz), vz);
  }

  /// Returns the sign of det(q − p, r − p, s − p).
  [[nodiscard]] CGAL::Sign side(const HullPoint& s) const {
    const Height height = height_of(s);
    if (height.value > height.doubt) return CGAL::POSITIVE;
    if (height.value < -height.doubt) return CGAL::NEGATIVE;
    return side_in_doubt(s);
  }

  /// True if s is lower than t along the normal. If the heights of both points over the plane are within rounding error
  /// of zero, the comparison is exact. Otherwise the heights are compared as doubles.
  [[nodiscard]] bool is_lower(const HullPoint& s, const HullPoint& t) const {
    const Height a = height_of(s);
    const Height b = height_of(t);
    if (std::abs(a.value) > a.doubt || std::abs(b.value) > b.doubt) return a.value < b.value;
    const CGAL::Sign side_s = side_in_doubt(s);
    const CGAL::Sign side_t = side_in_doubt(t);
    if (side_s != side_t || side_s == CGAL::ZERO) return side_s < side_t;
    return HullKernel().less_signed_distance_to_plane_3_object()(p_, q_, r_, s, t);
  }

 private:
  struct Height {
    double value, doubt;
  };

  [[nodiscard]] Height height_of(const HullPoint& s) const {
    const double x = s.x() - p_.x(), y = s.y() - p_.y(), z = s.z() - p_.z();
    const double largest = larger(wx_, x) * larger(wy_, y) * larger(wz_, z);
    return {nx_ * x + ny_ * y + nz_ * z, kRounding * largest + kUnderflow};
  }
  static double larger(double w, double x) { return std::abs(x) > w ? std::abs(x) : w; }
  [[nodiscard]] CGAL::Sign side_in_doubt(const HullPoint& s) const;

  // The determinant has six products of three differences with eight roundings each; the bound is doubled.
  static constexpr double kRounding = 96 * 0x1.0p-53;
  // Products below this may have lost bits by underflow.
  static constexpr double kUnderflow = 1e-250;

  HullPoint p_, q_, r_;
  double nx_ = 0.0, ny_ = 0.0, nz_ = 0.0;  // (q − p) × (r − p)
  double wx_ = 0.0, wy_ = 0.0, wz_ = 0.0;  // the largest |difference| on each axis
};

}  // namespace tern
