#include "executor/committed_trajectory.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tern {
namespace {

constexpr int kRestIntervals = 4;
constexpr Duration kRestInterval{250'000};

CubicPiece rest_piece(const Vec3& p, Duration duration) {
  CubicPiece piece{duration, PowerCubic::Zero()};
  piece.coefficients.col(3) = p;
  return piece;
}

/// The part [from, to) of a spline as pieces, rest after its end included. @pre start ≤ from < to
void append_pieces(const TimedSpline& timed, const ClampedSpline& spline, UTime from, UTime to,
                   std::vector<CubicPiece>& out) {
  const double interval_s = spline.interval_s();
  for (int j = 0; j < spline.intervals(); ++j) {
    const UTime begin = timed.start + timed.interval * j;
    const UTime a = std::max(from, begin);
    const UTime b = std::min(to, begin + timed.interval);
    if (a >= b) continue;
    const double u = (a - begin).seconds() / interval_s;
    // One second is 1/Δt in u: stretched by that, the parameter counts seconds from a.
    out.push_back({b - a, reparametrized(spline.power(j), u, u + 1.0 / interval_s)});
  }
  const UTime rest_from = std::max(from, timed.end());
  if (rest_from < to) out.push_back(rest_piece(timed.control_points.rightCols<1>(), to - rest_from));
}

}  // namespace

CommittedTrajectory::CommittedTrajectory(const Vec3& p, UTime from) {
  const ClampedSpline rest = at_rest(p, kRestIntervals, kRestInterval.seconds());
  segments_.push_back({TimedSpline{from, kRestInterval, rest.control_points()}, rest});
}

void CommittedTrajectory::splice(const TimedSpline& next) {
  const UTime newest = segments_.back().timed.start;
  if (next.start <= newest) {
    throw std::invalid_argument("splice: starts at " + std::to_string(next.start.us) + " us, not after " +
                                std::to_string(newest.us) + " us");
  }
  ClampedSpline spline = next.spline();
  if (!spline.ends_at_rest()) throw std::invalid_argument("splice: does not end at rest");
  segments_.push_back({next, std::move(spline)});
}

void CommittedTrajectory::drop_from(UTime t) {
  while (segments_.size() > 1 && segments_.back().timed.start >= t) segments_.pop_back();
}

std::size_t CommittedTrajectory::index_at(UTime t) const {
  std::size_t k = segments_.size() - 1;
  while (k > 0 && segments_[k].timed.start > t) --k;
  return k;
}

const TimedSpline& CommittedTrajectory::in_force_at(UTime t) const { return segments_[index_at(t)].timed; }

MotionSample CommittedTrajectory::sample(UTime t) const {
  const Segment& segment = segments_[index_at(t)];
  if (t < segment.timed.start) return MotionSample{.p = segment.timed.control_points.col(0)};
  return segment.spline.sample((t - segment.timed.start).seconds());
}

PiecewiseCubic CommittedTrajectory::pieces(UTime from, UTime to) const {
  if (from >= to) {
    throw std::invalid_argument("pieces: from " + std::to_string(from.us) + " us is not before " +
                                std::to_string(to.us));
  }
  PiecewiseCubic result{from, {}};
  const Segment& first = segments_.front();
  const UTime known_from = std::min(std::max(from, first.timed.start), to);
  if (from < known_from) result.pieces.push_back(rest_piece(first.timed.control_points.col(0), known_from - from));
  for (std::size_t k = index_at(from); k < segments_.size(); ++k) {
    const Segment& segment = segments_[k];
    const UTime a = std::max(known_from, segment.timed.start);
    const UTime b = k + 1 < segments_.size() ? std::min(to, segments_[k + 1].timed.start) : to;
    if (a < b) append_pieces(segment.timed, segment.spline, a, b, result.pieces);
  }
  return result;
}

void CommittedTrajectory::forget_before(UTime t) {
  segments_.erase(segments_.begin(), segments_.begin() + static_cast<std::ptrdiff_t>(index_at(t)));
}

}  // namespace tern
