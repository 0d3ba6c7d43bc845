// The sweeps of all obstacles over one horizon, per time interval: boxes first, sweeps and hulls C_ij when needed
// (paper §3.2). See docs/planner/separation.md.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
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
  Box box;           ///< the box of the map, not inflated; for a track a box around it over all times of interest, W
  AlphaShare alpha;  ///< the share of the track's α that applies: reduced by the assurance, and if the start is relaxed
  const MotionBoxes* boxes = nullptr;  ///< boxes of the track's motion; null if they are not known

  [[nodiscard]] bool moves() const { return track != nullptr && track->kind != TrackKind::Static; }
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
/// assign() makes the boxes of all neighbours. Sweeps and hulls are made at first use, each a pure function of its
/// inputs. The object keeps its memory: once it has seen the largest horizon, boxes and sweeps allocate nothing. Hulls
/// are allocated by CGAL.
class SweptObstacles {
 public:
  /// Has no interval until assign().
  SweptObstacles() = default;
  SweptObstacles(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                 const std::vector<double>& times, const Box& region) {
    assign(obstacles, body, origin, times, region);
  }
  SweptObstacles(SweptObstacles&&) = default;
  SweptObstacles& operator=(SweptObstacles&&) = default;

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
    int slot;      ///< index of its sweeps and hulls
  };
  [[nodiscard]] const std::vector<Neighbour>& neighbours(int interval) const { return neighbours_[idx(interval)]; }
  /// The boxes whose convex hull is C_ij over a part, valid until the next call. For a body that is neither a sphere
  /// nor a box they exclude the body.
  struct Sweep {
    std::span<const CentredBox> boxes;
    /// The direction that last separated this sweep; zero if there is none. It saves time and changes no answer.
    /// assign() clears it together with the boxes.
    Vec3& last_direction;
  };
  Sweep sweep(const Neighbour& neighbour, const TimePart& part);
  /// Returns the extreme points of C_ij over that part, valid until the next assign().
  const Points& hull(const Neighbour& neighbour, const TimePart& part);
  /// Returns Neighbour::box for that part alone.
  const Box& part_box(const Neighbour& neighbour, const TimePart& part);
  /// Returns the obstacle's box (with α, without β) at the quarter k of the interval, k = 0 … 4. If the curve's point
  /// at that time is nearer to it than the radius, no part of the interval is separated.
  /// @pre the body is a sphere or a box
  static constexpr int kQuarters = 5;
  const CentredBox& at_quarter(int interval, const Neighbour& neighbour, int k);

  /// Returns the neighbour that last blocked a curve in this interval; −1 if none has.
  int& last_blocker(int interval) { return last_blocker_[idx(interval)]; }

  [[nodiscard]] const PlanningObstacle& obstacle(const Neighbour& c) const { return (*obstacles_)[idx(c.obstacle)]; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] bool body_is_round_or_box() const { return body_is_box_; }
  /// Returns the body's vertices if the sweeps exclude the body, else none.
  [[nodiscard]] const Points& vertices_to_add() const { return body_is_box_ ? no_vertices_ : body_.vertices; }
  /// Returns how many hulls CGAL has made; static obstacles need none.
  [[nodiscard]] std::int64_t hulls_made() const { return hulls_made_; }
  /// Returns how many pairs of obstacle and interval were left out because they cannot touch the region.
  [[nodiscard]] std::int64_t pairs_out_of_reach() const { return out_of_reach_; }

 private:
  struct Span {
    double from, to;
  };
  /// Results for one part of one neighbour.
  struct Part {
    int first = -1, count = 0;      ///< its boxes in boxes_; −1 until made
    int hull = -1;                  ///< its hull in hulls_; −1 until made
    Vec3 direction = Vec3::Zero();  ///< Sweep::last_direction
    Box box;                        ///< part_box(); empty until made
  };
  /// Results for one neighbour, once more than its box is needed.
  struct Slot {
    std::array<Part, TimePart::kSlots> parts;
    std::array<CentredBox, kQuarters> quarters;
    bool has_quarters = false;
  };

  void add_track(int index, const Box& region);
  void add_static(int index, const Box& region);
  [[nodiscard]] Span span(const TimePart& part) const;
  Slot& slot_of(const Neighbour& neighbour);
  Part& part_of(const Neighbour& neighbour, const TimePart& part);
  Part& swept_part_of(const Neighbour& neighbour, const TimePart& part);
  [[nodiscard]] std::span<const CentredBox> boxes_of(const Part& made) const {
    return {&boxes_[idx(made.first)], static_cast<std::size_t>(made.count)};
  }
  void make_sweep(const PlanningObstacle& obstacle, Span span);
  [[nodiscard]] Points make_hull(std::span<const CentredBox> boxes) const;

  const std::vector<PlanningObstacle>* obstacles_ = nullptr;
  Body body_;
  Vec3 body_half_ = Vec3::Zero();  ///< half-extents of the whole body, m
  Vec3 box_half_ = Vec3::Zero();   ///< half-extents that the body adds to the obstacles' boxes, m
  bool body_is_box_ = true;        ///< the body is a sphere or a box: it adds half-extents, and no vertices
  UTime origin_;
  std::vector<double> times_;
  std::vector<UTimeSpan> spans_;  ///< one per interval
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<int> last_blocker_;
  std::vector<int> slots_;  ///< by Neighbour::slot: index into made_; −1 until made
  std::vector<Slot> made_;
  std::vector<CentredBox> boxes_;  ///< the boxes of all sweeps
  std::deque<Points> hulls_;       ///< a deque, so that references stay valid
  std::size_t hulls_used_ = 0;
  std::int64_t hulls_made_ = 0, out_of_reach_ = 0;
  Points no_vertices_{3, 0};
};

}  // namespace tern
