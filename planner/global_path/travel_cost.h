// The cost of a way beyond its length: regions that paths should avoid or prefer.
#pragma once

#include <functional>

#include "core/base/types.h"

namespace tern {

/// The cost of the straight way from a to b, m: |b − a| + extra(a, b), with extra ≥ 0 and additive along a line.
///
/// No region is closed. A region of λ per metre is crossed if the detour is longer by more than λ times the metres
/// inside.
struct TravelCost {
  std::function<double(const Vec3& a, const Vec3& b)> extra;  ///< deterministic; empty if length alone counts
  Box region;  ///< outside it the cost per metre is constant; empty if it is so everywhere

  [[nodiscard]] bool is_length() const { return !extra; }
  [[nodiscard]] double operator()(const Vec3& a, const Vec3& b) const {
    const double length = (b - a).norm();
    return extra ? length + extra(a, b) : length;
  }
};

}  // namespace tern
