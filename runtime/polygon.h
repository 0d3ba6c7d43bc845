// Simple polygons: the outlines of prism regions.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

/// True if no two sides touch, except neighbours at their common corner. A repeated corner, a crossing and a spike that
/// folds back are therefore excluded. Both orientations are accepted. O(n²). Computed in doubles: corners closer to a
/// side than rounding (1e-12 of the size) may count as touching.
bool is_simple_polygon(const std::vector<Eigen::Vector2d>& corners);

}  // namespace tern
