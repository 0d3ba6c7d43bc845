#include "core/geometry/oriented_plane.h"

namespace tern {
namespace {

// hi + lo, |lo| ≤ ulp(hi)/2 (Dekker 1971; Hida, Li, Bailey 2001).
struct Twofold {
  double hi = 0.0, lo = 0.0;
};

Twofold normalised(double hi, double lo) {
  const double sum = hi + lo;
  return {sum, lo - (sum - hi)};
}

Twofold exact_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

Twofold operator-(const Twofold& a) { return {-a.hi, -a.lo}; }

Twofold operator+(const Twofold& a, const Twofold& b) {
  const Twofold high = exact_sum(a.hi, b.hi);
  const Twofold low = exact_sum(a.lo, b.lo);
  const Twofold sum = normalised(high.hi, high.lo + low.hi);
  return normalised(sum.hi, sum.lo + low.lo);
}

Twofold operator*(const Twofold& a, const Twofold& b) {
  const double product = a.hi * b.hi;
  const double rest = std::fma(a.hi, b.hi, -product);
  return normalised(product, rest + (a.hi * b.lo + a.lo * b.hi));
}

Twofold minor(const Twofold& a, const Twofold& b, const Twofold& c, const Twofold& d) { return a * d + -(b * c); }

// About 100 roundings of 2⁻¹⁰⁴ each on products of three differences, with a factor of 50 to spare.
constexpr double kTwofoldRounding = 5000 * 0x1.0p-104;
constexpr double kTwofoldUnderflow = 1e-200;

}  // namespace

CGAL::Sign OrientedPlane::side_in_doubt(const HullPoint& s) const {
  const double x = s.x() - p_.x(), y = s.y() - p_.y(), z = s.z() - p_.z();
  const double largest_x = larger(wx_, x), largest_y = larger(wy_, y), largest_z = larger(wz_, z);
  if (largest_x == 0.0 || largest_y == 0.0 || largest_z == 0.0) return CGAL::ZERO;
  const auto difference = [this](const HullPoint& a, int axis) { return exact_sum(a[axis], -p_[axis]); };
  const Twofold det = minor(difference(q_, 1), difference(q_, 2), difference(r_, 1), difference(r_, 2)) * difference(s, 0) +
                      minor(difference(q_, 2), difference(q_, 0), difference(r_, 2), difference(r_, 0)) * difference(s, 1) +
                      minor(difference(q_, 0), difference(q_, 1), difference(r_, 0), difference(r_, 1)) * difference(s, 2);
  const double doubt = kTwofoldRounding * largest_x * largest_y * largest_z + kTwofoldUnderflow;
  if (det.hi > doubt) return CGAL::POSITIVE;
  if (det.hi < -doubt) return CGAL::NEGATIVE;
  return CGAL::orientation(p_, q_, r_, s);
}

}  // namespace tern
