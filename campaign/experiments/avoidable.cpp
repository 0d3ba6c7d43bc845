#include "campaign/experiments/avoidable.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/world/body.h"

namespace tern {
namespace {

constexpr double kStep = 0.005;  // s
constexpr double kMinDistance = 0.05, kMaxDistance = 12.0;
/// The largest |p'|, |p''|, |p'''| of s³ (10 − 15 s + 6 s²) on [0, 1].
constexpr double kPeakSpeed = 1.875, kPeakJerk = 60.0;
const double kPeakAcceleration = 10.0 / std::sqrt(3.0);

/// Returns the least duration of a move by d within the limits, s.
double least_time(const Vec3& d, const Limits& limits) {
  double least = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = std::abs(d[axis]);
    least =
        std::max({least, kPeakSpeed * way / limits.v_max[axis], std::sqrt(kPeakAcceleration * way / limits.a_max[axis]),
                  std::cbrt(kPeakJerk * way / limits.j_max[axis])});
  }
  return least;
}

struct Move {
  double begin_s = 0.0, duration_s = 1.0;
  Vec3 by = Vec3::Zero();

  [[nodiscard]] Vec3 at(double t) const {
    const double s = std::clamp((t - begin_s) / duration_s, 0.0, 1.0);
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) * by;
  }
};

Move random_move(Rng& rng, const Limits& limits, double from_s, double until_s) {
  Move move;
  move.begin_s = rng.uniform(from_s, until_s);
  const double z = rng.uniform(-1.0, 1.0);
  const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  const double distance = kMinDistance * std::pow(kMaxDistance / kMinDistance, rng.uniform());
  move.by = distance * Vec3(r * std::cos(azimuth), r * std::sin(azimuth), z);
  const double slower = rng.uniform();
  move.duration_s = std::max(kStep, least_time(move.by, limits) * (1.0 + 3.0 * slower * slower));
  return move;
}

/// The centre of every obstacle at each step.
std::vector<std::vector<Vec3>> sampled(const World& world, double until_s) {
  std::vector<std::vector<Vec3>> all;
  for (const WorldObstacle& obstacle : world.obstacles) {
    auto& centres = all.emplace_back();
    for (int k = 0; k * kStep <= until_s; ++k) centres.push_back(obstacle.at(k * kStep).p);
  }
  return all;
}

}  // namespace

int clear_moves(const RestingVehicle& vehicle, const World& world, std::uint64_t seed, const MoveSearch& search,
                int enough) {
  Rng rng(seed);
  const auto centres = sampled(world, search.until_s);
  const Box body = body_box(vehicle.body);
  const Box room = places_within(vehicle.flight_box, body);
  std::vector<Box> reach;  ///< of positions relative to the obstacle's centre
  for (const WorldObstacle& o : world.obstacles) {
    reach.push_back(grown(places_at(box_around(Vec3::Zero(), o.half_extents()), body), Vec3::Constant(search.margin)));
  }
  const auto is_clear = [&](const Move& first, const Move& second) {
    for (std::size_t k = 0; static_cast<double>(k) * kStep <= search.until_s; ++k) {
      const double t = static_cast<double>(k) * kStep;
      const Vec3 p = vehicle.start + first.at(t) + second.at(t);
      if (!room.contains(p)) return false;
      for (std::size_t i = 0; i < centres.size(); ++i) {
        const Vec3 apart = p - centres[i][k];
        if ((apart.array() > reach[i].min().array()).all() && (apart.array() < reach[i].max().array()).all())
          return false;
      }
    }
    return true;
  };
  int clear = 0;
  for (int n = 0; n < search.moves && clear < enough; ++n) {
    const Move first = random_move(rng, vehicle.limits, search.earliest_s, 0.6 * search.until_s);
    Move second;
    if (n % 2 == 1) {
      second = random_move(rng, vehicle.limits, first.begin_s + first.duration_s, search.until_s);
    }
    if (is_clear(first, second)) ++clear;
  }
  return clear;
}

}  // namespace tern
