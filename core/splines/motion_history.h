// A past motion as consecutive cubic pieces. New pieces are appended at one end, old ones are forgotten at the other.
#pragma once

#include <deque>

#include "core/splines/piecewise_cubic.h"

namespace tern {

/// A motion up to the time end(). Before its oldest piece it is at rest: at the start of that piece, or at the initial
/// position if there is no piece.
class MotionHistory {
 public:
  /// Starts with the motion that is at rest at p (W, m) until `end`.
  MotionHistory(const Vec3& p, UTime end) : p_(p), end_(end) {}

  /// Appends a piece that starts at end(). It may start at another position than the last piece ends.
  /// @throws std::invalid_argument unless its duration is > 0
  void append(const CubicPiece& piece);
  /// Appends all pieces of `motion`. @throws std::invalid_argument unless it starts at end()
  void append(const PiecewiseCubic& motion);

  [[nodiscard]] UTime end() const { return end_; }
  /// Returns the motion at t ≤ end(): at a joint that of the later piece, at end() that of the last one. O(log
  /// pieces).
  /// @throws std::invalid_argument if t > end()
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// Returns the pieces between two times; the first and the last one are cut.
  /// @throws std::invalid_argument unless from < to ≤ end()
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const;
  /// Forgets all pieces that end at or before t, except the last piece of all.
  void forget_before(UTime t);

 private:
  struct Flown {
    UTime start;
    CubicPiece piece;
  };
  /// Returns the index of the piece at time t. @pre a piece starts at or before t
  [[nodiscard]] std::size_t index_at(UTime t) const;

  Vec3 p_;
  UTime end_;
  std::deque<Flown> flown_;
};

}  // namespace tern
