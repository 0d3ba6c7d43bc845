// The cost of a way beyond its length: regions that paths should avoid or prefer.
#pragma once

#include <functional>
#include <memory>

#include "core/base/types.h"
#include "planner/semantics/drift.h"
#include "planner/semantics/information_map.h"

namespace tern {

/// The cost of the straight way from a to b, m: |b − a| + extra(a, b), with extra ≥ 0 and additive along a line.
///
/// No region is closed. A region of λ per metre is crossed if the detour is longer by more than λ times the metres
/// inside.
/// With `priced` the cost of a step depends on the way beyond it. A search node then carries the drift of its way to
/// the goal, with the blind time at its start.
struct TravelCost {
  std::function<double(const Vec3& a, const Vec3& b)> extra;  ///< deterministic; empty if length alone counts
  Box region;  ///< outside it the cost per metre is constant; empty if it is so everywhere

  /// Extends the way to the goal by the step from a to b. At b the way has this drift. Returns the cost of the whole
  /// way, at least that from b plus |b − a|. Deterministic; empty if costs have no memory.
  std::function<double(const Vec3& a, const Vec3& b, Drift& drift)> priced = {};
  std::shared_ptr<const InformationMap> information = {};  ///< behind `priced`, for others to read; else null

  [[nodiscard]] bool is_length() const { return !extra && !priced; }
  /// Returns the cost of the straight way from a to b alone.
  [[nodiscard]] double operator()(const Vec3& a, const Vec3& b) const {
    if (priced) {
      Drift drift;
      return priced(a, b, drift);
    }
    const double length = (b - a).norm();
    return extra ? length + extra(a, b) : length;
  }
};

}  // namespace tern
