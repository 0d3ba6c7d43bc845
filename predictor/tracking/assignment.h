// Optimal assignment with a gate.
#pragma once

#include <cstddef>
#include <vector>

namespace tern {

inline constexpr int kUnassigned = -1;
/// The most steps of one assign() that the optimal method may take: some 10 ms. 170 rows and columns that are all
/// within one gate of each other take as many.
inline constexpr double kMaxAssignmentSteps = 1e7;

/// A row and a column that may be assigned to each other.
struct Pairing {
  std::size_t row = 0, column = 0;
  double cost = 0.0;  ///< ≥ 0
};

/// Returns for each row its column, or kUnassigned. Each column is assigned at most once, and only pairings with
/// cost ≤ gate are made. The sum of costs is minimal, where an unassigned row costs `gate`. Ties are broken by index,
/// so the result is deterministic.
///
/// Pairings within the gate divide rows and columns into connected groups. Each group is solved by the Hungarian method
/// with potentials (H. W. Kuhn 1955; shortest augmenting paths). It takes at most r² (r + c) steps for r rows and
/// c columns. A group for which kMaxAssignmentSteps leave too few is matched cheapest pairing first, in O(p log p) for
/// p pairings. In such a throng the optimum is a guess as well.
/// @param pairings  each row and column at most once; all others are beyond the gate
/// @param gate  ≥ 0, finite
std::vector<int> assign(std::size_t rows, std::size_t columns, const std::vector<Pairing>& pairings, double gate);

}  // namespace tern
