// How wrong the vehicle's own estimate was, against the truth.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/world/inertial.h"
#include "core/world/vehicle.h"

namespace tern {

/// The errors of ODOMETRY's position in W against VEHICLE_TRUTH, not aligned, from take-off on.
///
/// | measure  | equation                                                               |
/// |----------|------------------------------------------------------------------------|
/// | error    | ‖p̂ − p‖                                                                |
/// | sigma    | √tr Σ, the stated standard deviation of the error in three dimensions  |
/// | ANEES    | mean of eᵀ Σ⁻¹ e / 3: 1 for a consistent estimator                     |
/// | coverage | share of instants with eᵀ Σ⁻¹ e below 11.345, the 99 % quantile         |
struct EstimateMeasures {
  double end_m = 0.0, sigma_end_m = 0.0;    ///< newest
  double peak_m = 0.0, sigma_peak_m = 0.0;  ///< largest
  double rmse_m = 0.0;
  double anees = 0.0, coverage = 0.0;
  double blind_s = 0.0;             ///< time with fewer than kFewTracks tracks, s; NaN: tracks were never stated
  std::int64_t corrections = 0;     ///< epochs of T_WO
  double believed_to_goal_m = 0.0;  ///< distance of UAV_STATE from the goal
  double true_to_goal_m = 0.0;      ///< distance of VEHICLE_TRUTH from it
};

/// Gathers EstimateMeasures. An ODOMETRY is compared with the truth at its time, between the two states around it.
class EstimateWatch {
 public:
  static constexpr int kFewTracks = 10;
  static constexpr double kMoving = 0.3;  ///< m/s: the vehicle has taken off

  void add(const Odometry& odometry);
  void add_truth(const UavState& truth);
  void add_believed(const UavState& state) { believed_ = state.motion.p; }
  /// @return nullopt if no ODOMETRY of a moving vehicle was compared
  [[nodiscard]] std::optional<EstimateMeasures> measures(const Vec3& goal) const;

 private:
  void compare();
  void compare(const Odometry& odometry, const Vec3& truth);

  std::deque<UavState> truths_;
  std::deque<Odometry> waiting_;
  bool has_moved_ = false, states_tracks_ = false;
  std::optional<Vec3> believed_, true_;
  std::optional<UTime> compared_;
  EstimateMeasures sums_;
  std::int64_t count_ = 0;
  double squares_ = 0.0, nees_ = 0.0, covered_ = 0.0;
};

/// The measures as three lines of the summary's text.
std::string to_text(const EstimateMeasures& measures);
/// Adds the measures to a summary's JSON, as its key `estimate`.
std::string with_estimate(const std::string& summary_json, const EstimateMeasures& measures);

}  // namespace tern
