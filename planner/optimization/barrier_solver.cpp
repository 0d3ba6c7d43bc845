#include "planner/optimization/barrier_solver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/optimization/cholesky.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

constexpr double kWithRounding = 1.0 + 1e-9;  ///< a larger ratio is not due to rounding
constexpr double kStrictlyInside = 1e-10;     ///< m; larger than the rounding of positions 10 km from the origin

/// All constraints with their gradients, in y = x − x0. Gradients of rows are constant, those of spheres depend on y.
class Constraints {
 public:
  void assign(const ConvexProblem& p, const FreeVariables& x0) {
    n_ = p.variables();
    for (std::vector<double>* v : {&value_, &weight_, &bound_}) v->clear();
    entries_.clear();
    at_.clear();
    for (int r = 0; r < p.row_count(); ++r) add_row(p, x0, r);
    linear_ = static_cast<int>(bound_.size());
    for (int k = 0; k < p.spheres(); ++k) add_sphere(p, x0, k);
  }

  [[nodiscard]] int count() const { return linear_ + spheres(); }
  [[nodiscard]] int spheres() const { return static_cast<int>(at_.size()); }

  /// Writes c_i(y) for all i, and updates the gradients of spheres.
  void evaluate(const std::vector<double>& y, std::vector<double>& c) {
    for (int i = 0; i < linear_; ++i) c[idx(i)] = dot(i, y.data()) - bound_[idx(i)];
    for (int k = 0; k < spheres(); ++k) {
      Vec3 at = at_[idx(k)];
      const Entries& of = entries_[idx(linear_ + k)];
      const double* weight = weight_.data() + of.begin;
      for (int e = 0; e < of.count; ++e) at[e % 3] += weight[e] * y[idx(of.column + e)];
      for (int e = 0; e < of.count; ++e) value_[idx(of.begin + e)] = weight[e] * at[e % 3] / radius_;
      c[idx(linear_ + k)] = (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] - radius_ * radius_) / (2.0 * radius_);
    }
  }

  /// ∇c_i · v.
  [[nodiscard]] double dot(int i, const double* v) const {
    const Entries& of = entries_[idx(i)];
    const double* value = value_.data() + of.begin;
    double sum = 0.0;
    for (int e = 0; e < of.count; ++e) sum += value[e] * v[of.column + e * of.stride];
    return sum;
  }

  /// v += factor ∇c_i.
  void add_gradient(int i, double factor, double* v) const {
    const Entries& of = entries_[idx(i)];
    const double* value = value_.data() + of.begin;
    for (int e = 0; e < of.count; ++e) v[of.column + e * of.stride] += factor * value[e];
  }

  /// lower triangle += factor ∇c_i ∇c_iᵀ.
  void add_outer(int i, double factor, double* matrix) const {
    const Entries& of = entries_[idx(i)];
    const double* value = value_.data() + of.begin;
    double* corner = matrix + idx(of.column * (n_ + 1));
    switch (of.count) {
      case 1: return add_few<1>(value, factor, corner, of.stride);
      case 2: return add_few<2>(value, factor, corner, of.stride);
      case 3: return add_few<3>(value, factor, corner, of.stride);
      case 4: return add_few<4>(value, factor, corner, of.stride);
      default: break;
    }
    for (int e = 0; e < of.count; ++e) {
      const double scaled = factor * value[e];
      double* row = corner + idx(e * of.stride * n_);
      for (int f = 0; f <= e; ++f) row[idx(f * of.stride)] += scaled * value[f];
    }
  }

  /// lower triangle += multiplier ∇²c_i, which is 0 for rows.
  void add_curvature(int i, double multiplier, double* matrix) const {
    if (i < linear_) return;
    const double scaled = multiplier / radius_;
    const Entries& of = entries_[idx(i)];
    const double* weight = weight_.data() + of.begin;
    for (int e = 0; e < of.count; ++e) {
      double* row = matrix + idx((of.column + e) * n_ + of.column);
      for (int f = e % 3; f <= e; f += 3) row[f] += scaled * weight[e] * weight[f];  // axes are independent
    }
  }

 private:
  /// The columns of one gradient's entries: column, column + stride … Rows of one axis take every third.
  struct Entries {
    int begin, count;  ///< in value_ and weight_
    int column, stride;
  };

  /// add_outer() for a constant count, which the compiler unrolls. Most gradients have few entries.
  template <int kCount>
  void add_few(const double* value, double factor, double* corner, int stride) const {
    for (int e = 0; e < kCount; ++e) {
      const double scaled = factor * value[e];
      double* row = corner + idx(e * stride * n_);
      for (int f = 0; f <= e; ++f) row[idx(f * stride)] += scaled * value[f];
    }
  }

  void add_row(const ConvexProblem& p, const FreeVariables& x0, int r) {
    const double* row = p.row(r);
    int first = 0;
    int end = n_;
    while (first < end && row[first] == 0.0) ++first;
    while (first < end && row[end - 1] == 0.0) --end;
    const int stride = is_of_one_axis(row + first, end - first) ? 3 : 1;
    double square = 0.0;
    double at_x0 = 0.0;
    for (int c = first; c < end; c += stride) {
      square += row[c] * row[c];
      at_x0 += row[c] * x0[c];
    }
    const double scale = square > 0.0 ? 1.0 / std::sqrt(square) : 1.0;
    const int begin = static_cast<int>(value_.size());
    for (int c = first; c < end; c += stride) push(scale * row[c], 0.0);
    entries_.push_back({begin, static_cast<int>(value_.size()) - begin, first, stride});
    bound_.push_back(scale * (p.bounds[idx(r)] - at_x0));
  }

  static bool is_of_one_axis(const double* row, int count) {
    for (int c = 0; c < count; ++c) {
      if (c % 3 != 0 && row[c] != 0.0) return false;
    }
    return true;
  }

  void add_sphere(const ConvexProblem& p, const FreeVariables& x0, int k) {
    radius_ = std::sqrt(p.sphere_radius2);
    int first = 0;
    int end = n_;
    while (first < end && p.sphere_weight(k, first) == 0.0) first += 3;
    while (first < end && p.sphere_weight(k, end - 1) == 0.0) end -= 3;
    entries_.push_back({static_cast<int>(value_.size()), end - first, first, 1});
    for (int c = first; c < end; ++c) push(0.0, p.sphere_weight(k, c));
    at_.push_back(p.sphere_point(k, x0));
  }

  void push(double value, double weight) {
    value_.push_back(value);
    weight_.push_back(weight);
  }

  int n_ = 0;
  int linear_ = 0;
  double radius_ = 1.0;
  std::vector<Entries> entries_;  ///< per constraint
  std::vector<double> value_;     ///< of the gradients
  std::vector<double> weight_;    ///< of W_k
  std::vector<double> bound_;     ///< per row, less the row at x0
  std::vector<Vec3> at_;          ///< per sphere: W_k x0 + p_k
};

}  // namespace

