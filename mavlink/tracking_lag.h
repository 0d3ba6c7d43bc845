// How far the vehicle flies behind its setpoints, in seconds. A wrong feed-forward against drag shows as such a lag.
#pragma once

#include <optional>

#include "core/base/types.h"

namespace tern::mavlink {

/// The mean of (p_c − p)·v_c / |v_c|² over the last kOver in motion. Drag without feed-forward causes a lag in
/// proportion to speed. Stationary times do not count.
class TrackingLag {
 public:
  static constexpr double kOver = 3.0;    ///< time constant of the exponential mean, s in motion
  static constexpr double kMoving = 1.0;  ///< slower counts as stationary, m/s

  /// Adds a state. @param dt_s  since the last one, s  @param p_c, v_c  the command at the time of p
  void add(double dt_s, const Vec3& p_c, const Vec3& v_c, const Vec3& p);
  /// The lag, s; negative: the vehicle is ahead. @return nullopt before 2 kOver in motion
  [[nodiscard]] std::optional<double> seconds() const;

 private:
  double lag_s_ = 0.0, moved_s_ = 0.0;
};

}  // namespace tern::mavlink
