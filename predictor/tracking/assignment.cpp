#include "predictor/tracking/assignment.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace tern {
namespace {

using Index = Eigen::Index;

// Returns for each row the column of the cheapest complete assignment. @pre rows ≤ columns, finite costs. Index 0 is a
// sentinel.
std::vector<Index> cheapest_assignment(const Eigen::MatrixXd& cost) {
  const auto rows = static_cast<std::size_t>(cost.rows());
  const auto columns = static_cast<std::size_t>(cost.cols());
  const auto reduced = [&](std::size_t r, std::size_t c) {
    return cost(static_cast<Index>(r) - 1, static_cast<Index>(c) - 1);
  };
  std::vector<double> row_potential(rows + 1, 0.0), column_potential(columns + 1, 0.0);
  std::vector<std::size_t> row_of(columns + 1, 0), previous(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    std::vector<double> slack(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> in_tree(columns + 1, false);
    row_of[0] = row;
    std::size_t column = 0;
    do {
      in_tree[column] = true;
      const std::size_t r = row_of[column];
      double delta = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c <= columns; ++c) {
        if (in_tree[c]) continue;
        const double value = reduced(r, c) - row_potential[r] - column_potential[c];
        if (value < slack[c]) slack[c] = value, previous[c] = column;
        if (slack[c] < delta) delta = slack[c], next = c;
      }
      for (std::size_t c = 0; c <= columns; ++c) {
        if (in_tree[c])
          row_potential[row_of[c]] += delta, column_potential[c] -= delta;
        else
          slack[c] -= delta;
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {
      row_of[column] = row_of[previous[column]];
      column = previous[column];
    }
  }
  std::vector<Index> column_of(rows, 0);
  for (std::size_t c = 1; c <= columns; ++c) {
    if (row_of[c] != 0) column_of[row_of[c] - 1] = static_cast<Index>(c) - 1;
  }
  return column_of;
}

struct Group {
  std::vector<std::size_t> rows, columns;  // ascending
  std::vector<Pairing> pairings;
};

// Connected components of the pairings within the gate, in order of their first row.
std::vector<Group> groups_of(std::size_t rows, std::size_t columns, const std::vector<Pairing>& pairings, double gate) {
  std::vector<std::size_t> parent(rows + columns);  // a forest of rows, then columns; the root is the least of its tree
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const Pairing& pairing : pairings) {
    if (pairing.cost > gate) continue;
    const auto [first, second] = std::minmax({root(pairing.row), root(rows + pairing.column)});
    parent[second] = first;
  }
  std::vector<Group> groups(rows);  // by root; a column alone is in none
  for (std::size_t r = 0; r < rows; ++r) groups[root(r)].rows.push_back(r);
  for (std::size_t c = 0; c < columns; ++c) {
    if (root(rows + c) < rows) groups[root(rows + c)].columns.push_back(c);
  }
  for (const Pairing& pairing : pairings) {
    if (pairing.cost <= gate) groups[root(pairing.row)].pairings.push_back(pairing);
  }
  std::erase_if(groups, [](const Group& group) { return group.pairings.empty(); });
  return groups;
}

std::size_t position_of(std::size_t index, const std::vector<std::size_t>& ascending) {
  return static_cast<std::size_t>(std::ranges::lower_bound(ascending, index) - ascending.begin());
}

void assign_optimally(const Group& group, double gate, std::vector<int>& column_of) {
  const auto rows = static_cast<Index>(group.rows.size());
  const auto columns = static_cast<Index>(group.columns.size());
  // Each row has an extra column that means "unassigned". A pair beyond the gate costs more than leaving both alone.
  Eigen::MatrixXd cost(rows, columns + rows);
  cost.leftCols(columns).setConstant(2.0 * gate + 1.0);
  cost.rightCols(rows).setConstant(gate);
  for (const Pairing& pairing : group.pairings) {
    cost(static_cast<Index>(position_of(pairing.row, group.rows)),
         static_cast<Index>(position_of(pairing.column, group.columns))) = pairing.cost;
  }
  const std::vector<Index> cheapest = cheapest_assignment(cost);
  for (std::size_t r = 0; r < group.rows.size(); ++r) {
    const Index c = cheapest[r];
    if (c >= columns || cost(static_cast<Index>(r), c) > gate) continue;
    column_of[group.rows[r]] = static_cast<int>(group.columns[static_cast<std::size_t>(c)]);
  }
}

void assign_cheapest_first(Group group, std::vector<bool>& taken, std::vector<int>& column_of) {
  std::ranges::sort(group.pairings, {},
                    [](const Pairing& pairing) { return std::tuple(pairing.cost, pairing.row, pairing.column); });
  for (const Pairing& pairing : group.pairings) {
    if (column_of[pairing.row] != kUnassigned || taken[pairing.column]) continue;
    column_of[pairing.row] = static_cast<int>(pairing.column);
    taken[pairing.column] = true;
  }
}

}  // namespace

std::vector<int> assign(std::size_t rows, std::size_t columns, const std::vector<Pairing>& pairings, double gate) {
  std::vector<int> column_of(rows, kUnassigned);
  std::vector<bool> taken(columns, false);  // columns of groups that are assigned cheapest first
  double left = kMaxAssignmentSteps;
  for (Group& group : groups_of(rows, columns, pairings, gate)) {
    const auto r = static_cast<double>(group.rows.size()), c = static_cast<double>(group.columns.size());
    const double steps = r * r * (r + c);
    if (steps <= left) {
      left -= steps;
      assign_optimally(group, gate, column_of);
    } else {
      assign_cheapest_first(std::move(group), taken, column_of);
    }
  }
  return column_of;
}

}  // namespace tern
