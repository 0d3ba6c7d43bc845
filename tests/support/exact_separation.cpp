#include "tests/support/exact_separation.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace tern {
namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    2048, 2048, boost::multiprecision::signed_magnitude, boost::multiprecision::checked, void>>;
// Products of doubles from 2⁻¹⁰⁷⁴ to 2⁵⁰ add up without rounding.
using WideFloat =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<2304, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
using Narrow = __int128;

// Four times the bits of a difference, and 8 more, must fit.
constexpr int kNarrowBits = 29;
constexpr int kWideBits = 260;

template <class Int>
struct Vec {
  Int x = 0, y = 0, z = 0;
  bool operator==(const Vec& o) const { return x == o.x && y == o.y && z == o.z; }
};
template <class Int>
Vec<Int> operator-(const Vec<Int>& a, const Vec<Int>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Int>
Vec<Int> operator*(const Vec<Int>& a, const Int& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class Int>
Int dot(const Vec<Int>& a, const Vec<Int>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Int>
Vec<Int> cross(const Vec<Int>& a, const Vec<Int>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Int>
using Set = std::vector<Vec<Int>>;

// A vector along the shortest one from the origin to a face's affine hull, if its foot is strictly inside the face.
// Zero if the origin is in the face.
template <class Int>
std::optional<Vec<Int>> foot(const Set<Int>& face) {
  const Vec<Int>& p = face[0];
  if (face.size() == 1) return p;
  if (face.size() == 2) {
    const Vec<Int> e = face[1] - p;
    const Int length = dot(e, e);
    const Int t = -dot(p, e);
    if (!(t > 0 && t < length)) return std::nullopt;
    return p * length - e * Int(-t);
  }
  const Vec<Int>& q = face[1];
  const Vec<Int>& r = face[2];
  const Vec<Int> n = cross(q - p, r - p);
  const Int height = dot(n, p);
  if (face.size() == 3) {
    if (!(dot(cross(q, r), n) > 0 && dot(cross(r, p), n) > 0 && dot(cross(p, q), n) > 0)) return std::nullopt;
    return n * Int(height > 0 ? 1 : (height < 0 ? -1 : 0));
  }
  const Vec<Int>& s = face[3];
  const std::array<Int, 4> volumes{dot(q, cross(r, s)), -dot(p, cross(r, s)), dot(p, cross(q, s)),
                                   -dot(p, cross(q, r))};
  const auto positive = [](const Int& v) { return v > 0; };
  const auto negative = [](const Int& v) { return v < 0; };
  const bool inside =
      std::all_of(volumes.begin(), volumes.end(), positive) || std::all_of(volumes.begin(), volumes.end(), negative);
  return inside ? std::optional<Vec<Int>>(Vec<Int>{}) : std::nullopt;
}

// The face of a simplex that holds its point nearest to the origin, and the vector to it (scaled).
template <class Int>
std::pair<Set<Int>, Vec<Int>> nearest_face(const Set<Int>& simplex) {
  for (unsigned mask = 1; mask < (1U << simplex.size()); ++mask) {
    Set<Int> face;
    for (unsigned k = 0; k < simplex.size(); ++k) {
      if ((mask & (1U << k)) != 0) face.push_back(simplex[k]);
    }
    const std::optional<Vec<Int>> v = foot(face);
    if (!v) continue;
    const Int height = dot(*v, face[0]);
    if (std::all_of(simplex.begin(), simplex.end(), [&](const Vec<Int>& w) { return dot(*v, w) >= height; })) {
      return {face, *v};
    }
  }
  throw std::logic_error("exact_separation: no face of the simplex is nearest");
}

template <class Int>
Vec<Int> lowest(const Set<Int>& points, const Vec<Int>& v) {
  return *std::min_element(points.begin(), points.end(),
                           [&v](const Vec<Int>& p, const Vec<Int>& q) { return dot(v, p) < dot(v, q); });
}

double to_double(Narrow value) { return static_cast<double>(value); }
double to_double(const Wide& value) { return value.convert_to<double>(); }

template <class Int>
ExactSeparation decide(const Set<Int>& a, const Set<Int>& b, double unit) {
  Set<Int> simplex{a[0] - b[0]};
  while (true) {
    const auto [face, v] = nearest_face(simplex);
    if (v == Vec<Int>{}) return {false, 0.0};
    const Vec<Int> next = lowest(a, v) - lowest(b, v * Int(-1));
    const Int height = dot(v, face[0]);
    if (dot(v, next) >= height) {
      const double length = std::hypot(to_double(v.x), to_double(v.y), to_double(v.z));
      return {true, unit * (to_double(height) / length)};
    }
    simplex = face;
    simplex.push_back(next);
  }
}

bool on_grid(const Points& points, const Vec3& origin) {
  constexpr double kMost = 0x1.0p28;
  const Points steps = points / kExactGrid;
  const Points offsets = points.colwise() - origin;
  return (steps.array() == steps.array().round()).all() && (offsets.array().abs() < kMost * kExactGrid).all();
}

template <class Int>
Set<Int> integers(const Points& points, int shift) {
  Set<Int> set;
  for (const auto& p : points.colwise()) {
    set.push_back({Int(std::ldexp(p.x(), shift)), Int(std::ldexp(p.y(), shift)), Int(std::ldexp(p.z(), shift))});
  }
  return set;
}

// Exponents of the last and first bit of all coordinates.
std::pair<int, int> bit_range(const Points& a, const Points& b) {
  std::pair<int, int> range{0, 1};
  for (const Points* points : {&a, &b}) {
    for (const double x : points->reshaped()) {
      int exponent = 0;
      if (std::frexp(x, &exponent) == 0.0) continue;
      range = {std::min(range.first, exponent - 53), std::max(range.second, exponent)};
    }
  }
  return range;
}

}  // namespace

ExactSeparation exact_separation(const Points& a, const Points& b) {
  if (a.cols() == 0 || b.cols() == 0 || !a.allFinite() || !b.allFinite()) {
    throw std::invalid_argument("exact_separation: empty or not finite");
  }
  static_assert(4 * kNarrowBits + 8 < 127 && 4 * kWideBits + 8 < 2048);
  if (on_grid(a, b.col(0)) && on_grid(b, b.col(0))) {
    return decide(integers<Narrow>(a, 24), integers<Narrow>(b, 24), kExactGrid);
  }
  const auto [last, first] = bit_range(a, b);
  if (first - last > 150 || last < -900)
    throw std::invalid_argument("exact_separation: coordinates span too many bits");
  return decide(integers<Wide>(a, -last), integers<Wide>(b, -last), std::ldexp(1.0, last));
}

bool exactly_separates(const Plane& plane, const Points& a, const Points& b, double margin) {
  // The sign of n·p + d + offset: by rounding where that cannot matter, else exactly.
  const auto sign = [&plane](const Vec3& p, double offset) {
    const double rounded = plane.signed_distance(p) + offset;
    const double doubt = 0x1.0p-48 * (p.lpNorm<1>() + std::abs(plane.d) + offset);
    if (std::abs(rounded) > doubt) return rounded > 0.0 ? 1 : -1;
    const WideFloat height = WideFloat(plane.n.x()) * WideFloat(p.x()) + WideFloat(plane.n.y()) * WideFloat(p.y()) +
                             WideFloat(plane.n.z()) * WideFloat(p.z()) + WideFloat(plane.d) + WideFloat(offset);
    return height.sign();
  };
  for (const auto& p : a.colwise()) {
    if (sign(p, 0.0) < 0) return false;
  }
  for (const auto& p : b.colwise()) {
    if (sign(p, margin) > 0) return false;
  }
  return true;
}

}  // namespace tern
