#include "simulator/worlds/coarse_motions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/splines/piecewise_cubic.h"
#include "core/world/resampling.h"
#include "simulator/worlds/declared_motions.h"

namespace tern {
namespace {

class Coarsening {
 public:
  Coarsening(const WorldObstacle& obstacle, Duration window, std::size_t pieces)
      : obstacle_(obstacle), window_(window), pieces_(pieces) {}

  [[nodiscard]] std::optional<CoarseMotion> of(const TrefoilMotion& m) const {
    return of_oscillation(Vec3(3, 3, 1).cwiseProduct(m.scale.cwiseAbs()));
  }

  [[nodiscard]] std::optional<CoarseMotion> of(const WaveMotion& m) const {
    return of_oscillation(m.amplitude.cwiseAbs());
  }

  [[nodiscard]] std::optional<CoarseMotion> of(const WaypointMotion& m) const {
    if (m.points.size() < 2) return std::nullopt;
    const Duration last = Duration::from_seconds(m.points.back().first);
    const Duration first = Duration::from_seconds(m.points.front().first);
    const double windows = (last - (m.repeat ? first : std::max(first, Duration{}))).seconds() / window_.seconds();
    const double most = std::floor(static_cast<double>(pieces_) * (m.repeat ? windows : std::max(1.0, windows)));
    if (static_cast<double>(m.points.size() - 1) <= most) return std::nullopt;
    if (most < 1.0) return CoarseMotion(places_of(m));
    Track way = way_of(m);
    if (way.motion.pieces.empty()) return std::nullopt;
    return CoarseMotion(resampled(way, static_cast<std::size_t>(most)));
  }

  [[nodiscard]] static std::optional<CoarseMotion> of(const StaticMotion&) { return std::nullopt; }
  [[nodiscard]] static std::optional<CoarseMotion> of(const LinearMotion&) { return std::nullopt; }

 private:
  [[nodiscard]] std::optional<CoarseMotion> of_oscillation(const Vec3& reach) const {
    if (!obstacle_.moves()) return std::nullopt;
    const Duration own = fit_piece(obstacle_.bounds());
    const Box places = box_around(obstacle_.spec().centre, reach);
    if (pieces_ < 2) return CoarseMotion(places);
    const std::int64_t gaps = static_cast<std::int64_t>(pieces_) - 1;
    const std::int64_t units = (window_.us + gaps * kGridUnit.us - 1) / (gaps * kGridUnit.us);
    const Duration h = std::max(own, kGridUnit * units);
    const Vec3& fourth = obstacle_.bounds().fourth;
    if (hermite_error_bound(h.seconds(), fourth.maxCoeff()) > reach.maxCoeff()) return CoarseMotion(places);
    if (h == own) return std::nullopt;
    return CoarseMotion(h);
  }

  [[nodiscard]] static Box places_of(const WaypointMotion& m) {
    Box places;
    for (const auto& [t, p] : m.points) places.extend(p);
    return places;
  }

  /// The segments as pieces. Before world time 0 the obstacle rests, so a path that does not repeat begins there.
  [[nodiscard]] static Track way_of(const WaypointMotion& m) {
    Track way;
    for (std::size_t i = 0; i + 1 < m.points.size(); ++i) {
      const Duration begin = Duration::from_seconds(m.points[i].first);
      const Duration end = Duration::from_seconds(m.points[i + 1].first);
      const Duration from = m.repeat ? begin : std::max(begin, Duration{});
      if (from >= end) continue;
      const Vec3 v = (m.points[i + 1].second - m.points[i].second) / (m.points[i + 1].first - m.points[i].first);
      CubicPiece piece{end - from, PowerCubic::Zero()};
      piece.coefficients.col(2) = v;
      piece.coefficients.col(3) = m.points[i].second + v * (from - begin).seconds();
      if (way.motion.pieces.empty()) way.motion.start = UTime{} + from;
      way.motion.pieces.push_back(piece);
    }
    way.alpha.resize(way.motion.pieces.size(), Vec3::Zero());
    return way;
  }

  const WorldObstacle& obstacle_;
  Duration window_;
  std::size_t pieces_;
};

}  // namespace

CoarseMotions coarse_motions(const World& world, Duration window, std::size_t pieces) {
  CoarseMotions coarse;
  for (const WorldObstacle& o : world.obstacles) {
    auto motion = std::visit([&](const auto& m) { return Coarsening(o, window, pieces).of(m); }, o.spec().motion);
    if (motion) coarse.emplace(o.id(), std::move(*motion));
  }
  return coarse;
}

PresentCount max_present(const World& world, Duration after) {
  PresentCount most;
  std::size_t always = 0;
  std::vector<std::pair<double, int>> changes;  // at a time, arrivals before departures
  for (const WorldObstacle& o : world.obstacles) {
    const bool vanishes = std::isfinite(o.first_s()) || std::isfinite(o.last_s());
    if (!vanishes) {
      ++(o.moves() ? always : most.resting);
      continue;
    }
    changes.emplace_back(o.first_s(), -1);
    changes.emplace_back(o.last_s() + after.seconds(), 1);
  }
  std::sort(changes.begin(), changes.end());
  std::size_t now = always;
  most.moving = always;
  for (const auto& [t, change] : changes) {
    change < 0 ? ++now : --now;
    most.moving = std::max(most.moving, now);
  }
  return most;
}

}  // namespace tern
