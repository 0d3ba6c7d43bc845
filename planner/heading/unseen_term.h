// Unseen space: the places from which a mover that no sensor has seen could come.
#pragma once

#include <utility>
#include <vector>

#include "core/base/types.h"
#include "core/world/vehicle.h"
#include "planner/heading/look_term.h"
#include "planner/problem/tuning.h"
#include "planner/unseen/unseen_watch.h"

namespace tern {

/// Looks where unseen movers may be, and a look could show that there are none.
///
/// A mover of speed w at distance x comes to the body, of radius r, within τ = (x − r) / w. Its urgency is
///
///     u(x) = exp(−τ / T),        T = kSightAhead + time to stop (stop_time)
///
/// Let P be the places where a part of an unseen mover may be (UnseenField). Along a bearing, sight ends at s: at the
/// first box that is known, or at UnseenField::kFarthest. P begins up to kUnseenBefore before a wall that is looked
/// at, so boxes are grown by that, but not over the vehicle. One radian around the bearing has the worth
///
///     w ∫ [x in P] (−u′(x)) dx,  x from r to s
///
/// So if P fills a ray from ρ on, a look there is worth w (u(ρ) − u(s)): as much urgency as it can take away. P behind
/// a wall counts for nothing; P in a gap counts. The term's unit is m: the way that unseen movers come nearer while
/// nobody looks. P is that of the field's time. O(kUnseenBearings · (boxes + steps)) for each instant.
class UnseenTerm final : public LookTerm {
 public:
  /// @param known   with its field; is kept by reference  @pre known.field
  /// @param boxes   of the things that are known: they end the sight if they cross the vehicle's height, W
  /// @param radius  of the body about its vertical axis, m
  UnseenTerm(const UnseenKnowledge& known, std::vector<Box> boxes, double radius, const Limits& limits)
      : field_(*known.field), boxes_(std::move(boxes)), radius_(radius), limits_(limits) {}

  [[nodiscard]] double weight() const override { return kUnseenWeight; }
  void look(const LookInstant& now, std::vector<LookTarget>& targets) const override;

 private:
  /// Returns the distance at which sight ends, m.
  [[nodiscard]] double sight(const LookInstant& now, const Vec3& way, const std::vector<Box>& near) const;

  const UnseenField& field_;
  std::vector<Box> boxes_;
  double radius_;
  Limits limits_;
};

}  // namespace tern
