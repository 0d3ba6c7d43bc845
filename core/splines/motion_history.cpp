#include "core/splines/motion_history.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tern {
namespace {

CubicPiece rest_piece(const Vec3& p, Duration duration) {
  CubicPiece piece{duration, PowerCubic::Zero()};
  piece.coefficients.col(3) = p;
  return piece;
}

}  // namespace

void MotionHistory::append(const CubicPiece& piece) {
  if (piece.duration <= Duration{}) {
    throw std::invalid_argument("a piece of " + std::to_string(piece.duration.us) + " us");
  }
  flown_.push_back({end_, piece});
  end_ = end_ + piece.duration;
}

void MotionHistory::append(const PiecewiseCubic& motion) {
  if (motion.start != end_) {
    throw std::invalid_argument("a motion starts at " + std::to_string(motion.start.us) +
                                " us, and the history ends at " + std::to_string(end_.us) + " us");
  }
  for (const CubicPiece& piece : motion.pieces) append(piece);
}

std::size_t MotionHistory::index_at(UTime t) const {
  const auto later = std::ranges::upper_bound(flown_, t, {}, &Flown::start);
  return idx(later - flown_.begin()) - 1;
}

MotionSample MotionHistory::sample(UTime t) const {
  if (t > end_) {
    throw std::invalid_argument("motion at " + std::to_string(t.us) + " us, after " + std::to_string(end_.us));
  }
  if (flown_.empty() || t < flown_.front().start) return MotionSample{.p = p_};
  const Flown& f = flown_[index_at(t)];
  return sample_cubic(f.piece.coefficients, (t - f.start).seconds());
}

PiecewiseCubic MotionHistory::pieces(UTime from, UTime to) const {
  if (from >= to || to > end_) {
    throw std::invalid_argument("motion from " + std::to_string(from.us) + " to " + std::to_string(to.us) +
                                " us, known until " + std::to_string(end_.us));
  }
  PiecewiseCubic result{from, {}};
  const UTime first = flown_.empty() ? end_ : flown_.front().start;
  if (from < first) result.pieces.push_back(rest_piece(p_, std::min(first, to) - from));
  if (to <= first) return result;
  for (std::size_t k = index_at(std::max(from, first)); k < flown_.size() && flown_[k].start < to; ++k) {
    const auto& [start, piece] = flown_[k];
    const UTime a = std::max(from, start), b = std::min(to, start + piece.duration);
    if (a == start) {
      result.pieces.push_back({b - a, piece.coefficients});
    } else {
      const double t_s = (a - start).seconds();
      result.pieces.push_back({b - a, reparametrized(piece.coefficients, t_s, t_s + 1.0)});
    }
  }
  return result;
}

void MotionHistory::forget_before(UTime t) {
  while (flown_.size() > 1 && flown_[1].start <= t) {
    flown_.pop_front();
    p_ = flown_.front().piece.coefficients.col(3);
  }
}

}  // namespace tern
