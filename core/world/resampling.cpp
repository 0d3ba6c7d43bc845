#include "core/world/resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "core/wire/message_limits.h"

namespace tern {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Gauss-Legendre nodes and weights of order 4 on [0, 1] (M. Abramowitz, I. A. Stegun, table 25.4).
struct GaussNode {
  double u, weight;
};
constexpr std::array<GaussNode, 4> kGauss{{{0.06943184420297371, 0.17392742256872693},
                                           {0.33000947820757187, 0.32607257743127307},
                                           {0.66999052179242813, 0.32607257743127307},
                                           {0.93056815579702629, 0.17392742256872693}}};

/// The shifted Legendre polynomials P_0 … P_3 at u ∈ [0, 1].
std::array<double, 4> legendre(double u) {
  return {1.0, 2.0 * u - 1.0, (6.0 * u - 6.0) * u + 1.0, ((20.0 * u - 30.0) * u + 12.0) * u - 1.0};
}

/// The pieces [first, last] of the track and the cubic that replaces them.
struct Run {
  CubicPiece fit;
  Vec3 error = Vec3::Zero();  // upper bound of |fit − original| per axis
  std::size_t first = 0, last = 0;
  std::size_t previous = kNone, next = kNone;
  std::uint32_t version = 0;
};

bool fits_a_message(const PowerCubic& c) {
  return c.col(0).cwiseAbs().maxCoeff() <= kMaxJerk && c.col(1).cwiseAbs().maxCoeff() <= kMaxAcceleration &&
         c.col(2).cwiseAbs().maxCoeff() <= kMaxSpeed && c.col(3).cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

/// Returns the least-squares cubic over two consecutive pieces.
CubicPiece least_squares(const CubicPiece& a, const CubicPiece& b) {
  const Duration whole = a.duration + b.duration;
  const double h = whole.seconds();
  // Relative to the first position, so that a track far from the origin keeps its digits.
  const Vec3 origin = a.coefficients.col(3);
  Eigen::Matrix<double, 3, 4> moments = Eigen::Matrix<double, 3, 4>::Zero();
  double before = 0.0;
  for (const CubicPiece* part : {&a, &b}) {
    const double length = part->duration.seconds();
    for (const GaussNode& node : kGauss) {
      const Vec3 p = sample_cubic(part->coefficients, node.u * length).p - origin;
      const std::array<double, 4> basis = legendre((before + node.u * length) / h);
      for (std::size_t k = 0; k < basis.size(); ++k)
        moments.col(static_cast<Eigen::Index>(k)) += node.weight * length / h * basis[k] * p;
    }
    before += length;
  }
  const Vec3 l0 = moments.col(0), l1 = 3.0 * moments.col(1), l2 = 5.0 * moments.col(2), l3 = 7.0 * moments.col(3);
  CubicPiece piece;
  piece.duration = whole;
  piece.coefficients.col(0) = 20.0 * l3 / (h * h * h);
  piece.coefficients.col(1) = (6.0 * l2 - 30.0 * l3) / (h * h);
  piece.coefficients.col(2) = (2.0 * l1 - 6.0 * l2 + 12.0 * l3) / h;
  piece.coefficients.col(3) = origin + l0 - l1 + l2 - l3;
  if (!fits_a_message(piece.coefficients)) {
    piece.coefficients.setZero();
    piece.coefficients.col(3) = origin + l0;
  }
  return piece;
}

/// Returns the largest |q(begin + τ) − p(τ)| per axis for τ ∈ [0, h].
Vec3 deviation(const PowerCubic& q, const PowerCubic& p, double begin_s, double h_s) {
  const MotionSample at = sample_cubic(q, begin_s);
  PowerCubic difference;
  difference.col(0) = q.col(0) - p.col(0);
  difference.col(1) = 0.5 * at.a - p.col(1);
  difference.col(2) = at.v - p.col(2);
  difference.col(3) = at.p - p.col(3);
  const Box box = cubic_bounds(difference, 0.0, h_s);
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
}

/// Returns Σ |c_k| t^k per axis, a bound of every term of an evaluation up to t.
Vec3 magnitude(const PowerCubic& c, double t_s) {
  const PowerCubic a = c.cwiseAbs();
  return ((a.col(0) * t_s + a.col(1)) * t_s + a.col(2)) * t_s + a.col(3);
}

class Merger {
 public:
  explicit Merger(const Track& track) : track_(track), left_(track.motion.pieces.size()) {
    runs_.resize(left_);
    for (std::size_t k = 0; k < left_; ++k) {
      runs_[k].fit = track.motion.pieces[k];
      runs_[k].first = runs_[k].last = k;
      runs_[k].previous = k == 0 ? kNone : k - 1;
      runs_[k].next = k + 1 == left_ ? kNone : k + 1;
    }
    for (std::size_t k = 0; k + 1 < left_; ++k) propose(k);
  }

  Track reduced_to(std::size_t max_pieces) {
    while (left_ > max_pieces) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      const auto [cost, length, at, version, next_version] = best;
      const std::size_t next = runs_[at].next;
      if (version != runs_[at].version || next == kNone || next_version != runs_[next].version) continue;
      merge(at);
    }
    return built();
  }

 private:
  // (error, pieces, run, its version, the next run's version)
  using Candidate = std::tuple<double, std::size_t, std::size_t, std::uint32_t, std::uint32_t>;

  static Vec3 error_of(const CubicPiece& fit, const Run& a, const Run& b) {
    const double length_a = a.fit.duration.seconds();
    const Vec3 of_a = a.error + deviation(fit.coefficients, a.fit.coefficients, 0.0, length_a);
    const Vec3 of_b = b.error + deviation(fit.coefficients, b.fit.coefficients, length_a, b.fit.duration.seconds());
    return of_a.cwiseMax(of_b);
  }

  void propose(std::size_t at) {
    const Run& a = runs_[at];
    if (a.next == kNone) return;
    const Run& b = runs_[a.next];
    const Vec3 error = error_of(least_squares(a.fit, b.fit), a, b);
    candidates_.emplace(error.maxCoeff(), b.last - a.first + 1, at, a.version, b.version);
  }

  void merge(std::size_t at) {
    Run& a = runs_[at];
    Run& b = runs_[a.next];
    const CubicPiece fit = least_squares(a.fit, b.fit);
    a.error = error_of(fit, a, b);
    a.fit = fit;
    a.last = b.last;
    ++a.version;
    ++b.version;
    a.next = b.next;
    if (a.next != kNone) runs_[a.next].previous = at;
    --left_;
    propose(at);
    if (a.previous != kNone) propose(a.previous);
  }

  [[nodiscard]] Track built() const {
    Track result = track_;
    result.motion.pieces.clear();
    result.alpha.clear();
    result.shares.clear();
    for (std::size_t at = 0; at != kNone; at = runs_[at].next) {
      result.motion.pieces.push_back(runs_[at].fit);
      result.alpha.push_back(alpha_of(runs_[at]));
      if (!track_.shares.empty()) result.shares.push_back(shares_of(runs_[at], result.alpha.back()));
    }
    return result;
  }

  [[nodiscard]] Vec3 alpha_of(const Run& run) const {
    if (run.first == run.last) return track_.alpha[run.first];
    return alpha_at(run, 0);
  }

  /// Returns the run's α at each level, as shares of its α at the first level.
  [[nodiscard]] AlphaShares shares_of(const Run& run, const Vec3& alpha) const {
    if (run.first == run.last) return track_.shares[run.first];
    AlphaShares shares{};
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const Vec3 at_level = alpha_at(run, static_cast<int>(k) + 1);
      for (int axis = 0; axis < 3; ++axis) {
        shares[k][idx(axis)] =
            std::min(share_of(at_level[axis], alpha[axis]), k == 0 ? 1.0F : shares[k - 1][idx(axis)]);
      }
    }
    return shares;
  }

