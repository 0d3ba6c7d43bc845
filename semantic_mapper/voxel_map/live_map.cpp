#include "semantic_mapper/voxel_map/live_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/geometry/box.h"
#include "semantic_mapper/voxel_map/octomap_voxels.h"
#include "semantic_mapper/voxel_map/ray_walk.h"
#include "semantic_mapper/voxel_map/standing_place.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {
namespace {

// Log-odds in steps of 0.05. OctoMap's defaults: 0.847, −0.405, −2.0 and 3.5.
constexpr int kHit = 17;
constexpr int kPass = -8;
constexpr int kLowest = -40;
constexpr int kHighest = 70;
constexpr std::int8_t kUnseen = -128;

}  // namespace

LiveMap::LiveMap(VoxelMap base, const ClassMeanings& classes, const ScanRange& range)
    : base_(std::move(base)), range_(range) {
  if (base_.grid.voxels() > kMaxLiveVoxels) {
    throw std::invalid_argument(
        fmt::format("a live map of {} voxels (limit {}): give smaller extents or a coarser resolution",
                    base_.grid.voxels(), kMaxLiveVoxels));
  }
  unlabelled_ = {VoxelLabel::Occupied, index_of_class(kUnlabelled, base_.class_names)};
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i]) meanings_[i] = {classes[i]->label, index_of_class(classes[i]->name, base_.class_names)};
  }
  log_odds_.assign(base_.labels.size(), kUnseen);
  last_.assign(base_.labels.size(), {});
  met_by_.assign(base_.labels.size(), 0);
}

void LiveMap::hit(std::int64_t voxel, const Meaning& meaning) {
  const auto i = idx(voxel);
  const bool is_first = met_by_[i] != 2 * scans_ + 1;
  if (is_first || strength_of(meaning.label) > strength_of(last_[i].label)) last_[i] = meaning;
  if (!is_first) return;
  met_by_[i] = 2 * scans_ + 1;
  const int before = log_odds_[i] == kUnseen ? 0 : log_odds_[i];
  log_odds_[i] = static_cast<std::int8_t>(std::min(before + kHit, kHighest));
}

void LiveMap::pass(std::int64_t voxel) {
  const auto i = idx(voxel);
  if (met_by_[i] >= 2 * scans_) return;
  met_by_[i] = 2 * scans_;
  const int before = log_odds_[i] == kUnseen ? 0 : log_odds_[i];
  log_odds_[i] = static_cast<std::int8_t>(std::max(before + kPass, kLowest));
}

int LiveMap::add(const Scan& scan) {
  ++scans_;
  const double reach = scan.range > 0.0 ? std::min(scan.range, range_.max) : range_.max;
  const VoxelGrid& grid = base_.grid;
  std::vector<Vec3> ends;
  ends.reserve(scan.points.size());
  // All points first: a voxel with a point in it is hit, even if other rays pass it.
  for (const LabelledPoint& point : scan.points) {
    const Vec3 ray = point.position - scan.sensor;
    const double distance = ray.norm();
    if (distance < range_.min) continue;
    if (distance > reach) {
      ends.emplace_back(scan.sensor + ray * (reach / distance));
      continue;
    }
    ends.push_back(point.position);
    if (!grid.bounds().contains(point.position)) continue;
    const Eigen::Vector3i cell = grid.cell_of(point.position);
    if (!grid.contains(cell)) continue;  // on the upper face of the grid
    const Meaning& meaning = scan.has_classes ? meanings_[point.class_number] : unlabelled_;
    if (meaning.label != VoxelLabel::Unknown) {
      hit(grid.index(cell), meaning);
    } else {
      met_by_[idx(grid.index(cell))] = std::max(met_by_[idx(grid.index(cell))], 2 * scans_);  // neither hit nor passed
    }
  }
  for (const Vec3& end : ends) walk_ray(grid, scan.sensor, end, [this](std::int64_t voxel) { pass(voxel); });
  return static_cast<int>(ends.size());
}

bool LiveMap::set_octomap(const OctoMapFile& octomap) {
  VoxelPainter painter(base_.grid, VoxelLabel::Unknown);
  paint_octomap(octomap, painter);
  std::vector<VoxelLabel> labels = painter.finish().labels;
  if (std::ranges::all_of(labels, [](VoxelLabel label) { return label == VoxelLabel::Unknown; })) return false;
  octomap_ = std::move(labels);
  return true;
}

void LiveMap::free_start(const Body& body, const Vec3& p) {
  start_ = p;
  const VoxelGrid& grid = base_.grid;
  const Box near =
      grown(Box(p - body.half_extents(), p + body.half_extents()), Vec3::Constant(kStartMargin * grid.resolution));
  const Box cut = near.intersection(grid.bounds());
  if (cut.isEmpty()) return;
  const Eigen::Vector3i low = grid.cell_of(cut.min());
  const Eigen::Vector3i high = grid.cell_of(cut.max()).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        std::int8_t& log_odds = log_odds_[idx(grid.index({x, y, z}))];
        if (log_odds == kUnseen) log_odds = kPass;
      }
    }
  }
}

VoxelMap LiveMap::map(const Body& body, const Vec3& p) const {
  VoxelMap map = base_;
  const auto strengthen = [&map](std::size_t i, VoxelLabel label, std::uint8_t class_index) {
    if (strength_of(label) <= strength_of(map.labels[i])) return;
    map.labels[i] = label;
    map.classes[i] = class_index;
  };
  for (std::size_t i = 0; i < octomap_.size(); ++i) {
    strengthen(i, octomap_[i], octomap_[i] == VoxelLabel::Occupied ? unlabelled_.class_index : std::uint8_t{0});
  }
  for (std::size_t i = 0; i < map.labels.size(); ++i) {
    if (log_odds_[i] == kUnseen) continue;
    const bool is_occupied = log_odds_[i] >= 0;
    strengthen(i, is_occupied ? last_[i].label : VoxelLabel::Free,
               is_occupied ? last_[i].class_index : std::uint8_t{0});
  }
  const bool has_left = start_ && (p - *start_).norm() > kStartMargin * map.grid.resolution;
  const auto freed =
      has_left ? voxels_met(map.grid, map.labels, body, p) : voxels_stood_in(map.grid, map.labels, body, p);
  for (const std::int64_t voxel : freed) {
    if (base_.labels[idx(voxel)] == VoxelLabel::Occupied) continue;
    map.labels[idx(voxel)] = VoxelLabel::Free;
    map.classes[idx(voxel)] = 0;
  }
  map.version = map.compute_version();
  return map;
}

}  // namespace tern