/// The state of one solve, in y = x − x0.
class BarrierSolver::Iteration {
 public:
  ConvexSolution solve(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                       const StopFunction& stop) {
    problem_ = &problem;
    x0_ = x0;
    n_ = problem.variables();
    constraints_.assign(problem, x0);
    m_ = constraints_.count();
    hessian_factor_.resize(n_);
    system_.resize(n_);
    lower_bound_ = -kNoBound;
    solution_ = {};
    for (std::vector<double>* v : {&y_, &gradient0_, &gradient_, &dual_residual_, &step_, &work_})
      v->assign(idx(n_), 0.0);
    for (std::vector<double>* v :
         {&c_, &slack_, &multiplier_, &stiffness_, &slack_step_, &multiplier_step_, &complement_})
      v->assign(idx(m_), 0.0);
    return run(max_iterations, stop);
  }

 private:
  ConvexSolution run(int max_iterations, const StopFunction& stop) {
    if (!prepare()) return fail();
    for (;;) {
      evaluate();
      keep_if_best();
      if (optimal() || solution_.iterations >= max_iterations || stop()) return solution_;
      if (!advance()) return fail();
      ++solution_.iterations;
    }
  }

  ConvexSolution fail() {
    solution_.solver_failed = true;
    return solution_;
  }

