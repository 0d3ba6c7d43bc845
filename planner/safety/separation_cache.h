// The results that one caller has had of the sweeps of a horizon: they save time and change no answer.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "planner/safety/swept_obstacles.h"

namespace tern {

/// Keeps sweeps, hulls and boxes of SweptObstacles, and which direction and which obstacle decided last. Each is made
/// at first use. References and spans that it returns stay valid until the next start().
///
/// The object keeps its memory: once it has seen the largest horizon, it allocates hulls only, which CGAL does.
class SeparationCache {
 public:
  using Neighbour = SweptObstacles::Neighbour;

  /// Knows no obstacles until start().
  SeparationCache() = default;
  explicit SeparationCache(const SweptObstacles& obstacles) { start(obstacles); }

  /// Forgets everything.
  /// @param obstacles  must stay as they are while this cache is used
  void start(const SweptObstacles& obstacles);

  [[nodiscard]] const SweptObstacles& obstacles() const { return *obstacles_; }

  struct Sweep {
    std::span<const CentredBox> boxes;  ///< as SweptObstacles::append_sweep() makes them
    Vec3& last_direction;               ///< the direction that last separated this sweep; zero if there is none
  };
  Sweep sweep(const Neighbour& neighbour, const TimePart& part);
  const Points& hull(const Neighbour& neighbour, const TimePart& part);
  const Box& part_box(const Neighbour& neighbour, const TimePart& part);
  const CentredBox& at_quarter(int interval, const Neighbour& neighbour, int k);

  /// Returns the neighbour that last blocked a curve in this interval; −1 if none has.
  int& last_blocker(int interval) { return last_blocker_[idx(interval)]; }

  /// Returns how many hulls CGAL has made; static obstacles need none.
  [[nodiscard]] std::int64_t hulls_made() const { return hulls_made_; }

 private:
  /// Results for one part of one neighbour.
  struct Part {
    std::span<const CentredBox> boxes;  ///< empty until made
    int hull = -1;                      ///< its hull in hulls_; −1 until made
    Vec3 direction = Vec3::Zero();      ///< Sweep::last_direction
    Box box;                            ///< part_box(); empty until made
  };
  /// Results for one neighbour, once more than its box is needed.
  struct Slot {
    std::array<Part, TimePart::kSlots> parts;
    std::array<CentredBox, SweptObstacles::kQuarters> quarters;
    bool has_quarters = false;
  };
  /// Keeps lists of boxes where they are until clear().
  class Store {
   public:
    void clear();
    std::span<const CentredBox> keep(std::span<const CentredBox> boxes);

   private:
    std::vector<std::vector<CentredBox>> blocks_;  ///< each keeps its capacity
    std::size_t block_ = 0;                        ///< the one that is being filled
  };

  Slot& slot_of(const Neighbour& neighbour);
  Part& part_of(const Neighbour& neighbour, const TimePart& part);
  Part& swept_part_of(const Neighbour& neighbour, const TimePart& part);

  const SweptObstacles* obstacles_ = nullptr;
  std::vector<int> last_blocker_;
  std::vector<int> slots_;  ///< by Neighbour::slot: index into made_; −1 until made
  std::deque<Slot> made_;   ///< a deque, as hulls_, so that references stay valid
  std::size_t made_used_ = 0;
  std::vector<CentredBox> scratch_;
  Store boxes_;
  std::deque<Points> hulls_;
  std::size_t hulls_used_ = 0;
  std::int64_t hulls_made_ = 0;
};

/// The sweeps of a horizon, and the results that its owner has had of them.
struct SweptHorizon {
  SweptHorizon() = default;
  SweptHorizon(const SweptHorizon&) = delete;  ///< the cache knows the obstacles by their address
  SweptHorizon& operator=(const SweptHorizon&) = delete;

  SweptObstacles obstacles;
  SeparationCache cache;

  /// Assigns the obstacles (SweptObstacles::assign) and starts the cache with them.
  SeparationCache& assign(const std::vector<PlanningObstacle>& list, const Body& body, UTime origin,
                          std::span<const double> times, const Box& region) {
    obstacles.assign(list, body, origin, times, region);
    cache.start(obstacles);
    return cache;
  }
};

}  // namespace tern