  [[nodiscard]] Vec3 alpha_at(const Run& run, int level) const {
    constexpr double kUnit = kResamplingUlps * std::numeric_limits<double>::epsilon();
    const PowerCubic& q = run.fit.coefficients;
    const Vec3 terms = magnitude(q, run.fit.duration.seconds());
    Vec3 alpha = Vec3::Zero();
    Duration since{};
    for (std::size_t k = run.first; k <= run.last; ++k) {
      const CubicPiece& original = track_.motion.pieces[k];
      const double h = original.duration.seconds();
      const Vec3 own = track_.alpha_at(k, level);
      const Vec3 rounding = kUnit * (terms + magnitude(original.coefficients, h) + own);
      alpha = alpha.cwiseMax(own + deviation(q, original.coefficients, since.seconds(), h) + rounding);
      since = since + original.duration;
    }
    return alpha;
  }

  const Track& track_;
  std::size_t left_;
  std::vector<Run> runs_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
};

}  // namespace

Track resampled(const Track& track, std::size_t max_pieces) {
  if (max_pieces < 1 || track.motion.pieces.empty()) {
    throw std::invalid_argument("a track of " + std::to_string(track.motion.pieces.size()) +
                                " pieces resampled to at most " + std::to_string(max_pieces));
  }
  if (track.kind == TrackKind::Static || track.motion.pieces.size() <= max_pieces) return track;
  return Merger(track).reduced_to(max_pieces);
}

}  // namespace tern
