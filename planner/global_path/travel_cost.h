// What a metre of way costs beyond its length: where paths would rather not, or rather, lead.
#pragma once

#include <functional>

#include "core/base/types.h"

namespace tern {

/// The cost of the straight way from a to b, in metres of way: |b − a| + extra(a, b), extra ≥ 0, additive along a line.
/// It closes no region: what costs λ per metre is crossed when going around is longer by more than λ times the metres
/// inside.
struct TravelCost {
  std::function<double(const Vec3& a, const Vec3& b)> extra;  ///< none: length alone. Deterministic
  Box region;  ///< outside it the cost per metre is the same everywhere; empty: none

  [[nodiscard]] bool is_length() const { return !extra; }
  [[nodiscard]] double operator()(const Vec3& a, const Vec3& b) const {
    const double length = (b - a).norm();
    return extra ? length + extra(a, b) : length;
  }
};

}  // namespace tern
