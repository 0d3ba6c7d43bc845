#include "simulator/worlds/appearances.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

double refused_within_m(const WorldObstacle& o) {
  const auto* motion = std::get_if<WaypointMotion>(&o.spec().motion);
  return motion != nullptr && std::isfinite(o.first_s()) ? motion->leave_out_within_m : 0.0;
}

}  // namespace

Appearances::Appearances(const World& world) {
  for (std::size_t k = 0; k < world.obstacles.size(); ++k) {
    const WorldObstacle& o = world.obstacles[k];
    if (refused_within_m(o) > 0.0) undecided_.emplace_back(o.first_s(), k);
  }
  std::sort(undecided_.rbegin(), undecided_.rend());
}

int Appearances::admit(World& world, double t_s, const std::function<Vec3(double)>& vehicle) {
  int left_out = 0;
  for (; !undecided_.empty() && undecided_.back().first <= t_s; undecided_.pop_back()) {
    const auto [at, k] = undecided_.back();
    WorldObstacle& o = world.obstacles[k];
    if (distance_to_box(vehicle(at), o.at(at).p, o.half_extents()) >= refused_within_m(o)) continue;
    o.leave_out();
    ++left_out;
  }
  return left_out;
}

}  // namespace tern
