// Measures drag and lag of the vehicle in a flight, for the feed-forward of the next one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern::mavlink {

/// Gains of a PX4's level position and velocity loops.
struct LoopGains {
  double position_p = 0.0;                    ///< MPC_XY_P, 1/s
  double velocity_p = 0.0, velocity_i = 0.0;  ///< MPC_XY_VEL_P_ACC, 1/s, and MPC_XY_VEL_I_ACC, 1/s²
  double velocity_d = 0.0;                    ///< MPC_XY_VEL_D_ACC
};

/// Measures a PX4's level motion from setpoints and estimates. Its velocity loop commands the acceleration
///
///     u = a_s + K_v e + K_i ∫ e dt − D v̇,    e = v_s + K_p (p_s − p) − v,
///
/// with the setpoint (p_s, v_s, a_s) as it was sent. The vehicle has
///
///     v̇ = γ u_τ − k v + c,
///
/// where u_τ is u after a first-order lag of τ, k the drag per mass, and c the wind on each axis. γ, k and c are those
/// of least squares over spans of kSpan. τ is the one of a grid with the smallest residuals. The gains are known, so
/// feedback does not pass for feed-forward.
class FlightIdentification {
 public:
  static constexpr Duration kSpan{100'000};
  static constexpr std::size_t kLags = 20;
  static constexpr double kFirstLag = 0.04, kLagStep = 0.02;  ///< s
  static constexpr double kLeastMotion = 10.0;                ///< s, faster than 1 m/s
  static constexpr double kMaxSigma = 0.1;                    ///< 1/s: a less certain drag is not reported

  /// Takes a setpoint as it is sent. @param a  with all feed-forward, m/s²
  void sent(const Vec3& p, const Vec3& v, const Vec3& a);
  /// Takes an estimate. @param at  ascending @param p, v  in the frame of the setpoints
  void add(UTime at, const Vec3& p, const Vec3& v, const LoopGains& gains);
  /// The vehicle does not follow for a while.
  void pause() { last_.reset(); }

  struct Answer {
    double drag_per_s = 0.0;  ///< k, 1/s
    double drag_sigma = 0.0;  ///< its standard error
    double lag_s = 0.0;       ///< τ
    double share = 0.0;       ///< γ: of the commanded acceleration
    double moved_s = 0.0;     ///< time in motion
  };
  /// @return nullopt after too little motion, if k or τ is uncertain, or if γ is off 1 by more than 15 %
  [[nodiscard]] std::optional<Answer> answer() const;

 private:
  static constexpr int kUnknowns = 4;  ///< γ, k, c_x, c_y
  using Row = Eigen::Matrix<double, kUnknowns, 1>;
  struct Fit {
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal = Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
    Row right = Row::Zero();
    Eigen::Vector2d lagged = Eigen::Vector2d::Zero(), sum = Eigen::Vector2d::Zero();  ///< u_τ, and ∫ u_τ dt
  };
  void begin(UTime at, const Eigen::Vector2d& v);
  void close_span(const Eigen::Vector2d& v);
  [[nodiscard]] static double lag_of(std::size_t k) { return kFirstLag + kLagStep * static_cast<double>(k); }

  struct Sent {
    Eigen::Vector2d p, v, a;
  };
  std::optional<Sent> sent_;
  std::array<Fit, kLags> fits_;
  double squares_ = 0.0;  ///< Σ of the squared changes of speed
  int spans_ = 0;         ///< per axis and span
  double moved_s_ = 0.0;
  std::optional<UTime> last_;
  double settled_s_ = 0.0;  ///< since the filters began
  Eigen::Vector2d integral_ = Eigen::Vector2d::Zero(), v_ = Eigen::Vector2d::Zero(), rate_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d span_v_ = Eigen::Vector2d::Zero(), travelled_ = Eigen::Vector2d::Zero();
  double span_s_ = 0.0;
};

}  // namespace tern::mavlink
