// Optimal assignment with a gate.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

inline constexpr int kUnassigned = -1;

/// Returns for each row its column, or kUnassigned. Each column is assigned at most once, and only pairs with
/// cost ≤ gate are made. The sum of costs is minimal, where an unassigned row costs `gate`. Ties are broken by index,
/// so the result is deterministic.
///
/// Pairs within the gate divide rows and columns into connected groups. Each group is solved by the Hungarian method
/// with potentials (H. W. Kuhn 1955; shortest augmenting paths). O(r² (r + c)) for a group of r rows and c columns.
/// @param cost rows × columns, entries ≥ 0 (infinite allowed); @param gate ≥ 0, finite
std::vector<int> assign(const Eigen::MatrixXd& cost, double gate);

}  // namespace tern
