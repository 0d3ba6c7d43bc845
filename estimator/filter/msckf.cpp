#include "estimator/filter/msckf.h"

#include <Eigen/Dense>

#include "estimator/filter/rotation.h"

namespace tern {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows of a feature without its own error; nullopt if it has no position or its views contradict the state.
/// @param gate  the standard normal quantile of the χ² gate
std::optional<FeatureRows> gated_rows(const std::vector<PosedView>& views, int poses, const MatrixXd& P_poses,
                                      double gate) {
  const auto x_W = triangulated(views);
  if (!x_W) return std::nullopt;
  FeatureRows rows = feature_rows(views, *x_W, poses);
  if (rows.r.size() <= 3) return std::nullopt;
  eliminate_feature(rows);
  // A track has views of clones in a row: the columns before its first one are zero.
  const Index from = Index{6} * views.front().pose, span = Index{6} * (views.back().pose + 1) - from;
  const auto H = rows.H_x.middleCols(from, span);
  MatrixXd S = MatrixXd::Identity(rows.r.size(), rows.r.size());
  S.noalias() += H * (P_poses.block(from, from, span, span) * H.transpose()).eval();
  const VectorXd white = S.llt().matrixL().solve(rows.r);
  const double limit = chi_square_quantile(static_cast<int>(rows.r.size()), gate);
  // A NaN is refused as well.
  if (!(white.squaredNorm() < limit)) return std::nullopt;
  return rows;
}

}  // namespace

void Msckf::propagate(const ImuStep& step, const ImuNoise& noise, double gravity) {
  ImuStep half = step;
  half.h *= 0.5;
  const ErrorTransition change = error_transition(moved(nav_, half, gravity), step, noise, gravity);
  nav_ = moved(nav_, step, gravity);
  const Index past = P_.cols() - kNavErrors;
  const NavMatrix inner = change.Phi * nav_covariance() * change.Phi.transpose() + change.Q;
  P_.topLeftCorner<kNavErrors, kNavErrors>() = 0.5 * (inner + inner.transpose());
  P_.topRightCorner(kNavErrors, past) = change.Phi * P_.topRightCorner(kNavErrors, past).eval();
  P_.bottomLeftCorner(past, kNavErrors) = P_.topRightCorner(kNavErrors, past).transpose();
}

void Msckf::add_clone(std::int64_t number, UTime at) {
  clones_.push_back({number, at, nav_.R, nav_.p, nav_.v});
  const Index n = P_.cols();
  P_.conservativeResize(n + 6, n + 6);
  P_.bottomLeftCorner(6, n) = P_.topLeftCorner(6, n);
  P_.topRightCorner(n, 6) = P_.topLeftCorner(n, 6);
  P_.bottomRightCorner(6, 6) = P_.topLeftCorner(6, 6).eval();
}

void Msckf::remove_clone(std::size_t index) {
  const Index at = column(index), after = P_.cols() - at - 6, n = P_.cols() - 6;
  P_.middleRows(at, after) = P_.bottomRows(after).eval();
  P_.middleCols(at, after) = P_.rightCols(after).eval();
  P_.conservativeResize(n, n);
  clones_.erase(clones_.begin() + static_cast<std::ptrdiff_t>(index));
}

UpdateCounts Msckf::use(const std::vector<UsableFeature>& features, std::size_t first) {
  UpdateCounts counts;
  const int poses = static_cast<int>(clones_.size() - first);
  const Index columns = Index{6} * poses;
  const MatrixXd P_poses = P_.bottomRightCorner(columns, columns);
  std::vector<FeatureRows> accepted;
  Index rows = 0;
  for (const UsableFeature& feature : features) {
    std::vector<PosedView> views = feature.views;
    for (PosedView& view : views) view.pose -= static_cast<int>(first);
    auto of_feature = gated_rows(views, poses, P_poses, kGate95);
    if (!of_feature) {
      ++counts.refused;
      continue;
    }
    ++counts.used;
    rows += of_feature->r.size();
    accepted.push_back(std::move(*of_feature));
  }
  if (rows == 0) return counts;
  MatrixXd H(rows, columns);
  VectorXd r(rows);
  Index row = 0;
  for (const FeatureRows& of_feature : accepted) {
    H.middleRows(row, of_feature.r.size()) = of_feature.H_x;
    r.segment(row, of_feature.r.size()) = of_feature.r;
    row += of_feature.r.size();
  }
  compress(H, r);
  correct(H, r, column(first));
  return counts;
}

bool Msckf::agree(std::vector<PosedView> views) const {
  const int first = views.front().pose, poses = static_cast<int>(clones_.size()) - first;
  for (PosedView& view : views) view.pose -= first;
  return gated_rows(views, poses, P_.bottomRightCorner(6 * poses, 6 * poses), kGate999).has_value();
}

void Msckf::correct(const MatrixXd& H, const VectorXd& r, Index first) {
  const MatrixXd PHt = P_.middleCols(first, H.cols()) * H.transpose();
  MatrixXd S = MatrixXd::Identity(H.rows(), H.rows());
  S.noalias() += H * PHt.middleRows(first, H.cols());
  const Eigen::LLT<MatrixXd> root(S);
  // P − P Hᵀ S⁻¹ H P = P − W Wᵀ with W = P Hᵀ L⁻ᵀ: symmetric to the last bit.
  const MatrixXd Wt = root.matrixL().solve(PHt.transpose());
  const VectorXd error = Wt.transpose() * root.matrixL().solve(r);
  P_.selfadjointView<Eigen::Lower>().rankUpdate(Wt.transpose(), -1.0);
  P_.triangularView<Eigen::StrictlyUpper>() = P_.transpose();

  nav_ = corrected(nav_, error.head<kNavErrors>());
  for (std::size_t k = 0; k < clones_.size(); ++k) {
    const auto of_clone = error.segment<6>(column(k));
    const RotationIntegrals turn = rotation_integrals(of_clone.head<3>());
    Clone& clone = clones_[k];
    clone.R = orthonormal(turn.exp * clone.R);
    clone.p = turn.exp * clone.p + turn.first * of_clone.tail<3>();
  }
}

void Msckf::add_common_error(const Eigen::Matrix<double, 6, 6>& D) {
  std::vector<Index> poses{kTheta};
  for (std::size_t k = 0; k < clones_.size(); ++k) poses.push_back(column(k));
  for (const Index row : poses) {
    for (const Index col : poses) P_.block<6, 6>(row, col) += D;
  }
}

bool Msckf::is_finite() const {
  return P_.allFinite() && nav_.R.allFinite() && nav_.p.allFinite() && nav_.v.allFinite() &&
         nav_.gyro_bias.allFinite() && nav_.accel_bias.allFinite();
}

void compress(MatrixXd& H, VectorXd& r) {
  if (H.rows() <= H.cols()) return;
  const Index n = H.cols();
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(H);
  r.applyOnTheLeft(qr.householderQ().adjoint());
  const MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  H = upper;
  r = r.head(n).eval();
}

}  // namespace tern
