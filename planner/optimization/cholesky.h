// The Cholesky factorization of a small dense matrix, in a fixed order of operations.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Solves symmetric positive definite systems by L Lᵀ, row-major.
class Cholesky {
 public:
  void resize(int n) {
    n_ = n;
    l_.assign(idx(n) * idx(n), 0.0);
    inverse_.resize(static_cast<std::size_t>(n));
  }

  /// The row-major lower triangle, to be filled before factor().
  double* matrix() { return l_.data(); }

  /// Factorizes in place. @return false if a pivot is not positive and finite
  bool factor() {
    for (int r = 0; r < n_; ++r) {
      double* row = &l_[idx(r * n_)];
      for (int c = 0; c < r; ++c) {
        const double* other = &l_[idx(c * n_)];
        double sum = row[c];
        for (int k = 0; k < c; ++k) sum -= row[k] * other[k];
        row[c] = sum * inverse_[idx(c)];
      }
      double pivot = row[r];
      for (int k = 0; k < r; ++k) pivot -= row[k] * row[k];
      if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
      row[r] = std::sqrt(pivot);
      inverse_[idx(r)] = 1.0 / row[r];
    }
    return true;
  }

  /// y := L⁻¹ y.
  void solve_lower(double* y) const {
    for (int r = 0; r < n_; ++r) {
      const double* row = &l_[idx(r * n_)];
      double sum = y[r];
      for (int k = 0; k < r; ++k) sum -= row[k] * y[k];
      y[r] = sum * inverse_[idx(r)];
    }
  }

  /// y := (L Lᵀ)⁻¹ y.
  void solve(double* y) const {
    solve_lower(y);
    for (int r = n_ - 1; r >= 0; --r) {
      y[r] *= inverse_[idx(r)];
      const double* row = &l_[idx(r * n_)];
      for (int k = 0; k < r; ++k) y[k] -= row[k] * y[r];
    }
  }

 private:
  int n_ = 0;
  std::vector<double> l_, inverse_;
};

}  // namespace tern