  bool prepare() {
    if (problem_->worst_violation(x0_) <= 0.0) {
      solution_.found = true;
      solution_.x = x0_;
      solution_.objective = problem_->objective(x0_);
    }
    for (int r = 0; r < n_; ++r) {
      double sum = problem_->gradient[r];
      for (int c = 0; c < n_; ++c) {
        sum += problem_->hessian(r, c) * x0_[c];
        if (c <= r) hessian_factor_.matrix()[r * n_ + c] = problem_->hessian(r, c);
      }
      gradient0_[idx(r)] = sum;
    }
    if (!hessian_factor_.factor()) return false;
    constraints_.evaluate(y_, c_);
    for (int i = 0; i < m_; ++i) slack_[idx(i)] = std::max(-c_[idx(i)], kMinFirstSlack);
    const double mu = first_barrier();
    for (int i = 0; i < m_; ++i) multiplier_[idx(i)] = mu / slack_[idx(i)];
    return true;
  }

  /// Returns the first barrier parameter. The gain of the unconstrained optimum bounds the possible gain.
  double first_barrier() {
    work_ = gradient0_;
    hessian_factor_.solve_lower(work_.data());
    double gain = 0.0;
    for (const double w : work_) gain += 0.5 * w * w;
    return std::max(kFirstBarrierShare * gain / std::max(m_, 1), 1e-9);
  }

  /// Constraints, gradient and dual residual at y.
  void evaluate() {
    constraints_.evaluate(y_, c_);
    for (int r = 0; r < n_; ++r) {
      double sum = gradient0_[idx(r)];
      for (int c = 0; c < n_; ++c) sum += problem_->hessian(r, c) * y_[idx(c)];
      gradient_[idx(r)] = sum;
    }
    dual_residual_ = gradient_;
    for (int i = 0; i < m_; ++i) {
      // For a feasible constraint the slack may grow to the true distance; its residual then vanishes.
      slack_[idx(i)] = std::max(slack_[idx(i)], -c_[idx(i)]);
      constraints_.add_gradient(i, multiplier_[idx(i)], dual_residual_.data());
    }
  }

  /// Keeps y if it is the best strictly feasible point, and the dual bound if it is the highest.
  void keep_if_best() {
    const FreeVariables x = x0_ + Eigen::Map<const Eigen::VectorXd>(y_.data(), n_);
    const double objective = problem_->objective(x);
    tolerance_ = std::max(kGapShare * std::abs(objective), kGapAbsolute);
    double lagrangian = objective;
    double nearest = -1.0;
    for (int i = 0; i < m_; ++i) {
      lagrangian += multiplier_[idx(i)] * c_[idx(i)];
      nearest = std::max(nearest, c_[idx(i)]);
    }
    work_ = dual_residual_;
    hessian_factor_.solve_lower(work_.data());
    for (const double w : work_) lagrangian -= 0.5 * w * w;
    lower_bound_ = std::max(lower_bound_, lagrangian);
    if (nearest <= -kStrictlyInside && (!solution_.found || objective < solution_.objective) &&
        problem_->worst_violation(x) <= 0.0) {
      solution_.found = true;
      solution_.x = x;
      solution_.objective = objective;
    }
    if (solution_.found) solution_.gap = std::max(solution_.objective - lower_bound_, 0.0);
  }

  [[nodiscard]] bool optimal() const { return solution_.found && solution_.gap <= tolerance_; }

