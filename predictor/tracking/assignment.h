// Optimal assignment with gates: which detection belongs to which track.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

inline constexpr int kUnassigned = -1;

/// For each row the column that it gets, or kUnassigned: each column at most once, only pairs with cost ≤ gate, and the
/// sum of the costs least where an unassigned row costs `gate`. Ties go to whatever comes first by index, always alike.
/// Rows and columns that gates do not connect are solved apart, each group by the Hungarian method with potentials
/// (H. W. Kuhn 1955; shortest augmenting paths): O(r² (r + c)) for a group of r rows and c columns.
/// @param cost rows × columns, entries ≥ 0 (infinite allowed); @param gate ≥ 0, finite.
std::vector<int> assign(const Eigen::MatrixXd& cost, double gate);

}  // namespace tern
