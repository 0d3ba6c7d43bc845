#include "mission/check.h"

#include <fmt/format.h>

#include "core/world/body.h"
#include "core/world/body_distance.h"

namespace tern::mission {
namespace {

/// A message names at most this many steps.
constexpr int kNamed = 3;
/// A body that overlaps a voxel by less touches it only, m: rounding of coordinates up to 1e5 m.
constexpr double kTouch = 1e-6;

/// Joins what is wrong with each step: the first kNamed, and how many more there are.
class Findings {
 public:
  void add(const Step& step, const std::string& what) {
    const Vec3& p = step.position;
    if (++count_ > kNamed) return;
    text_ += fmt::format("{}{} at ({:.2f}, {:.2f}, {:.2f}) m {}", text_.empty() ? "" : "; ", step.name, p.x(), p.y(),
                         p.z(), what);
  }
  [[nodiscard]] std::string text() const {
    return count_ > kNamed ? fmt::format("{}; and {} more", text_, count_ - kNamed) : text_;
  }

 private:
  std::string text_;
  int count_ = 0;
};

/// Returns the class of an occupied voxel that the body at p overlaps; nullptr if it overlaps none.
const std::string* blocked_by(const VoxelMap& map, const Body& body, const BodyDistance& distance, const Vec3& p) {
  const VoxelGrid& grid = map.grid;
  const Box reach = body_box(body);
  const Vec3 half = Vec3::Constant(0.5 * grid.resolution);
  const Box cut = Box(p + reach.min(), p + reach.max()).intersection(grid.bounds());
  if (cut.isEmpty()) return nullptr;
  const Eigen::Vector3i low = grid.cell_of(cut.min()).cwiseMax(0);
  const Eigen::Vector3i high = grid.cell_of(cut.max()).cwiseMin(grid.size - Eigen::Vector3i::Ones());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const auto index = idx(grid.index({x, y, z}));
        if (map.labels[index] != VoxelLabel::Occupied) continue;
        if (distance(p - grid.centre({x, y, z}), half) < -kTouch) return &map.class_names[map.classes[index]];
      }
    }
  }
  return nullptr;
}

}  // namespace

std::string steps_outside(const Mission& mission, const Box& flight_box, const Body& body) {
  const Box places = places_within(flight_box, body_box(body));
  Findings findings;
  for (const Step& step : mission.steps) {
    if (step.action == Action::Follow) continue;
    const Vec3 beyond = (places.min() - step.position).cwiseMax(step.position - places.max());
    Eigen::Index axis = 0;
    const double most = beyond.maxCoeff(&axis);
    if (most > kBoxTolerance)
      findings.add(step, fmt::format("is outside the flight box by {:.2f} m on {}", most, "xyz"[axis]));
  }
  return findings.text();
}

std::string steps_too_fast(const Mission& mission, const Limits& limits) {
  const double most = limits.v_max.head<2>().maxCoeff();
  Findings findings;
  for (const Step& step : mission.steps) {
    if (step.speed <= most) continue;
    findings.add(step, fmt::format("has a speed of {:g} m/s; that of the vehicle is {:g} m/s (uav.limits.v_max)",
                                   step.speed, most));
  }
  return findings.text();
}

std::string steps_blocked(const Mission& mission, const VoxelMap& map, const Body& body) {
  const BodyDistance distance(body);
  Findings findings;
  for (const Step& step : mission.steps) {
    if (step.action == Action::Follow) continue;
    const std::string* name = blocked_by(map, body, distance, step.position);
    if (name != nullptr) findings.add(step, "is in " + (name->empty() ? std::string("an obstacle") : *name));
  }
  return findings.text();
}

}  // namespace tern::mission
