#include "core/world/track.h"

#include "core/world/alpha_share.h"

namespace tern {

Box Track::bounds(UTime t0, UTime t1) const { return bounds_at(*this, t0, t1, {}, {0, motion.start}); }

Box bounds_at(const Track& track, UTime t0, UTime t1, const AlphaShare& share, PiecewiseCubic::Located first) {
  const PiecewiseCubic& motion = track.motion;
  const auto half = [&](std::size_t piece) -> Vec3 { return track.half_extents + share.of(track, piece); };
  if (track.kind == TrackKind::Static) return box_around(motion.pieces.front().coefficients.col(3), half(0));
  Box box;
  UTime piece_start = first.start;
  for (std::size_t k = first.index; k < motion.pieces.size() && piece_start <= t1; ++k) {
    const CubicPiece& piece = motion.pieces[k];
    const UTime piece_end = piece_start + piece.duration;
    const UTime from = std::max(piece_start, t0);
    const UTime to = std::min(piece_end, t1);
    if (from <= to) {
      const Box swept = cubic_bounds(piece.coefficients, (from - piece_start).seconds(), (to - piece_start).seconds());
      box.extend(grown(swept, half(k)));
    }
    piece_start = piece_end;
  }
  if (const UTime end = piece_start; t1 > end) {
    const Vec3 p = motion.sample(end).p;
    box.extend(box_around(p, half(track.alpha.size() - 1) + Vec3::Constant(track.top_speed * (t1 - end).seconds())));
  }
  if (t0 < motion.start) {
    const Vec3 p = motion.sample(motion.start).p;
    const double back_s = (motion.start - t0).seconds();
    box.extend(box_around(p, half(0) + Vec3::Constant(track.top_speed * back_s)));
  }
  return box;
}

}  // namespace tern
