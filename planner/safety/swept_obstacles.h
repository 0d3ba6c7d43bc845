// The obstacles of one horizon, cut into time intervals: boxes first, sweeps and hulls C_ij when first needed (paper
// §3.2).
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

/// Boxes that hold a moving track over whole pieces of its motion, as Track::bounds() has them. They are made once per
/// prediction set and spare work.
struct MotionBoxes {
  Box whole;                    ///< over all pieces
  UTime end;                    ///< of the last piece
  std::span<const Box> pieces;  ///< over each
};

/// An obstacle as the planner takes it: a track, or a box of the map that never moves.
struct PlanningObstacle {
  std::int64_t id = 0;           ///< track id; −1 − k: the k-th box of the map
  const Track* track = nullptr;  ///< null: a static box
  Box box;           ///< the static box (not inflated by the body); for a track: holds it over all times of interest
  AlphaShare alpha;  ///< what counts of the track's α: less where the plan is not promised, or its start lies inside
  const MotionBoxes* boxes = nullptr;  ///< of the track's motion; null: not known

  [[nodiscard]] bool moves() const { return track != nullptr && track->kind != TrackKind::Static; }
  /// Whether where it will be is promised, not estimated.
  [[nodiscard]] bool is_declared_or_static() const { return track == nullptr || track->kind != TrackKind::Estimated; }
  /// When its last piece ends. @pre it has a track
  [[nodiscard]] UTime motion_end() const { return boxes != nullptr ? boxes->end : track->motion.end(); }
};

/// Whole microseconds around an interval or its part.
struct UTimeSpan {
  UTime from, to;
};

/// Sweeps of obstacles over the intervals [times[k], times[k+1]] and their parts (TimePart): what there is, not what is
/// asked of it (interval_separation.h).
///
/// C_ij = conv of V_i^o ⊕ (−V^U) ⊕ box(α_ij) ⊕ box(β_ij) along the predicted motion (paper §3.2). A sphere's radius is
/// not in the hull: it is the clearance that separation asks for. The sweep is conv of the boxes of track_sweep.h,
/// which says what β is. Most questions are asked of those boxes themselves. Only published planes and `method: joint`
/// need the hull's vertices. Boxes of all candidates are made by assign(), sweeps and hulls lazily; each is a pure
/// function of its inputs.
///
/// The object keeps its memory from one assign() to the next. Once it has seen the largest horizon, boxes and sweeps
/// allocate nothing (hulls do, in CGAL).
class SweptObstacles {
 public:
  /// Holds no interval until assign().
  SweptObstacles() = default;
  SweptObstacles(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                 const std::vector<double>& times, const Box& region) {
    assign(obstacles, body, origin, times, region);
  }
  SweptObstacles(SweptObstacles&&) = default;
  SweptObstacles& operator=(SweptObstacles&&) = default;

  /// @param obstacles  kept alive by the caller until the next assign()
  /// @param origin     the time that `times` counts from
  /// @param times      seconds since origin, strictly ascending, ≥ 2. @throws std::invalid_argument for fewer
  /// @param region     only obstacles that the body can touch while its centre is in this box are kept, W
  void assign(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
              std::span<const double> times, const Box& region);

  [[nodiscard]] int intervals() const { return static_cast<int>(times_.size()) - 1; }
  [[nodiscard]] double time(int k) const { return times_[idx(k)]; }

