#include "simulator/inertial/track_simulator.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tern {
namespace {

using Cell = std::pair<int, int>;

const Landmark* find(const std::vector<Landmark>& landmarks, std::uint64_t id) {
  const auto at = std::lower_bound(landmarks.begin(), landmarks.end(), id,
                                   [](const Landmark& landmark, std::uint64_t wanted) { return landmark.id < wanted; });
  return at != landmarks.end() && at->id == id ? &*at : nullptr;
}

/// How well a landmark is recognized: the same in every frame.
std::uint64_t strength(std::uint64_t id) {
  std::uint64_t x = (id + 1) * 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  return x ^ (x >> 31);
}

}  // namespace

SimulatedTrack TrackSimulator::measure(const Followed& track, const Landmark& landmark, const StereoPixel& pixel) {
  const Eigen::Vector2d left = pixel.left + track.slip, right = left - Eigen::Vector2d(pixel.disparity, 0.0);
  const auto noise = [&] {
    const double u = rng_.normal(), v = rng_.normal();
    return Eigen::Vector2d(spec_.noise_px * Eigen::Vector2d(u, v));
  };
  SimulatedTrack measured{track.id, landmark.id,    landmark.surface,       left,
                          right,    pixel.in_right, !track.slip.isZero(0.0)};
  measured.left += noise();
  measured.right += noise();
  return measured;
}

void TrackSimulator::follow(const CameraFrame& frame, const std::vector<Landmark>& landmarks,
                            std::vector<SimulatedTrack>& to) {
  std::vector<Followed> kept;
  for (Followed& track : followed_) {
    const Landmark* landmark = find(landmarks, track.landmark);
    const auto pixel = landmark != nullptr ? frame.see(landmark->point) : std::nullopt;
    if (!pixel || frame.hides(landmark->point) || rng_.uniform() < spec_.lost) continue;
    if (rng_.uniform() < spec_.wrong) {
      const double u = rng_.uniform(-kSlip, kSlip), v = rng_.uniform(-kSlip, kSlip);
      track.slip += Eigen::Vector2d(u, v);
    }
    to.push_back(measure(track, *landmark, *pixel));
    kept.push_back(track);
  }
  followed_ = std::move(kept);
}

void TrackSimulator::begin(const CameraFrame& frame, const std::vector<Landmark>& landmarks,
                           std::vector<SimulatedTrack>& to) {
  const auto cell_of = [&](const Eigen::Vector2d& at) {
    return Cell{static_cast<int>(std::floor(at.x() / spec_.apart_px)),
                static_cast<int>(std::floor(at.y() / spec_.apart_px))};
  };
  std::set<Cell> taken;
  std::set<std::uint64_t> tracked;
  for (const SimulatedTrack& track : to) {
    taken.insert(cell_of(track.left));
    tracked.insert(track.landmark);
  }
  std::vector<std::pair<std::uint64_t, const Landmark*>> order;
  for (const Landmark& landmark : landmarks) {
    if (tracked.count(landmark.id) == 0) order.emplace_back(strength(landmark.id), &landmark);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [hash, landmark] : order) {
    if (std::ssize(to) >= spec_.at_most) return;
    const auto pixel = frame.see(landmark->point);
    if (!pixel || taken.count(cell_of(pixel->left)) > 0 || frame.hides(landmark->point)) continue;
    taken.insert(cell_of(pixel->left));
    followed_.push_back({++last_id_, landmark->id, Eigen::Vector2d::Zero()});
    to.push_back(measure(followed_.back(), *landmark, *pixel));
  }
}

std::vector<SimulatedTrack> TrackSimulator::observe(const CameraFrame& frame, const std::vector<Landmark>& landmarks) {
  std::vector<SimulatedTrack> tracks;
  follow(frame, landmarks, tracks);
  begin(frame, landmarks, tracks);
  return tracks;
}

}  // namespace tern
