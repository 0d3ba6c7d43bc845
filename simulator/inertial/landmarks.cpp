#include "simulator/inertial/landmarks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/digest.h"

namespace tern {
namespace {

/// Ids of cells are (cell + 1) · kPerCell + index; the other landmarks have smaller ids.
constexpr std::uint64_t kPerCell = 1u << 16;
constexpr std::int64_t kCellsAside = 1 << 20;  ///< cells on each side of 0 per axis
constexpr double kHorizonBand = 0.05;          ///< rad

std::uint64_t mixed(std::uint64_t seed, std::uint64_t part) {
  std::uint64_t x = seed + 0x9e3779b97f4a7c15ULL * (part + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t cell_number(int i, int j) {
  return static_cast<std::uint64_t>((i + kCellsAside) * 2 * kCellsAside + j + kCellsAside);
}

double density_of(const LandmarkSpec& spec, const std::string& class_name) {
  const auto found = std::find_if(spec.regions.begin(), spec.regions.end(),
                                  [&](const auto& entry) { return entry.first == class_name; });
  return found == spec.regions.end() ? spec.ground : found->second;
}

/// A region that begins at most this far above the ground covers it, m.
constexpr double kOnGround = 0.5;

/// Whether the region covers the ground at p.
bool covers(const Region& region, Vec3 p) {
  const Box bounds = region.bounds();
  if (bounds.min().z() > p.z() + kOnGround) return false;
  p.z() = std::clamp(p.z(), bounds.min().z(), bounds.max().z());
  return region.contains(p);
}

}  // namespace

int poisson(Rng& rng, double mean) {
  int count = -1;
  double sum = 0.0;
  do {
    sum -= std::log1p(-rng.uniform());
    ++count;
  } while (sum < mean);
  return count;
}

LandmarkField::LandmarkField(const World& world, const std::vector<Region>& regions, const LandmarkSpec& spec,
                             std::uint64_t seed)
    : world_(&world), spec_(spec), seed_(digest("landmarks", seed)), largest_(spec.ground) {
  for (const Region& region : regions) {
    const double density = density_of(spec, region.class_name);
    regions_.emplace_back(region, density);
    largest_ = std::max(largest_, density);
    if (density > spec.ground) draw_sides(region, density, digest(region.name, seed_));
  }
  for (std::size_t k = 0; k < world.obstacles.size(); ++k) {
    draw_obstacle(k, world.obstacles[k].moves() ? spec.movers : spec.obstacles, mixed(seed_, k));
  }
  draw_horizon(digest("horizon", seed_));
}

void LandmarkField::draw_side(const Vec3& from, const Vec3& to, double height, double density, Rng& rng) {
  const Vec3 along = to - from;
  for (int n = poisson(rng, density * along.norm() * height); n > 0; --n) {
    const double s = rng.uniform(), z = rng.uniform();
    Landmark landmark{next_id(), SurfaceClass::Region, {}};
    landmark.point.p = from + s * along + z * height * Vec3::UnitZ();
    landmark.point.normal = along.cross(Vec3::UnitZ()).normalized();
    landmark.point.two_sided = true;
    fixed_.push_back(landmark);
  }
}

void LandmarkField::draw_sides(const Region& region, double density, std::uint64_t seed) {
  std::vector<Eigen::Vector2d> corners;
  const Box bounds = region.bounds();
  if (const auto* prism = std::get_if<PrismRegion>(&region.shape)) {
    corners = prism->corners;
  } else if (std::holds_alternative<Box>(region.shape)) {
    const Vec3 &a = bounds.min(), &b = bounds.max();
    corners = {{a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}, {a.x(), b.y()}};
  }
  Rng rng(seed);
  const double z = bounds.min().z(), height = bounds.max().z() - z;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    draw_side({corners[j].x(), corners[j].y(), z}, {corners[i].x(), corners[i].y(), z}, height, density, rng);
  }
}

void LandmarkField::draw_obstacle(std::size_t k, double density, std::uint64_t seed) {
  Rng rng(seed);
  const Vec3& h = world_->obstacles[k].half_extents();
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double side = face % 2 == 0 ? -1.0 : 1.0;
    for (int n = poisson(rng, density * 4.0 * h[u] * h[v]); n > 0; --n) {
      OnObstacle landmark{k, next_id(), Vec3::Zero(), Vec3::Zero()};
      landmark.normal[axis] = side;
      landmark.offset[axis] = side * h[axis];
      landmark.offset[u] = rng.uniform(-h[u], h[u]);
      landmark.offset[v] = rng.uniform(-h[v], h[v]);
      on_obstacles_.push_back(landmark);
    }
  }
}

void LandmarkField::draw_horizon(std::uint64_t seed) {
  Rng rng(seed);
  for (int n = poisson(rng, 2.0 * std::numbers::pi * spec_.horizon); n > 0; --n) {
    const double azimuth = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double up = rng.uniform(-kHorizonBand, kHorizonBand);
    Landmark landmark{next_id(), SurfaceClass::Horizon, {}};
    landmark.point.p = kHorizonM * Vec3(std::cos(azimuth), std::sin(azimuth), up);
    landmark.point.far = true;
    horizon_.push_back(landmark);
  }
}

double LandmarkField::ground_density(double x, double y) const {
  const Vec3 p(x, y, spec_.ground_z_m);
  for (const auto& [region, density] : regions_) {
    if (covers(region, p)) return density;
  }
  return spec_.ground;
}

const std::vector<Landmark>& LandmarkField::cell(int i, int j) {
  const std::uint64_t number = cell_number(i, j);
  const auto [entry, is_new] = cells_.try_emplace(number);
  std::vector<Landmark>& landmarks = entry->second;
  if (!is_new) return landmarks;
  Rng rng(mixed(digest("ground", seed_), number));
  const int count = poisson(rng, largest_ * kCell * kCell);
  for (int k = 0; k < count; ++k) {
    const double x = kCell * (i + rng.uniform()), y = kCell * (j + rng.uniform());
    const double keep = rng.uniform();
    if (keep * largest_ >= ground_density(x, y)) continue;
    Landmark landmark{(number + 1) * kPerCell + static_cast<std::uint64_t>(k), SurfaceClass::Ground, {}};
    landmark.point.p = Vec3(x, y, spec_.ground_z_m);
    landmark.point.normal = Vec3::UnitZ();
    landmarks.push_back(landmark);
  }
  return landmarks;
}

void LandmarkField::add_ground(const Vec3& eye, double reach_m, std::vector<Landmark>& to) {
  const auto index = [](double x) { return static_cast<int>(std::floor(x / kCell)); };
  for (int i = index(eye.x() - reach_m); i <= index(eye.x() + reach_m); ++i) {
    for (int j = index(eye.y() - reach_m); j <= index(eye.y() + reach_m); ++j) {
      for (const Landmark& landmark : cell(i, j)) {
        if ((landmark.point.p - eye).head<2>().norm() <= reach_m) to.push_back(landmark);
      }
    }
  }
}

std::vector<Landmark> LandmarkField::around(const Vec3& eye, double range_m, double grazing_rad, double t_s) {
  std::vector<Landmark> found;
  const double height = eye.z() - spec_.ground_z_m;
  const double reach = std::min(range_m, height / std::max(std::tan(grazing_rad), 1e-9));
  if (height > 0.0) add_ground(eye, reach, found);
  for (const Landmark& side : fixed_) {
    if ((side.point.p - eye).norm() <= range_m) found.push_back(side);
  }
  for (const OnObstacle& on : on_obstacles_) {
    const WorldObstacle& obstacle = world_->obstacles[on.obstacle];
    if (!obstacle.present(t_s)) continue;
    const ObstacleState state = obstacle.at(t_s);
    if ((state.p + on.offset - eye).norm() > range_m) continue;
    Landmark landmark{on.id, obstacle.moves() ? SurfaceClass::Mover : SurfaceClass::Obstacle, {}};
    landmark.point.p = state.p + on.offset;
    landmark.point.v = state.v;
    landmark.point.normal = on.normal;
    found.push_back(landmark);
  }
  for (Landmark landmark : horizon_) {
    landmark.point.p += eye;
    found.push_back(landmark);
  }
  std::sort(found.begin(), found.end(), [](const Landmark& a, const Landmark& b) { return a.id < b.id; });
  return found;
}

}  // namespace tern
