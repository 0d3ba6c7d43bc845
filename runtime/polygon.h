// Simple polygons: what a prism region's outline must be.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

/// True if no two sides touch but neighbours at their common corner: no corner twice, no crossing, no spike folded back
/// on itself. Either turning sense. O(n²). Decided in doubles: corners nearer to a side than rounding (1e-12 of the
/// size) may count as touching.
bool is_simple_polygon(const std::vector<Eigen::Vector2d>& corners);

}  // namespace tern
