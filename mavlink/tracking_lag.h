// How far behind its setpoints a vehicle flies, in seconds: what a wrong feed-forward against drag shows as.
#pragma once

#include <optional>

#include "core/base/types.h"

namespace tern::mavlink {

/// The mean of (p_c − p)·v_c / |v_c|² over the last kOver in motion. Drag that nothing is fed forward against leaves
/// a lag in proportion to speed; at rest nothing is learnt.
class TrackingLag {
 public:
  static constexpr double kOver = 3.0;    ///< of the exponential mean, s in motion
  static constexpr double kMoving = 1.0;  ///< slower is rest, m/s

  /// @param dt_s  since the last one, s  @param p_c, v_c  commanded for the time at which the vehicle was at p
  void add(double dt_s, const Vec3& p_c, const Vec3& v_c, const Vec3& p);
  /// s; negative: ahead. @return nullopt before 2 kOver in motion
  [[nodiscard]] std::optional<double> seconds() const;

 private:
  double lag_s_ = 0.0, moved_s_ = 0.0;
};

}  // namespace tern::mavlink
