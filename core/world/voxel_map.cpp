#include "core/world/voxel_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/digest.h"

namespace tern {
namespace {

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

bool same_grid(const VoxelGrid& a, const VoxelGrid& b) {
  return a.origin == b.origin && a.resolution == b.resolution && a.size == b.size;
}

/// The run that starts at voxel `begin`.
VoxelRun run_at(const VoxelMap& map, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < map.labels.size() && map.labels[end] == map.labels[begin] && map.classes[end] == map.classes[begin])
    ++end;
  return {map.labels[begin], map.classes[begin], static_cast<std::int32_t>(end - begin)};
}

}  // namespace

Eigen::Vector3i VoxelGrid::cell(std::int64_t index) const {
  const std::int64_t row = index / size.x();
  return {static_cast<int>(index % size.x()), static_cast<int>(row % size.y()), static_cast<int>(row / size.y())};
}

Eigen::Vector3i VoxelGrid::cell_of(const Vec3& p) const {
  const Vec3 scaled = (p - origin) / resolution;
  return {static_cast<int>(std::floor(scaled.x())), static_cast<int>(std::floor(scaled.y())),
          static_cast<int>(std::floor(scaled.z()))};
}

std::uint64_t VoxelMap::compute_version() const {
  std::uint64_t h = digest(bytes_of(grid.resolution));
  for (int i = 0; i < 3; ++i) h = digest(bytes_of(grid.size[i]), digest(bytes_of(grid.origin[i]), h));
  for (const std::string& name : class_names) h = digest(bytes_of('\0'), digest(name, h));
  for (std::size_t i = 0; i < labels.size();) {
    const VoxelRun run = run_at(*this, i);
    h = digest(bytes_of(run.length), digest(bytes_of(run.class_index), digest(bytes_of(run.label), h)));
    i += static_cast<std::size_t>(run.length);
  }
  return h == 0 ? 1 : h;
}

std::vector<MapChunk> to_chunks(const VoxelMap& map) {
  std::vector<MapChunk> chunks;
  MapChunk head;
  head.version = map.version;
  head.grid = map.grid;
  head.class_names = map.class_names;
  chunks.push_back(head);
  for (std::size_t i = 0; i < map.labels.size();) {
    if (chunks.back().runs.size() == kMaxRunsPerChunk) {
      head.first_voxel = static_cast<std::int64_t>(i);
      chunks.push_back(head);
    }
    const VoxelRun run = run_at(map, i);
    chunks.back().runs.push_back(run);
    i += static_cast<std::size_t>(run.length);
  }
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    chunks[k].index = static_cast<std::int32_t>(k);
    chunks[k].count = static_cast<std::int32_t>(chunks.size());
  }
  return chunks;
}

Result<bool> MapAssembler::add(const MapChunk& chunk) {
  const std::int64_t epoch_us = chunk.header.name.sender_epoch_us;
  const bool is_another = epoch_us_ != 0 && epoch_us != epoch_us_;
  if (is_another && chunk.header.utime - last_sent_ <= kMapSilence) return false;
  if (is_another) map_ = {};
  last_sent_ = is_another ? chunk.header.utime : std::max(last_sent_, chunk.header.utime);
  epoch_us_ = epoch_us;
  if (chunk.version == finished_version_) return false;
  if (chunk.version != map_.version) {
    map_ = VoxelMap{chunk.grid, {}, {}, chunk.class_names, chunk.version};
    map_.labels.assign(static_cast<std::size_t>(chunk.grid.voxels()), VoxelLabel::Unknown);
    map_.classes.assign(map_.labels.size(), 0);
    have_.assign(static_cast<std::size_t>(chunk.count), false);
    missing_ = chunk.count;
  }
  const auto discard = [&](const char* why) {
    const std::string text = fmt::format("map version {:016x}, chunk {}: {}", chunk.version, chunk.index, why);
    map_ = {};
    return fail(text);
  };
  if (!same_grid(chunk.grid, map_.grid) || chunk.class_names != map_.class_names)
    return discard("its grid or class names differ from those of earlier chunks");
  if (chunk.count != static_cast<int>(have_.size()) || chunk.index >= chunk.count)
    return discard("its number of chunks differs from that of earlier chunks");
  if (have_[idx(chunk.index)]) return false;
  auto at = idx(chunk.first_voxel);
  for (const VoxelRun& run : chunk.runs) {
    const auto length = static_cast<std::size_t>(run.length);
    if (at + length > map_.labels.size()) return discard("runs go beyond the grid");
    std::fill_n(map_.labels.begin() + static_cast<std::ptrdiff_t>(at), length, run.label);
    std::fill_n(map_.classes.begin() + static_cast<std::ptrdiff_t>(at), length, run.class_index);
    at += length;
  }
  have_[idx(chunk.index)] = true;
  if (--missing_ > 0) return false;
  if (map_.compute_version() != chunk.version)
    return discard("the digest of the complete map differs from its version");
  finished_version_ = chunk.version;
  return true;
}

VoxelMap MapAssembler::take() {
  VoxelMap map = std::move(map_);
  map_ = {};
  return map;
}

}  // namespace tern
