#include "tools/report/map_runs.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace tern::report {
namespace {

constexpr double kAround = 1.0;  // m

struct Layers {
  int low = 0, high = -1;
};

Layers flown_layers(const audit::FlightRecord& record, const VoxelGrid& grid) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const UavState& s : record.states) {
    low = std::min(low, s.motion.p.z());
    high = std::max(high, s.motion.p.z());
  }
  if (!(low <= high)) return {};
  const Vec3 o = grid.origin;
  return {std::max(0, grid.cell_of({o.x(), o.y(), low - kAround}).z()),
          std::min(grid.size.z() - 1, grid.cell_of({o.x(), o.y(), high + kAround}).z())};
}

VoxelLabel seen_from_above(const VoxelMap& map, int x, int y, const Layers& layers) {
  VoxelLabel best = VoxelLabel::Free;
  const auto rank = [](VoxelLabel label) {
    return label == VoxelLabel::Occupied     ? 3
           : label == VoxelLabel::Repulsive  ? 2
           : label == VoxelLabel::Attractive ? 1
                                             : 0;
  };
  for (int z = layers.low; z <= layers.high; ++z) {
    const VoxelLabel label = map.labels[idx(map.grid.index({x, y, z}))];
    if (rank(label) > rank(best)) best = label;
  }
  return best;
}

}  // namespace

nlohmann::json map_runs(const audit::FlightRecord& record, std::size_t most) {
  nlohmann::json runs = nlohmann::json::array();
  if (record.maps.empty() || record.plans.empty()) return {{"runs", runs}};
  const auto named = record.maps.find(record.plans.back().inputs.map_version);
  const VoxelMap& map = named == record.maps.end() ? record.maps.rbegin()->second : named->second;
  const Layers layers = flown_layers(record, map.grid);
  for (int y = 0; y < map.grid.size.y(); ++y) {
    for (int x = 0; x < map.grid.size.x();) {
      const VoxelLabel label = seen_from_above(map, x, y, layers);
      int end = x + 1;
      while (end < map.grid.size.x() && seen_from_above(map, end, y, layers) == label) ++end;
      if (label != VoxelLabel::Free) runs.push_back({x, y, end - x, static_cast<int>(label)});
      x = end;
    }
    if (runs.size() > most) return {{"runs", nlohmann::json::array()}};
  }
  return {{"runs", runs}, {"origin", {map.grid.origin.x(), map.grid.origin.y()}}, {"resolution", map.grid.resolution}};
}

}  // namespace tern::report
