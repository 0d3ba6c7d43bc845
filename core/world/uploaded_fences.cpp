#include "core/world/uploaded_fences.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/geometry/box.h"
#include "core/wire/message_limits.h"
#include "core/world/fence_voxels.h"

namespace tern {

Result<std::vector<VoxelLabel>> uploaded_fence_labels(const std::vector<Fence>& fences, const VoxelGrid& grid,
                                                      const Box& flight_box) {
  if (fences.empty()) return std::vector<VoxelLabel>{};
  const Box needed = fenced_box(fences, flight_box, grid.resolution);
  if (!needed.isEmpty() && !grown(grid.bounds(), Vec3::Constant(kFenceTouch)).contains(needed)) {
    const Vec3 &low = needed.min(), &high = needed.max();
    return fail(
        fmt::format("the map ends within the fences: state a smaller uav.flight_box, larger voxels "
                    "(mapper.resolution_m), or mapper.extents that contain ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m",
                    low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
  }
  const double work = static_cast<double>(grid.voxels()) * static_cast<double>(fences.size());
  if (work > kMaxFenceWork) {
    return fail(
        fmt::format("{} fences in a map of {} voxels take too long: upload fewer, or make the voxels larger "
                    "(mapper.resolution_m)",
                    fences.size(), grid.voxels()));
  }
  return fence_labels(fences, grid);
}

void add_uploaded_fences(const std::vector<VoxelLabel>& labels, VoxelMap& map) {
  if (labels.empty()) return;
  std::vector<std::string>& names = map.class_names;
  auto found = std::find(names.begin(), names.end(), kUploadedFence);
  if (found == names.end() && names.size() < kMaxMapClasses) found = names.insert(names.end(), kUploadedFence);
  const auto name = found == names.end() ? std::uint8_t{0} : static_cast<std::uint8_t>(found - names.begin());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] != VoxelLabel::Occupied || map.labels[k] == VoxelLabel::Occupied) continue;
    map.labels[k] = VoxelLabel::Occupied;
    map.classes[k] = name;
  }
  map.version = map.compute_version();
}

bool holds_fences(const VoxelMap& map, const std::vector<VoxelLabel>& labels) {
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] == VoxelLabel::Occupied && map.labels[k] != VoxelLabel::Occupied) return false;
  }
  return true;
}

void free_uploaded_fences(VoxelMap& map) {
  const auto found = std::find(map.class_names.begin(), map.class_names.end(), kUploadedFence);
  if (found == map.class_names.end()) return;
  const auto name = static_cast<std::uint8_t>(found - map.class_names.begin());
  for (std::size_t k = 0; k < map.labels.size(); ++k) {
    if (map.classes[k] == name) map.labels[k] = VoxelLabel::Free;
  }
}

}  // namespace tern
