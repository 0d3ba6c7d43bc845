// A grid of nodes at the crossings of three sets of unevenly spaced lines.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "core/base/types.h"
#include "planner/global_path/grid_axis.h"

namespace tern {

/// Node (i, j, k) is at (x_i, y_j, z_k), the least corner of cell (i, j, k). Nodes are numbered with x running fastest.
struct RectilinearGrid {
  using Cell = Eigen::Vector3i;
  GridAxis axis[3];

  [[nodiscard]] Cell size() const { return {axis[0].size(), axis[1].size(), axis[2].size()}; }
  [[nodiscard]] std::int64_t nodes() const {
    return static_cast<std::int64_t>(axis[0].size()) * axis[1].size() * axis[2].size();
  }
  [[nodiscard]] Vec3 low() const { return {axis[0].low(), axis[1].low(), axis[2].low()}; }
  [[nodiscard]] Vec3 high() const { return {axis[0].high(), axis[1].high(), axis[2].high()}; }
  [[nodiscard]] std::int32_t index(const Cell& c) const {
    return c.x() + axis[0].size() * (c.y() + axis[1].size() * c.z());
  }
  [[nodiscard]] Cell cell_of(std::int32_t node) const {
    const std::int32_t row = node / axis[0].size();
    return {node % axis[0].size(), row % axis[1].size(), row / axis[1].size()};
  }
  [[nodiscard]] Vec3 position(const Cell& c) const { return {axis[0][c.x()], axis[1][c.y()], axis[2][c.z()]}; }
  [[nodiscard]] Vec3 position(std::int32_t node) const { return position(cell_of(node)); }
  /// Returns the cell that contains p, or the nearest one.
  [[nodiscard]] Cell cell(const Vec3& p) const {
    return {axis[0].cell(p.x()), axis[1].cell(p.y()), axis[2].cell(p.z())};
  }

  /// Returns the range (from, to) of the nodes in the closed box; `to` is excluded.
  [[nodiscard]] std::pair<Cell, Cell> nodes_within(const Box& box) const {
    Cell from;
    Cell to;
    for (int i = 0; i < 3; ++i) std::tie(from[i], to[i]) = axis[i].lines_within(box.min()[i], box.max()[i]);
    return {from, to};
  }

  /// Calls visit(node) for the existing nodes c − below … c + above, in order of their numbers.
  template <class Visit>
  void for_neighbours(const Cell& c, int below, int above, const Visit& visit) const {
    Cell from;
    Cell to;
    for (int i = 0; i < 3; ++i) {
      from[i] = std::max(c[i] - below, 0);
      to[i] = std::min(c[i] + above, axis[i].size() - 1);
    }
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        const std::int32_t row = index({0, y, z});
        for (int x = from.x(); x <= to.x(); ++x) visit(row + x);
      }
    }
  }
};

}  // namespace tern
