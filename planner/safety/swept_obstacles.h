// The obstacles of one horizon, cut into time intervals: boxes first, hulls C_ij when first needed (paper §3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/track.h"
#include "core/world/vehicle.h"

namespace tern {

/// β ≤ this, m: how far a hull may exceed the true sweep because motion is sampled.
inline constexpr double kBetaMax = 0.005;

/// An obstacle as the planner takes it: a track, or a box of the map that never moves.
struct PlanningObstacle {
  std::int64_t id = 0;           ///< track id; −1 − k: the k-th box of the map
  const Track* track = nullptr;  ///< null: a static box
  Box box;  ///< the static box (not inflated by the body); for a track: holds it over all times of interest
  double alpha_scale = 1.0;  ///< < 1 when the start lay inside the obstacle inflated by its α

  [[nodiscard]] bool moves() const { return track != nullptr && track->kind != TrackKind::Static; }
};

/// Hulls of obstacles over the intervals [times[k], times[k+1]], each perhaps split into 2 or 4 parts of equal time.
///
/// C_ij = conv of V_i^o ⊕ (−V^U) ⊕ box(α_ij) ⊕ box(β_ij) along the predicted motion (paper §3.2). A sphere's radius is
/// not in the hull: it is the clearance that separation asks for. β: within a cubic piece |ξ''| ≤ a per axis, and the
/// chord between samples h apart leaves the curve by at most a h²/8; samples stand at every piece break and h keeps β ≤
/// kBetaMax. Boxes of all candidates are made at construction, hulls lazily; a hull is a pure function of its inputs.
class SweptObstacles {
 public:
  /// @param obstacles  kept alive by the caller for the life of this object
  /// @param origin     the time that `times` counts from
  /// @param times      seconds since origin, strictly ascending, ≥ 2
  /// @param region     only obstacles that the body can touch while its centre is in this box are kept, W
  SweptObstacles(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                 std::vector<double> times, const Box& region);

  [[nodiscard]] int intervals() const { return static_cast<int>(times_.size()) - 1; }
  [[nodiscard]] double time(int k) const { return times_[static_cast<std::size_t>(k)]; }

  /// An obstacle that may matter in an interval.
  struct Candidate {
    Box box;       ///< where the vehicle's centre may touch it: the sweep grown by the whole body
    int obstacle;  ///< index into the constructor's list
    int slot;      ///< where its hulls are kept
  };
  [[nodiscard]] const std::vector<Candidate>& candidates(int interval) const {
    return candidates_[static_cast<std::size_t>(interval)];
  }
  /// The extreme points of C_ij over part `part` of `parts` (1, 2, 4) of the interval. Valid until this object dies.
  const Points& hull(int interval, const Candidate& candidate, int part, int parts);
  /// As Candidate::box, of that part alone.
  [[nodiscard]] Box part_box(int interval, const Candidate& candidate, int part, int parts) const;

  [[nodiscard]] const PlanningObstacle& obstacle(const Candidate& c) const {
    return obstacles_[static_cast<std::size_t>(c.obstacle)];
  }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] std::int64_t hulls_made() const { return hulls_made_; }

 private:
  struct Span {
    double from, to;
  };
  [[nodiscard]] Span span(int interval, int part, int parts) const;
  [[nodiscard]] Points make_hull(const PlanningObstacle& obstacle, Span span) const;

  const std::vector<PlanningObstacle>& obstacles_;
  Body body_;
  bool body_is_box_;  ///< the body adds half-extents; its vertices are never multiplied out
  UTime origin_;
  std::vector<double> times_;
  std::vector<std::vector<Candidate>> candidates_;
  std::vector<Points> hulls_;  ///< per slot: the whole, 2 halves, 4 quarters; no columns: not made yet
  std::int64_t hulls_made_ = 0;
};

}  // namespace tern