  /// An obstacle that may matter in an interval.
  struct Candidate {
    Box box;       ///< where the vehicle's centre may touch it: the sweep grown by the whole body
    int obstacle;  ///< index into the list of assign()
    int slot;      ///< where its sweeps and hulls are kept
  };
  [[nodiscard]] const std::vector<Candidate>& candidates(int interval) const { return candidates_[idx(interval)]; }
  /// The boxes whose convex hull is C_ij (for a body that is neither a sphere nor a box: without the body) over a part.
  /// Both are valid until the next call.
  struct Sweep {
    std::span<const CentredBox> boxes;
    /// Memory of the narrow phase: what separated it last; zero: none yet. It saves time and changes no answer. It
    /// stands beside the boxes because it is theirs: found with them, and forgotten with them by assign().
    Vec3& last_direction;
  };
  Sweep sweep(const Candidate& candidate, const TimePart& part);
  /// The extreme points of C_ij over that part. Valid until the next assign().
  const Points& hull(const Candidate& candidate, const TimePart& part);
  /// As Candidate::box, of that part alone.
  const Box& part_box(const Candidate& candidate, const TimePart& part);
  /// Where the obstacle's box (with α, without β) is at the quarter k of the interval, k = 0 … 4. A curve whose point
  /// of that time comes nearer than the radius is separated in no part. Not for bodies that are neither spheres nor
  /// boxes.
  static constexpr int kQuarters = 5;
  const CentredBox& at_quarter(int interval, const Candidate& candidate, int k);

  /// The same for an interval: the candidate that blocked a curve in it last; −1: none yet.
  int& last_blocker(int interval) { return last_blocker_[idx(interval)]; }

  [[nodiscard]] const PlanningObstacle& obstacle(const Candidate& c) const { return (*obstacles_)[idx(c.obstacle)]; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] bool body_is_round_or_box() const { return body_is_box_; }
  /// What the sweeps lack of the body: its vertices where it is neither a sphere nor a box, else none.
  [[nodiscard]] const Points& vertices_to_add() const { return body_is_box_ ? no_vertices_ : body_.vertices; }
  /// By CGAL: what stands still needs none.
  [[nodiscard]] std::int64_t hulls_made() const { return hulls_made_; }
  /// Pairs of obstacle and interval that were dropped because they cannot reach the region.
  [[nodiscard]] std::int64_t pairs_out_of_reach() const { return out_of_reach_; }

 private:
  struct Span {
    double from, to;
  };
  /// What is kept of one part of one candidate.
  struct Part {
    int first = -1, count = 0;      ///< its boxes in boxes_; −1: not made yet
    int hull = -1;                  ///< its hull in hulls_
    Vec3 direction = Vec3::Zero();  ///< Sweep::last_direction
    Box box;                        ///< part_box(); empty: not made yet
  };
  /// What is kept of one candidate, once it is more than a box.
  struct Slot {
    std::array<Part, TimePart::kSlots> parts;
    std::array<CentredBox, kQuarters> quarters;
    bool has_quarters = false;
  };

  void add_track(int index, const Box& region);
  void add_static(int index, const Box& region);
  [[nodiscard]] Span span(const TimePart& part) const;
  Slot& slot_of(const Candidate& candidate);
  Part& part_of(const Candidate& candidate, const TimePart& part);
  Part& swept_part_of(const Candidate& candidate, const TimePart& part);
  [[nodiscard]] std::span<const CentredBox> boxes_of(const Part& made) const {
    return {&boxes_[idx(made.first)], static_cast<std::size_t>(made.count)};
  }
  void make_sweep(const PlanningObstacle& obstacle, Span span);
  [[nodiscard]] Points make_hull(std::span<const CentredBox> boxes) const;

  const std::vector<PlanningObstacle>* obstacles_ = nullptr;
  Body body_;
  Vec3 body_half_ = Vec3::Zero();  ///< of the whole body
  Vec3 box_half_ = Vec3::Zero();   ///< what the body adds to the obstacles' boxes
  bool body_is_box_ = true;        ///< the body adds half-extents; its vertices are never multiplied out
  UTime origin_;
  std::vector<double> times_;
  std::vector<UTimeSpan> spans_;  ///< of the intervals
  std::vector<std::vector<Candidate>> candidates_;
  std::vector<int> last_blocker_;
  std::vector<int> slots_;  ///< [Candidate::slot]: its place in made_, −1: nothing made yet
  std::vector<Slot> made_;
  std::vector<CentredBox> boxes_;  ///< of all sweeps
  std::deque<Points> hulls_;       ///< references stay valid
  std::size_t hulls_used_ = 0;
  std::int64_t hulls_made_ = 0, out_of_reach_ = 0;
  Points no_vertices_{3, 0};
};

}  // namespace tern
