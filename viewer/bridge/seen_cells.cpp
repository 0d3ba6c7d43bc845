#include "viewer/bridge/seen_cells.h"

#include <algorithm>
#include <cmath>

#include "perception/view.h"

namespace tern {
namespace {

int cell_at(double metres) { return static_cast<int>(std::floor(metres / SeenCells::kCell)); }

/// Returns the slot of a cell; cells of one window have different ones.
std::size_t slot(int x, int y) {
  const auto wrapped = [](int k) { return (k % SeenCells::kSide + SeenCells::kSide) % SeenCells::kSide; };
  return idx(wrapped(y) * SeenCells::kSide + wrapped(x));
}

}  // namespace

void SeenCells::add(const SightingSet& frame) {
  const auto [found, is_new] = sensors_.try_emplace(frame.sensor_id);
  Sensor& sensor = found->second;
  if (!is_new && frame.at >= sensor.used && frame.at - sensor.used < kPeriod) return;
  if (is_new || frame.at < sensor.used) sensor.cells.assign(idx(kSide * kSide), {});
  sensor.used = frame.at;
  const Vec3& eye = frame.view.sensor_position;
  const int left = cell_at(eye.x()) - kSide / 2, low = cell_at(eye.y()) - kSide / 2;
  for (int y = low; y < low + kSide; ++y) {
    for (int x = left; x < left + kSide; ++x) {
      const Vec3 centre(kCell * (x + 0.5), kCell * (y + 0.5), eye.z());
      if (looked_at(frame.view, centre) == Looked::Through) sensor.cells[slot(x, y)] = {x, y, frame.at};
    }
  }
}

bool SeenCells::is_seen(int x, int y, UTime since) const {
  return std::ranges::any_of(sensors_, [&](const auto& entry) {
    const Seen& seen = entry.second.cells[slot(x, y)];
    return seen.x == x && seen.y == y && seen.at >= since;
  });
}

std::vector<SeenCells::Run> SeenCells::unseen(const Vec3& centre, UTime since) const {
  std::vector<Run> runs;
  const int left = cell_at(centre.x()) - kShown / 2, low = cell_at(centre.y()) - kShown / 2;
  for (int y = low; y < low + kShown; ++y) {
    bool continues = false;
    for (int x = left; x < left + kShown; ++x) {
      const bool is_unseen = !is_seen(x, y, since);
      if (is_unseen && continues) ++runs.back().count;
      if (is_unseen && !continues) runs.push_back({x, y, 1});
      continues = is_unseen;
    }
  }
  return runs;
}

}  // namespace tern
