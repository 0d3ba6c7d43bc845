#include "semantic_mapper/voxel_map/cloud_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

/// The mark of a point on a voxel, in eight bytes: a large cloud has as many. Marks are sorted by voxel, then by class.
class Mark {
 public:
  Mark(std::int64_t voxel, std::uint8_t class_number)
      : packed_(static_cast<std::uint64_t>(voxel) << 8U | std::uint64_t{class_number}) {}
  [[nodiscard]] std::int64_t voxel() const { return static_cast<std::int64_t>(packed_ >> 8U); }
  [[nodiscard]] std::uint8_t class_number() const { return static_cast<std::uint8_t>(packed_ & 0xffU); }
  friend bool operator<(const Mark& a, const Mark& b) { return a.packed_ < b.packed_; }

 private:
  std::uint64_t packed_;
};

std::vector<Mark> marks_of(const CloudLayer& cloud, const VoxelGrid& grid) {
  std::vector<Mark> marks;
  marks.reserve(cloud.points.size());
  const int reach = static_cast<int>(std::ceil(cloud.point_radius / grid.resolution));
  const double radius2 = cloud.point_radius * cloud.point_radius;
  for (const LabelledPoint& point : cloud.points) {
    if (!cloud.classes[point.class_number] ||
        !grown(grid.bounds(), Vec3::Constant(cloud.point_radius)).contains(point.position)) {
      continue;
    }
    const Cell own = grid.cell_of(point.position);
    const Cell low = (own - Cell::Constant(reach)).cwiseMax(0);
    const Cell high = (own + Cell::Constant(reach)).cwiseMin(grid.size - Cell::Ones());
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          const Cell cell(x, y, z);
          if (cell != own && (grid.centre(cell) - point.position).squaredNorm() > radius2) continue;
          marks.emplace_back(grid.index(cell), point.class_number);
        }
      }
    }
  }
  std::sort(marks.begin(), marks.end());
  return marks;
}

/// The marks of one voxel, counted.
struct Tally {
  std::array<int, kVoxelLabels> of_label{};
  std::array<int, kVoxelLabels> most{};             ///< marks of the class with the most marks, per label
  std::array<std::uint8_t, kVoxelLabels> leader{};  ///< that class
};

Tally count(const CloudLayer& cloud, std::vector<Mark>::const_iterator begin, std::vector<Mark>::const_iterator end) {
  Tally tally;
  while (begin != end) {
    const std::uint8_t number = begin->class_number();
    const auto next = std::find_if(begin, end, [&](const Mark& m) { return m.class_number() != number; });
    const int n = static_cast<int>(next - begin);
    const auto label = idx(cloud.classes[number]->label);
    tally.of_label[label] += n;
    if (n > tally.most[label]) {
      tally.most[label] = n;
      tally.leader[label] = number;
    }
    begin = next;
  }
  return tally;
}

}  // namespace

bool paint_cloud(const CloudLayer& cloud, VoxelPainter& painter) {
  const VoxelGrid grid = painter.grid();
  const std::int64_t layer = static_cast<std::int64_t>(grid.size.x()) * grid.size.y();
  const std::vector<Mark> marks = marks_of(cloud, grid);
  bool has_painted = marks.empty();
  for (auto begin = marks.begin(); begin != marks.end();) {
    const std::int64_t voxel = begin->voxel();
    const auto end = std::find_if(begin, marks.end(), [&](const Mark& m) { return m.voxel() != voxel; });
    const Tally tally = count(cloud, begin, end);
    begin = end;
    for (std::size_t label = 0; label < kVoxelLabels; ++label) {
      if (tally.of_label[label] < cloud.min_points) continue;
      const std::uint8_t number = tally.leader[label];
      const std::uint8_t index = painter.class_index(cloud.classes[number]->name);
      const std::int64_t floor = cloud.fill_below[number] ? voxel % layer : voxel;
      for (std::int64_t v = floor; v <= voxel; v += layer) painter.paint(v, cloud.classes[number]->label, index);
      has_painted = true;
    }
  }
  return has_painted;
}

}  // namespace tern
