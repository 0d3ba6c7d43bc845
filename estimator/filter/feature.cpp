#include "estimator/filter/feature.h"

#include <Eigen/Dense>
#include <cmath>

#include "estimator/filter/rotation.h"

namespace tern {
namespace {

using Eigen::Matrix3d;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

constexpr int kSteps = 6;            ///< of Gauss and Newton; three reach rounding from the linear solution
constexpr double kNearest = 0.05;    ///< m: nothing that a camera images is nearer
constexpr double kConverged = 1e-9;  ///< of (u, v, 1/z): far below any camera's noise

/// A view relative to the last one: the point (u, v, 1)/ρ of the last camera is (M (u, v, 1) + ρ t)/ρ here.
struct RelativeView {
  Matrix3d M;
  Vec3 t_left, t_right;
};

RelativeView relative(const PosedView& view, const PosedView& last) {
  const Matrix3d R_CW = view.R_WC.transpose();
  const Vec3 t = R_CW * (last.p_WC - view.p_WC);
  return {R_CW * last.R_WC, t, t - Vec3(view.baseline, 0.0, 0.0)};
}

Matrix23 projection_jacobian(const Vec3& x) {
  const double w = 1.0 / x.z();
  Matrix23 J;
  J << w, 0.0, -x.x() * w * w, 0.0, w, -x.y() * w * w;
  return J;
}

/// The sum of squares at (u, v, ρ), with its normal equations.
struct Normal {
  Matrix3d A = Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  double cost = 0.0;
  bool in_front = true;
};

void add_ray(Normal& sum, const Matrix3d& M, const Vec3& t, const Vec3& uvr, const Eigen::Vector2d& z, double weight) {
  const Vec3 x = M * Vec3(uvr.x(), uvr.y(), 1.0) + uvr.z() * t;
  if (x.z() <= 1e-6) {
    sum.in_front = false;
    return;
  }
  Matrix3d D;
  D << M.col(0), M.col(1), t;
  const Matrix23 J = projection_jacobian(x) * D;
  const Eigen::Vector2d r = z - projected(x);
  sum.A += weight * J.transpose() * J;
  sum.b += weight * J.transpose() * r;
  sum.cost += weight * r.squaredNorm();
}

Normal normal_at(const std::vector<PosedView>& views, const std::vector<RelativeView>& relatives, const Vec3& uvr) {
  Normal sum;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const double weight = 1.0 / (views[k].sigma * views[k].sigma);
    add_ray(sum, relatives[k].M, relatives[k].t_left, uvr, views[k].z.left, weight);
    if (views[k].z.has_right) add_ray(sum, relatives[k].M, relatives[k].t_right, uvr, views[k].z.right, weight);
  }
  return sum;
}

/// The point nearest to all rays, in (u, v, 1/z) of the last view.
Vec3 linear_solution(const std::vector<PosedView>& views) {
  Matrix3d A = Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  const auto add = [&](const Vec3& centre, const Vec3& direction) {
    const Vec3 d = direction.normalized();
    const Matrix3d across = Matrix3d::Identity() - d * d.transpose();
    A += across;
    b += across * centre;
  };
  for (const PosedView& view : views) {
    add(view.p_WC, view.R_WC * view.z.left.homogeneous());
    if (view.z.has_right) {
      add(view.p_WC + view.R_WC * Vec3(view.baseline, 0.0, 0.0), view.R_WC * view.z.right.homogeneous());
    }
  }
  const PosedView& last = views.back();
  const Vec3 x_C = last.R_WC.transpose() * (A.ldlt().solve(b) - last.p_WC);
  if (!x_C.allFinite() || x_C.z() < kNearest || x_C.z() > kFarthest) {
    return {last.z.left.x(), last.z.left.y(), 1.0 / kFarthest};
  }
  return {x_C.x() / x_C.z(), x_C.y() / x_C.z(), 1.0 / x_C.z()};
}

}  // namespace

std::optional<Vec3> triangulated(const std::vector<PosedView>& views) {
  const PosedView& last = views.back();
  std::vector<RelativeView> relatives;
  relatives.reserve(views.size());
  for (const PosedView& view : views) relatives.push_back(relative(view, last));

  Vec3 uvr = linear_solution(views);
  Normal now = normal_at(views, relatives, uvr);
  double damping = 1e-6;
  for (int k = 0; k < kSteps && now.in_front; ++k) {
    Matrix3d A = now.A;
    A.diagonal() *= 1.0 + damping;
    const Vec3 step = A.ldlt().solve(now.b);
    if (!step.allFinite()) return std::nullopt;
    const Normal next = normal_at(views, relatives, uvr + step);
    if (next.in_front && next.cost <= now.cost) {
      uvr += step;
      now = next;
      damping *= 0.1;
      if (step.cwiseAbs().maxCoeff() < kConverged) break;
    } else {
      damping = std::max(damping * 100.0, 1e-3);
    }
  }
  if (uvr.z() < 1.0 / kFarthest) {
    uvr.z() = 1.0 / kFarthest;
    now = normal_at(views, relatives, uvr);
  }
  if (!now.in_front || uvr.z() > 1.0 / kNearest) return std::nullopt;
  return last.p_WC + last.R_WC * Vec3(uvr.x(), uvr.y(), 1.0) / uvr.z();
}

FeatureRows feature_rows(const std::vector<PosedView>& views, const Vec3& x_W, int poses) {
  Eigen::Index rows = 0;
  for (const PosedView& view : views) rows += view.z.has_right ? 4 : 2;
  FeatureRows out{Eigen::MatrixXd::Zero(rows, 6 * poses), Eigen::MatrixXd(rows, 3), Eigen::VectorXd(rows)};
  const Matrix3d X = skew(x_W);
  Eigen::Index row = 0;
  for (const PosedView& view : views) {
    const Vec3 x_left = view.R_WC.transpose() * (x_W - view.p_WC);
    const auto add = [&](const Vec3& x_C, const Eigen::Vector2d& z) {
      const Matrix23 B = projection_jacobian(x_C) * view.R_WC.transpose() / view.sigma;
      out.H_x.block<2, 3>(row, 6 * view.pose) = B * X;
      out.H_x.block<2, 3>(row, 6 * view.pose + 3) = -B;
      out.H_f.middleRows<2>(row) = B;
      out.r.segment<2>(row) = (z - projected(x_C)) / view.sigma;
      row += 2;
    };
    add(x_left, view.z.left);
    if (view.z.has_right) add(x_left - Vec3(view.baseline, 0.0, 0.0), view.z.right);
  }
  return out;
}

void eliminate_feature(FeatureRows& rows) {
  const Eigen::Index left = rows.r.size() - 3;
  const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(rows.H_f);
  rows.H_x.applyOnTheLeft(qr.householderQ().adjoint());
  rows.r.applyOnTheLeft(qr.householderQ().adjoint());
  rows.H_x = rows.H_x.bottomRows(left).eval();
  rows.r = rows.r.tail(left).eval();
  rows.H_f.resize(0, 3);
}

double chi_square_quantile(int freedom, double z) {
  const double s = 2.0 / (9.0 * freedom);
  const double root = 1.0 - s + z * std::sqrt(s);
  return freedom * root * root * root;
}

}  // namespace tern
