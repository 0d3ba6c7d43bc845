// The filter itself: the state of the body with clones of past poses, its covariance, and linear corrections of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/world/inertial.h"
#include "estimator/filter/feature.h"
#include "estimator/filter/motion.h"

namespace tern {

/// The pose of the body at a past frame. Its error (θ, e_p) is a part of the filter's state.
struct Clone {
  std::int64_t number = 0;  ///< of the frame, ascending
  UTime at;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 p = Vec3::Zero();
  Vec3 v = Vec3::Zero();  ///< as estimated when the clone was made
};

/// A feature that is ready to be used: its views from clones, in ascending order of their numbers.
struct UsableFeature {
  std::int64_t id = 0;
  std::vector<PosedView> views;  ///< `pose` is the clone's index in Msckf::clones()
};

struct UpdateCounts {
  int used = 0;
  int refused = 0;  ///< by the χ² gate, or without a position
};

/// A right-invariant multi-state constraint Kalman filter. The error's order is: body and biases (NavState), then (θ,
/// e_p) of each clone.
class Msckf {
 public:
  Msckf(const NavState& state, const NavMatrix& covariance) : nav_(state), P_(covariance) {}

  void propagate(const ImuStep& step, const ImuNoise& noise, double gravity);
  void add_clone(std::int64_t number, UTime at);
  /// @pre index < clones().size()
  void remove_clone(std::size_t index);

  /// Corrects the state by static features. A feature is used if its views agree with its position and the state
  /// (χ² gate, 95 %). Cost: O(features · views³ + rows · clones²).
  /// @param first  clones before this index have no views
  UpdateCounts use(const std::vector<UsableFeature>& features, std::size_t first);

  /// Whether the views agree with one static point and the state (χ² gate, 99.9 %). At most one view in a thousand that
  /// follows its point is doubted.
  /// @pre views is not empty, in ascending order of poses; `pose` is the clone's index
  [[nodiscard]] bool agree(std::vector<PosedView> views) const;

  /// Corrects the state by a residual r = H ε + n, n ~ N(0, 1), of the errors from column `first` on.
  void correct(const Eigen::MatrixXd& H, const Eigen::VectorXd& r, Eigen::Index first);

  /// Adds an error of the whole path, a rigid motion in W: the error (θ, e_p) of each pose has it in common. The
  /// errors of poses relative to each other stay.
  /// @param D  its covariance
  void add_common_error(const Eigen::Matrix<double, 6, 6>& D);

  [[nodiscard]] const NavState& nav() const { return nav_; }
  [[nodiscard]] const std::vector<Clone>& clones() const { return clones_; }
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return P_; }
  [[nodiscard]] NavMatrix nav_covariance() const { return P_.topLeftCorner<kNavErrors, kNavErrors>(); }
  [[nodiscard]] static Eigen::Index column(std::size_t clone) {
    return kNavErrors + 6 * static_cast<Eigen::Index>(clone);
  }
  /// Whether all numbers are finite.
  [[nodiscard]] bool is_finite() const;

 private:
  NavState nav_;
  std::vector<Clone> clones_;
  Eigen::MatrixXd P_;
};

/// Returns rows with the same information and at most as many rows as columns: [H r] = Q [H' r'; 0 rest].
void compress(Eigen::MatrixXd& H, Eigen::VectorXd& r);

}  // namespace tern