  bool advance() {
    double* matrix = system_.matrix();
    for (int r = 0; r < n_; ++r) {
      for (int c = 0; c <= r; ++c) matrix[r * n_ + c] = problem_->hessian(r, c);
    }
    double mu = 0.0;
    for (int i = 0; i < m_; ++i) {
      mu += slack_[idx(i)] * multiplier_[idx(i)];
      stiffness_[idx(i)] = multiplier_[idx(i)] / slack_[idx(i)];
      constraints_.add_outer(i, stiffness_[idx(i)], matrix);
      constraints_.add_curvature(i, multiplier_[idx(i)], matrix);
    }
    mu /= std::max(m_, 1);
    if (!system_.factor()) return false;
    for (int i = 0; i < m_; ++i) complement_[idx(i)] = slack_[idx(i)] * multiplier_[idx(i)];
    direction();
    const double affine = largest_step(1.0);
    double mu_affine = 0.0;
    for (int i = 0; i < m_; ++i) {
      mu_affine +=
          (slack_[idx(i)] + affine * slack_step_[idx(i)]) * (multiplier_[idx(i)] + affine * multiplier_step_[idx(i)]);
    }
    mu_affine /= std::max(m_, 1);
    const double ratio = mu > 0.0 ? mu_affine / mu : 0.0;
    const double target = std::max(ratio * ratio * ratio * mu, kLastBarrierShare * tolerance_ / std::max(m_, 1));
    // The second-order term is the error of the whole affine step, so it is scaled by the possible share of that step.
    // With the full term iterates may cycle.
    for (int i = 0; i < m_; ++i)
      complement_[idx(i)] += affine * slack_step_[idx(i)] * multiplier_step_[idx(i)] - target;
    direction();
    const double length = largest_step(kStepShare);
    for (int r = 0; r < n_; ++r) y_[idx(r)] += length * step_[idx(r)];
    for (int i = 0; i < m_; ++i) {
      slack_[idx(i)] += length * slack_step_[idx(i)];
      multiplier_[idx(i)] += length * multiplier_step_[idx(i)];
    }
    return length > kMinStep;
  }

  /// Computes Newton's direction for the complementarity residual in complement_.
  void direction() {
    for (int r = 0; r < n_; ++r) step_[idx(r)] = -dual_residual_[idx(r)];
    for (int i = 0; i < m_; ++i) {
      const double residual = c_[idx(i)] + slack_[idx(i)];
      const double pull = (multiplier_[idx(i)] * residual - complement_[idx(i)]) / slack_[idx(i)];
      multiplier_step_[idx(i)] = pull;
      constraints_.add_gradient(i, -pull, step_.data());
    }
    system_.solve(step_.data());
    for (int i = 0; i < m_; ++i) {
      const double along = constraints_.dot(i, step_.data());
      slack_step_[idx(i)] = -(c_[idx(i)] + slack_[idx(i)]) - along;
      multiplier_step_[idx(i)] += stiffness_[idx(i)] * along;
    }
  }

  /// Returns the longest step ≤ 1 that keeps slacks and multipliers positive, times `share` if a bound limits it.
  [[nodiscard]] double largest_step(double share) const {
    double length = 1.0;
    // Few bounds limit the step. The others are skipped without a division, which would be slow.
    const auto keep_positive = [&](double value, double step) {
      if (share * value < -kWithRounding * length * step) length = std::min(length, -share * value / step);
    };
    for (int i = 0; i < m_; ++i) {
      keep_positive(slack_[idx(i)], slack_step_[idx(i)]);
      keep_positive(multiplier_[idx(i)], multiplier_step_[idx(i)]);
    }
    return length;
  }

  static constexpr double kNoBound = 1e300;

  const ConvexProblem* problem_ = nullptr;
  FreeVariables x0_;
  int n_ = 0;
  Constraints constraints_;
  int m_ = 0;
  double lower_bound_ = -kNoBound;  ///< of the optimum
  double tolerance_ = 0.0;          ///< of the gap, m²
  Cholesky hessian_factor_, system_;
  std::vector<double> y_, gradient0_, gradient_, dual_residual_, step_, work_;
  std::vector<double> c_, slack_, multiplier_, slack_step_, multiplier_step_, complement_;
  std::vector<double> stiffness_;  ///< multiplier_/slack_
  ConvexSolution solution_;
};

BarrierSolver::BarrierSolver() : iteration_(std::make_unique<Iteration>()) {}
BarrierSolver::~BarrierSolver() = default;
BarrierSolver::BarrierSolver(BarrierSolver&&) noexcept = default;

ConvexSolution BarrierSolver::solve(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                                    const StopFunction& stop) {
  return iteration_->solve(problem, x0, max_iterations, stop);
}

}  // namespace tern
