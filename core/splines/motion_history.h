// What moved how until now: consecutive cubic pieces that grow at one end and are forgotten at the other.
#pragma once

#include <deque>

#include "core/splines/piecewise_cubic.h"

namespace tern {

/// A motion from the far past to end(): at rest at its first place until its first piece. Times before what was
/// forgotten read as at rest at the oldest place that is known.
class MotionHistory {
 public:
  /// At rest at p (W, m) until `end`.
  MotionHistory(const Vec3& p, UTime end) : p_(p), end_(end) {}

  /// It went on by `piece` from end() on. It may jump: whether it may is the caller's rule.
  /// @throws std::invalid_argument unless its duration is > 0.
  void append(const CubicPiece& piece);
  /// The same for each piece of `motion`. @throws std::invalid_argument unless it starts at end().
  void append(const PiecewiseCubic& motion);

  [[nodiscard]] UTime end() const { return end_; }
  /// At t ≤ end(), O(log pieces); at a joint the later piece's, at end() the last one's.
  /// @throws std::invalid_argument after end().
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// The pieces between two times, the first and the last one cut. @throws std::invalid_argument unless from < to ≤
  /// end().
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const;
  /// Forgets the pieces that end at or before t, but the last.
  void forget_before(UTime t);

 private:
  struct Flown {
    UTime start;
    CubicPiece piece;
  };
  /// The index of the piece that holds t. @pre there is a piece that starts at or before t
  [[nodiscard]] std::size_t index_at(UTime t) const;

  Vec3 p_;
  UTime end_;
  std::deque<Flown> flown_;
};

}  // namespace tern
