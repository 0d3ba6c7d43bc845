#include "viewer/bridge/voxel_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

bool is_drawn(VoxelLabel label) {
  return label == VoxelLabel::Occupied || label == VoxelLabel::Attractive || label == VoxelLabel::Repulsive;
}

int gravity(VoxelLabel label) {
  switch (label) {
    case VoxelLabel::Occupied: return 4;
    case VoxelLabel::Repulsive: return 3;
    case VoxelLabel::Attractive: return 2;
    case VoxelLabel::Free: return 1;
    case VoxelLabel::Unknown: return 0;
  }
  return 0;
}

/// Labels on a grid; outside there is nothing.
struct Labels {
  VoxelGrid grid;
  std::vector<VoxelLabel> labels;

  [[nodiscard]] VoxelLabel at(const Eigen::Vector3i& v) const {
    return grid.contains(v) ? labels[idx(grid.index(v))] : VoxelLabel::Unknown;
  }
};

Labels coarsened(const VoxelMap& map, int factor) {
  Labels coarse{map.grid, {}};
  if (factor == 1) {
    coarse.labels = map.labels;
    return coarse;
  }
  coarse.grid.resolution *= factor;
  coarse.grid.size = (map.grid.size.array() + factor - 1) / factor;
  coarse.labels.assign(static_cast<std::size_t>(coarse.grid.voxels()), VoxelLabel::Unknown);
  std::size_t k = 0;
  for (int z = 0; z < map.grid.size.z(); ++z) {
    for (int y = 0; y < map.grid.size.y(); ++y) {
      for (int x = 0; x < map.grid.size.x(); ++x, ++k) {
        VoxelLabel& label = coarse.labels[idx(coarse.grid.index({x / factor, y / factor, z / factor}))];
        if (gravity(map.labels[k]) > gravity(label)) label = map.labels[k];
      }
    }
  }
  return coarse;
}

/// The faces of one layer of voxels with one orientation; u along the first other axis, v along the second.
struct Layer {
  int axis, direction, depth, width, height;
  std::vector<VoxelLabel> mask;  ///< Unknown: no face

  [[nodiscard]] VoxelLabel& at(int u, int v) { return mask[idx(v * width + u)]; }
  [[nodiscard]] Eigen::Vector3i cell(int u, int v) const {
    Eigen::Vector3i c;
    c[axis] = depth;
    c[(axis + 1) % 3] = u;
    c[(axis + 2) % 3] = v;
    return c;
  }
};

Layer exposed(const Labels& labels, int direction, int depth) {
  const int axis = direction / 2;
  const Eigen::Vector3i& size = labels.grid.size;
  Layer layer{axis, direction, depth, size[(axis + 1) % 3], size[(axis + 2) % 3], {}};
  layer.mask.assign(static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height),
                    VoxelLabel::Unknown);
  Eigen::Vector3i step = Eigen::Vector3i::Zero();
  step[axis] = direction % 2 == 0 ? -1 : 1;
  for (int v = 0; v < layer.height; ++v) {
    for (int u = 0; u < layer.width; ++u) {
      const Eigen::Vector3i cell = layer.cell(u, v);
      const VoxelLabel label = labels.at(cell);
      if (is_drawn(label) && labels.at(cell + step) != label) layer.at(u, v) = label;
    }
  }
  return layer;
}

/// Removes rectangles from the layer: as wide as the run, then as high as the run repeats.
void join(Layer& layer, std::vector<VoxelFace>& faces) {
  for (int v = 0; v < layer.height; ++v) {
    for (int u = 0; u < layer.width; ++u) {
      const VoxelLabel label = layer.at(u, v);
      if (label == VoxelLabel::Unknown) continue;
      int u_end = u + 1;
      while (u_end < layer.width && layer.at(u_end, v) == label) ++u_end;
      const auto same_row = [&](int row) {
        for (int k = u; k < u_end; ++k) {
          if (layer.at(k, row) != label) return false;
        }
        return true;
      };
      int v_end = v + 1;
      while (v_end < layer.height && same_row(v_end)) ++v_end;
      for (int row = v; row < v_end; ++row) std::fill_n(&layer.at(u, row), u_end - u, VoxelLabel::Unknown);
      VoxelFace face{label, static_cast<std::uint8_t>(layer.direction), layer.cell(u, v), layer.cell(u_end, v_end)};
      face.low[layer.axis] = face.high[layer.axis] = layer.depth + layer.direction % 2;
      faces.push_back(face);
    }
  }
}

}  // namespace

VoxelSurface voxel_surface(const VoxelMap& map, std::int64_t max_voxels) {
  int factor = 1;
  while (map.grid.voxels() / (static_cast<std::int64_t>(factor) * factor * factor) > max_voxels) ++factor;
  const Labels labels = coarsened(map, factor);
  VoxelSurface surface{labels.grid, {}, {}};
  for (const VoxelLabel label : labels.labels) surface.occupied.push_back(label == VoxelLabel::Occupied);
  for (int direction = 0; direction < 6; ++direction) {
    for (int depth = 0; depth < labels.grid.size[direction / 2]; ++depth) {
      Layer layer = exposed(labels, direction, depth);
      join(layer, surface.faces);
    }
  }
  return surface;
}

double distance_to_occupied(const VoxelSurface& surface, const BodyDistance& body, const Vec3& p) {
  const VoxelGrid& grid = surface.grid;
  const Eigen::Vector3i cell = grid.cell_of(p);
  const Vec3 reach = body.bounds().max().cwiseMax(-body.bounds().min());
  const bool is_inside = grid.contains(cell) && surface.occupied[idx(grid.index(cell))];
  double nearest = is_inside ? -reach.minCoeff() : std::numeric_limits<double>::infinity();
  for (const VoxelFace& face : surface.faces) {
    if (face.label != VoxelLabel::Occupied) continue;
    const Vec3 low = grid.origin + grid.resolution * face.low.cast<double>();
    const Vec3 high = grid.origin + grid.resolution * face.high.cast<double>();
    const double from_position = (p - p.cwiseMax(low).cwiseMin(high)).norm();
    if (from_position - reach.norm() >= nearest) continue;
    nearest = std::min(nearest, body(p - 0.5 * (low + high), 0.5 * (high - low)));
  }
  return nearest;
}

}  // namespace tern
