#include "runtime/polygon.h"

namespace tern {
namespace {

using Eigen::Vector2d;

/// Sign of the turn a → b → c: 1 left, −1 right, 0 straight or back.
int turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d ab = b - a;
  const Vector2d ac = c - a;
  const double cross = ab.x() * ac.y() - ab.y() * ac.x();
  const double tolerance = 1e-12 * ab.norm() * ac.norm();
  return cross > tolerance ? 1 : cross < -tolerance ? -1 : 0;
}

/// Whether c, known to lie on the line a b, lies between them.
bool between(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (c.array() >= a.array().min(b.array())).all() && (c.array() <= a.array().max(b.array())).all();
}

bool segments_touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const int abc = turn(a, b, c);
  const int abd = turn(a, b, d);
  const int cda = turn(c, d, a);
  const int cdb = turn(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

}  // namespace

bool is_simple_polygon(const std::vector<Eigen::Vector2d>& corners) {
  const std::size_t n = corners.size();
  if (n < 3) return false;
  const auto at = [&](std::size_t i) -> const Vector2d& { return corners[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (at(i) == at(i + 1)) return false;
    // Neighbours share at(i + 1); they overlap only if the outline turns straight back there.
    const bool folded = turn(at(i), at(i + 1), at(i + 2)) == 0 && (at(i + 1) - at(i)).dot(at(i + 2) - at(i + 1)) < 0.0;
    if (folded) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j == n - 1;
      if (!neighbours && segments_touch(at(i), at(i + 1), at(j), at(j + 1))) return false;
    }
  }
  return true;
}

}  // namespace tern
