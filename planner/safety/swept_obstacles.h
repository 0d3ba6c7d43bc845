// The sweeps of all obstacles over one horizon, per time interval (paper §3.2). See docs/planner/separation.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/swept_boxes.h"
#include "core/world/alpha_share.h"
#include "core/world/track.h"
#include "core/world/track_sweep.h"
#include "core/world/vehicle.h"
#include "planner/safety/time_part.h"

namespace tern {

/// Boxes around a moving track over whole pieces of its motion, as Track::bounds() returns them. They are made once per
/// prediction set, to save work.
struct MotionBoxes {
  Box whole;                    ///< over all pieces
  UTime end;                    ///< end of the last piece
  std::span<const Box> pieces;  ///< over each piece
};

/// An obstacle of one request: a track, or a static box of the map.
struct PlanningObstacle {
  std::int64_t id = 0;           ///< track id; −1 − k for the k-th box of the map
  const Track* track = nullptr;  ///< null for a box of the map
  /// A box of the map, grown by its margin. For a track a box around it over all times of interest, W.
  Box box;
  /// The share of the track's α that applies: reduced by the assurance, and if the start is relaxed. For a box of the
  /// map its scale is that of the margin.
  AlphaShare alpha;
  const MotionBoxes* boxes = nullptr;  ///< boxes of the track's motion; null if they are not known
  double margin = 0.0;                 ///< by which the box of the map is grown on each side: PoseError::margin(), m

  [[nodiscard]] bool moves() const { return track != nullptr && track->kind != TrackKind::Static; }
  /// Returns the box of the map with this scale of its margin. @pre track is null
  [[nodiscard]] Box map_box(double scale) const { return grown(box, Vec3::Constant((scale - 1.0) * margin)); }
  /// Reduced assurances leave the α of such an obstacle as it is.
  [[nodiscard]] bool is_declared_or_static() const { return track == nullptr || track->kind != TrackKind::Estimated; }
  /// Returns when its last piece ends. @pre track is not null
  [[nodiscard]] UTime motion_end() const { return boxes != nullptr ? boxes->end : track->motion.end(); }
};

/// An interval or a part of it, rounded outwards to whole microseconds.
struct UTimeSpan {
  UTime from, to;
};

/// Sweeps of obstacles over the intervals [times[k], times[k+1]] and their parts (TimePart). Separation tests on them
/// are in interval_separation.h.
///
///     C_ij = conv( V_i^o ⊕ (−V^U) ⊕ box(α_ij) ⊕ box(β_ij)  along the predicted motion ξ_i )          (paper §3.2)
///
/// The radius of a spherical body is not part of the hull: it is the clearance that separation requires. The sweep is
/// the convex hull of the boxes of track_sweep.h, which defines β. Most tests use those boxes; only published planes
/// and `method: joint` need the vertices of the hull.
///
/// assign() finds the neighbours of each interval. Sweeps, their boxes and hulls are pure functions of what was
/// assigned; SeparationCache keeps their results. The object keeps its memory: once it has seen the largest horizon,
/// assign() allocates nothing.
class SweptObstacles {
 public:
  /// Has no interval until assign().
  SweptObstacles() = default;
  SweptObstacles(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                 const std::vector<double>& times, const Box& region) {
    assign(obstacles, body, origin, times, region);
  }

  /// @param obstacles  must stay alive until the next assign()
  /// @param origin     the time that `times` counts from
  /// @param times      seconds after origin, at least two, strictly ascending. @throws std::invalid_argument for fewer
  /// @param region     box of the body's centre, W; obstacles that the body cannot touch from there are left out
  void assign(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
              std::span<const double> times, const Box& region);

  [[nodiscard]] int intervals() const { return static_cast<int>(times_.size()) - 1; }
  [[nodiscard]] double time(int k) const { return times_[idx(k)]; }

  /// An obstacle that the body may touch in an interval.
  struct Neighbour {
    Box box;       ///< the sweep grown by the whole body: the body touches it only if its centre is inside, W
    int obstacle;  ///< index into the list of assign()
    int slot;      ///< number of its sweeps, 0 … slots() − 1; one obstacle at rest has the same in all intervals
  };
  [[nodiscard]] const std::vector<Neighbour>& neighbours(int interval) const { return neighbours_[idx(interval)]; }
  [[nodiscard]] int slots() const { return slots_; }

  /// Appends the boxes whose convex hull is C_ij over a part. For a body that is neither a sphere nor a box they
  /// exclude the body.
  void append_sweep(std::vector<CentredBox>& boxes, const Neighbour& neighbour, const TimePart& part) const;
  /// Returns the extreme points of C_ij, made of all boxes of its sweep.
  [[nodiscard]] Points hull(const Neighbour& neighbour, std::span<const CentredBox> boxes) const;
  /// Returns whether hull() needs CGAL.
  [[nodiscard]] bool hull_is_made_by_cgal(const Neighbour& neighbour) const {
    return obstacle(neighbour).moves() || !body_is_box_;
  }
  /// Returns Neighbour::box for that part alone.
  [[nodiscard]] Box part_box(const Neighbour& neighbour, const TimePart& part) const;
  /// The instants k = 0 … 4 at the quarters of an interval.
  static constexpr int kQuarters = 5;
  /// Returns the obstacle's box (with α, without β) at a quarter of the interval. If the curve's point at that time is
  /// nearer to it than the radius, no part of the interval is separated.
  /// @pre the body is a sphere or a box
  [[nodiscard]] CentredBox box_at_quarter(int interval, const Neighbour& neighbour, int k) const;

  [[nodiscard]] const PlanningObstacle& obstacle(const Neighbour& c) const { return (*obstacles_)[idx(c.obstacle)]; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] bool body_is_round_or_box() const { return body_is_box_; }
  /// Returns the body's vertices if the sweeps exclude the body, else none.
  [[nodiscard]] const Points& vertices_to_add() const { return body_is_box_ ? no_vertices_ : body_.vertices; }
  /// Returns how many pairs of obstacle and interval were left out because they cannot touch the region.
  [[nodiscard]] std::int64_t pairs_out_of_reach() const { return out_of_reach_; }

 private:
  struct Span {
    double from, to;
  };

  void add_track(int index, const Box& region);
  void add_static(int index, const Box& region);
  [[nodiscard]] Span span(const TimePart& part) const;
  [[nodiscard]] CentredBox box_at_rest(const PlanningObstacle& obstacle) const;

  const std::vector<PlanningObstacle>* obstacles_ = nullptr;
  Body body_;
  Vec3 body_half_ = Vec3::Zero();  ///< half-extents of the whole body, m
  Vec3 box_half_ = Vec3::Zero();   ///< half-extents that the body adds to the obstacles' boxes, m
  bool body_is_box_ = true;        ///< the body is a sphere or a box: it adds half-extents, and no vertices
  UTime origin_;
  std::vector<double> times_;
  std::vector<UTimeSpan> spans_;  ///< one per interval
  std::vector<std::vector<Neighbour>> neighbours_;
  int slots_ = 0;
  std::int64_t out_of_reach_ = 0;
  Points no_vertices_{3, 0};
};

}  // namespace tern
