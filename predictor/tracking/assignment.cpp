#include "predictor/tracking/assignment.h"

#include <algorithm>
#include <cstddef>
#include <limits>
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
  std::vector<Index> rows, columns;
};

// Marks the index as seen. @return true the first time
bool first_time(std::vector<bool>& seen, Index index) {
  const auto i = static_cast<std::size_t>(index);
  if (seen[i]) return false;
  seen[i] = true;
  return true;
}

// Connected components of the pairs within the gate, in order of their first row.
std::vector<Group> groups_of(const Eigen::MatrixXd& cost, double gate) {
  std::vector<bool> row_seen(static_cast<std::size_t>(cost.rows()), false);
  std::vector<bool> column_seen(static_cast<std::size_t>(cost.cols()), false);
  std::vector<Group> groups;
  for (Index seed = 0; seed < cost.rows(); ++seed) {
    if (!first_time(row_seen, seed)) continue;
    Group group{{seed}, {}};
    for (std::size_t next = 0; next < group.rows.size(); ++next) {
      for (Index c = 0; c < cost.cols(); ++c) {
        if (cost(group.rows[next], c) > gate || !first_time(column_seen, c)) continue;
        group.columns.push_back(c);
        for (Index r = 0; r < cost.rows(); ++r) {
          if (cost(r, c) > gate || !first_time(row_seen, r)) continue;
          group.rows.push_back(r);
        }
      }
    }
    std::sort(group.rows.begin(), group.rows.end());
    std::sort(group.columns.begin(), group.columns.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double gate) {
  std::vector<int> result(static_cast<std::size_t>(cost.rows()), kUnassigned);
  for (const Group& group : groups_of(cost, gate)) {
    const auto rows = static_cast<Index>(group.rows.size());
    const auto columns = static_cast<Index>(group.columns.size());
    if (columns == 0) continue;
    // Each row has an extra column that means "unassigned". A pair beyond the gate costs more than leaving both alone.
    Eigen::MatrixXd square = Eigen::MatrixXd::Constant(rows, columns + rows, gate);
    for (Index r = 0; r < rows; ++r) {
      for (Index c = 0; c < columns; ++c) {
        const double pair = cost(group.rows[static_cast<std::size_t>(r)], group.columns[static_cast<std::size_t>(c)]);
        square(r, c) = pair <= gate ? pair : 2.0 * gate + 1.0;
      }
    }
    const std::vector<Index> column_of = cheapest_assignment(square);
    for (std::size_t r = 0; r < group.rows.size(); ++r) {
      const Index c = column_of[r];
      if (c >= columns || square(static_cast<Index>(r), c) > gate) continue;
      result[static_cast<std::size_t>(group.rows[r])] = static_cast<int>(group.columns[static_cast<std::size_t>(c)]);
    }
  }
  return result;
}

}  // namespace tern
